#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/integration/alpha.h"
#include "framework/integration/sampler.h"
#include "framework/integration/step.h"

namespace pintle {

class Writer;
class Reader;

/// An instant at which a law of time changes its course: steps end at `before` and go on from `after`, a few roundings later.
struct LawChange {
  double before, after;  ///< [s]
  bool jumps;            ///< forces or accelerations do; else only what is finer
};

struct Scheme {
  const Tableau* tableau = nullptr;  ///< explicit; nullptr: generalised-α
  double tolerance = 1e-8;   ///< local error of each component relative to its scale, see ErrorScale
  Constraints constraints = Constraints::projection;
  double onset_cut = 0;      ///< 0: locate contact onset and loss as events. Positive: the strategy of
                             ///< Flores and Ambrósio (2010), halve the step until the first penetration
                             ///< is below this [m]; loss is then taken at the end of a step
  const Tableau* fallback = nullptr; ///< takes over for good where a stage of `tableau` comes near a singular pose; or none
  double max_step = std::numeric_limits<double>::infinity();  ///< [s]
  std::vector<LawChange> changes = {};          ///< of the laws of time, in order, apart from each other
  std::vector<std::vector<double>> pieces = {};  ///< of each law, ends of its smooth pieces, of which a step passes one whole at most
  long max_steps = 100'000'000;
  double rho = 0.8;          ///< of generalised-α: spectral radius at infinite frequency, 0 to 1
  double switch_below = 0;   ///< an explicit step that stability, not accuracy, holds below this gives way to
                             ///< generalised-α [s]; 0: never
  std::string reason = {};   ///< why this scheme, in words
};

/// As scene files call it.
inline std::string name(const Scheme& s) { return s.tableau ? std::string(s.tableau->name) : "generalized-alpha"; }

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
  template <class A>
  void archive(A& x) { x(PINTLE_MEMBERS(contact, begin, end, approach, separation, deepest, peak_force, lost)); }
};

struct Counts {
  long steps = 0, rejected = 0, events = 0, evaluations = 0, factorizations = 0, partitions = 0;
  template <class A>
  void archive(A& x) { x(PINTLE_MEMBERS(steps, rejected, events, evaluations, factorizations, partitions)); }
};

/// Marches a system in time: adaptive steps of an embedded Runge–Kutta pair or of generalised-α, constraints
/// kept, contacts opened and closed. Each call of `advance` makes one accepted step, which an event may shorten.
class Integrator {
 public:
  /// @pre start meets the constraints nearly; it is settled here, and contacts begun if it overlaps
  Integrator(const System&, const Scheme&, State start);

  /// One step towards `until`, ending there at the latest. @returns false when it cannot; see failure()
  bool advance(double until);
  /// Dense output inside the last step or at its end, fully evaluated in `sampled()`. Of an explicit step it is brought
  /// onto the constraints, of an implicit one, whose a and λ are the scheme's, it is not. Changes nothing of the steps and
  /// depends on the last one alone, not on what was sampled before. @returns false if it cannot be settled
  bool sample(double t, State& out);
  /// At the state that `sample` gave last. @pre there was one
  const Equations& sampled() const { return sampler_->equations(); }

  const State& state() const { return step_.to.state; }
  const Equations& equations() const { return eq_; }  ///< at the present state, while steps succeed
  const Step& last() const { return step_; }
  const std::vector<Impact>& impacts() const { return impacts_; }  ///< in order of beginning
  const std::string& failure() const { return failure_; }
  Counts counts() const;
  double worst_position() const { return worst_position_; }  ///< largest scaled |C| at a step's end
  double worst_velocity() const { return worst_velocity_; }
  bool implicit() const { return alpha_.has_value(); }  ///< now
  const std::string& switched() const { return switched_; }  ///< when and why it became so in the run; else empty

  /// Everything the following steps depend on, and the impacts and counts so far, as they are to the bit.
  /// For this System, scheme and program only.
  std::string save() const;
  /// Goes on from there as the integrator saved would have. Afterwards it is as saved or, where it throws, of no use.
  /// @throws std::invalid_argument saying why it is not what `save` of an integrator of this system made
  void load(const std::string& saved);

 private:
  friend class Writer;
  friend class Reader;
  template <class A>
  void archive(A&);
  const char* fault_of_loaded() const;
  bool settle(Instant&);
  bool attempt(double h);
  bool watch_stiffness();
  bool fall_back();
  double fork_pivot() const;
  bool at_singular_configuration() const;
  bool passes_fork() const;
  std::string trouble() const;
  double fastest_speed(const Eigen::VectorXd& y) const;
  struct Touch {
    double depth, rate;
    template <class A>
    void archive(A& x) { x(PINTLE_MEMBERS(depth, rate)); }
  };
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
  double lightness(int contact) const;
  double onset_step(int contact) const;
  double release_ahead() const;
  double law_ahead(double t) const;
  bool pass_change();
  void look_at_end();
  void follow_impacts();
  bool stop(const std::string& reason);

  const System& system_;
  Scheme scheme_;
  Equations eq_;
  std::optional<Stages> stages_;  ///< one of the two
  std::optional<Alpha> alpha_;
  std::unique_ptr<Sampler> sampler_;  ///< from the first sample on
  Step step_;
  State dense_;
  double h_ = 0, h_open_ = 0, h_closed_ = 0, error_before_ = 1;
  double fastest_ = 0, energy_ = 0, fine_length_ = 1, mass_ = 0, lowest_shape_ = 0;  ///< scales of the error norm
  std::vector<double> reach_;      ///< per body, largest |x_BP| of its markers [m]
  std::vector<int> open_impact_;   ///< per contact, index into impacts_, −1 while open
  std::vector<double> loss_at_begin_;
  std::vector<Impact> impacts_;
  std::vector<Touch> before_, after_;  ///< per contact, at the step's start and end
  bool after_known_ = false;       ///< of the state that the next step starts from
  Counts counts_;
  std::string failure_;
  int events_here_ = 0;
  double worst_position_ = 0, worst_velocity_ = 0;
  int held_by_stability_ = 0;
  double last_tenth_ = 0;  ///< when the last tenth of the steps allowed began [s]
  bool fallen_back_ = false, at_singular_configuration_ = false;
  std::string switched_;
};

}  // namespace pintle
