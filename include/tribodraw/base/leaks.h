#ifndef tribodraw_base_leaks_h
#define tribodraw_base_leaks_h

#if defined(__SANITIZE_ADDRESS__)
#  include <sanitizer/lsan_interface.h>
#endif

namespace tribodraw
{
  /// Memory that is never given back, looked for by the leak sanitizer (cmake -DTRIBODRAW_SANITIZE=ON; otherwise nothing
  /// happens here). What MPI takes at its start and what its plugins forget is not ours.
  namespace leaks
  {
    /// What is allocated in its life is not looked for.
    class Ignored
    {
    public:
      Ignored(const Ignored &)            = delete;
      Ignored &operator=(const Ignored &) = delete;
#if defined(__SANITIZE_ADDRESS__)
      Ignored() { __lsan_disable(); }
      ~Ignored() { __lsan_enable(); }
#else
      Ignored() {}
      ~Ignored() {}
#endif
    };

    /// To be called before MPI ends: it unloads its plugins, and what they keep would then look lost. Ends the process
    /// with a report if something was lost.
    inline void
    check()
    {
#if defined(__SANITIZE_ADDRESS__)
      __lsan_do_leak_check();
#endif
    }
  } // namespace leaks
} // namespace tribodraw

#endif
