#pragma once

#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/study/measures/path_distance.h"
#include "framework/study/measures/question.h"

/// Many runs of one scene: their measures, the cases, the tables. docs/studies.md
namespace pintle {

/// A number from a run or another analysis, described in words: "peak force at gudgeon pin", "x of slider at 0.05 s", "energy lost", "rms
/// torque of crank drive after 10 ms", "frequency of mode 1". docs/studies.md has the grammar.
struct Measure {
  std::string name;                     ///< header of its column
  std::string words;                    ///< as written by the user
  Place place = {};                     ///< where
  std::string file = {};                ///< of the study, for messages; empty: the scene's
  Question question = {};               ///< analysis that gives it
  std::optional<PathTarget> path = {};  ///< instead of words: the rms distance of a curve to these points
  std::size_t situation = 0;            ///< of the study, in which it is measured; 0 without situations
};

struct MeasuredValue {
  double value = 0;  ///< NaN: the run ended earlier, or there is no such quantity (the stress of a body that is rigid in this case)
  std::string unit;  ///< SI: "N", "J", "m"; may be empty
};
/// The value of a measure in a run. Only names are used of the scene, which is the one that was built.
/// @throws SceneError  the words cannot be read, or name something the scene lacks; lists what it has
MeasuredValue measured(const Measure&, const Scene&, const Model&, const Run&);
/// Where the curve of a measure with a path passes its points. @pre it has a path
std::vector<Passage> passages_of(const Measure&, const Scene&, const Run&);

/// The measured quantity in each row of a run, before its statistic is taken. Empty: there is no such quantity in this case.
std::vector<double> curve(const Measure&, const Scene&, const Model&, const Run&);

/// Its unit, without a run. @throws SceneError  as above
std::string measured_unit(const Measure&, const Scene&);

/// Checks the words against a scene before anything runs.
/// @throws SceneError  as above, or a time is beyond the end of the run
void validate(const std::vector<Measure>&, const Scene&);
/// Checks measures that need a flexible body: stress, displacement, modes.
/// @param varied  parameters and paths set by the cases. One below `bodies.BODY` may make it flexible.
/// @throws SceneError  the body is rigid, and no case may change that
void validate_flexible(const std::vector<Measure>&, const Scene&, const std::vector<std::string>& varied);

/// Makes a scene output what the measures need, so that they do not depend on the output interval: points and stresses recorded, 2000 rows
/// in a window, a row at each instant. No frames. Called after with_pieces, before build. Words that cannot be read, or name something
/// missing, are ignored.
void prepare(Scene&, const std::vector<Measure>&);

}  // namespace pintle
