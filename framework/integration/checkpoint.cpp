// Saves and restores the data of an Integrator that a restart needs.
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "framework/common/archive.h"
#include "framework/integration/integrator.h"

namespace pintle {

template <class A>
void Integrator::archive(A& x) {
  std::string method(stepper_->name()), fallback(scheme_.fallback ? scheme_.fallback->name : "");
  x(PINTLE_MEMBERS(method, fallback, scheme_.switch_below, step_.from, step_.to, step_.h, norm_, control_, switching_, events_, counts_,
                   happenings_, failure_, ended_, worst_position_, worst_velocity_, last_tenth_, near_singular_, eq_.permanent,
                   eq_.evaluations, eq_.factorizations));
  if constexpr (A::loading) {
    if (!x.good()) return;
    stepper_ = make_stepper(method, system_, scheme_, eq_);
    if (!stepper_) return x.fail();
    if (method != name(scheme_)) switching_.goes_on_with(method);  // `auto` may choose another method now
    scheme_.fallback = find_tableau(fallback);
    stepper_->load(x);
  } else {
    stepper_->save(x);
  }
}

std::string Integrator::save() const {
  std::ostringstream out(std::ios::binary);
  Writer writer(out);
  writer.whole(*this);
  return std::move(out).str();
}

// Checks all loaded indices and sizes.
const char* Integrator::fault_of_loaded() const {
  const Eigen::Index n = system_.n(), rows = system_.n_rows(), n_y = system_.n_y();
  const auto whole = [&](const Instant& node) {
    const Memory& m = node.memory;
    const bool remembers = m.a.size() == system_.n_s() && m.lambda.size() == rows && m.lambda_before.size() == rows &&
                           m.dy_before.size() == n_y && m.F.size() == n && m.P.size() == n;
    const bool empty = m.a.size() + m.lambda.size() + m.lambda_before.size() + m.dy_before.size() + m.F.size() + m.P.size() == 0;
    return node.state.y.size() == n_y && node.dy.size() == n_y && node.state.impact_rate.size() == system_.contacts.size() &&
           node.state.friction.size() == dry_states(system_) && node.state.y.allFinite() && node.dy.allFinite() &&
           std::isfinite(node.state.t) && (remembers || empty);
  };
  if (step_.to.state.y.size() != n_y) return "its number of coordinates or of energies in its ledger differs";
  if (!whole(step_.from) || !whole(step_.to) || !stepper_->fits(step_.to))
    return "it belongs to another system, or contains numbers that are not finite";
  if (const char* fault = events_.fault()) return fault;
  if (!(step_.h >= 0) || !control_.sound() || eq_.permanent < 0 || eq_.permanent > rows) return "its step is invalid";
  return nullptr;
}

void Integrator::load(const std::string& saved) {
  std::istringstream in(saved, std::ios::binary);
  Reader reader(in);
  reader.whole(*this);
  if (reader.other_layout()) throw std::invalid_argument("it was saved by a build of pintle with another layout of this data");
  if (!reader.good() || in.peek() != std::istringstream::traits_type::eof())
    throw std::invalid_argument("it is incomplete, or belongs to another system");
  if (const char* fault = fault_of_loaded()) throw std::invalid_argument(fault);
  step_.error.setZero(system_.n_y());
  dense_.state = step_.to.state;
  const long evaluations = eq_.evaluations, factorizations = eq_.factorizations;
  hold_laws();
  stepper_->evaluate_end(step_, eq_);
  eq_.evaluations = evaluations, eq_.factorizations = factorizations;
}

}  // namespace pintle
