#include "framework/integration/time_stepping/moreau_jean.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/common/archive.h"
#include "framework/common/index.h"
#include "framework/dynamics/equations/energy.h"
#include "framework/dynamics/equations/rigid_contacts.h"
#include "framework/dynamics/equations/sticking.h"
#include "framework/integration/events/impact_log.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MoreauJean::MoreauJean(const System& system, double step)
    : system_(system),
      traits_{.order = 2, .implicit = false, .follows_impacts = false, .ends_evaluated = true, .fixed_step = step},
      contacts_(system),
      given_(system.contacts.size(), 0.0),
      given_now_(given_),
      left_(given_) {}

bool MoreauJean::evaluate_node(Instant& node, Equations& eq) {
  if (!pintle::project(system_, node.state.t, node.state.y, eq)) return false;
  accelerate(system_, node.state, eq);
  fill_derivative(system_, node.state.y, eq, node.dy);
  return eq.regular;
}

bool MoreauJean::project(Instant& node, Equations& eq) {
  if (!evaluate_node(node, eq)) return false;
  balance_ = energies(system_, node.state, eq).balance();
  return true;
}

// From q to q + h/2 s; there, under forces, joints and contacts, s to s⁺; then to q + h/2 (s + s⁺).
bool MoreauJean::attempt(double h, const ErrorNorm&, Step& step, Equations& eq) {
  const Index n = system_.n();
  const State& from = step.from.state;
  step.h = h;
  trouble_ = "singular configuration, which steps of one length do not pass; take method: auto, or start or drive the mechanism elsewhere";
  step.error.setZero(system_.n_y());
  middle_ = from;
  middle_.t = from.t + h / 2;
  middle_.y.head(n) += h / 2 * from.y.segment(n, n);
  contacts_.look(from, middle_, h);
  if (const int c = contacts_.passed_through(); c >= 0) {
    trouble_ = "bodies pass through each other within one step at \"" + system_.contact_names[at(c)] + "\"; use a shorter step";
    return false;
  }
  std::ranges::fill(middle_.impact_rate, 0.0);
  std::ranges::fill(middle_.friction, DryFriction{});
  pose(system_, middle_.t, middle_.y, eq);
  factor(system_, middle_.y, eq);
  if (!eq.regular) return false;
  for (int i = 0; i < 2; ++i) {  // speed-dependent quantities, with the speeds of the midpoint
    middle_.y.segment(n, n) = from.y.segment(n, n) + (i == 0 ? VectorXd(VectorXd::Zero(n)) : VectorXd(h / 2 * eq.a));
    speed(system_, middle_.t, middle_.y, eq);
    accelerate(system_, middle_, eq);
    if (!eq.regular) return false;
  }

  State& to = step.to.state;
  to = from;
  to.t = from.t + h;
  VectorXd speeds = from.y.segment(n, n) + h * eq.a;
  book_driver_impulses(system_, eq, h * eq.lambda, to);
  if (!put_impulses(h, from, speeds, to, eq)) return false;
  to.y.segment(n, n) = speeds;
  to.y.head(n) = middle_.y.head(n) + h / 2 * speeds;
  to.y.segment(system_.x_begin(), system_.n_x()) += h * step.from.dy.segment(system_.x_begin(), system_.n_x());
  if (!to.y.allFinite() || !evaluate_node(step.to, eq) || !push_apart(step.to, eq)) return false;
  book_rates(step);
  book_loss(to, eq);
  return step.to.dy.allFinite();
}

