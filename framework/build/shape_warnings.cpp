#include "framework/build/shape_warnings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "framework/bodies/attachments.h"
#include "framework/bodies/elastic_parts.h"
#include "framework/bodies/modal_basis.h"
#include "framework/build/choose_method.h"
#include "framework/common/text.h"
#include "framework/component/fe/statics.h"
#include "framework/scene/joint_words.h"

namespace pintle {

namespace {

std::string percent(double part) { return number_text(std::round(1000 * part) / 10) + " %"; }

/// ∂f/∂δ [N/m] at the depth reached at a hundredth of the motion's speed, or if nothing moves yet, at a hundredth of the contact's fine
/// length.
double stiffness_of_blow(const System& system, const ContactPair& pair, double motion) {
  double mobility = 0;  // 1/m of the two bodies there
  for (const int marker : {pair.a, pair.b}) {
    const Marker& m = system.markers[static_cast<std::size_t>(marker)];
    if (m.body == ground) continue;
    const Body& b = system.bodies[static_cast<std::size_t>(m.body)];
    mobility += 1 / b.m + m.x_BP.squaredNorm() / b.J;
  }
  const double speed = 1e-2 * motion * system.length;
  return stiffness_at(pair.normal, speed > 0 ? depth_reached(pair.normal, mobility, speed) : 1e-2 * fine_length(pair, system.length));
}

}  // namespace

std::vector<std::string> contact_warnings(const Scene& scene, const System& system, const BuiltOrder& order,
                                          const std::vector<std::optional<MechanismBody>>& bodies) {
  constexpr double matters = 0.1;  // missing compliance, relative to that of the contact
  std::vector<std::string> out;
  if (system.contacts.empty()) return out;
  std::vector<const ElasticBody*> flexible;
  for (const auto& b : bodies) flexible.push_back(b && b->body.flex ? &b->elastic : nullptr);
  const double motion = spectrum(scene, system).motion;
  for (const Attachment& at : attachments_of(scene, order, flexible)) {
    if (at.of != Attachment::contact) continue;
    const ContactPair& pair = system.contacts[at.k];
    if (is_held(pair) || is_rigid(pair)) continue;
    const FreeCompliance& yields = bodies[at.body]->when_free[static_cast<std::size_t>((at.row - inertia_loads) / 3)];
    const double stiffness = stiffness_of_blow(system, pair, motion);
    for (Eigen::Index k = 0; k < 2; ++k) {
      const double share = std::max(0.0, yields.kept[k]) / yields.full[k];
      if (!(share < least_covered) || !((yields.full[k] - yields.kept[k]) * stiffness > matters)) continue;
      out.push_back("\"" + system.contact_names[at.k] + "\" strikes \"" + scene.bodies[at.body].name + "\" where its shapes cover only " +
                    percent(share) + " of its compliance along its " + (k == 0 ? "x" : "y") +
                    " axis: peak forces and hysteresis will be wrong; use craig-bampton, or keep more shapes");
      break;
    }
  }
  return out;
}

std::string stiff_parts_warning(const MechanismBody& b) {
  if (!(b.inertia_covered.share < least_covered)) return "";
  return "the shapes of \"" + b.body.name + "\" cover only " + percent(b.inertia_covered.share) + " of its deformation under " +
         b.inertia_covered.of +
         ": parts beyond or between its connection points stay rigid; increase the count of craig-bampton until its shapes, which now "
         "end at " +
         number_text(std::round(b.modes.omega.maxCoeff() / (2 * std::numbers::pi))) + " Hz, deform these parts";
}

std::vector<std::string> stress_warnings(const System& system, const std::vector<RecordedStress>& stresses,
                                         const std::vector<std::optional<MechanismBody>>& bodies) {
  std::vector<std::string> out;
  constexpr double rounding = 1e-8;  // relative to the bending stress at the radius of gyration
  std::set<int> reported;
  for (const RecordedStress& s : stresses) {
    if (!s.probe.beam || !reported.insert(s.body).second) continue;
    const MechanismBody& made = *bodies[static_cast<std::size_t>(s.body)];
    if (const std::string lacks = fibre_warning(made.elastic); !lacks.empty())
      out.push_back("\"" + system.bodies[static_cast<std::size_t>(s.body)].name + "\": " + lacks);
    double stretch = 0, bend = 0;
    for (Eigen::Index i = 0; i < made.modes.shapes.cols(); ++i) {
      const StressField field = stress_field(made.elastic.model, made.modes.shapes.col(i), made.elastic.fibres);
      stretch = std::max(stretch, field.section_forces.row(0).cwiseAbs().maxCoeff() / s.probe.sides.front().A);
      bend =
          std::max(bend, field.section_forces.row(2).cwiseAbs().maxCoeff() / std::sqrt(s.probe.sides.front().A * s.probe.sides.front().I));
    }
    if (stretch > rounding * bend) continue;
    const std::string& name = system.bodies[static_cast<std::size_t>(s.body)].name;
    out.push_back("no shape of \"" + name +
                  "\" stretches it: its section force N is recorded as 0, and the stress is that of bending only; "
                  "use craig-bampton if joints or forces act on two of its points, or keep more shapes");
  }
  return out;
}

}  // namespace pintle
