#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <system_error>

namespace tribodraw
{
  namespace fs = std::filesystem;

  namespace
  {
    /// Remember the names of the folder's files on the disk. Not every file system can; the content is there either way.
    void sync_folder(const fs::path &folder)
    {
      const int handle = open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
      if (handle < 0)
        return;
      fsync(handle);
      close(handle);
    }
  } // namespace

  void
  write_file(const fs::path &file, const std::string &content, const bool durable)
  {
    fs::path temporary = file;
    temporary += partial_file_extension;
    const auto fail = [&](const std::string &doing) {
      const std::string reason = std::strerror(errno);
      std::error_code   ignored;
      fs::remove(temporary, ignored);
      throw InputError(describe_error("cannot " + doing + " (" + reason + ").", file.string(), "", "", "Choose another folder with --output or free some space."));
    };
    std::unique_ptr<std::FILE, int (*)(std::FILE *)> stream(std::fopen(temporary.c_str(), "wb"), &std::fclose);
    if (!stream)
      fail("create the file");
    if (std::fwrite(content.data(), 1, content.size(), stream.get()) != content.size())
      fail("write the file");
    if (durable && (std::fflush(stream.get()) != 0 || fsync(fileno(stream.get())) != 0))
      fail("write the file");
    if (std::fclose(stream.release()) != 0)
      fail("write the file");
    if (std::rename(temporary.c_str(), file.c_str()) != 0)
      fail("rename the finished file");
    if (durable)
      sync_folder(file.parent_path());
  }

  std::string
  read_file(const fs::path &file, const std::uintmax_t max_bytes)
  {
    std::error_code error;
    if (!fs::exists(file, error))
      throw InputError(describe_error("the file does not exist.", file.string()));
    if (!fs::is_regular_file(file, error))
      throw InputError(describe_error("this is not a regular file.", file.string()));
    const auto size = fs::file_size(file, error);
    if (error)
      throw InputError(describe_error("cannot read the file (" + error.message() + ").", file.string()));
    if (size > max_bytes)
      throw InputError(describe_error("the file is too large.", file.string(), std::to_string(size) + " bytes", "at most " + std::to_string(max_bytes) + " bytes"));
    std::ifstream in(file, std::ios::binary);
    std::string   content(size, '\0');
    if (!in || (size > 0 && !in.read(content.data(), static_cast<std::streamsize>(size))))
      throw InputError(describe_error("cannot read the file (no permission?).", file.string()));
    return content;
  }

  void
  prepare_output_folder(const fs::path &folder)
  {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder))
      throw InputError(describe_error("cannot create the output folder (" + (error ? error.message() : "a file is in the way") + ").",
                                      folder.string(), "", "", "Choose a writable folder with --output."));
    const fs::path probe = folder / ".writable";
    {
      std::ofstream out(probe);
      if (!out)
        throw InputError(describe_error("the output folder is not writable.", folder.string(), "", "", "Choose a writable folder with --output."));
    }
    fs::remove(probe, error);
    for (const auto &entry : fs::directory_iterator(folder, error))
      if (entry.path().extension() == partial_file_extension)
        fs::remove(entry.path(), error);
  }

  std::string
  hash_bytes(const void *data, const std::size_t size)
  {
    std::uint64_t hash  = 14695981039346656037ull;
    const auto   *bytes = static_cast<const unsigned char *>(data);
    for (std::size_t i = 0; i < size; ++i)
      hash = (hash ^ bytes[i]) * 1099511628211ull;
    char text[17];
    std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(hash));
    return text;
  }

  std::string
  hash_text(const std::string &content)
  {
    return hash_bytes(content.data(), content.size());
  }
} // namespace tribodraw
