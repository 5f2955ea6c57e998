/* A library to be preloaded (LD_PRELOAD) that interrupts the writing of result files, for kill_test.py.
 *
 * Each file that the program writes gives three events: its content is being written, it is about to get its name, it has got
 * its name. INTERRUPT_AT=n chooses the n-th of them. INTERRUPT_HOW=kill: SIGKILL there, in the first case after half of the
 * content; INTERRUPT_HOW=full: from there on the disk is full; INTERRUPT_HOW=count: the number of events is written to the
 * file INTERRUPT_COUNT.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static long  n_events = 0;
static FILE *partial  = NULL;

static int
is_partial(const char *name)
{
  const char  *end    = ".partial";
  const size_t length = strlen(name);
  return length > strlen(end) && strcmp(name + length - strlen(end), end) == 0;
}

/* 1: kill now, 2: the disk is full, 0: go on. */
static int
event(void)
{
  const char *at = getenv("INTERRUPT_AT"), *how = getenv("INTERRUPT_HOW");
  ++n_events;
  if (how && strcmp(how, "count") == 0)
    {
      FILE *(*real)(const char *, const char *) = (FILE * (*)(const char *, const char *)) dlsym(RTLD_NEXT, "fopen");
      FILE *out                                 = real(getenv("INTERRUPT_COUNT"), "w");
      if (out)
        {
          fprintf(out, "%ld\n", n_events);
          fclose(out);
        }
      return 0;
    }
  if (!at || !how || n_events < atol(at))
    return 0;
  return strcmp(how, "kill") == 0 ? 1 : 2;
}

FILE *
fopen(const char *name, const char *mode)
{
  FILE *(*real)(const char *, const char *) = (FILE * (*)(const char *, const char *)) dlsym(RTLD_NEXT, "fopen");
  FILE *stream                              = real(name, mode);
  if (stream && mode[0] == 'w' && is_partial(name))
    partial = stream;
  return stream;
}

size_t
fwrite(const void *data, size_t size, size_t count, FILE *stream)
{
  size_t (*real)(const void *, size_t, size_t, FILE *)
      = (size_t(*)(const void *, size_t, size_t, FILE *)) dlsym(RTLD_NEXT, "fwrite");
  const int what = stream == partial && partial ? event() : 0;
  if (what == 0)
    return real(data, size, count, stream);
  const size_t written = real(data, size, count / 2, stream);
  fflush(stream);
  if (what == 1)
    raise(SIGKILL);
  errno = ENOSPC;
  return written;
}

int
rename(const char *from, const char *to)
{
  int (*real)(const char *, const char *) = (int (*)(const char *, const char *)) dlsym(RTLD_NEXT, "rename");
  if (!is_partial(from))
    return real(from, to);
  if (event() == 1)
    raise(SIGKILL);
  const int result = real(from, to);
  if (event() == 1)
    raise(SIGKILL);
  return result;
}
