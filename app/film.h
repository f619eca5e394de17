#pragma once

#include <filesystem>
#include <limits>
#include <optional>

#include "app/frame_picture.h"

namespace pintle {

/// What of a run is drawn, as a picture or a film.
struct Drawn {
  std::filesystem::path directory, file;
  PictureStyle style;
  std::string around;                 ///< an owner to fill the picture with
  std::optional<double> deformation;  ///< of flexible bodies, drawn so many times as large
  bool quiet = false;
};

/// Which frames a film shows, and when.
struct FilmPlan {
  double rate = 25;                                        ///< pictures a second
  std::optional<double> speed;                             ///< time of the run over time of the film; else every frame once
  double from = -std::numeric_limits<double>::infinity();  ///< [s]
  double until = std::numeric_limits<double>::infinity();  ///< [s]
};

/// Writes the film. @returns false: the user stopped it, and there is no file
/// @throws std::invalid_argument  the plan does not do; std::runtime_error  the results or the file do not
bool write_film(const Drawn&, const FilmPlan&);

/// Of a picture of a film the frame to show, for each; the frame nearest to its time. @pre frames are in the order of their times
std::vector<std::size_t> shown_frames(const std::vector<double>& frame_times, const FilmPlan&);

}  // namespace pintle
