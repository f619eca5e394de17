// Preloaded into the program: counts its calls that write files or ask for memory, and lets one of them, or all from one on,
// fail, or kills the program there. Told by the environment:
//   PINTLE_FAULT        CALL:K:WHAT:HOW   the K-th CALL (from 1) of write, sync, close, rename, open, mkdir, allocate,
//                                         memory; WHAT is an errno's number, "short" (half is written), "kill" or
//                                         "kill-after"; HOW is "once" or "on"
//   PINTLE_FAULT_UNDER  files and folders whose path begins so count, others do not
//   PINTLE_FAULT_LOG    where the counts of all calls are written at the end
// Memory counts from where the program sets its signals, its first act.
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <time.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

enum Call { write_call, sync_call, close_call, rename_call, open_call, mkdir_call, allocate_call, memory_call, calls };
constexpr const char* names[calls] = {"write", "sync", "close", "rename", "open", "mkdir", "allocate", "memory"};
enum class Fault { none, error, half, kill, kill_after };

std::atomic<long> count[calls];
std::atomic<bool> armed{false};
bool ours[4096];  ///< descriptors of files that count
Call which = calls;
long at = 0;
int error_number = 0;
Fault fault = Fault::none;
bool goes_on = false;
const char* under = "";

__attribute__((constructor)) void read_environment() {
  if (const char* prefix = std::getenv("PINTLE_FAULT_UNDER")) under = prefix;
  const char* said = std::getenv("PINTLE_FAULT");
  char call[16] = "", what[16] = "", how[8] = "";
  if (!said || std::sscanf(said, "%15[^:]:%ld:%15[^:]:%7s", call, &at, what, how) != 4) return;
  for (int c = 0; c < calls; ++c)
    if (std::strcmp(call, names[c]) == 0) which = static_cast<Call>(c);
  goes_on = std::strcmp(how, "on") == 0;
  error_number = std::atoi(what);
  fault = std::strcmp(what, "short") == 0        ? Fault::half
          : std::strcmp(what, "kill") == 0       ? Fault::kill
          : std::strcmp(what, "kill-after") == 0 ? Fault::kill_after
                                                 : Fault::error;
}

__attribute__((destructor)) void write_counts() {
  armed = false;
  const char* log = std::getenv("PINTLE_FAULT_LOG");
  if (!log) return;
  const int file = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_TRUNC, 0666));
  for (int c = 0; c < calls; ++c) {
    char line[64];
    const int n = std::snprintf(line, sizeof line, "%s %ld\n", names[c], count[c].load());
    ::syscall(SYS_write, file, line, static_cast<std::size_t>(n));
  }
  ::syscall(SYS_close, file);
}

void die() { ::syscall(SYS_kill, ::syscall(SYS_getpid), SIGKILL); }

/// What is to happen to this call; one that is to be killed before it is.
Fault next(Call call) {
  const long k = ++count[call];
  if (call != which || k < at || (k > at && !goes_on)) return Fault::none;
  if (fault == Fault::kill) die();
  if (fault == Fault::error) errno = error_number;
  return fault;
}

bool counts(int file) { return file >= 0 && file < 4096 && ours[file]; }
bool counts(const char* path) { return *under != '\0' && std::strncmp(path, under, std::strlen(under)) == 0; }

template <class F>
F* real(const char* name) {
  return reinterpret_cast<F*>(::dlsym(RTLD_NEXT, name));
}

/// @param act  the call itself
template <class Act>
auto judged(Call call, Act act) -> decltype(act()) {
  const Fault f = next(call);
  if (f == Fault::error) return -1;
  const auto result = act();
  if (f == Fault::kill_after) die();
  return result;
}

bool fails_for_memory() {
  if (!armed.load(std::memory_order_relaxed)) return false;
  const bool fails = next(memory_call) == Fault::error;
  if (fails) errno = ENOMEM;
  return fails;
}

}  // namespace

extern "C" {

ssize_t write(int file, const void* text, std::size_t n) {
  const auto act = [&](std::size_t bytes) { return static_cast<ssize_t>(::syscall(SYS_write, file, text, bytes)); };
  if (!counts(file)) return act(n);
  const Fault f = next(write_call);
  if (f == Fault::error) return -1;
  const ssize_t done = act(f == Fault::half && n > 1 ? n / 2 : n);
  if (f == Fault::kill_after) die();
  return done;
}

int fsync(int file) {
  const auto act = [&] { return static_cast<int>(::syscall(SYS_fsync, file)); };
  return counts(file) ? judged(sync_call, act) : act();
}

int syncfs(int file) noexcept {
  const auto act = [&] { return static_cast<int>(::syscall(SYS_syncfs, file)); };
  return counts(file) ? judged(sync_call, act) : act();
}

int close(int file) {
  const bool counted = counts(file);
  if (counted) ours[file] = false;
  const int done = static_cast<int>(::syscall(SYS_close, file));
  return counted && next(close_call) == Fault::error ? -1 : done;
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const int mode = (flags & O_CREAT) != 0 ? va_arg(more, int) : 0;
  va_end(more);
  const auto act = [&] { return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode)); };
  if (!counts(path)) return act();
  const int file = judged(open_call, act);
  if (file >= 0 && file < 4096) ours[file] = true;
  return file;
}

int rename(const char* from, const char* to) noexcept {
  const auto act = [&] { return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0)); };
  return counts(to) ? judged(rename_call, act) : act();
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) noexcept {
  const auto act = [&] { return static_cast<int>(::syscall(SYS_renameat2, from_folder, from, to_folder, to, flags)); };
  return counts(to) ? judged(rename_call, act) : act();
}

int mkdir(const char* path, mode_t mode) noexcept {
  const auto act = [&] { return static_cast<int>(::syscall(SYS_mkdirat, AT_FDCWD, path, mode)); };
  return counts(path) ? judged(mkdir_call, act) : act();
}

int posix_fallocate(int file, off_t offset, off_t length) {
  if (counts(file)) {
    const Fault f = next(allocate_call);
    if (f == Fault::error) return error_number;
  }
  return real<int(int, off_t, off_t)>("posix_fallocate")(file, offset, length);
}

// PINTLE_FAULT_CLOCK: every seventh look at the clock an hour earlier than the one before, and on from there.
int clock_gettime(clockid_t clock, timespec* time) noexcept {
  static std::atomic<long> looks{0};
  static const bool jumps = std::getenv("PINTLE_FAULT_CLOCK") != nullptr;
  const int done = static_cast<int>(::syscall(SYS_clock_gettime, clock, time));
  if (jumps) time->tv_sec -= 3600 * (++looks / 7);
  return done;
}

sighandler_t signal(int number, sighandler_t handler) noexcept {
  armed = true;
  return real<sighandler_t(int, sighandler_t)>("signal")(number, handler);
}

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void* malloc(std::size_t size) noexcept { return fails_for_memory() ? nullptr : __libc_malloc(size); }
void* calloc(std::size_t n, std::size_t size) noexcept { return fails_for_memory() ? nullptr : __libc_calloc(n, size); }
void* realloc(void* old, std::size_t size) noexcept { return fails_for_memory() ? nullptr : __libc_realloc(old, size); }
void* memalign(std::size_t alignment, std::size_t size) noexcept { return fails_for_memory() ? nullptr : __libc_memalign(alignment, size); }
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return fails_for_memory() ? nullptr : __libc_memalign(alignment, size);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t size) noexcept {
  if (fails_for_memory()) return ENOMEM;
  *out = __libc_memalign(alignment, size);
  return *out ? 0 : ENOMEM;
}

}  // extern "C"
