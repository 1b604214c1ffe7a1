// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "common/artefact/atomic_file.h"
#include "common/cli/stage_state.h"

namespace roomcut {

void end_out_of_memory() {
  remove_temporary_files();
  std::array<char, 512> text{};  // one write, and no allocation
  std::size_t size = 0;
  for (const std::string_view part : {std::string_view("error[N07] "), kNoMemory,
                                      std::string_view("\nhint: "), kNoMemoryHint, std::string_view("\n")}) {
    size += part.copy(text.data() + size, text.size() - size);
  }
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text.data(), size);
  ::_exit(static_cast<int>(ExitCode::kNoResult));
}

namespace {

/// Memory that runs out where nobody can catch it: before run_stage(), in a destructor, in a thread.
[[noreturn]] void end_uncaught() {
  try {
    if (const std::exception_ptr current = std::current_exception()) {
      std::rethrow_exception(current);
    }
  } catch (const std::bad_alloc&) {
    end_out_of_memory();
  } catch (const std::exception& error) {
    if (std::string_view(error.what())
            .starts_with("pthread_create")) {  // oneTBB, whose threads need some too
      end_out_of_memory();
    }
    const std::string text = std::string("unexpected: ") + error.what() + "\n";
    [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, text.data(), text.size());
  } catch (...) {  // nothing can be told of it
    std::abort();
  }
  std::abort();
}

/// From before main() on.
[[maybe_unused]] const std::terminate_handler kBefore = std::set_terminate(end_uncaught);

}  // namespace

}  // namespace roomcut

#ifdef ROOMCUT_WRAPS_MALLOC
namespace {

/// Smaller requests fail only when there is no memory left; larger ones also when a damaged file asks for
/// them, and then the library says so.
constexpr std::size_t kSmallRequest = std::size_t{1} << 20;

void* or_end(void* memory, std::size_t size) {
  if (memory == nullptr && size > 0 && size < kSmallRequest) {
    roomcut::end_out_of_memory();
  }
  return memory;
}

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp,readability-identifier-naming)
extern "C" {
void* __real_malloc(std::size_t size);
void* __real_calloc(std::size_t count, std::size_t size);
void* __real_realloc(void* old, std::size_t size);
char* __real_strdup(const char* text);

/// libhdf5 does not survive that one of its small requests is refused: it calls exit(), or goes on with a
/// null pointer. The linker leads the calls of archives here (CMakeLists.txt).
void* __wrap_malloc(std::size_t size) {
  return or_end(__real_malloc(size), size);
}
void* __wrap_calloc(std::size_t count, std::size_t size) {
  return or_end(__real_calloc(count, size), count * size);
}
void* __wrap_realloc(void* old, std::size_t size) {
  return or_end(__real_realloc(old, size), size);
}
char* __wrap_strdup(const char* text) {
  return static_cast<char*>(or_end(__real_strdup(text), 1));
}
}
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp,readability-identifier-naming)
#endif
