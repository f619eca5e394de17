#pragma once

#include <vector>

#include "framework/common/members.h"
#include "framework/dynamics/model/system.h"

namespace pintle {

/// Which rigid contacts are closed at the midpoints of the steps of a time-stepping scheme. Bodies overlap there by their motion in a step,
/// which can exceed the distance of a corner from the end of an edge. So a contact belongs to the piece that it crossed since the midpoint
/// before, and stays with it. A contact that was under load in the step before stays closed, even if it is open at the midpoint: a body
/// following a curve is off the curve there.
class MiddleContacts {
 public:
  explicit MiddleContacts(const System&);

  /// Examines the midpoint of a step h that began at `from` with the speeds of `middle`.
  void look(const State& from, const State& middle, double h);
  bool closed(std::size_t contact) const { return now_[contact]; }
  /// Whether it continues from the step before.
  bool goes_on(std::size_t contact) const { return goes_on_[contact]; }
  /// A contact that reached this midpoint from the other side of its bodies; −1: none.
  int passed_through() const { return passed_; }
  /// The step is accepted.
  void keep() { before_ = now_; }

  template <class A>
  void archive(A& x) {
    x(PINTLE_MEMBERS(before_));
  }
  bool fits() const { return before_.size() == now_.size(); }

 private:
  bool look(int contact, const State& middle, double h);
  bool is_held_elsewhere(int contact) const;

  const System& system_;
  std::vector<unsigned char> before_, now_, goes_on_;
  int passed_ = -1;
};

}  // namespace pintle
