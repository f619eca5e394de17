#pragma once

#include <sys/types.h>

#include <filesystem>
#include <span>

namespace pintle {

/// A film being made by the program ffmpeg, a child process started without a shell: MP4, WebM or GIF, by the ending of its name. The file
/// appears complete at the end or not at all.
class FilmFile {
 public:
  /// @param width, height  even [px]   @param rate  pictures per second
  /// @throws std::runtime_error  there is no ffmpeg; FileError  the file cannot be created
  FilmFile(std::filesystem::path file, int width, int height, double rate);
  ~FilmFile();  ///< unless it is finished, stops ffmpeg and leaves no file
  FilmFile(const FilmFile&) = delete;

  /// @param picture  from Canvas::pixels. @throws std::runtime_error  with ffmpeg's message
  void add(std::span<const unsigned char> picture);
  /// @throws std::runtime_error  with ffmpeg's message
  void finish();

  /// Checks, before its pictures are drawn, whether a film can be made: ffmpeg and a writable folder exist.
  /// @throws std::runtime_error, FileError
  static void foresee(const std::filesystem::path&);
  static bool is_film(const std::filesystem::path&);  ///< by its ending

 private:
  void start(int width, int height, double rate);
  [[noreturn]] void fail();
  int wait();

  std::filesystem::path file_, part_;
  int pictures_ = -1, words_ = -1;  ///< pipe to ffmpeg; its messages, in an unnamed file
  pid_t child_ = -1;
};

}  // namespace pintle
