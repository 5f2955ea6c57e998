#include <tribodraw/base/archive.h>
#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>

#include <gtest/gtest.h>

#include <unistd.h>

using namespace tribodraw;

namespace
{
  std::filesystem::path file_name()
  {
    return std::filesystem::temp_directory_path() / ("archive" + std::to_string(::getpid()));
  }
} // namespace

TEST(Archive, RoundTrip)
{
  Archive a;
  a.put("x", std::vector<double>{1. / 3., -0., 1e300});
  a.put("one", 2.5);
  a.put("empty", std::vector<double>{});
  a.put("text", std::string("wörd"));
  a.save(file_name());
  const Archive b = Archive::load(file_name());
  EXPECT_EQ(b.numbers("x", 3), a.numbers("x"));
  EXPECT_EQ(b.number("one"), 2.5);
  EXPECT_TRUE(b.numbers("empty").empty());
  EXPECT_EQ(b.text("text"), "wörd");
  EXPECT_THROW(b.numbers("y"), InputError);
  EXPECT_THROW(b.numbers("x", 4), InputError);
  std::filesystem::remove(file_name());
}

TEST(Archive, EveryFlippedByteAndEveryTruncationIsDetected)
{
  Archive a;
  a.put("x", std::vector<double>{1, 2, 3});
  a.put("t", std::string("abc"));
  a.save(file_name());
  const std::string content = read_file(file_name());
  for (std::size_t i = 0; i < content.size(); ++i)
    {
      std::string broken = content;
      broken[i]          = static_cast<char>(broken[i] ^ 0x10);
      write_file(file_name(), broken);
      EXPECT_THROW(Archive::load(file_name()), InputError) << "byte " << i;
      write_file(file_name(), content.substr(0, i));
      EXPECT_THROW(Archive::load(file_name()), InputError) << "cut at " << i;
    }
  std::filesystem::remove(file_name());
}
