#include "framework/integration/law_changes.h"

#include <algorithm>
#include <limits>

namespace pintle {

double law_end(const Scheme& scheme, double t) {
  double ahead = std::numeric_limits<double>::infinity();
  const auto change =
      std::upper_bound(scheme.changes.begin(), scheme.changes.end(), t, [](double x, const LawChange& c) { return x < c.before; });
  if (change != scheme.changes.end()) ahead = change->before;
  for (const std::vector<double>& ends : scheme.pieces)
    if (const auto end = std::upper_bound(ends.begin(), ends.end(), t); end != ends.end() && end + 1 != ends.end())
      ahead = std::min(ahead, *(end + 1));
  return ahead;
}

const LawChange* change_at(const Scheme& scheme, double t) {
  const auto next =
      std::upper_bound(scheme.changes.begin(), scheme.changes.end(), t, [](double x, const LawChange& c) { return x < c.before; });
  return next == scheme.changes.begin() || t >= (next - 1)->after ? nullptr : &*(next - 1);
}

}  // namespace pintle
