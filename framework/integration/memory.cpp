// What an integrator remembers, out to bytes and back: the part of Integrator that a restart needs.
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "framework/integration/archive.h"
#include "framework/integration/integrator.h"

namespace pintle {

template <class A>
void Integrator::archive(A& x) {
  x(PINTLE_MEMBERS(step_.from, step_.to, step_.h, h_, h_open_, h_closed_, error_before_, fastest_, energy_, open_impact_, loss_at_begin_, after_,
                   after_known_, impacts_, counts_, failure_, events_here_, worst_position_, worst_velocity_, held_by_stability_, last_tenth_,
                   fallen_back_, at_singular_configuration_, switched_, scheme_.max_step, eq_.permanent, eq_.evaluations, eq_.factorizations));
  bool implicit = alpha_.has_value();
  const auto name = [](const Tableau* t) { return t ? std::string(t->name) : std::string(); };
  std::string pair = name(stages_ ? &stages_->tableau() : nullptr), fallback = name(scheme_.fallback);
  x(PINTLE_MEMBERS(implicit, pair, fallback, scheme_.switch_below));
  if constexpr (A::loading) {
    if (x.good() && implicit) {  // it had switched
      if (!alpha_) alpha_.emplace(system_, eq_, scheme_.rho, scheme_.tolerance);
      stages_.reset();
    } else if (const Tableau* saved = find_tableau(pair); x.good() && saved) {  // what `auto` takes now may be another
      if (saved != scheme_.tableau && switched_.empty()) switched_ = pair + " throughout, as in the run that was saved";
      stages_.emplace(system_, *saved, scheme_.constraints);
      alpha_.reset();
      scheme_.fallback = find_tableau(fallback);
    } else {
      x.fail();
    }
    if (!x.good()) return;
  }
  if (alpha_)
    x.whole(*alpha_);
  else
    x.whole(*stages_);
}

std::string Integrator::save() const {
  std::ostringstream out(std::ios::binary);
  Writer writer(out);
  writer.whole(*this);
  return out.str();
}

// Of what was loaded, all that is an index or a size.
const char* Integrator::fault_of_loaded() const {
  const Eigen::Index n = system_.n(), rows = system_.n_rows(), n_y = system_.n_y();
  const std::size_t contacts = system_.contacts.size();
  const auto whole = [&](const Instant& node, bool implicit) {
    const Memory& m = node.memory;
    const bool remembers = m.a.size() == n && m.lambda.size() == rows && m.lambda_before.size() == rows && m.dy_before.size() == n_y &&
                           m.F.size() == n && m.P.size() == n;
    const bool empty = m.a.size() + m.lambda.size() + m.lambda_before.size() + m.dy_before.size() + m.F.size() + m.P.size() == 0;
    return node.state.y.size() == n_y && node.dy.size() == n_y && node.state.impact_rate.size() == contacts && node.state.y.allFinite() &&
           node.dy.allFinite() && std::isfinite(node.state.t) && (remembers || (empty && !implicit));
  };
  if (step_.to.state.y.size() != n_y) return "it has another number of coordinates or of energies in its ledger";
  if (!whole(step_.from, false) || !whole(step_.to, alpha_.has_value()) || open_impact_.size() != contacts || loss_at_begin_.size() != contacts ||
      after_.size() != contacts || (stages_ && !stages_->fits(system_)))
    return "it is of another system, or has numbers that are none";
  for (std::size_t c = 0; c < contacts; ++c) {
    const int open = open_impact_[c];
    if (open >= static_cast<int>(impacts_.size()) || open < -1 || (open >= 0 && impacts_[static_cast<std::size_t>(open)].contact != static_cast<int>(c)))
      return "a contact's impact is not there";
  }
  for (const Impact& i : impacts_)
    if (i.contact < 0 || i.contact >= static_cast<int>(contacts)) return "an impact is of no contact";
  if (!(step_.h >= 0) || !(h_ >= 0) || !(error_before_ > 0) || eq_.permanent < 0 || eq_.permanent > rows) return "its step is none";
  return nullptr;
}

void Integrator::load(const std::string& saved) {
  std::istringstream in(saved, std::ios::binary);
  Reader reader(in);
  reader.whole(*this);
  if (reader.other_layout()) throw std::invalid_argument("it was saved by a build of pintle with another layout of it");
  if (!reader.good() || in.peek() != std::istringstream::traits_type::eof())
    throw std::invalid_argument("it is not whole, or of another system");
  if (const char* fault = fault_of_loaded()) throw std::invalid_argument(fault);
  step_.error.setZero(system_.n_y());
  dense_ = step_.to.state;
  const long evaluations = eq_.evaluations, factorizations = eq_.factorizations;
  Instant here = step_.to;
  if (alpha_)
    alpha_->evaluate_between(system_, step_, here.state, eq_);
  else
    stages_->settle(system_, here, eq_);
  eq_.evaluations = evaluations, eq_.factorizations = factorizations;
}

}  // namespace pintle
