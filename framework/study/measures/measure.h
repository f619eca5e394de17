#pragma once

#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "framework/study/measures/path_distance.h"
#include "framework/study/measures/question.h"

/// Many runs of one scene: what is measured of each, the cases, the tables. docs/studies.md
namespace pintle {

/// A number that a run, or another analysis, yields, asked for in words: "peak force at gudgeon pin", "x of slider at 0.05 s",
/// "energy lost", "rms torque of crank drive after 10 ms", "frequency of mode 1". docs/studies.md has the grammar.
struct Measure {
  std::string name;                     ///< heads its column
  std::string words;                    ///< as the user wrote them
  Place place = {};                     ///< where
  std::string file = {};                ///< of the study, for messages; empty: the scene's
  Question question = {};               ///< what yields it
  std::optional<PathTarget> path = {};  ///< instead of words: the rms distance of a curve to these points
  std::size_t situation = 0;            ///< of the study, in which it is measured; without situations 0
};

struct MeasuredValue {
  double value = 0;  ///< NaN: the run did not come so far, or there is no such thing (the stress of a body that is rigid in this case)
  std::string unit;  ///< SI: "N", "J", "m"; may be empty
};
/// What a measure is in a run. Of the scene, the names count: it is the one that was built.
/// @throws SceneError  the words cannot be read, or name what the scene has not; with what it has
MeasuredValue measured(const Measure&, const Scene&, const Model&, const Run&);
/// Where the curve of a measure with a path passes its points. @pre it has one
std::vector<Passage> passages_of(const Measure&, const Scene&, const Run&);

/// What it is about in each row of a run, whatever its statistic. Empty: there is no such thing in this case.
std::vector<double> curve(const Measure&, const Scene&, const Model&, const Run&);

/// Its unit, without a run. @throws SceneError  as above
std::string measured_unit(const Measure&, const Scene&);

/// Judges the words against a scene before anything runs.
/// @throws SceneError  as above, or a time lies beyond the run's end
void judge(const std::vector<Measure>&, const Scene&);
/// Judges measures of what only a flexible body has: stress, displacement, modes.
/// @param varied  what cases of the scene set: parameters and paths. One below `bodies.BODY` may make it flexible.
/// @throws SceneError  the body is rigid, and no case may change that
void validate_flexible(const std::vector<Measure>&, const Scene&, const std::vector<std::string>& varied);

/// Makes a scene put out what the measures need, so that they are what they say and not what the output interval shows of
/// them: points and stresses recorded, 2000 rows in a window, a row at each instant. No frames. Called after with_pieces,
/// before build. Words that cannot be read or name what is not there are passed over.
void prepare(Scene&, const std::vector<Measure>&);

}  // namespace pintle
