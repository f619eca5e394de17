// pintle-mesher: makes meshes for the library that started it, which communicates through its standard input.
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <clocale>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>

#include "meshes/confine.h"
#include "meshes/gmsh_mesher.h"
#include "meshes/reject.h"
#include "meshes/wire.h"

namespace pintle {

namespace {

constexpr int line = 0, done = 42;

bool receive(void* data, std::size_t size) {
  for (char* at = static_cast<char*>(data); size > 0;) {
    const ssize_t n = recv(line, at, size, 0);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n, size -= static_cast<std::size_t>(n);
  }
  return true;
}
std::string answer(Answer kind, const std::string& words) { return static_cast<char>(kind) + words; }

void limit_memory(double bytes) {
#if !defined(__SANITIZE_ADDRESS__)  // the sanitizer reserves terabytes
  const rlimit space{static_cast<rlim_t>(bytes), static_cast<rlim_t>(bytes)};
  setrlimit(RLIMIT_AS, &space);
#else
  static_cast<void>(bytes);
#endif
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
}

/// Confines the process as far as the system allows; an environment variable disables this for tests.
bool shut_in(const std::vector<std::string>& folders) {
  const bool offered = std::getenv("PINTLE_NO_CONFINEMENT") == nullptr;
  clearenv();  // a script could read it
  return offered && confine(folders);
}

Mesh made(const MesherTask& task) {
  if (!task.at.empty() && chdir(task.at.c_str()) != 0) throw std::runtime_error(task.at + ": is no longer a folder");
  const bool script = task.file.ends_with(".geo");
  if (!(script && task.unconfined) && !shut_in(task.folders) && script)
    reject(task.file,
           ": a .geo file is a program, and this system cannot confine it (Landlock and seccomp of Linux); if you trust the source of the "
           "drawing, allow it with --trust-geo, otherwise use a .step, .brep or .msh file");
  return task.link ? gmsh_link(*task.link, task.options) : gmsh_geometry(task.file, task.options, task.scale);
}

std::string worked_on(const std::string& words) {
  try {
    const MesherTask task = unpacked_task(words);
    limit_memory(task.most_bytes);
    return answer(Answer::mesh, packed(made(task)));
  } catch (const std::bad_alloc&) {
    return answer(Answer::out_of_memory, {});
  } catch (const std::length_error&) {  // a list too long for any memory
    return answer(Answer::out_of_memory, {});
  } catch (const std::invalid_argument& e) {
    return answer(Answer::invalid_argument, e.what());
  } catch (const std::exception& e) {
    return answer(Answer::runtime_error, e.what());
  }
}

extern "C" void wake(int) {}

/// The child's exit code, 128 + signal if one killed it; −1 if the library disconnected before.
int outcome(pid_t child, const sigset_t& awake) {
  for (;;) {
    int status = 0;
    if (waitpid(child, &status, WNOHANG) == child) return WIFSIGNALED(status) ? killed_by + WTERMSIG(status) : WEXITSTATUS(status);
    pollfd other{line, POLLRDHUP, 0};
    if (ppoll(&other, 1, nullptr, &awake) > 0) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      return -1;
    }
  }
}

int serve() {
  struct sigaction on_child {};
  on_child.sa_handler = wake;
  sigaction(SIGCHLD, &on_child, nullptr);
  sigset_t child, awake;
  sigemptyset(&child), sigaddset(&child, SIGCHLD);
  sigprocmask(SIG_BLOCK, &child, &awake);  // except while waiting for one
  const pid_t self = getpid();
  if (!send_message(line, PINTLE_VERSION)) return 1;
  for (std::uint64_t length = 0; receive(&length, sizeof length);) {
    std::string words(static_cast<std::size_t>(length), '\0');
    if (!receive(words.data(), words.size())) return 1;
    const pid_t worker = fork();
    if (worker < 0) return 1;
    if (worker == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != self) _exit(1);
      _exit(send_message(line, worked_on(words)) ? done : 1);
    }
    if (const int code = outcome(worker, awake); code != done) return code;
  }
  return 0;
}

}  // namespace

}  // namespace pintle

#if defined(__SANITIZE_ADDRESS__)
// A crash ends the process by its signal; leaks are not checked, because the check starts a process, which is forbidden here.
extern "C" const char* __asan_default_options() { return "handle_segv=0:detect_leaks=0"; }
#endif

int main() {
  std::setlocale(LC_ALL, "C.UTF-8");  // Gmsh also sets it, but only when no file can be opened any more
  std::setlocale(LC_NUMERIC, "C");
  return pintle::serve();
}
