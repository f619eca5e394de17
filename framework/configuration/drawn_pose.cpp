#include "framework/configuration/drawn_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/common/index.h"
#include "framework/common/some_of.h"
#include "framework/common/text.h"
#include "framework/dynamics/equations/equations.h"

namespace pintle {

namespace {

// Whether the scene gives the position of a body, independently of the joints.
bool is_drawn(const Scene& scene, const std::string& body) {
  if (body == "ground") return true;
  const auto found = std::ranges::find(scene.bodies, body, &SceneBody::name);
  return found != scene.bodies.end() && found->drawn_at;
}

}  // namespace

std::vector<Eigen::Vector2d> drawn_journals(const Scene& scene, const System& system, const Eigen::VectorXd& y,
                                            std::vector<std::string>& doubts) {
  std::vector<Eigen::Vector2d> out(at(n_clearances(system)), Eigen::Vector2d::Zero());
  if (out.empty()) return out;
  constexpr double rounding = 1e-6, direction_is_meant = 0.5;  // of the clearance
  Equations eq(system);
  pose(system, 0, y, eq);
  for (std::size_t c = 0; c < out.size(); ++c) {
    const auto joint = std::ranges::find(scene.joints, system.contact_names[c], &SceneJoint::name);
    const bool given = std::ranges::find(scene.start_journals, system.contact_names[c], &StartJournal::joint) != scene.start_journals.end();
    if (given || joint == scene.joints.end() || !is_drawn(scene, joint->a.body) || !is_drawn(scene, joint->b.body)) continue;
    const ContactPair& pair = system.contacts[c];
    const Eigen::Vector2d e = eq.motion[at(pair.a)].r - eq.motion[at(pair.b)].r;
    const double clearance = pair.gap.clearance();
    if (e.norm() <= clearance && e.norm() > clearance * (is_held(pair) ? direction_is_meant : rounding)) out[c] = e;
    if (e.norm() > clearance + bearing_radius(pair.gap))
      doubts.push_back(quoted(joint->name) + ": the journal is drawn " + number_text(e.norm(), 3) +
                       " m from the centre of its bearing, which is outside the bearing; " +
                       "the run starts with it at the centre. Correct the bodies' `pose`, or give the joint an eccentricity in `start`");
  }
  return out;
}

void doubt_moves(const Scene& scene, const System& system, const Eigen::VectorXd& before, const Eigen::VectorXd& after,
                 std::vector<std::string>& doubts) {
  constexpr double far = 0.5, turned = std::numbers::pi / 2;  // of the mechanism's length; [rad]
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    const Eigen::Vector3d move = (after - before).segment<3>(static_cast<Eigen::Index>(3 * b));
    const double away = move.head<2>().norm();
    const bool moved = scene.bodies[b].drawn_at && away > far * system.length;
    if (!moved && !(scene.bodies[b].drawn_angle && std::abs(move[2]) > turned)) continue;
    doubts.push_back(
        "to close the joints " + quoted(scene.bodies[b].name) + " was " +
        (moved ? "moved by " + number_text(away, 3) + " m" : "turned by " + number_text(move[2] * 180 / std::numbers::pi, 3) + " deg") +
        " from where it is drawn; if another configuration was intended, correct its `pose` or fix it in `start`");
  }
}

std::string driven_twice(const System& system, const Redundancy& r) {
  std::vector<std::string> drivers;
  for (const int k : r.implied_by)
    if (is_driver(system.joints[at(k)])) drivers.push_back(quoted(system.joint_names[at(k)]));
  if (is_driver(system.joints[at(r.joint)])) drivers.push_back(quoted(system.joint_names[at(r.joint)]));
  if (drivers.size() < 2) return "";
  return "the drivers " + some_of(drivers, false) +
         " drive the same degree of freedom, and the motion does not determine how they share the force; remove " +
         (drivers.size() == 2 ? "one" : "all but one") + " of them";
}

}  // namespace pintle
