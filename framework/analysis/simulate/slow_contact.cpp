#include "framework/analysis/simulate/slow_contact.h"

#include <cmath>
#include <sstream>

namespace pintle {

// In an impact the rate falls from its onset, |δ̇| ≤ δ̇₀, and the damping force is at most χ times the elastic force. If a contact is
// compressed at more than twice the onset rate, with more damping than elastic force, its law is outside the range in which it was fitted
// to a restitution.
void SlowContacts::see(const System& system, const Step& step, const Equations& eq) {
  constexpr double faster = 2, outweighs = 1;
  for (std::size_t c = 0; c < seen_.size(); ++c) {
    Seen& s = seen_[c];
    const ContactPair& pair = system.contacts[c];
    const double onset = step.to.state.impact_rate[c];
    if (!(onset > 0) || is_held(pair) || is_rigid(pair) || pair.follows || damping_share(pair.normal, 1, 1) == 0) {
      s.beyond = false;
      continue;
    }
    const Gap& gap = eq.contact[c].gap;
    const double over = damping_share(pair.normal, gap.rate, onset);
    const bool beyond = gap.depth > 0 && gap.rate > faster * onset && over > outweighs;
    if (beyond || s.beyond) {
      const Eigen::Index z = system.z_begin() + system.contact_z[c];
      s.lost += step.to.state.y[z] - step.from.state.y[z];
    }
    if (beyond && s.since < 0) s.since = step.to.state.t;
    if (beyond && over > s.over) s.over = over, s.onset = onset, s.rate = gap.rate;
    s.beyond = beyond;
  }
}

void SlowContacts::warn(const System& system, double in_play, std::vector<std::string>& warnings) const {
  constexpr double little = 1e-2;  // relative to the energy in play
  for (std::size_t c = 0; c < seen_.size(); ++c) {
    const Seen& s = seen_[c];
    if (!(s.lost > little * in_play)) continue;
    std::ostringstream text;
    text.precision(3);
    text << "\"" << system.contact_names[c] << "\": from t = " << s.since << " s on a contact that began at " << s.onset
         << " m/s was pressed in at up to " << s.rate << " m/s, where the damping of its law is " << s.over
         << " times the elastic force; the law is made for impacts, which slow down from their onset. A hysteresis of " << s.lost << " J, "
         << 100 * s.lost / in_play
         << " % of the energy in play, is doubtful; set `approach speed: largest`, raise `slowest impact` to the speeds meant, or take "
         << "model: spring-damper";
    warnings.push_back(text.str());
  }
}

}  // namespace pintle
