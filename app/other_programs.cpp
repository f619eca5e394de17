// Commands executed by separate programs, which replace this process: they load libraries that other commands do not need.
#include "app/other_programs.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/options.h"

namespace pintle::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* hdf5_packages = "libhdf5-dev pkgconf";

fs::path beside_us(const std::string& program) { return fs::read_symlink("/proc/self/exe").parent_path() / program; }

std::vector<char*> argv_of(std::vector<std::string>& words) {
  std::vector<char*> out;
  for (std::string& word : words) out.push_back(word.data());
  out.push_back(nullptr);
  return out;
}

/// @param command   "picture"   @param packages  needed to build the program   @param error  errno
[[noreturn]] void fail_to_start(const fs::path& file, const std::string& command, const std::string& packages, int error) {
  if (error == ENOENT)
    throw std::runtime_error(file.string() + " is missing, and `pintle " + command +
                             "` needs it; build all programs (./dev build). The build needs: apt-get install " + packages);
  throw std::runtime_error(file.string() + ", which `pintle " + command + "` needs, cannot be started");
}

int become(const std::string& program, const std::string& command, const Options& options, const std::string& packages) {
  const fs::path file = beside_us(program);
  std::vector<std::string> words{"pintle " + command};
  words.insert(words.end(), options.passed_on.begin(), options.passed_on.end());
  ::execv(file.c_str(), argv_of(words).data());
  fail_to_start(file, command, packages, errno);
}

}  // namespace

int picture(const Options& options) { return become("pintle-picture", "picture", options, "libcairo2-dev pkgconf"); }
int film(const Options& options) { return become("pintle-picture", "film", options, "libcairo2-dev pkgconf"); }
int view(const Options& options) { return become("pintle-view", "view", options, "libcpp-httplib-dev pkgconf"); }
int fmu(const Options& options) { return become("pintle-fmu", "fmu", options, "libxml2-dev libminizip-dev pkgconf"); }
int hdf5(const Options& options) { return become("pintle-hdf5", "hdf5", options, hdf5_packages); }

void require_hdf5() {
  const fs::path file = beside_us("pintle-hdf5");
  if (::access(file.c_str(), X_OK) != 0) fail_to_start(file, "run --hdf5", hdf5_packages, errno);
}

int write_hdf5(const fs::path& directory) {
  const fs::path file = beside_us("pintle-hdf5");
  std::vector<std::string> words{"pintle hdf5", "--quiet", "--", directory.string()};
  pid_t child = 0;
  if (const int error = ::posix_spawn(&child, file.c_str(), nullptr, nullptr, argv_of(words).data(), environ); error != 0)
    fail_to_start(file, "run --hdf5", hdf5_packages, error);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0)
    if (errno != EINTR)
      throw std::runtime_error(file.string() + ": whether it succeeded is unknown; the results are in " + directory.string());
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  throw std::runtime_error(file.string() + " was ended by signal " + std::to_string(WTERMSIG(status)) + "; the results are in " +
                           directory.string() + ", and `pintle hdf5` converts them");
}

}  // namespace pintle::app
