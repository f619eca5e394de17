// What an integrator remembers, out to bytes and back: the part of Integrator that a restart needs.
#include <sstream>
#include <stdexcept>

#include "framework/integration/archive.h"
#include "framework/integration/integrator.h"

namespace pintle {

template <class A>
void Integrator::archive(A& x) {
  x(step_.from, step_.to, step_.h, h_, h_open_, h_closed_, error_before_, fastest_, energy_, open_impact_, loss_at_begin_,
    impacts_, counts_, failure_, events_here_, worst_position_, worst_velocity_, held_by_stability_, fallen_back_, at_fork_, switched_, eq_.evaluations,
    eq_.factorizations);
  bool implicit = alpha_.has_value();
  const auto name = [](const Tableau* t) { return t ? std::string(t->name) : std::string(); };
  std::string pair = name(stages_ ? &stages_->tableau() : nullptr), fallback = name(scheme_.fallback);
  x(implicit, pair, fallback, scheme_.switch_below);
  if constexpr (A::loading) {
    if (const Tableau* saved = find_tableau(pair); saved && stages_ && x.good()) {  // what `auto` takes now may be another
      if (saved != scheme_.tableau && switched_.empty()) switched_ = pair + " throughout, as in the run that was saved";
      stages_.emplace(system_, *saved, scheme_.constraints);
      scheme_.fallback = find_tableau(fallback);
    }
    if (implicit && stages_ && x.good()) {  // it had switched
      stages_.reset();
      alpha_.emplace(system_, eq_, scheme_.rho, scheme_.constraints, scheme_.tolerance);
    }
  }
  if (alpha_.has_value() != implicit)
    x.stream.setstate(std::ios::failbit);
  else if (alpha_)
    x(*alpha_);
  else
    x(*stages_);
}

std::string Integrator::save() const {
  std::ostringstream out(std::ios::binary);
  Writer writer(out);
  writer(*this);
  return out.str();
}

void Integrator::load(const std::string& saved) {
  std::istringstream in(saved, std::ios::binary);
  Reader reader(in);
  reader(*this);
  const auto whole = [&](const Instant& node) {
    return node.state.y.size() == system_.n_y() && node.dy.size() == system_.n_y() &&
           node.state.impact_rate.size() == system_.contacts.size();
  };
  if (!reader.good() || in.peek() != std::istringstream::traits_type::eof() || !whole(step_.from) || !whole(step_.to) ||
      open_impact_.size() != system_.contacts.size())
    throw std::invalid_argument("not the state of an integrator of this system");
  step_.error.setZero(system_.n_y());
  scratch_ = step_.to;
  dense_ = step_.to.state;
  const long evaluations = eq_.evaluations, factorizations = eq_.factorizations;
  if (alpha_)
    restore();
  else
    stages_->settle(system_, scratch_, eq_);
  eq_.evaluations = evaluations, eq_.factorizations = factorizations;
}

}  // namespace pintle
