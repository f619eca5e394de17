#include "framework/analysis/simulate/undecided_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/common/dense.h"
#include "framework/common/index.h"
#include "framework/common/some_of.h"
#include "framework/common/text.h"
#include "framework/dynamics/equations/rigid_contacts.h"
#include "framework/dynamics/equations/sharing.h"
#include "framework/dynamics/equations/sticking.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

UndecidedContacts::UndecidedContacts(const System& system) : system_(system) {
  for (std::size_t c = 0; c < system.contacts.size(); ++c)
    if (is_rigid(system.contacts[c])) rigid_.push_back(c);
  now_.resize(rigid_.size(), Doing::open);
  before_ = now_;
}

// If a time-stepping scheme gives the forces, what the contact does follows from them; `see` sets `struck` in its first step, which may be
// a bounce.
UndecidedContacts::Doing UndecidedContacts::doing(std::size_t contact, const State& state) const {
  constexpr double limit = 1e-9;  // relative to the largest static friction: a smaller difference from it is rounding
  if (!(state.impact_rate[contact] > 0)) return Doing::open;
  const Coulomb* law = dry_law(system_, contact);
  const DryFriction& dry = state.friction[contact];
  if (!law || dry.direction == DryFriction::undecided) return Doing::without_friction;
  if (dry.direction == 0) return Doing::sticks;
  if (dry.direction != DryFriction::given) return dry.direction > 0 ? Doing::slides_on : Doing::slides_back;
  if (std::abs(dry.force) < (1 - limit) * law->mu_static * dry.load) return Doing::sticks;
  return dry.force < 0 ? Doing::slides_on : Doing::slides_back;
}

// The state, with given forces replaced by what each contact does.
State UndecidedContacts::decided(const State& state) const {
  State out = state;
  for (std::size_t i = 0; i < rigid_.size(); ++i) {
    DryFriction& dry = out.friction[rigid_[i]];
    if (now_[i] == Doing::struck) out.impact_rate[rigid_[i]] = 0;
    if (dry.direction != DryFriction::given) continue;
    dry = {};
    if (now_[i] == Doing::sticks || now_[i] == Doing::without_friction) dry.direction = 0;
    if (now_[i] == Doing::slides_on) dry.direction = 1;
    if (now_[i] == Doing::slides_back) dry.direction = -1;
  }
  return out;
}

void UndecidedContacts::see(const State& state) {
  if (rigid_.empty() || (!shares_.empty() && !two_motions_.empty())) return;
  const bool first = !eq_;
  bool changed = first;
  for (std::size_t i = 0; i < rigid_.size(); ++i) {
    before_[i] = first ? Doing::slides_on : now_[i];
    now_[i] = doing(rigid_[i], state);
    if (state.friction[rigid_[i]].direction == DryFriction::given && before_[i] == Doing::open) now_[i] = Doing::struck;
    changed = changed || now_[i] != before_[i];
  }
  if (!changed) return;
  if (first) eq_ = std::make_unique<Equations>(system_), dy_.resize(system_.n_y());
  const State here = decided(state);
  if (!evaluate(system_, here, *eq_, dy_)) return;
  if (shares_.empty()) look_for_shares(here);
  if (two_motions_.empty()) look_for_two_motions(here);
}

namespace {

// Columns of forces: each normal force with the friction that it causes while sliding, and each sticking force. Of equal columns, as where
// two corners meet, only the first is kept.
MatrixXd directions_of(const Equations& eq, const Closed& closed, std::vector<int>& contact) {
  constexpr double same = 1e-9;
  const auto columns = std::ssize(eq.sticking.of);
  MatrixXd out(columns, columns);  // columns among those of eq.sticking
  Index count = 0;
  std::vector<VectorXd> taken;
  const auto take = [&](const VectorXd& column, int of) {
    const VectorXd does = eq.sticking.J * column;
    const auto is_same = [&](const VectorXd& other) { return (does - other).norm() <= same * does.norm(); };
    if (std::ranges::any_of(taken, is_same)) return;
    taken.push_back(does);
    out.col(count++) = column;
    contact.push_back(of);
  };
  std::vector<bool> seen(eq.sticking.of.size());
  for (std::size_t i = 0; i < closed.unknowns.size(); ++i) {
    const UnilateralContact& k = closed.unknowns[i];
    VectorXd column = VectorXd::Unit(out.rows(), k.normal);
    if (k.sliding >= 0) column[k.sliding] = -k.direction * k.mu;
    take(column, closed.contact[i]);
    seen[at(k.normal)] = true;
  }
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (!seen[i] && eq.sticking.of[i].holds) take(VectorXd::Unit(out.rows(), static_cast<Index>(i)), -1);
  return out.leftCols(count);
}

std::string listed(const System& system, const std::vector<int>& contacts) {
  std::vector<std::string> names;
  for (const int c : contacts)
    if (const std::string& name = system.contact_names[at(c)]; std::ranges::find(names, name) == names.end()) names.push_back(name);
  return some_of(names);
}

}  // namespace

