#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"
#include "tests/paper/plot.h"

/// The atlas of extremes: how far each axis of a scene may go, and what is said past that. One table of cases, run by the
/// tests (atlas_test.cpp), which assert every verdict, and by the program that prints docs/stability.md (page.cpp).
namespace extremes {

using pintle::printed;

/// How a case may end. Nothing else is allowed: a number that is not finite, an exception that is no SceneError or AssemblyError,
/// an end without a reason or no end within the case's time is trouble, whatever the case expects.
enum class End {
  finished,  ///< Status::finished and no warning
  warned,    ///< Status::finished, with a warning
  stopped,   ///< any other Status, with a reason
  rejected   ///< a SceneError or AssemblyError, before the run
};
const char* word(End);

/// A scene read, built, assembled and run; throws nothing.
struct Attempt {
  End end = End::rejected;
  std::string said;     ///< reason, message or first warning; else empty
  std::string trouble;  ///< what must never be: see End. Empty: sound
  std::optional<pintle::Scene> scene;
  std::optional<pintle::Model> model;
  std::optional<pintle::Run> run;  ///< as far as it went

  bool whole() const { return run && (end == End::finished || end == End::warned) && trouble.empty(); }
  /// Of the trajectory; the name without its unit: "slider.x". @throws std::out_of_range
  std::vector<double> column(const std::string& name) const;
  double last(const std::string& name) const { return column(name).back(); }
  std::vector<double> ledger(const std::string& name) const;  ///< likewise of the ledger
  /// Energy left unexplained at worst, over the energy in play.
  double open_books() const;
};
/// @param seconds  of computing; a run that takes longer is stopped and that is trouble
Attempt attempt(const std::string& scene_text, double seconds = 60);
Attempt attempt(pintle::Scene, double seconds = 60);

/// What a case's runner answers.
struct Finding {
  End end = End::finished;
  std::string said, trouble;  ///< as of an Attempt
  double measured = 0;        ///< the figure asserted; ≥ 0
  double bound = 0;           ///< it must not exceed this; 0 where `measured` is 0: exact. Negative: nothing is measured
};
/// Nothing measured: how it ended is all that is asserted.
Finding ended(const Attempt&);
/// A figure and its bound; if the attempt did not finish, no figure.
Finding measured(const Attempt&, double measured, double bound);
/// The worst of several: first whatever is trouble or did not end as `first` did, else the largest measured/bound.
Finding worst(const std::vector<Finding>&);

/// One point of an axis.
struct Case {
  double value = 0;         ///< place on the axis, SI; orders the rows
  std::string label;        ///< the same as a reader wants it, "10 nm"; with `what` it names the test, unique within the axis
  std::string what = {};    ///< what else distinguishes it, "gonthier"; may be empty
  End end = End::finished;  ///< how it must end
  std::string says = {};    ///< what `said` must contain
  std::function<Finding()> run = {};
  bool nightly = false;  ///< takes minutes: not in plain ctest
  /// Not empty: it may also be refused, saying this. For values at which rounding decides, which differs between processors.
  std::string or_refused = {};
};

struct Axis {
  std::string name;      ///< "radial clearance"
  std::string text;      ///< the mechanism, and what varies
  std::string asserted;  ///< what is measured, against which limit, law or oracle
  std::string why;       ///< why so much is allowed
  std::vector<Case> cases;
};
using Atlas = std::vector<Axis>;

/// A case with what running it gave.
struct Row {
  const Axis* axis;
  const Case* what;
  Finding found;
  double seconds = 0;
  std::string wrong() const;  ///< what is not as it must be, in words; empty: the verdict is good
};
Row row(const Axis&, const Case&);  ///< runs it; throws nothing

/// The tables. A new family of axes: a file, a declaration here, a line in atlas().
Atlas axes_of_contact();  ///< clearance, stiffness, restitution, friction, starts: contact*.cpp
Atlas axes_of_motion();   ///< speed, mass, slenderness, damping, tolerance, units, …
const Atlas& atlas();     ///< all of them, made once

// --- words for writing scenes ---

std::string number(double);  ///< all its digits, as a scene reads it
/// A rigid four-bar, slider-crank … are texts; `text` with each {name} replaced by its value.
std::string with(std::string text, const std::vector<std::pair<std::string, std::string>>& values);

}  // namespace extremes
