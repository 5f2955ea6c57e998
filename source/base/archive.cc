#include <tribodraw/base/archive.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>

#include <zlib.h>

#include <cstring>

namespace tribodraw
{
  namespace
  {
    const std::string magic = "TRIBODRAW-ARCHIVE 1\n";

    void append_number(std::string &out, const std::uint64_t value)
    {
      out.append(reinterpret_cast<const char *>(&value), sizeof(value));
    }

    void append_text(std::string &out, const std::string &text)
    {
      append_number(out, text.size());
      out += text;
    }

    /// Reads the body with a bounds check at every step: a hostile count never allocates.
    class Reader
    {
    public:
      Reader(const std::string &content, std::size_t start, std::string file_name)
        : body(content)
        , position(start)
        , file(std::move(file_name))
      {}
      bool at_end() const { return position == body.size(); }
      std::uint64_t number()
      {
        std::uint64_t value;
        std::memcpy(&value, take(sizeof(value)), sizeof(value));
        return value;
      }
      std::string text()
      {
        const auto size = number();
        return std::string(take(size), size);
      }
      std::vector<double> doubles()
      {
        const auto count = number();
        if (count > body.size() / sizeof(double))
          fail();
        std::vector<double> values(count);
        const char         *bytes = take(count * sizeof(double));
        if (count)
          std::memcpy(values.data(), bytes, count * sizeof(double));
        return values;
      }

    private:
      const char *take(const std::uint64_t size)
      {
        if (size > body.size() - position)
          fail();
        const char *at = body.data() + position;
        position += size;
        return at;
      }
      [[noreturn]] void fail() const
      {
        throw InputError(describe_error("the checkpoint ends in the middle of an item.", file));
      }
      const std::string &body;
      std::size_t        position;
      std::string        file;
    };
  } // namespace

  void
  Archive::put(const std::string &name, std::vector<double> values)
  {
    arrays[name] = std::move(values);
  }

  void
  Archive::put(const std::string &name, const double value)
  {
    arrays[name] = {value};
  }

  void
  Archive::put(const std::string &name, const std::string &text)
  {
    texts[name] = text;
  }

  bool
  Archive::has(const std::string &name) const
  {
    return arrays.count(name) || texts.count(name);
  }

  const std::vector<double> &
  Archive::numbers(const std::string &name, const std::size_t expected_size) const
  {
    const auto found = arrays.find(name);
    if (found == arrays.end())
      throw InputError("The checkpoint has no item '" + name + "'.");
    if (expected_size != SIZE_MAX && found->second.size() != expected_size)
      throw InputError(describe_error("the checkpoint does not fit this run (another mesh or model?).", "item '" + name + "'",
                                      std::to_string(found->second.size()) + " numbers", std::to_string(expected_size)));
    return found->second;
  }

  double
  Archive::number(const std::string &name) const
  {
    return numbers(name, 1)[0];
  }

  const std::string &
  Archive::text(const std::string &name) const
  {
    const auto found = texts.find(name);
    if (found == texts.end())
      throw InputError("The checkpoint has no item '" + name + "'.");
    return found->second;
  }

  void
  Archive::save(const std::filesystem::path &file) const
  {
    std::string body;
    for (const auto &[name, values] : arrays)
      {
        append_text(body, name);
        append_number(body, 0);
        append_number(body, values.size());
        body.append(reinterpret_cast<const char *>(values.data()), values.size() * sizeof(double));
      }
    for (const auto &[name, text] : texts)
      {
        append_text(body, name);
        append_number(body, 1);
        append_text(body, text);
      }
    std::string content = magic;
    append_number(content, crc32_z(0, reinterpret_cast<const Bytef *>(body.data()), body.size()));
    append_number(content, body.size());
    write_file(file, content + body, /*durable=*/true);
  }

  Archive
  Archive::load(const std::filesystem::path &file)
  {
    const std::string content = read_file(file);
    if (content.compare(0, magic.size(), magic) != 0 || content.size() < magic.size() + 16)
      throw InputError(describe_error("this is not a tribodraw checkpoint of version 1.", file.string()));
    Reader              reader(content, magic.size(), file.string());
    const std::uint64_t checksum = reader.number(), size = reader.number();
    const std::size_t   start = magic.size() + 16;
    if (content.size() - start != size)
      throw InputError(describe_error("the checkpoint is truncated.", file.string()));
    if (crc32_z(0, reinterpret_cast<const Bytef *>(content.data()) + start, size) != checksum)
      throw InputError(describe_error("the checkpoint is damaged (wrong checksum).", file.string()));
    Archive archive;
    while (!reader.at_end())
      {
        const std::string name = reader.text();
        if (reader.number() == 0)
          archive.arrays[name] = reader.doubles();
        else
          archive.texts[name] = reader.text();
      }
    return archive;
  }
} // namespace tribodraw
