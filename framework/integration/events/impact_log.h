#pragma once

#include <span>
#include <vector>

#include "framework/dynamics/equations/rigid_contacts.h"
#include "framework/integration/events/event.h"
#include "framework/integration/events/impact.h"

namespace pintle {

/// Overlap of a contact, minus the slack of a rigid one, and its rate, from the coordinates and speeds alone.
Guard gap_of(const System&, int contact, const State&);
/// The gap of a contact and its normal force, from the same data; nothing else is computed.
ContactEffect pressing(const System&, int contact, const State&);
/// Its normal force at a latched approach speed [m/s]. @pre it is not rigid
NormalForce normal_force(const System&, int contact, const State&, double latched);
/// Positive if an open contact touches: the overlap; for profiles, the least of it and of the margins inside its pieces.
Guard onset_of(const System&, int contact, const State&);
/// For profiles, how far inside its pieces a contact is, and at which side it is nearest to leaving them.
Margin margin_of(const System&, int contact, const State&);

/// Whether the contact, or a pair beyond the ends of its pieces, was under load at the end of the step before.
bool was_pressed(const System&, int contact, const State& from);
/// The time by which time-stepping divides the impulse of a contact in a step h to report a force [s]: h for a continuing contact; the
/// fixed step for an impact, and for a remainder of a step too short to resolve forces.
double time_of_force(const System&, int contact, const State& from, double h, double fixed_step);

struct ToExamine {
  int parts = 0;     ///< of the step; 0: even at twice the speeds of the step's ends the pieces are too far apart to meet
  double reach = 0;  ///< four times the distance between them that is covered at these speeds [m]
};
/// How closely to examine a step for touching: in each part the motion is at most a quarter of the smaller piece.
ToExamine to_examine(const System&, int contact, const Step&);

/// Log of the contacts of each journal with its bearing's wall: updated as each begins, lasts and ends.
class ImpactLog {
 public:
  explicit ImpactLog(const System&);

  bool touching(int contact) const { return open_[static_cast<std::size_t>(contact)] >= 0; }
  /// @param before  state from which its losses are counted   @param gap  where it begins   @param begin  time, which may be more accurate
  /// than the state's
  /// @param latched  its approach speed
  void begin(int contact, const State& before, const Guard& gap, double begin, double latched);
  void end(int contact, double end, double separation);
  /// An impact of a rigid contact while it is closed; it may end the contact. Call after the energy is recorded.
  void strike(const Blow&, const State&);
  /// The contact continues at another pair of the same two profiles.
  void pass(int contact, int to);
  /// Deepest penetration, peak force and loss of the contacts that are closed during an accepted step.
  void follow(const Step&, std::span<const Guard> from, std::span<const Guard> to, const DenseOutput&);
  const std::vector<Impact>& impacts() const { return impacts_; }  ///< in order of their begin

  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(impacts_, open_, loss_at_begin_));
  }
  const char* fault() const;

 private:
  double loss(int contact, const State&) const;
  void follow(int contact, const Step&, const Guard& from, const Guard& to, const DenseOutput&);

  const System& system_;
  std::vector<Impact> impacts_;
  std::vector<int> open_;              ///< per contact, index into impacts_, −1 while open
  std::vector<double> loss_at_begin_;  ///< per contact [J]
};

}  // namespace pintle
