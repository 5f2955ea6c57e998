#include "guarded_read.h"

#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <malloc.h>
#include <new>
#include <sys/resource.h>
#include <unistd.h>

namespace
{
  std::atomic<std::size_t> live{ 0 }, highest{ 0 };

#if !defined(__SANITIZE_ADDRESS__)
  void
  count(void *block)
  {
    const std::size_t now  = live += malloc_usable_size(block);
    std::size_t       peak = highest;
    while (now > peak && !highest.compare_exchange_weak(peak, now))
      ;
  }

  void *
  allocate(std::size_t n)
  {
    void *const block = std::malloc(n == 0 ? 1 : n);
    if (!block)
      throw std::bad_alloc();
    count(block);
    return block;
  }

  void
  release(void *block) noexcept
  {
    if (block)
      live -= malloc_usable_size(block);
    std::free(block);
  }
#endif
} // namespace

#if !defined(__SANITIZE_ADDRESS__)
void *
operator new(std::size_t n)
{
  return allocate(n);
}
void *
operator new[](std::size_t n)
{
  return allocate(n);
}
void
operator delete(void *block) noexcept
{
  release(block);
}
void
operator delete[](void *block) noexcept
{
  release(block);
}
void
operator delete(void *block, std::size_t) noexcept
{
  release(block);
}
void
operator delete[](void *block, std::size_t) noexcept
{
  release(block);
}
#endif

namespace guarded_read
{
  namespace
  {
    /// Limits the address space while it lives.
    class MemoryLimit
    {
    public:
      explicit MemoryLimit(std::size_t growth)
      {
#if !defined(__SANITIZE_ADDRESS__)
        std::size_t   pages = 0;
        std::ifstream statm("/proc/self/statm");
        statm >> pages;
        getrlimit(RLIMIT_AS, &before);
        rlimit limit   = before;
        limit.rlim_cur = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + growth;
        set            = pages > 0 && setrlimit(RLIMIT_AS, &limit) == 0;
#else
        (void)growth;
#endif
      }
      ~MemoryLimit()
      {
        if (set)
          setrlimit(RLIMIT_AS, &before);
      }
      MemoryLimit(const MemoryLimit &)            = delete;
      MemoryLimit &operator=(const MemoryLimit &) = delete;

    private:
      rlimit before{};
      bool   set = false;
    };
  } // namespace

  Outcome
  read(const std::string &content, const tribodraw::GivenScales &given)
  {
    const std::filesystem::path file
        = std::filesystem::temp_directory_path() / ("tribodraw_guarded_" + std::to_string(getpid()) + ".bin");
    tribodraw::write_file(file, content);
    Outcome outcome;
    // What earlier reads left in the allocator must not serve this one.
    malloc_trim(0);
    const std::size_t before = live;
    highest                  = before;
    {
      const MemoryLimit limit(content.size() + allowance);
      try
        {
          outcome.map = tribodraw::read_surface_file(file, given);
        }
      catch (const tribodraw::InputError &e)
        {
          outcome.message = e.what();
        }
      catch (const std::exception &e)
        {
          outcome.failure = std::string("other exception: ") + e.what();
        }
    }
    outcome.peak = highest - before;
    std::filesystem::remove(file);
    return outcome;
  }
} // namespace guarded_read
