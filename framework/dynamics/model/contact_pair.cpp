#include "framework/dynamics/model/contact_pair.h"

namespace pintle {

MovingPoint moving_point(const MarkerMotion& m) { return {m.r, m.v, m.w}; }

ContactEffect evaluate(const ContactPair& pair, const MarkerMotion& journal,
                       const MarkerMotion& bearing, double impact_rate) {
  ContactEffect out;
  out.gap = evaluate(pair.gap, moving_point(journal), moving_point(bearing));
  if (impact_rate <= 0 || pair.link >= 0 || (out.gap.depth <= 0 && pair.normal.d == 0)) return out;

  out.normal = evaluate(pair.normal, Approach{out.gap.depth, out.gap.rate, impact_rate});
  Eigen::Vector2d force = -out.normal.force * out.gap.n;
  if (pair.friction) {
    const double slip = pair.sliding == Sliding::material ? out.gap.material_slip
                                                          : out.gap.geometric_slip;
    out.friction = evaluate(*pair.friction, slip, out.normal.force).force;
    out.friction_loss = -out.friction * slip;
    force += out.friction * perp(out.gap.n);
  }
  out.on_journal << force, pair.gap.journal * cross(out.gap.n, force);
  out.on_bearing << -force, -pair.gap.bearing * cross(out.gap.n, force);
  return out;
}

}  // namespace pintle
