#include "framework/integration/events/deep_overlap.h"

#include "framework/common/text.h"
#include "framework/integration/events/impact_log.h"

namespace pintle {

std::string deep_overlap(const System& system, const Step& step, std::span<const Guard> from, std::span<const Guard> to, double h) {
  const State& state = step.to.state;
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    const ContactPair& pair = system.contacts[c];
    const int contact = static_cast<int>(c);
    if (!is_rigid(pair) || is_released(system, Switch::contact, contact, state.y)) continue;
    const bool closed = state.impact_rate[c] > 0;
    const double deep = fine_length(pair, system.length) + h * state.impact_rate[c];
    // A body may lie behind an open pair, as before the other side of a plate: then it was as deep at the step's start.
    const bool passes = !closed && h == 0 && from[c].value <= deep && to[c].value > deep &&
                        !(is_corner(pair.gap.a) && is_corner(pair.gap.b)) && gap_of(system, contact, step.from.state).value <= deep;
    if (!closed && !passes) continue;
    const double depth = gap_of(system, contact, state).value;
    if (!(depth > deep)) continue;
    return "contact \"" + system.contact_names[c] + "\": rigid bodies overlap by " + number_text(depth, 3) +
           " m, and no forces part them; " + (h > 0 ? "the step may be too long, " : "") + pressed_together;
  }
  return "";
}

}  // namespace pintle
