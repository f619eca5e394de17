#include "framework/integration/events/deep_overlap.h"

#include "framework/common/text.h"
#include "framework/integration/events/impact_log.h"

namespace pintle {

std::string deep_overlap(const System& system, const State& state, double h) {
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    const ContactPair& pair = system.contacts[c];
    if (!is_rigid(pair) || !(state.impact_rate[c] > 0)) continue;
    const double depth = gap_of(system, static_cast<int>(c), state).value;
    if (!(depth > fine_length(pair, system.length) + h * state.impact_rate[c])) continue;
    return "contact \"" + system.contact_names[c] + "\": rigid bodies overlap by " + number_text(depth, 3) +
           " m, and no forces part them; " + (h > 0 ? "the step may be too long, " : "") + pressed_together;
  }
  return "";
}

}  // namespace pintle