// Impulses of the contacts that are closed at the midpoint: Newton's law for the opening speeds and slips at the start and end of the step,
// which are those at the midpoint corrected for the rotation of J in half a step. For a continuing contact, the gap left by the step
// before, of order h³, is added to the speed at the end and does not count as approach speed in the next step.
bool MoreauJean::put_impulses(double h, const State& from, VectorXd& speeds, State& to, Equations& eq) {
  constexpr double rounding = 1e-10;  // relative to the approach speeds
  std::ranges::fill(given_now_, 0.0);
  std::ranges::fill(left_, std::numeric_limits<double>::infinity());
  std::ranges::fill(to.impact_rate, 0.0);
  std::ranges::fill(to.friction, DryFriction{});
  for (std::size_t c = 0; c < system_.contacts.size(); ++c)
    if (contacts_.closed(c)) middle_.impact_rate[c] = system_.contacts[c].slowest_impact, middle_.friction[c].direction = 0;
  evaluate_held(system_, middle_, eq);
  if (eq.sticking.of.empty()) return true;

  const Closed closed = closed_contacts(system_, middle_, eq);
  std::vector<double> e;
  for (const int c : closed.contact) e.push_back(system_.contacts[at(c)].rigid->restitution);
  const MatrixXd W = respond_to_sticking(system_, eq);
  const auto& J = eq.sticking.J;
  const VectorXd turning = h / 2 * (sticking_accelerations(system_, eq) - J.transpose() * eq.a);
  const VectorXd before = J.transpose() * from.y.segment(system_.n(), system_.n()) - turning, free = J.transpose() * speeds + turning;
  const double fastest = fastest_there(eq, speeds.cwiseAbs() + from.y.segment(system_.n(), system_.n()).cwiseAbs());
  VectorXd meeting = before, closing = free;
  for (std::size_t i = 0; i < closed.unknowns.size(); ++i) {
    const auto c = at(closed.contact[i]);
    const int k = closed.unknowns[i].normal;
    meeting[k] += given_[c];
    if (!contacts_.goes_on(c)) continue;
    const double most = std::abs(turning[k]);
    given_now_[c] = std::clamp(-gap_of(system_, closed.contact[i], from).value / h, -most, most);
    closing[k] += given_now_[c];
  }
  auto x = newton_impulses(system_, closed, e, W, meeting, closing, fastest);
  if (!x) {  // bodies wedged between others cannot all separate with restitution e
    std::ranges::fill(e, 0.0);
    x = newton_impulses(system_, closed, e, W, meeting, closing, fastest);
  }
  if (!x) {
    trouble_ = "contact \"" + system_.contact_names[at(closed.contact.front())] + "\": no impulses can stop the bodies that meet here; " +
               pressed_together;
    return false;
  }
  speeds += eq.sticking.a * *x;
  const VectorXd after = free + W * *x;
  book_impulses(system_, closed, *x, (before + after) / 2, to);
  book_driver_impulses(system_, eq, eq.sticking.lambda * *x, to);
  for (std::size_t i = 0; i < closed.unknowns.size(); ++i) {
    const UnilateralContact& k = closed.unknowns[i];
    const auto c = at(closed.contact[i]);
    if (!((*x)[k.normal] > 0)) {
      given_now_[c] = 0;
      continue;
    }
    if (!(after[k.normal] > rounding * std::abs(before[k.normal]))) left_[c] = contacts_.goes_on(c) ? h * std::abs(turning[k.normal]) : 0;
    to.impact_rate[c] = std::max(-before[k.normal], system_.contacts[c].slowest_impact);
    const double over = time_of_force(system_, closed.contact[i], from, h, traits_.fixed_step);
    to.friction[c] = {DryFriction::given, k.tangent >= 0 ? (*x)[k.tangent] / over : 0, (*x)[k.normal] / over};
  }
  return true;
}