// Looks for forces without effect on the motion, W z = 0, that include normal forces.
void UndecidedContacts::look_for_shares(const State& state) {
  const auto closed_now = std::ranges::count_if(now_, [](Doing d) { return d != Doing::open && d != Doing::struck; });
  if (closed_now < 2) return;
  std::vector<int> contact;
  const MatrixXd directions = directions_of(*eq_, closed_contacts(system_, state, *eq_), contact),
                 W = directions.transpose() * (eq_->sticking.J.transpose() * eq_->sticking.a) * directions;
  if (W.cols() < 2 || !W.allFinite()) return;
  const VectorXd unit = W.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(unit.asDiagonal() * W * unit.asDiagonal()));
  const Index none = (eigen.eigenvalues().array() <= one_force * eigen.eigenvalues().maxCoeff()).count();
  if (none == 0) return;
  std::vector<int> shared;
  for (std::size_t i = 0; i < contact.size(); ++i)
    if (contact[i] >= 0 && eigen.eigenvectors().row(static_cast<Index>(i)).head(none).norm() > std::sqrt(one_force))
      shared.push_back(contact[i]);
  if (shared.size() < 2) return;
  shares_ = "rigid contacts " + listed(system_, shared) + ": from t = " + number_text(state.t, 6) +
            " s on more are closed than the motion can tell apart, so that the motion and sums of forces are certain, but not each single "
            "normal force: the run takes those that share the load most evenly. Where single ones matter give the contacts a law with a "
            "stiffness instead of model: impact";
}

// A sliding, pressed contact could also open if it would do so without force. A contact that has just opened, or touches at the start but
// is open, could also be pressed.
void UndecidedContacts::look_for_two_motions(const State& state) {
  for (std::size_t i = 0; i < rigid_.size() && two_motions_.empty(); ++i) {
    const std::size_t c = rigid_[i];
    const bool slides = now_[i] == Doing::slides_on || now_[i] == Doing::slides_back,
               opened = now_[i] == Doing::open && before_[i] != now_[i];
    if (!dry_law(system_, c) || !(slides || opened)) continue;
    const double direction = now_[i] == Doing::slides_on ? 1 : now_[i] == Doing::slides_back ? -1 : 0;
    if (!goes_both_ways(c, state, direction)) continue;
    two_motions_ = quoted(system_.contact_names[c]) + ": at t = " + number_text(state.t, 6) +
                   " s rigid bodies with so much friction can either be pressed there or part (Painlevé); the run assumes that " +
                   (slides ? "they are pressed" : "they part") + ". Give the contact a law with a stiffness, or less friction";
  }
}

/// @param direction  of sliding; 0: the contact is open, and the direction is that of its slip
bool UndecidedContacts::goes_both_ways(std::size_t c, const State& state, double direction) {
  constexpr double times = 10, little = 1e-6;
  const ContactPair& pair = system_.contacts[c];
  State closed = state, open = state;
  closed.impact_rate[c] = std::max(state.impact_rate[c], pair.slowest_impact);
  closed.friction[c].direction = direction == 0 ? 1 : direction;
  evaluate_held(system_, closed, *eq_);
  if (direction == 0) {
    const Gap& gap = eq_->contact[c].gap;
    if (gap.depth < -times * pair.slack || std::abs(gap.rate) > pair.slowest_impact || gap.material_slip == 0) return false;
    closed.friction[c].direction = std::copysign(1.0, gap.material_slip);
  }
  // A normal force of 1 N with its friction must accelerate the bodies towards each other.
  const Closed now = closed_contacts(system_, closed, *eq_);
  const auto i = std::ranges::find(now.contact, static_cast<int>(c)) - now.contact.begin();
  if (i == std::ssize(now.contact)) return false;
  const UnilateralContact& k = now.unknowns[at(i)];
  const MatrixXd W = respond_to_sticking(system_, *eq_);
  if (k.sliding < 0 || !(W(k.normal, k.normal) - k.direction * k.mu * W(k.normal, k.sliding) < 0)) return false;
  open.impact_rate[c] = 0, open.friction[c] = {};
  if (!evaluate(system_, open, *eq_, dy_)) return false;
  evaluate_held(system_, closed, *eq_);
  const double parts = sticking_accelerations(system_, *eq_)[k.normal],
               terms = eq_->sticking.J.col(k.normal).cwiseAbs().dot(eq_->a.cwiseAbs()) + std::abs(parts);
  if (!(parts > little * terms)) return false;
  return evaluate(system_, closed, *eq_, dy_) && eq_->contact[c].normal.force > 0;
}

void UndecidedContacts::warn(std::vector<std::string>& warnings) const {
  for (const std::string* doubt : {&shares_, &two_motions_})
    if (!doubt->empty()) warnings.push_back(*doubt);
}

}  // namespace pintle
