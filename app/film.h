#pragma once

#include <filesystem>
#include <limits>
#include <optional>

#include "app/frame_picture.h"

namespace pintle {

/// What a picture or film of a run shows.
struct Drawn {
  std::filesystem::path directory, file;
  PictureStyle style;
  std::string around;                 ///< an owner to show alone, filling the picture
  std::optional<double> deformation;  ///< of flexible bodies, drawn with this factor
  bool quiet = false;
};

/// Which frames a film shows, and when.
struct FilmPlan {
  double rate = 25;                                        ///< pictures per second
  std::optional<double> speed;                             ///< time of the run over time of the film; otherwise every frame is shown once
  double from = -std::numeric_limits<double>::infinity();  ///< [s]
  double until = std::numeric_limits<double>::infinity();  ///< [s]
};

/// Writes the film. @returns false: the user stopped it, and there is no file
/// @throws std::invalid_argument  the plan is invalid; std::runtime_error  the results or the file are not usable
bool write_film(const Drawn&, const FilmPlan&);

/// The impacts until the last frame that is shown, unless the style leaves them out. @throws std::runtime_error
std::vector<PlacedImpact> shown_impacts(const Drawn&, const FrameFiles& last);

/// The frame shown in each picture of a film: the one nearest to its time. @pre frames are ordered by time
std::vector<std::size_t> shown_frames(const std::vector<double>& frame_times, const FilmPlan&);

}  // namespace pintle
