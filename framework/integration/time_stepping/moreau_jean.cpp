#include "framework/integration/time_stepping/moreau_jean.h"

#include <algorithm>
#include <cmath>

#include "framework/common/archive.h"
#include "framework/common/index.h"
#include "framework/dynamics/equations/energy.h"
#include "framework/dynamics/equations/rigid_contacts.h"
#include "framework/dynamics/equations/sticking.h"

namespace pintle {

using Eigen::Index;
using Eigen::VectorXd;

MoreauJean::MoreauJean(const System& system, double step)
    : system_(system),
      traits_{.order = 2, .implicit = false, .follows_impacts = false, .ends_evaluated = true, .fixed_step = step},
      contacts_(system) {}

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

// From q to q + h/2 s; there, under forces, joints and contacts, s to s⁺; on to q + h/2 (s + s⁺).
bool MoreauJean::attempt(double h, const ErrorNorm&, Step& step, Equations& eq) {
  const Index n = system_.n();
  const State& from = step.from.state;
  step.h = h;
  trouble_ = "singular pose";
  step.error.setZero(system_.n_y());
  middle_ = from;
  middle_.t = from.t + h / 2;
  middle_.y.head(n) += h / 2 * from.y.segment(n, n);
  contacts_.look(middle_, h);
  if (const int c = contacts_.passed_through(); c >= 0) {
    trouble_ = "in one step bodies go right through each other at \"" + system_.contact_names[at(c)] + "\"; take a shorter step";
    return false;
  }
  std::ranges::fill(middle_.impact_rate, 0.0);
  std::ranges::fill(middle_.friction, DryFriction{});
  pose(system_, middle_.t, middle_.y, eq);
  factor(system_, middle_.y, eq);
  if (!eq.regular) return false;
  for (int i = 0; i < 2; ++i) {  // what depends on speeds, with those of the middle
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
  if (!to.y.allFinite() || !evaluate_node(step.to, eq)) return false;
  book_rates(step);
  book_loss(to, eq);
  return step.to.dy.allFinite();
}

// Impulses of the contacts that are closed in the middle.
bool MoreauJean::put_impulses(double h, const State& from, VectorXd& speeds, State& to, Equations& eq) {
  std::ranges::fill(to.impact_rate, 0.0);
  std::ranges::fill(to.friction, DryFriction{});
  for (std::size_t c = 0; c < system_.contacts.size(); ++c)
    if (contacts_.closed(c)) middle_.impact_rate[c] = system_.contacts[c].slowest_impact, middle_.friction[c].direction = 0;
  evaluate_held(system_, middle_, eq);
  if (eq.sticking.of.empty()) return true;

  const Closed closed = closed_contacts(system_, middle_, eq);
  std::vector<double> e;
  for (const int c : closed.contact) e.push_back(system_.contacts[at(c)].rigid->restitution);
  const Eigen::MatrixXd W = respond_to_sticking(system_, eq);
  const VectorXd before = eq.sticking.J.transpose() * from.y.segment(system_.n(), system_.n()), free = eq.sticking.J.transpose() * speeds;
  auto x = newton_impulses(system_, closed, e, W, before, free);
  if (!x) {  // bodies wedged between others cannot all part as e says
    std::ranges::fill(e, 0.0);
    x = newton_impulses(system_, closed, e, W, before, free);
  }
  if (!x) {
    trouble_ = "no impulses stop the bodies that meet at \"" + system_.contact_names[at(closed.contact.front())] +
               "\": a driver or too many contacts may press them together; give contacts a law with a stiffness";
    return false;
  }
  speeds += eq.sticking.a * *x;
  book_impulses(system_, closed, *x, (before + free + W * *x) / 2, to);
  book_driver_impulses(system_, eq, eq.sticking.lambda * *x, to);
  for (std::size_t i = 0; i < closed.unknowns.size(); ++i) {
    const UnilateralContact& k = closed.unknowns[i];
    const auto c = at(closed.contact[i]);
    if (!((*x)[k.normal] > 0)) continue;
    to.impact_rate[c] = std::max(-before[k.normal], system_.contacts[c].slowest_impact);
    to.friction[c] = {DryFriction::given, k.tangent >= 0 ? (*x)[k.tangent] / h : 0, (*x)[k.normal] / h};
  }
  return true;
}

// By the trapezoidal rule, but for what impulses have booked.
void MoreauJean::book_rates(Step& step) const {
  for (std::size_t i = 0; i < system_.integrals.size(); ++i) {
    const Account account = system_.integrals[i].account;
    if (account != Account::damper && account != Account::load && account != Account::damping) continue;
    const Index z = system_.z_begin() + static_cast<Index>(i);
    step.to.state.y[z] += step.h / 2 * (step.from.dy[z] + step.to.dy[z]);
  }
}

// What is missing of the balance is lost to the scheme.
void MoreauJean::book_loss(State& state, const Equations& eq) const {
  const auto scheme = std::ranges::find(system_.integrals, Account::scheme, &Integral::account) - system_.integrals.begin();
  state.y[system_.z_begin() + scheme] += balance_ - energies(system_, state, eq).balance();
}

// Places and speeds between the ends of a step are known no better than to its first order.
void MoreauJean::interpolate(const Step& step, double t, State& out) const {
  const double x = (t - step.from.state.t) / step.h;
  out.t = t;
  out.impact_rate = step.to.state.impact_rate;
  out.friction = step.to.state.friction;
  out.y = (1 - x) * step.from.state.y + x * step.y_end();
}

bool MoreauJean::sample(const Step& step, double t, Equations& eq, State& out) {
  if (t < step.to.state.t)
    interpolate(step, t, out);
  else
    out = step.to.state;
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
}
void MoreauJean::load(Reader& in) {
  in.whole(balance_);
  in.whole(contacts_);
}

}  // namespace pintle