// Bodies that overlap and stay in contact at the end of the step, as after an impact without restitution, are separated by the smallest
// displacement in the metric of M, without pushing one into another that was closed. The impact has removed as much energy in excess as
// this adds. Wedged bodies stay as they are.
bool MoreauJean::push_apart(Instant& end, Equations& eq) {
  constexpr int most = 3;
  State apart = end.state;
  VectorXd worked = VectorXd::Zero(static_cast<Index>(system_.contacts.size()));  // by each contact, up to a factor
  double balance = 0;
  bool pushed = false;
  for (int i = 0; i < most; ++i) {
    bool overlap = false;
    for (std::size_t c = 0; c < system_.contacts.size(); ++c) {
      const ContactPair& pair = system_.contacts[c];
      const int k = static_cast<int>(c);
      const bool closed = contacts_.closed(c) && (!pair.profiles || margin_of(system_, k, apart).value >= 0);
      overlap = overlap || (closed && gap_of(system_, k, apart).value > std::max(pair.slack, left_[c]));
      apart.impact_rate[c] = closed ? pair.slowest_impact : 0;
      apart.friction[c] = {};
    }
    if (!overlap) break;
    if (!pushed) balance = energies(system_, end.state, eq).balance();
    pushed = true;
    evaluate_held(system_, apart, eq);
    const Closed closed = closed_contacts(system_, apart, eq);
    const MatrixXd W = respond_to_sticking(system_, eq);
    VectorXd gaps(W.cols());
    for (std::size_t k = 0; k < closed.contact.size(); ++k) {
      const double gap = -eq.contact[at(closed.contact[k])].gap.depth;
      gaps[closed.unknowns[k].normal] = std::isfinite(left_[at(closed.contact[k])]) ? gap : std::max(gap, 0.0);
    }
    const auto x = unilateral_forces(closed.unknowns, W, gaps);
    if (!x) break;
    for (std::size_t k = 0; k < closed.contact.size(); ++k) {
      const Index n = closed.unknowns[k].normal;
      worked[closed.contact[k]] += std::max(-gaps[n], 0.0) * (*x)[n];
    }
    apart.y.head(system_.n()) += eq.sticking.a * *x;
    if (!pintle::project(system_, apart.t, apart.y, eq)) return false;
  }
  end.state.y = apart.y;
  if (!pushed || !evaluate_node(end, eq)) return !pushed;
  if (!(worked.sum() > 0)) return true;
  const double lifted = energies(system_, end.state, eq).balance() - balance;
  for (std::size_t c = 0; c < system_.contacts.size(); ++c)
    end.state.y[system_.z_begin() + system_.contact_z[c]] -= lifted * worked[static_cast<Index>(c)] / worked.sum();
  return true;
}

// Integrals by the trapezoidal rule, except those that impulses have recorded.
void MoreauJean::book_rates(Step& step) const {
  for (std::size_t i = 0; i < system_.integrals.size(); ++i) {
    const Account account = system_.integrals[i].account;
    if (account != Account::damper && account != Account::load && account != Account::damping) continue;
    const Index z = system_.z_begin() + static_cast<Index>(i);
    step.to.state.y[z] += step.h / 2 * (step.from.dy[z] + step.to.dy[z]);
  }
}

// The remaining difference in the energy balance is attributed to the scheme.
void MoreauJean::book_loss(State& state, const Equations& eq) const {
  const auto scheme = std::ranges::find(system_.integrals, Account::scheme, &Integral::account) - system_.integrals.begin();
  state.y[system_.z_begin() + scheme] += balance_ - energies(system_, state, eq).balance();
}

// Positions and speeds between the ends of a step are accurate only to first order.
void MoreauJean::interpolate(const Step& step, double t, VectorXd& y) const {
  const double x = (t - step.from.state.t) / step.h;
  y = (1 - x) * step.from.state.y + x * step.y_end();
}

bool MoreauJean::sample(const Step& step, double t, Equations& eq, State& out) {
  out = step.to.state;
  if (t < step.to.state.t) out.t = t, interpolate(step, t, out.y);
  if (!pintle::project(system_, out.t, out.y, eq)) return false;
  accelerate(system_, out, eq);
  book_loss(out, eq);
  return eq.regular;
}

void MoreauJean::evaluate_end(const Step& step, Equations& eq) {
  Instant end = step.to;
  evaluate_node(end, eq);
}

void MoreauJean::save(Writer& out) const {
  out.whole(balance_);
  out.whole(contacts_);
  out.whole(given_);
}
void MoreauJean::load(Reader& in) {
  in.whole(balance_);
  in.whole(contacts_);
  in.whole(given_);
}

}  // namespace pintle
