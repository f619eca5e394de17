#include "meshes/mesher.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "meshes/limits.h"
#include "meshes/module.h"
#include "meshes/wire.h"

extern char** environ;

namespace pintle {

namespace {

using clock = std::chrono::steady_clock;

/// The environment of the mesher: libraries use one thread, and it is not an MPI process.
std::vector<std::string> environment() {
  std::vector<std::string> out{"OPENBLAS_NUM_THREADS=1", "OMP_NUM_THREADS=1"};
  const auto dropped = [](std::string_view e) {
    for (const char* begin : {"OPENBLAS_NUM_THREADS=", "OMP_NUM_THREADS=", "OMPI_", "PMIX_", "PMI_", "PRTE_", "MV2_", "SLURM_"})
      if (e.starts_with(begin)) return true;
    return false;
  };
  for (char** e = environ; *e != nullptr; ++e)
    if (!dropped(*e)) out.emplace_back(*e);
  return out;
}

struct SpawnSettings {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t how;
  SpawnSettings() { posix_spawn_file_actions_init(&files), posix_spawnattr_init(&how); }
  ~SpawnSettings() { posix_spawn_file_actions_destroy(&files), posix_spawnattr_destroy(&how); }
  SpawnSettings(const SpawnSettings&) = delete;
};

std::string find_mesher() {
#ifdef PINTLE_WITHOUT_GPL
  throw std::runtime_error(
      "this pintle was built without Gmsh (PINTLE_GPL=OFF), which meshes drawings and links and reads .msh files; give the plate as a mesh "
      "(file: part.inp) or as a grid, or use a build with Gmsh");
#else
  return program_beside_modules("pintle-mesher");
#endif
}

/// One mesher: its process and the connection to it. It lives as long as the connection is open.
class Worker {
 public:
  Worker() : program_(find_mesher()) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) fail(errno);
    line_ = ends[0];
    const int error = start(ends[1]);
    ::close(ends[1]);
    if (error != 0) {
      ::close(line_);
      fail(error);
    }
    std::string version;
    const auto soon = clock::now() + std::chrono::seconds(60);
    if (!receive(version, 100, soon, nullptr) || version != PINTLE_VERSION) {
      end();
      throw std::runtime_error(
          program_ + (version.empty()
                          ? ": does not start; install pintle again"
                          : ": is of pintle " + version + ", the program of " PINTLE_VERSION "; install both from the same version"));
    }
  }
  ~Worker() { end(); }
  Worker(const Worker&) = delete;

  bool usable() const { return line_ >= 0 && owner_ == getpid(); }

  bool send(const std::string& words) const { return send_message(line_, words); }
  /// @returns false  the connection has ended   @throws MeshingStopped
  bool receive(std::string& words, std::uint64_t most, clock::time_point until, bool (*stop)()) {
    std::uint64_t length = 0;
    if (!receive(&length, sizeof length, until, stop) || length > most) return false;
    words.resize(static_cast<std::size_t>(length));
    return receive(words.data(), words.size(), until, stop);
  }
  bool late() const { return late_; }

  /// Ends the process, if it is still running, and waits for it. @returns its exit code, 128 + signal if one killed it
  int end(bool by_force = true) {
    if (line_ < 0) return 0;
    ::close(std::exchange(line_, -1));
    if (owner_ != getpid()) return 0;  // a fork of this program has a copy of the connection but does not own the mesher's process
    if (by_force) kill(process_, SIGKILL);
    int status = 0;
    while (waitpid(process_, &status, 0) < 0)
      if (errno != EINTR) return 0;
    return WIFSIGNALED(status) ? killed_by + WTERMSIG(status) : WEXITSTATUS(status);
  }

 private:
  [[noreturn]] void fail(int error) const {
    throw std::runtime_error(program_ + ": cannot be started (" + std::strerror(error) + "); it is built and installed with pintle");
  }

  int start(int their_end) {
    SpawnSettings s;
    posix_spawn_file_actions_adddup2(&s.files, their_end, 0);
    posix_spawn_file_actions_addopen(&s.files, 1, "/dev/null", O_WRONLY, 0);
#if !defined(__SANITIZE_ADDRESS__)
    posix_spawn_file_actions_addopen(&s.files, 2, "/dev/null", O_WRONLY, 0);
#endif
    // This program decides whether Ctrl-C ends the work; when it ends, so does the mesher.
    sigset_t blocked, all;
    sigemptyset(&blocked), sigfillset(&all);
    for (const int s_ : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE}) sigaddset(&blocked, s_);
    posix_spawnattr_setsigmask(&s.how, &blocked), posix_spawnattr_setsigdefault(&s.how, &all);
    posix_spawnattr_setflags(&s.how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    std::vector<std::string> kept = environment();
    std::vector<char*> variables;
    for (std::string& e : kept) variables.push_back(e.data());
    variables.push_back(nullptr);
    char* arguments[]{program_.data(), nullptr};
    return posix_spawn(&process_, program_.c_str(), &s.files, &s.how, arguments, variables.data());
  }

