#ifndef tribodraw_flow_factors_aligned_array_h
#define tribodraw_flow_factors_aligned_array_h

#include <cstddef>
#include <new>
#include <vector>

namespace tribodraw
{
  /// Allocator of memory that begins at a cache line. Vectors of the processor are as long as a line: read from within
  /// a line, each would need two.
  template <class T>
  struct CacheAligned
  {
    using value_type = T;
    static constexpr std::align_val_t line{ 64 };

    CacheAligned() = default;
    template <class Other>
    CacheAligned(const CacheAligned<Other> &)
    {
    }
    T *
    allocate(const std::size_t n)
    {
      return static_cast<T *>(::operator new(n * sizeof(T), line));
    }
    void
    deallocate(T *const place, std::size_t)
    {
      ::operator delete(place, line);
    }
    template <class Other>
    bool
    operator==(const CacheAligned<Other> &) const
    {
      return true;
    }
    template <class Other>
    bool
    operator!=(const CacheAligned<Other> &) const
    {
      return false;
    }
  };

  template <class T>
  using AlignedArray = std::vector<T, CacheAligned<T>>;
} // namespace tribodraw

#endif
