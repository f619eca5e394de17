#include "app/ffmpeg.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "framework/common/file.h"
#include "framework/common/file_names.h"
#include "framework/common/text.h"

extern char** environ;

namespace pintle {

namespace {

namespace fs = std::filesystem;

/// ffmpeg's options for a kind of file: its name for it, and its compression.
std::vector<std::string> packing(const std::string& ending) {
  if (ending == ".mp4") return {"-c:v", "libx264", "-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f", "mp4"};
  if (ending == ".webm") return {"-c:v", "libvpx-vp9", "-crf", "28", "-b:v", "0", "-cpu-used", "4", "-pix_fmt", "yuv420p", "-f", "webm"};
  return {"-filter_complex", "split[a][b];[a]palettegen=stats_mode=full[p];[b][p]paletteuse=dither=none", "-loop", "0", "-f", "gif"};
}

/// For the name of a film: `file:` prevents ffmpeg from treating it as an address or an option.
std::vector<std::string> arguments(const std::string& ending, const fs::path& part, int width, int height, double rate) {
  std::string pictures_a_second;
  append_number(pictures_a_second, rate);
  std::vector<std::string> out{"ffmpeg",
                               "-loglevel",
                               "error",
                               "-nostdin",
                               "-y",
                               "-f",
                               "rawvideo",
                               "-pixel_format",
                               "bgr0",
                               "-video_size",
                               std::to_string(width) + "x" + std::to_string(height),
                               "-framerate",
                               pictures_a_second,
                               "-i",
                               "pipe:0",
                               "-an",
                               "-threads",
                               "2"};
  for (std::string& word : packing(ending)) out.push_back(std::move(word));
  out.push_back("file:" + part.string());
  return out;
}

constexpr const char* no_ffmpeg = "ffmpeg, the program that encodes films, is not installed: apt-get install ffmpeg";

/// Whether the folders of PATH contain it.
bool ffmpeg_is_there() {
  const char* const path = std::getenv("PATH");
  if (path == nullptr) return true;  // the system then uses default folders
  std::istringstream folders(path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((fs::path(folder.empty() ? "." : folder) / "ffmpeg").c_str(), X_OK) == 0) return true;
  return false;
}

}  // namespace

void FilmFile::foresee(const fs::path& file) {
  if (!ffmpeg_is_there()) throw std::runtime_error(no_ffmpeg);
  std::error_code ignored;
  const auto fail = [&](int error) {
    throw std::runtime_error(file.string() + ": cannot be written (" + std::generic_category().message(error) +
                             "); name a film in an existing folder with write permission");
  };
  if (fs::is_directory(file, ignored)) fail(EISDIR);
  const fs::path part = unique_neighbour(file);
  const int made = ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (made < 0) fail(errno);
  ::close(made);
  fs::remove(part, ignored);
}

bool FilmFile::is_film(const fs::path& file) {
  const std::string ending = ending_of(file);
  return ending == ".mp4" || ending == ".webm" || ending == ".gif";
}

FilmFile::FilmFile(fs::path file, int width, int height, double rate) : file_(std::move(file)), part_(unique_neighbour(file_)) {
  words_ = ::memfd_create("ffmpeg", MFD_CLOEXEC);
  if (words_ < 0) throw std::runtime_error("ffmpeg cannot be started: there are too many open files, or there is not enough memory");
  start(width, height, rate);
}

void FilmFile::start(int width, int height, double rate) {
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) throw FileError(file_, errno, "cannot be made");
  pictures_ = pipe[1];
  std::vector<std::string> words = arguments(ending_of(file_), part_, width, height, rate);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, pipe[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&files, words_, STDERR_FILENO);
  posix_spawnattr_t own;
  posix_spawnattr_init(&own);
  sigset_t usual;
  sigemptyset(&usual);
  sigaddset(&usual, SIGPIPE);
  posix_spawnattr_setsigdefault(&own, &usual);
  posix_spawnattr_setpgroup(&own, 0);  // Ctrl-C reaches only this program, which then stops the film
  posix_spawnattr_setflags(&own, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  const int error = ::posix_spawnp(&child_, "ffmpeg", &files, &own, argv.data(), environ);
  posix_spawnattr_destroy(&own);
  posix_spawn_file_actions_destroy(&files);
  ::close(pipe[0]);
  if (error == 0) return;
  child_ = -1;
  if (error == ENOENT) throw std::runtime_error(no_ffmpeg);
  throw FileError("ffmpeg", error, "cannot be started");
}

FilmFile::~FilmFile() {
  if (pictures_ >= 0) ::close(pictures_);
  if (child_ > 0) {
    ::kill(child_, SIGKILL);
    wait();
  }
  if (words_ >= 0) ::close(words_);
  std::error_code ignored;
  if (!part_.empty()) fs::remove(part_, ignored);
}

int FilmFile::wait() {
  int status = -1;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) continue;
  child_ = -1;
  return status;
}

void FilmFile::fail() {
  if (pictures_ >= 0) ::close(std::exchange(pictures_, -1));
  if (child_ > 0) wait();
  std::array<char, 2000> said{};
  const ssize_t n = ::pread(words_, said.data(), said.size(), 0);
  std::string words(said.data(), n > 0 ? static_cast<std::size_t>(n) : 0);
  while (!words.empty() && words.back() == '\n') words.pop_back();
  throw FileError(file_, words.empty() ? "ffmpeg ended without a message" : "ffmpeg says: " + words);
}

void FilmFile::add(std::span<const unsigned char> picture) {
  while (!picture.empty()) {
    const ssize_t n = ::write(pictures_, picture.data(), picture.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail();
    picture = picture.subspan(static_cast<std::size_t>(n));
  }
}

void FilmFile::finish() {
  ::close(std::exchange(pictures_, -1));
  if (const int status = wait(); !WIFEXITED(status) || WEXITSTATUS(status) != 0) fail();
  if (::rename(part_.c_str(), file_.c_str()) != 0) throw FileError(file_, errno);
  part_.clear();
}

}  // namespace pintle