  bool receive(void* data, std::size_t size, clock::time_point until, bool (*stop)()) {
    for (char* at = static_cast<char*>(data); size > 0;) {
      pollfd line{line_, POLLIN, 0};
      const int ready = poll(&line, 1, 100);
      if (stop != nullptr && stop()) throw MeshingStopped();
      if (ready == 0 && clock::now() > until) return late_ = true, false;
      if (ready <= 0) continue;
      const ssize_t n = recv(line_, at, size, 0);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return false;
      at += n, size -= static_cast<std::size_t>(n);
    }
    return true;
  }

  std::string program_;
  pid_t process_ = -1, owner_ = getpid();
  int line_ = -1;
  bool late_ = false;
};

std::mutex idle_mutex;

/// Meshers waiting for a task.
std::vector<std::unique_ptr<Worker>>& idle() {
  static std::vector<std::unique_ptr<Worker>> workers;
  return workers;
}

std::unique_ptr<Worker> draw_worker() {
  const std::lock_guard lock(idle_mutex);
  while (!idle().empty()) {
    std::unique_ptr<Worker> worker = std::move(idle().back());
    idle().pop_back();
    if (worker->usable()) return worker;
  }
  return nullptr;
}

std::string shown(double bytes) {
  std::ostringstream s;
  s << (bytes >= 1e9 ? bytes / (1 << 30) : bytes / (1 << 20)) << (bytes >= 1e9 ? " GB" : " MB");
  return s.str();
}

std::string no_memory(const MesherLimits& limits) {
  return "meshing needs more than " + shown(static_cast<double>(limits.bytes)) +
         " of memory; make the cells larger (size), simplify the drawing, or allow more with --mesh-memory";
}

std::string too_slow(const MesherLimits& limits) {
  std::ostringstream s;
  s << "meshing takes longer than " << limits.seconds
    << " s; make the cells larger (size), simplify the drawing, or allow more with --mesh-time";
  return s.str();
}

/// Why the mesher has ended without an answer.
std::string death(int code, const MesherLimits& limits) {
  const int signal = code > killed_by ? code - killed_by : 0;
  if (signal == SIGSYS)
    return "the drawing does something that is not allowed, such as running a command (SystemCall); remove it, or allow it with "
           "--trust-geo if you trust the source of the drawing";
  if (signal == SIGKILL) return "the mesher was killed, probably because memory ran out; make the cells larger (size)";
  if (signal == SIGABRT || signal == 0) {
    const std::string how = signal == SIGABRT ? "gives up" : "ends";
    return "Gmsh " + how + " without a mesh; remove Exit or Abort from the drawing, use another size or element, or correct the drawing";
  }
  return std::string("Gmsh crashes on it (") + strsignal(signal) + "); use another size or element, or correct the drawing" +
         (signal == SIGSEGV ? "; if the mesh is large, allow more than " + shown(static_cast<double>(limits.bytes)) + " with --mesh-memory"
                            : "");
}

Mesh understood(const std::string& answer, const std::string& name, const MesherLimits& limits) {
  if (answer.empty()) throw std::runtime_error(name + ": the mesher gave no answer; please report this");
  const std::string words = answer.substr(1);
  switch (static_cast<Answer>(answer[0])) {
    case Answer::mesh: return unpacked_mesh(std::string_view(answer).substr(1));
    case Answer::invalid_argument: throw std::invalid_argument(words);
    case Answer::out_of_memory: throw std::runtime_error(name + ": " + no_memory(limits));
    default: throw std::runtime_error(words);
  }
}

}  // namespace

Mesh mesh_elsewhere(const MesherTask& task) {
  const MesherLimits limits = mesher_limits();
  const std::string name = task.link ? "link" : task.file, words = packed(task);
  std::unique_ptr<Worker> worker = draw_worker();
  if (!worker || !worker->send(words)) {  // there is none, or it was killed from outside
    worker = std::make_unique<Worker>();
    worker->send(words);
  }
  const auto until = clock::now() + std::chrono::duration_cast<clock::duration>(std::chrono::duration<double>(limits.seconds));
  std::string answer;
  if (!worker->receive(answer, limits.bytes, until, limits.stop)) {
    if (worker->late()) throw std::runtime_error(name + ": " + too_slow(limits));
    throw std::runtime_error(name + ": " + death(worker->end(false), limits));
  }
  {
    const std::lock_guard lock(idle_mutex);
    idle().push_back(std::move(worker));
  }
  return understood(answer, name, limits);
}

}  // namespace pintle
