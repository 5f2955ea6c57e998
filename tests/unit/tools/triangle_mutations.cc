// Damaged files of triangles: each is refused with a message that names the file and the reason, or it is read as a
// surface whose distances are finite. This program counts every `new`.
#include "triangle_samples.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/tools/smooth_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace
{
  std::atomic<std::size_t> live{ 0 }, highest{ 0 };
}

#if !defined(__SANITIZE_ADDRESS__)
void *
operator new(std::size_t n)
{
  void *const block = std::malloc(n == 0 ? 1 : n);
  if (!block)
    throw std::bad_alloc();
  const std::size_t now  = live += malloc_usable_size(block);
  std::size_t       peak = highest;
  while (now > peak && !highest.compare_exchange_weak(peak, now))
    ;
  return block;
}
void
operator delete(void *block) noexcept
{
  if (block)
    live -= malloc_usable_size(block);
  std::free(block);
}
void
operator delete(void *block, std::size_t) noexcept
{
  operator delete(block);
}
#endif

using namespace tribodraw;

namespace
{
  constexpr int mutants_of_a_format = 400; // 250 are asked for

  class Mutator
  {
  public:
    explicit Mutator(const unsigned seed) : engine(seed) {}

    std::string
    mutant(std::string text, const bool is_text)
    {
      for (std::size_t n = 1 + below(3); n > 0 && !text.empty(); --n)
        is_text &&below(2) == 0 ? replace_word(text) : change(text);
      return text;
    }

  private:
    std::mt19937 engine;

    std::size_t
    below(const std::size_t n)
    {
      return n == 0 ? 0 : engine() % n;
    }
    void
    change(std::string &text)
    {
      const std::size_t at = below(text.size()), length = 1 + below(60);
      switch (below(7))
        {
        case 0: // one bit
          text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
          break;
        case 1: // one byte
          text[at] = static_cast<char>(below(256));
          break;
        case 2: // lost
          text.erase(at, length);
          break;
        case 3: // doubled
          text.insert(at, text.substr(at, length));
          break;
        case 4: // the end is missing
          text.resize(at);
          break;
        case 5: // zeros or ones of broken storage
          std::fill_n(text.begin() + static_cast<std::ptrdiff_t>(at), std::min(length, text.size() - at),
                      below(2) ? '\0' : '\xff');
          break;
        default: // the number of triangles
          text.replace(std::min<std::size_t>(80, text.size()), 4, std::string("\xff\xff\xff\x7f", 4));
        }
    }
    void
    replace_word(std::string &text)
    {
      static const char *const words[]
          = { "nan", "inf", "1e999", "-1e300", "0", "99999999999999999999", "x", "", "-1", "vertex", "f", "endsolid" };
      const std::size_t begin = text.find_first_not_of(" \n", below(text.size()));
      if (begin == std::string::npos)
        return;
      const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
      text.replace(begin, end - begin, words[below(sizeof(words) / sizeof(words[0]))]);
    }
  };

  struct Count
  {
    int refused = 0, read = 0;
  };

  /// @return what is wrong with how the file was treated, or nothing.
  std::string
  judge(const std::string &content, const std::string &extension, Count &count)
  {
    const triangle_samples::File file(content, extension);
    const std::size_t            before = live;
    highest                             = before;
    std::string wrong;
    try
      {
        SmoothSurface::Options options;
        options.keep_sharp_edges = true;
        const SmoothSurface surface(read_triangles(file.path, 1), options);
        ++count.read;
        for (const Eigen::Vector3d &x :
             { Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(25, 10, 5), Eigen::Vector3d(200, -300, 100) })
          {
            const ToolDistance d = surface.distance(x);
            if (!std::isfinite(d.distance) || !(std::abs(d.normal.norm() - 1) < 1e-9) || !d.curvature.allFinite())
              wrong = "a distance is not finite";
          }
      }
    catch (const InputError &e)
      {
        ++count.refused;
        if (std::string(e.what()).find(file.path.filename().string()) == std::string::npos)
          wrong = std::string("the file is not named: ") + e.what();
      }
    catch (const std::exception &e)
      {
        wrong = std::string("other exception: ") + e.what();
      }
    // Per triangle some 0.6 kB in the end and, while normals are sought, some 2 kB more; a triangle takes at least 12
    // bytes of a file.
    const std::size_t allowed = (1 << 20) + 300 * content.size();
    if (highest - before > allowed)
      wrong = "memory: " + std::to_string(highest - before) + " bytes for a file of " + std::to_string(content.size());
    return wrong;
  }

  void
  mutate(const std::string &content, const std::string &extension, const bool is_text)
  {
    Mutator mutator(20260102);
    Count   count;
    for (int i = 0; i < mutants_of_a_format; ++i)
      {
        const std::string wrong = judge(mutator.mutant(content, is_text), extension, count);
        EXPECT_EQ(wrong, "") << "mutant " << i;
      }
    std::printf("%d mutants: %d refused, %d read as another surface\n", mutants_of_a_format, count.refused, count.read);
    EXPECT_GT(count.refused, mutants_of_a_format / 4);
    EXPECT_EQ(count.refused + count.read, mutants_of_a_format);
  }
} // namespace

TEST(TriangleMutations, AsciiStl)
{
  mutate(triangle_samples::ascii_stl(triangle_samples::punch()), ".stl", true);
}

TEST(TriangleMutations, BinaryStl)
{
  mutate(triangle_samples::binary_stl(triangle_samples::punch()), ".stl", false);
}

TEST(TriangleMutations, Obj)
{
  TriangleMesh mesh = triangle_samples::punch();
  mesh.normals.assign(mesh.triangles.size(), {});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (auto &n : mesh.normals[t])
      n = (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)).normalized();
  mutate(triangle_samples::obj(mesh, true), ".obj", true);
}

TEST(TriangleMutations, TruncationAtEveryPlace)
{
  const std::string ascii  = triangle_samples::ascii_stl(triangle_samples::punch()),
                    binary = triangle_samples::binary_stl(triangle_samples::punch());
  Count count;
  for (const std::string &content : { ascii, binary })
    for (std::size_t n = 0; n < content.size() - 10; n += 1 + content.size() / 150)
      EXPECT_EQ(judge(content.substr(0, n), ".stl", count), "") << n;
  EXPECT_EQ(count.read, 0); // both formats say where they end
}
