#ifndef tribodraw_source_surface_zip_archive_h
#define tribodraw_source_surface_zip_archive_h

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tribodraw
{
  /// Read-only zip archive in memory. Entries are unpacked in small pieces; what an entry claims to hold is compared
  /// with what its compressed size allows. All errors are InputError and name file and entry.
  class ZipArchive
  {
  public:
    /// @param content must live as long as the archive.
    ZipArchive(std::string_view content, std::string file);

    struct Entry
    {
      std::uint64_t index = 0;
      std::size_t   bytes = 0; ///< unpacked, as the archive says
      std::string   name;
    };

    std::optional<Entry> find(const std::string &name) const;
    /// Whole entry. Throws InputError if it is larger than @p most_bytes.
    std::string read(const Entry &entry, std::size_t most_bytes) const;

    /// Goes through an entry.
    class Stream
    {
    public:
      Stream(const ZipArchive &archive, const Entry &entry);
      /// Exactly @p n bytes.
      void read(char *target, std::size_t n);
      /// The entry must be at its end and its checksum right.
      void finish();

    private:
      const ZipArchive                       &archive;
      Entry                                   entry;
      std::unique_ptr<void, void (*)(void *)> handle;
      std::size_t                             position = 0;
    };

    [[noreturn]] void fail(const std::string &what, const std::string &entry, const std::string &value = "",
                           const std::string &allowed = "", const std::string &hint = "") const;

  private:
    std::string           file;
    std::size_t           n_bytes;
    std::shared_ptr<void> handle;
  };

  /// MD5 digest as 32 hexadecimal digits, small letters, of text given piece by piece.
  class Md5
  {
  public:
    Md5();
    ~Md5();
    void        add(const char *bytes, std::size_t n);
    std::string digest();

  private:
    struct State;
    std::unique_ptr<State> state;
  };
} // namespace tribodraw

#endif
