// SPDX-License-Identifier: GPL-3.0-or-later
// Preloaded (LD_PRELOAD) into a program, makes one call of the system fail: the one that ROOMCUT_FAIL names.
//
//   ROOMCUT_FAIL="KIND N"     the N-th call of this kind after the beginning of main() fails; KIND as in `names`; 0: none
//   ROOMCUT_FAIL="full N"     the N-th write and all that follow fail with "No space left on device"
//   ROOMCUT_FAIL_PROGRAM      only in the program of this name; empty: in all
//   ROOMCUT_FAIL_COUNT=FILE   appends "program KIND calls" for each kind when the program ends
//
// Calls of a library into itself do not pass here: what counts are those of the program, its libraries and HDF5's archive.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

enum Kind { WRITE, SYNC, RENAME, OPEN, FOLDER, TRUNCATE, TIMES, MAP, BIG, MEMORY, KINDS };
static const char *const names[KINDS] = {"write", "fsync", "rename", "open", "mkdir", "truncate", "times", "mmap", "big", "malloc"};
static const size_t big_allocation = 16384;  // bytes: buffers, tables, columns

static atomic_long calls[KINDS];
static atomic_int armed;
static long wanted = 0;
static enum Kind kind = KINDS;
static int full = 0;

// Whether this call is to fail; counts it.
static int fails(enum Kind which) {
  if (!atomic_load(&armed)) {
    return 0;
  }
  const long n = atomic_fetch_add(&calls[which], 1) + 1;
  return which == kind && (full ? n >= wanted : n == wanted) && wanted > 0;
}

// glibc's own allocator by its other names: dlsym() allocates.
extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);

static int no_memory(size_t size) {
  const int small = fails(MEMORY);
  const int large = size >= big_allocation && fails(BIG);
  if (small || large) {
    errno = ENOMEM;
  }
  return small || large;
}

void *malloc(size_t size) { return no_memory(size) ? NULL : __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return no_memory(count * size) ? NULL : __libc_calloc(count, size); }
void *realloc(void *old, size_t size) { return no_memory(size) ? NULL : __libc_realloc(old, size); }
void *memalign(size_t alignment, size_t size) { return no_memory(size) ? NULL : __libc_memalign(alignment, size); }
void *aligned_alloc(size_t alignment, size_t size) { return no_memory(size) ? NULL : __libc_memalign(alignment, size); }
int posix_memalign(void **out, size_t alignment, size_t size) {
  if (no_memory(size)) {
    return ENOMEM;
  }
  *out = __libc_memalign(alignment, size);
  return *out == NULL ? ENOMEM : 0;
}

#define REAL(name) ((__typeof__(&name))real(#name))
static void *real(const char *name) { return dlsym(RTLD_NEXT, name); }

// What is printed is no file: only descriptors beyond the standard ones count.
static int write_fails(int file) {
  if (file <= 2 || !fails(WRITE)) {
    return 0;
  }
  errno = ENOSPC;
  return 1;
}
ssize_t write(int file, const void *data, size_t size) { return write_fails(file) ? -1 : REAL(write)(file, data, size); }
ssize_t pwrite(int file, const void *data, size_t size, off_t at) { return write_fails(file) ? -1 : REAL(pwrite)(file, data, size, at); }
ssize_t pwrite64(int file, const void *data, size_t size, off64_t at) {
  return write_fails(file) ? -1 : REAL(pwrite64)(file, data, size, at);
}
ssize_t writev(int file, const struct iovec *parts, int count) { return write_fails(file) ? -1 : REAL(writev)(file, parts, count); }

static int refused(enum Kind which, int error) {
  if (!fails(which)) {
    return 0;
  }
  errno = error;
  return 1;
}
int fsync(int file) { return refused(SYNC, EIO) ? -1 : REAL(fsync)(file); }
int fdatasync(int file) { return refused(SYNC, EIO) ? -1 : REAL(fdatasync)(file); }
int rename(const char *from, const char *to) { return refused(RENAME, EIO) ? -1 : REAL(rename)(from, to); }
int ftruncate(int file, off_t size) { return refused(TRUNCATE, ENOSPC) ? -1 : REAL(ftruncate)(file, size); }
int ftruncate64(int file, off64_t size) { return refused(TRUNCATE, ENOSPC) ? -1 : REAL(ftruncate64)(file, size); }
int mkdir(const char *path, mode_t mode) { return refused(FOLDER, ENOSPC) ? -1 : REAL(mkdir)(path, mode); }
int utimensat(int folder, const char *path, const struct timespec times[2], int flags) {
  return refused(TIMES, EIO) ? -1 : REAL(utimensat)(folder, path, times, flags);
}
void *mmap(void *at, size_t size, int protection, int flags, int file, off_t offset) {
  return refused(MAP, ENOMEM) ? MAP_FAILED : REAL(mmap)(at, size, protection, flags, file, offset);
}
void *mmap64(void *at, size_t size, int protection, int flags, int file, off64_t offset) {
  return refused(MAP, ENOMEM) ? MAP_FAILED : REAL(mmap64)(at, size, protection, flags, file, offset);
}

#define OPENS(name)                                               \
  int name(const char *path, int flags, ...) {                    \
    va_list more;                                                 \
    va_start(more, flags);                                        \
    const mode_t mode = va_arg(more, mode_t);                     \
    va_end(more);                                                 \
    if ((flags & O_ACCMODE) != O_RDONLY && refused(OPEN, ENOSPC)) \
      return -1;                                                  \
    return REAL(name)(path, flags, mode);                         \
  }
OPENS(open)
OPENS(open64)

static void read_wish(void) {
  const char *wish = getenv("ROOMCUT_FAIL");
  const char *program = getenv("ROOMCUT_FAIL_PROGRAM");
  char word[16] = "";
  if (wish == NULL || sscanf(wish, "%15s %ld", word, &wanted) != 2) {
    return;
  }
  if (program != NULL && *program != '\0' && strcmp(program, program_invocation_short_name) != 0) {
    return;
  }
  full = strcmp(word, "full") == 0;
  for (int i = 0; i < KINDS; ++i) {
    if (strcmp(word, full ? "write" : names[i]) == 0 && (!full || i == WRITE)) {
      kind = (enum Kind)i;
    }
  }
  if (full) {
    kind = WRITE;
  }
  atomic_store(&armed, 1);
}

__attribute__((destructor)) static void tell_counts(void) {
  const char *path = getenv("ROOMCUT_FAIL_COUNT");
  if (path == NULL || !atomic_exchange(&armed, 0)) {
    return;
  }
  const int file = REAL(open)(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  for (int i = 0; i < KINDS && file >= 0; ++i) {
    char line[256];
    const int length = snprintf(line, sizeof line, "%s %s %ld\n", program_invocation_short_name, names[i], atomic_load(&calls[i]));
    if (REAL(write)(file, line, (size_t)length) != length) {
      break;
    }
  }
}

// Only from main() on: before it nothing could be told of.
typedef int (*Main)(int, char **, char **);
static Main main_of_program;
static int armed_main(int count, char **words, char **environment) {
  read_wish();
  return main_of_program(count, words, environment);
}
int __libc_start_main(Main begin, int count, char **words, void (*init)(void), void (*fini)(void), void (*rtld_fini)(void), void *stack) {
  typedef int (*Start)(Main, int, char **, void (*)(void), void (*)(void), void (*)(void), void *);
  main_of_program = begin;
  return ((Start)real("__libc_start_main"))(armed_main, count, words, init, fini, rtld_fini, stack);
}
