#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "framework/study/measures/measure.h"

/// The words of a measure, read against the names of a scene. docs/studies.md has the grammar.
namespace pintle {

enum class Statistic { none, peak, greatest, least, mean, rms, range, last };

enum class What {
  force,         ///< at a joint, of a driver, spring or load; part: "", x, y, normal, friction
  torque,        ///< likewise
  motion,        ///< of a body or point; part is the column, or speed, velocity, acceleration: a magnitude
  distance,      ///< between two points
  eccentricity,  ///< of a clearance
  depth,         ///< of a clearance, 0 where open
  stress,        ///< at a point
  displacement,  ///< of a point of a flexible body
  deflection,    ///< of a flexible body: the greatest displacement in it
  energy,        ///< part is the ledger's column
  lost,          ///< part is what it is lost to, all if empty; owner: all if empty
  work,          ///< of a driver or load; all if the owner is empty
  impacts,       ///< how many begin
  free_flight,   ///< the longest time between two contacts
  contact_time,  ///< in contact, in all
  written,       ///< an output or a state of the scene's own: the owner
  end,           ///< when the run ends
  path,          ///< distance of a point's curve to the measure's path
  column         ///< of trajectory.csv or ledger.csv; part is its header without unit and body
};

/// What a measure asks for.
struct Asked {
  Statistic statistic = Statistic::none;
  bool time_of = false;    ///< when the statistic is reached
  bool frequency = false;  ///< the dominant one
  What what = What::column;
  std::string owner = {};  ///< joint, driver, force, body or BODY.POINT
  std::string other = {};  ///< of a distance
  std::string part = {};
  double from = 0, to = std::numeric_limits<double>::infinity();  ///< [s]; infinity: the end of the run
  double last = 0;                                                ///< the window is as long, up to the end [s]; 0: it begins at `from`
  std::optional<SceneOutput> expression = {};                     ///< what is `written`, where the scene has no output of it
  bool instant = false;                                           ///< the value at `from`, which is `to`
  std::string unit = {};                                          ///< of the answer
};

/// Grows with time, so that without a statistic its change in the window is meant.
bool cumulative(What);

/// @throws SceneError  the words cannot be read, name what the scene has not, or ask what the measure's question does not tell; says
///                     what there is
Asked read_measure(const Measure&, const Scene&);

}  // namespace pintle
