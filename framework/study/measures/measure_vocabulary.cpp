#include "framework/study/measures/measure_vocabulary.h"

#include <algorithm>

#include "framework/common/nearest.h"

namespace pintle {

Names what_phrases(bool statistics) {
  Names out;
  const auto add = [&](const auto& entries) {
    for (const auto& entry : entries) out.emplace_back(entry.words);
  };
  if (statistics) add(statistic_words);
  add(motion_words), add(force_words), add(energy_words);
  for (const Phrases& phrases : {torque_words, eccentricity_words, depth_words, impact_words, flight_words, contact_time_words, work_words,
                                 loss_words, stress_words, displacement_words, deflection_words, distance_words})
    out.insert(out.end(), phrases.begin(), phrases.end());
  return out;
}

std::string with_nearest_beginning(std::string_view text, const Names& candidates) {
  std::string out;
  for (std::size_t words = 1, end = 0; end < text.size(); ++words, ++end) {
    end = std::min(text.find(' ', end), text.size());
    Names as_long;
    for (const std::string& candidate : candidates)
      if (static_cast<std::size_t>(std::ranges::count(candidate, ' ')) + 1 == words) as_long.push_back(candidate);
    const std::string beginning(text.substr(0, end));
    const std::string near = nearest(beginning, as_long);
    if (!near.empty()) out = near == lower(beginning) ? "" : near + std::string(text.substr(end));
  }
  return out;
}

}  // namespace pintle
