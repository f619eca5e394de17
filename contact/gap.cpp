#include "contact/gap.h"

namespace pintle {

Gap evaluate(const JournalBearing& gap, const MovingPoint& journal, const MovingPoint& bearing) {
  // Below this eccentricity its square is no longer a normal number, and n would not be unit [m].
  constexpr double concentric = 1e-140;

  Gap out;
  out.e = journal.r - bearing.r;
  const double distance = out.e.norm();
  const bool has_direction = !(distance < concentric);
  out.n = has_direction ? Eigen::Vector2d(out.e / distance) : Eigen::Vector2d::UnitX();
  out.depth = distance - gap.clearance();

  const Eigen::Vector2d t(-out.n.y(), out.n.x());
  const Eigen::Vector2d e_rate = journal.v - bearing.v;
  const double across = e_rate.dot(t);
  out.rate = e_rate.dot(out.n);
  out.material_slip = across + journal.w * gap.journal - bearing.w * gap.bearing;
  out.geometric_slip = has_direction ? out.depth * (across / distance) : 0;
  return out;
}

}  // namespace pintle
