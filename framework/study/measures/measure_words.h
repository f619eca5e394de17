#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "framework/study/measures/measure.h"

/// The words of a measure, interpreted with the names of a scene. docs/studies.md has the grammar.
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
  deflection,    ///< of a flexible body: its largest displacement
  energy,        ///< part is the energy-balance column
  lost,          ///< part is the kind of loss, all if empty; owner: all if empty
  work,          ///< of a driver or load; all if the owner is empty
  impacts,       ///< number of impacts
  free_flight,   ///< the longest time between two contacts
  contact_time,  ///< total time in contact
  written,       ///< an output or a state of the scene's own: the owner
  end,           ///< when the run ends
  path,          ///< distance of a point's curve from the measure's path
  column         ///< of trajectory.csv or ledger.csv; part is its header without unit and body
};

/// Parsed form of a measure.
struct Asked {
  Statistic statistic = Statistic::none;
  bool time_of = false;    ///< time at which the statistic is reached
  bool frequency = false;  ///< the dominant one
  What what = What::column;
  std::string owner = {};  ///< joint, driver, force, body or BODY.POINT
  std::string other = {};  ///< for a distance
  std::string part = {};
  double from = 0, to = std::numeric_limits<double>::infinity();  ///< [s]; infinity: the end of the run
  double last = 0;                                                ///< the window is as long, up to the end [s]; 0: it begins at `from`
  std::optional<SceneOutput> expression = {};                     ///< the expression to be `written`, if it is no output of the scene
  bool instant = false;                                           ///< the value at `from`, which equals `to`
  std::string unit = {};                                          ///< of the result
};

/// Whether it accumulates over time: without a statistic, its change in the window is meant.
bool cumulative(What);

/// @throws SceneError  the words cannot be read, name something the scene lacks, or ask for something that the measure's analysis does not
/// provide; the message lists what exists
Asked read_measure(const Measure&, const Scene&);

}  // namespace pintle
