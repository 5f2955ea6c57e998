#ifndef tribodraw_source_surface_text_tools_h
#define tribodraw_source_surface_text_tools_h

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tribodraw
{
  /// Without blanks, tabulators and carriage returns at its ends.
  std::string_view trimmed(std::string_view text);
  std::string      lower(std::string_view text);
  std::string_view without_byte_order_mark(std::string_view content);

  /// The first characters of a hostile text, printable: for messages and descriptions.
  std::string excerpt(std::string_view text, std::size_t length = 40);

  /// What stands for a point that was not measured: nothing, `bad`, `nan`, `***`, `---`, in any case of letters.
  bool is_missing_mark(std::string_view field);

  /// The whole field as a finite number, or nothing. @p decimal_comma: a comma is read as a decimal point.
  std::optional<double> parse_finite(std::string_view field, bool decimal_comma = false);
  /// As parse_finite(), but the marks of missing points give NaN.
  std::optional<double> parse_height(std::string_view field, bool decimal_comma = false);
  /// The whole field as a count, or nothing.
  std::optional<std::size_t> parse_count(std::string_view field);

  /// Cuts a text at line ends and counts the lines.
  class Lines
  {
  public:
    explicit Lines(std::string_view content) : rest(content) {}

    bool next(std::string_view &line);
    /// Number of the line that next() gave last, from 1.
    std::size_t
    number() const
    {
      return count;
    }
    /// False if the line that next() gave last was ended by the end of the file.
    bool
    complete() const
    {
      return ended;
    }

  private:
    std::string_view rest;
    std::size_t      count = 0;
    bool             ended = true;
  };

  /// How the numbers of a text file are separated and whether they have decimal commas, judged by one line: `;`, else
  /// a tabulator, else `,`, else blanks. Commas are decimal commas if something else separates.
  struct Separation
  {
    char separator     = 0; ///< 0: blanks and tabulators
    bool decimal_comma = false;
  };
  Separation separation_of(std::string_view line);

  /// Goes through the fields of a line without keeping them.
  class Fields
  {
  public:
    Fields(std::string_view line, const Separation &separation);
    bool next(std::string_view &field);

  private:
    std::string_view rest;
    char             separator;
    bool             more;
  };
} // namespace tribodraw

#endif
