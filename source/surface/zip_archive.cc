#include "zip_archive.h"

#include <tribodraw/base/errors.h>

#include <algorithm>
#include <boost/uuid/detail/md5.hpp>
#include <zip.h>

namespace tribodraw
{
  namespace
  {
    // Deflate cannot shrink anything more than that.
    constexpr std::size_t most_compression = 1032;

    zip_t *
    as_zip(const std::shared_ptr<void> &handle)
    {
      return static_cast<zip_t *>(handle.get());
    }

    std::string
    text_of(zip_error_t *error)
    {
      std::string text = zip_error_strerror(error);
      zip_error_fini(error);
      return text;
    }
  } // namespace

  ZipArchive::ZipArchive(std::string_view content, std::string file_name)
      : file(std::move(file_name)), n_bytes(content.size())
  {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t *source = zip_source_buffer_create(content.data(), content.size(), 0, &error);
    if (!source)
      throw InputError(describe_error("X3P: cannot open the archive (" + text_of(&error) + ").", file));
    zip_t *archive = zip_open_from_source(source, ZIP_RDONLY, &error);
    if (!archive)
      {
        zip_source_free(source);
        throw InputError(describe_error("X3P: this is no complete zip archive (" + text_of(&error) + ").",
                                        file + ", byte 0 to " + std::to_string(n_bytes), "", "",
                                        "A truncated file lacks the list of entries at its end."));
      }
    zip_error_fini(&error);
    handle = std::shared_ptr<void>(archive, [](void *a) { zip_discard(static_cast<zip_t *>(a)); });
  }

  void
  ZipArchive::fail(const std::string &what, const std::string &entry, const std::string &value,
                   const std::string &allowed, const std::string &hint) const
  {
    throw InputError(describe_error("X3P: " + what + ".", file + ", " + entry, value, allowed, hint));
  }

  std::optional<ZipArchive::Entry>
  ZipArchive::find(const std::string &name) const
  {
    const auto index = zip_name_locate(as_zip(handle), name.c_str(), 0);
    if (index < 0)
      return {};
    zip_stat_t status;
    zip_stat_init(&status);
    if (zip_stat_index(as_zip(handle), static_cast<zip_uint64_t>(index), 0, &status) != 0
        || (status.valid & ZIP_STAT_SIZE) == 0 || (status.valid & ZIP_STAT_COMP_SIZE) == 0)
      fail("the archive does not state the size of an entry", name);
    if (status.comp_size > n_bytes || status.size / most_compression > status.comp_size)
      fail("an entry claims to hold more than is possible", name, std::to_string(status.size) + " bytes",
           "at most " + std::to_string(most_compression) + " times its compressed size of "
               + std::to_string(status.comp_size));
    return Entry{ static_cast<std::uint64_t>(index), static_cast<std::size_t>(status.size), name };
  }

  std::string
  ZipArchive::read(const Entry &entry, std::size_t most_bytes) const
  {
    if (entry.bytes > most_bytes)
      fail("an entry is too long", entry.name, std::to_string(entry.bytes) + " bytes",
           "at most " + std::to_string(most_bytes));
    std::string content(entry.bytes, '\0');
    Stream      stream(*this, entry);
    stream.read(content.data(), content.size());
    stream.finish();
    return content;
  }

  ZipArchive::Stream::Stream(const ZipArchive &parent, const Entry &what)
      : archive(parent), entry(what), handle(zip_fopen_index(as_zip(parent.handle), what.index, 0),
                                             [](void *f) { zip_fclose(static_cast<zip_file_t *>(f)); })
  {
    if (!handle)
      archive.fail("cannot unpack an entry (" + std::string(zip_strerror(as_zip(parent.handle))) + ")", entry.name);
  }

  void
  ZipArchive::Stream::read(char *target, std::size_t n)
  {
    while (n > 0)
      {
        const auto got = zip_fread(static_cast<zip_file_t *>(handle.get()), target, n);
        if (got <= 0)
          archive.fail(got == 0 ? "an entry ends too early"
                                : "an entry is damaged ("
                                      + std::string(zip_file_strerror(static_cast<zip_file_t *>(handle.get()))) + ")",
                       entry.name + ", byte " + std::to_string(position), std::to_string(n) + " bytes are missing");
        target += got;
        n -= static_cast<std::size_t>(got);
        position += static_cast<std::size_t>(got);
      }
  }

  void
  ZipArchive::Stream::finish()
  {
    char       one;
    const auto got = zip_fread(static_cast<zip_file_t *>(handle.get()), &one, 1);
    if (got != 0)
      archive.fail(got > 0 ? "an entry is longer than the archive says"
                           : "an entry is damaged ("
                                 + std::string(zip_file_strerror(static_cast<zip_file_t *>(handle.get()))) + ")",
                   entry.name + ", byte " + std::to_string(position));
  }

  struct Md5::State
  {
    boost::uuids::detail::md5 md5;
  };

  Md5::Md5() : state(std::make_unique<State>())
  {
  }
  Md5::~Md5() = default;

  void
  Md5::add(const char *bytes, std::size_t n)
  {
    state->md5.process_bytes(bytes, n);
  }

  std::string
  Md5::digest()
  {
    boost::uuids::detail::md5::digest_type digest;
    state->md5.get_digest(digest);
    static_assert(sizeof(digest) == 16);
    // Bytes in the order of the digest, or, in older versions of Boost, numbers whose highest byte comes first.
    std::string text;
    for (const auto word : digest)
      for (int shift = 8 * static_cast<int>(sizeof(word)) - 4; shift >= 0; shift -= 4)
        text += "0123456789abcdef"[(word >> shift) & 15];
    return text;
  }
} // namespace tribodraw
