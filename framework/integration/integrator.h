#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "framework/integration/step.h"

namespace pintle {

struct Scheme {
  const Tableau* tableau = nullptr;
  double tolerance = 1e-8;   ///< local error of each component relative to its scale, see ErrorScale
  Constraints constraints = Constraints::projection;
  double onset_cut = 0;      ///< 0: locate contact onset and loss as events. Positive: the strategy of
                             ///< Flores and Ambrósio (2010), halve the step until the first penetration
                             ///< is below this [m]; loss is then taken at the end of a step
  double max_step = std::numeric_limits<double>::infinity();  ///< [s]
  long max_steps = 100'000'000;
};

/// One stay of a journal at its bearing's wall.
struct Impact {
  int contact;
  double begin;              ///< [s]
  double end = std::numeric_limits<double>::quiet_NaN();         ///< [s]; NaN: still touching
  double approach;           ///< speed at begin, as latched [m/s]
  double separation = std::numeric_limits<double>::quiet_NaN();  ///< speed at end [m/s]
  double deepest = 0;        ///< [m]
  double peak_force = 0;     ///< normal [N]
  double lost = 0;           ///< to hysteresis and friction [J]
};

struct Counts {
  long steps = 0, rejected = 0, events = 0, evaluations = 0, factorizations = 0, partitions = 0;
};

/// Marches a system in time: adaptive embedded Runge–Kutta steps, constraints kept, contacts opened
/// and closed. Each call of `advance` makes one accepted step, which an event may shorten.
class Integrator {
 public:
  /// @pre start meets the constraints nearly; it is settled here, and contacts begun if it overlaps
  Integrator(const System&, const Scheme&, State start);

  /// One step towards `until`, ending there at the latest. @returns false when it cannot; see failure()
  bool advance(double until);
  /// Dense output inside the last step, on the constraints and fully evaluated: `equations()` holds it
  /// until the next call. @returns false if it cannot be settled
  bool sample(double t, State& out);

  const State& state() const { return step_.to.state; }
  const Equations& equations() const { return eq_; }
  /// Evaluates equations() at the present state again, after `sample` has used them.
  void restore();
  const Step& last() const { return step_; }
  const std::vector<Impact>& impacts() const { return impacts_; }  ///< in order of beginning
  const std::string& failure() const { return failure_; }
  Counts counts() const;
  double worst_position() const { return worst_position_; }  ///< largest scaled |C| at a step's end
  double worst_velocity() const { return worst_velocity_; }

 private:
  struct Touch { double depth, rate; };
  Touch touch(int contact, const State&);
  Touch touch_at(int contact, double t);
  double scaled_error();
  bool step_to(double h);
  double first_event(int& contact, bool& onset);
  double crossing(int contact, double t0, double t1, bool onset);
  bool finish_at(double t, int contact);
  void open(int contact);
  void close(int contact, double rate);
  double speed_to_reach(int contact, double depth) const;
  void follow_impacts();
  bool stop(const std::string& reason);

  const System& system_;
  Scheme scheme_;
  Equations eq_;
  Stages stages_;
  Step step_;
  Node scratch_;
  State dense_;
  double h_ = 0, h_open_ = 0, h_closed_ = 0, error_before_ = 1;
  double fastest_ = 0, energy_ = 0, fine_length_ = 1, mass_ = 0;  ///< scales of the error norm
  std::vector<double> reach_;      ///< per body, largest |x_BP| of its markers [m]
  std::vector<int> open_impact_;   ///< per contact, index into impacts_, −1 while open
  struct Peak { double t, force; };
  std::vector<std::array<Peak, 2>> peaks_;  ///< per contact, normal force at the last two step ends
  std::vector<double> loss_at_begin_;
  std::vector<Impact> impacts_;
  std::vector<Touch> before_;      ///< per contact, at the step's start
  Counts counts_;
  std::string failure_;
  int events_here_ = 0;
  double worst_position_ = 0, worst_velocity_ = 0;
};

}  // namespace pintle
