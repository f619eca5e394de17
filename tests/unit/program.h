#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/unit/sanitized.h"

extern char** environ;

/// The program itself, started on a folder of its own.
namespace pintle_test {

inline std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Ended {
  int code = -1;  ///< -1: it was ended by a signal
  int signal = 0;
  std::string said, complained;  ///< on stdout and stderr
};

/// A folder that goes at the end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "pintle_program_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

using Words = std::vector<std::string>;

inline std::vector<char*> pointers(const Words& words) {
  std::vector<char*> out;
  for (const std::string& w : words) out.push_back(const_cast<char*>(w.c_str()));
  out.push_back(nullptr);
  return out;
}

/// @param environment  NAME=VALUE, before that of this process
inline pid_t start(const std::filesystem::path& log, const Words& command, Words environment = {}) {
  for (char** e = environ; *e != nullptr; ++e) environment.emplace_back(*e);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  const std::string out = log.string() + ".out", err = log.string() + ".err";
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  pid_t child = -1;
  if (posix_spawn(&child, command[0].c_str(), &files, nullptr, pointers(command).data(), pointers(environment).data()) != 0) child = -1;
  posix_spawn_file_actions_destroy(&files);
  return child;
}

inline Ended wait_for(pid_t child, const std::filesystem::path& log) {
  Ended end;
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child) return end;
  if (WIFEXITED(status)) end.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  end.said = contents(log.string() + ".out");
  end.complained = contents(log.string() + ".err");
  return end;
}

inline Ended run(const std::filesystem::path& log, const Words& command, const Words& environment = {}) {
  return wait_for(start(log, command, environment), log);
}

}  // namespace pintle_test
