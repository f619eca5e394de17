#pragma once

#include <sys/types.h>

#include <filesystem>
#include <span>

namespace pintle {

/// A film that is being made by the program ffmpeg, a child of this one without a shell: MP4, WebM or GIF, by the ending of its name.
/// The file appears whole at the end or not at all.
class FilmFile {
 public:
  /// @param width, height  even [px]   @param rate  pictures a second
  /// @throws std::runtime_error  there is no ffmpeg; FileError  the file cannot be made
  FilmFile(std::filesystem::path file, int width, int height, double rate);
  ~FilmFile();  ///< unless it is finished, ends ffmpeg and leaves nothing
  FilmFile(const FilmFile&) = delete;

  /// @param picture  as Canvas::pixels gives it. @throws std::runtime_error  what ffmpeg said
  void add(std::span<const unsigned char> picture);
  /// @throws std::runtime_error  what ffmpeg said
  void finish();

  /// What would keep the film from being made, before its pictures are drawn: no ffmpeg, no folder, one that cannot be written to.
  /// @throws std::runtime_error  FileError
  static void foresee(const std::filesystem::path&);
  static bool is_film(const std::filesystem::path&);  ///< by its ending

 private:
  void start(int width, int height, double rate);
  [[noreturn]] void fail();
  int wait();

  std::filesystem::path file_, part_;
  int pictures_ = -1, words_ = -1;  ///< to ffmpeg; what it says, a file without a name
  pid_t child_ = -1;
};

}  // namespace pintle
