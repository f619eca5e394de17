// Commands executed by separate programs, which replace this process: they load libraries that other commands do not need.
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <stdexcept>

#include "app/options.h"

namespace pintle::app {

namespace {

/// @param packages  needed to build the program
int become(const std::string& program, const std::string& command, const Options& options, const std::string& packages) {
  const std::filesystem::path file = std::filesystem::read_symlink("/proc/self/exe").parent_path() / program;
  std::vector<std::string> words{"pintle " + command};
  words.insert(words.end(), options.passed_on.begin(), options.passed_on.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execv(file.c_str(), argv.data());
  if (errno == ENOENT)
    throw std::runtime_error(file.string() + " is missing, and `pintle " + command +
                             "` needs it; install the packages that it is built with (apt-get install " + packages +
                             "), configure and build again");
  throw std::runtime_error(file.string() + ", which `pintle " + command + "` needs, cannot be started");
}

}  // namespace

int picture(const Options& options) { return become("pintle-picture", "picture", options, "libcairo2-dev pkgconf"); }
int film(const Options& options) { return become("pintle-picture", "film", options, "libcairo2-dev pkgconf"); }
int view(const Options& options) { return become("pintle-view", "view", options, "libcpp-httplib-dev pkgconf"); }
int fmu(const Options& options) { return become("pintle-fmu", "fmu", options, "libxml2-dev libminizip-dev pkgconf"); }

}  // namespace pintle::app
