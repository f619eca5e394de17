#include "framework/mechanism/profile_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/common/index.h"
#include "framework/dynamics/equations/meshing.h"
#include "framework/dynamics/model/marker_motion.h"

namespace pintle {

namespace {

/// A part beside or behind a piece does not overlap it; its distance is then that from the piece's end.
void as_far_as_the_end(double beside, double rate, Gap& gap) {
  const double distance = std::hypot(gap.depth, beside);
  if (distance > 0) gap.rate = -(gap.depth * gap.rate + beside * rate) / distance;
  gap.depth = -distance;
}

MovingPoint point_b(const System& system, std::size_t k, const State& state, const Equations& eq) {
  const ContactPair& pair = system.contacts[k];
  const MovingPoint b = moving_point(eq.motion[at(pair.b)]);
  return pair.flank ? in_its_gap(system, pair, static_cast<int>(k), state.y, b) : b;
}

}  // namespace

Eigen::Vector2d contact_place(const System& system, std::size_t k, const State& state, const Equations& eq) {
  const ContactPair& pair = system.contacts[k];
  const MovingPoint a = moving_point(eq.motion[at(pair.a)]);
  const Gap gap = gap_between(pair, a, point_b(system, k, state, eq));
  return touched(pair.gap.a, a.r + gap.arm_a, gap.n, gap.across);
}

ProfileContact profile_contact(const System& system, std::size_t first, const State& state, const Equations& eq) {
  ProfileContact out;
  constexpr double equal = 1e-9;  // relative: of two forces that differ by less, the first
  double most = 0;
  std::pair nearest{false, -std::numeric_limits<double>::infinity()};  // behind its face a part may also be deeper behind other faces
  for (std::size_t k = first; k < first + at(system.contacts[first].pairs); ++k) {
    const ContactPair& pair = system.contacts[k];
    const ContactEffect& effect = eq.contact[k];
    out.normal += effect.normal.force, out.friction += effect.friction, out.on_a += effect.on_a, out.on_b += effect.on_b;
    out.pressed = std::max(out.pressed, effect.normal.force);
    const MovingPoint a = moving_point(eq.motion[at(pair.a)]), b = moving_point(eq.motion[at(pair.b)]);
    Gap gap = gap_between(pair, a, point_b(system, k, state, eq));
    if (pair.flank) {
      const double along = pair.flank->side * std::cos(pair.flank->angle);
      out.teeth -= along * effect.normal.force, out.travel += (gap.depth + pair.flank->half) / (2 * along);
    }
    const auto [inside, inside_rate, side] = margin(pair, gap, a, b);
    if (!pair.journal && !pair.flank && std::min(inside, pair.deepest - gap.depth) < 0)
      as_far_as_the_end(std::min(inside, 0.0), inside_rate, gap);
    const std::pair near{state.impact_rate[k] > 0, std::min({gap.depth, pair.deepest - gap.depth, inside, inside - gap.depth})};
    const double force = effect.normal.force;
    if (most > 0 || force > 0 ? force > (1 + equal) * most : near > nearest)
      most = force, nearest = near, out.gap = gap,
      out.at = pair.journal ? Eigen::Vector2d(a.r - b.r) : touched(pair.gap.a, a.r + gap.arm_a, gap.n, gap.across);
  }
  return out;
}

}  // namespace pintle
