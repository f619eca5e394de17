#pragma once

#include <string>
#include <vector>

#include "framework/run/simulate.h"

/// Many runs of one scene: what is measured of each, the cases, the tables. docs/studies.md
namespace pintle {

/// A number that a run yields, asked for in words: "peak force at gudgeon pin", "x of slider at 0.05 s",
/// "energy lost", "rms torque of crank drive after 10 ms". docs/studies.md has the grammar.
struct Measure {
  std::string name;   ///< heads its column
  std::string words;  ///< as the user wrote them
  Place place;        ///< where
};

/// What a measure means in one model: found once, evaluated on any run of it.
/// @throws SceneError  the words cannot be read, or name what the model lacks; with what it has
struct MeasuredValue {
  double value = 0;   ///< NaN: the run did not come so far, or the scene lacks it (a clearance that this case has not)
  std::string unit;   ///< SI: "N", "J", "m"; may be empty
};
MeasuredValue measured(const Measure&, const Scene&, const Model&, const Run&);

/// The outputs that a scene must make beside its own, so that the measure is what it says and not what the output
/// interval shows of it: points recorded, an interval short enough, an instant hit. Called before build.
void prepare(Scene&, const std::vector<Measure>&);

}  // namespace pintle
