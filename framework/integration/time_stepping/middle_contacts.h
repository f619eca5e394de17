#pragma once

#include <vector>

#include "framework/common/members.h"
#include "framework/dynamics/model/system.h"

namespace pintle {

/// Which rigid contacts are closed in the middles of the steps of a time-stepping scheme. Bodies overlap there by what a step moves them,
/// which is more than a corner may lie beyond the end of an edge: so a contact belongs to the piece through which it came on the way from
/// the middle before, and stays with it. One that was pressed in the step before is closed still, though it may be open in the middle: on
/// its way round a curve a body is beside it there.
class MiddleContacts {
 public:
  explicit MiddleContacts(const System&);

  /// Looks at the middle of a step h that began at `from` with the speeds of `middle`.
  void look(const State& from, const State& middle, double h);
  bool closed(std::size_t contact) const { return now_[contact]; }
  /// It goes on from the step before.
  bool goes_on(std::size_t contact) const { return goes_on_[contact]; }
  /// A contact that came to this middle from the other side of its bodies; −1: none.
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
