#pragma once

// What sits the exam of the tangent: every joint, force and contact. A new one joins by one line in `kinds`.
#include <cmath>
#include <cstddef>
#include <optional>
#include <ostream>
#include <vector>

#include "contact/profile.h"
#include "framework/scene/units/signal_law.h"
#include "tests/contracts/moving_bodies.h"

namespace pintle::tangent_test {

using Eigen::Vector2d;

inline constexpr double clearance = 0.01, depth = 1e-3;  // of a bearing, of a contact that is pressed [m]

struct Kind {
  const char* name;
  std::vector<Joint> joints = {};
  std::vector<Force> forces = {};
  std::vector<ContactPair> contacts = {};
  std::vector<MotionSignal> signals = {};
  std::vector<SignalLaw> laws = {};
  std::vector<OwnState> states = {};
};
inline void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }
// Friction that grows with the sliding speeds drawn here.
inline ContactPair contact(double chi, std::optional<FrictionLaw> friction = {}, Sliding sliding = Sliding::material) {
  return {0, 1, JournalBearing{0.1 - clearance, 0.1}, ImpactLaw{1e6, 1.5, chi}, friction, sliding};
}
inline ContactPair spring_damper(std::optional<Ambrosio> friction = {}) {
  ContactPair pair = contact(0, friction);
  pair.normal = ImpactLaw{1e5, 1, 0, 20};
  return pair;
}
// Pieces of profiles, away from the points that carry them.
inline const Piece disc{.radius = 0.07, .centre = {0.02, -0.03}}, hollow{.radius = -0.3, .centre = {-0.04, 0.05}},
    corner{.radius = 0, .centre = {0.03, 0.02}, .normal = 0.3, .half = 0.8},
    flat{.centre = {-0.02, 0.06}, .normal = -0.7, .half = 0.5, .straight = true};
// Of an egg, or the hole of its shape: a span that bends far more than one pressing it moves along.
inline Piece span(bool inside, std::size_t which) {
  std::vector<Vector2d> rim;
  for (int i = 0; i < 12; ++i) {
    const double angle = (inside ? 2 : -2) * M_PI * i / 12, r = 0.3 + 0.02 * std::cos(angle);
    rim.emplace_back(0.03 + r * std::cos(angle), -0.02 + r * std::sin(angle));
  }
  return profile_through(rim, true).pieces[which];
}
inline const Piece egg = span(true, 1), other_egg = span(true, 4), egg_hole = span(false, 2);
inline ContactPair profiles(const Piece& a, const Piece& b) {
  ContactPair pair = contact(2, Ambrosio{0.3, 0, 50});
  pair.gap = {a, b};
  pair.profiles = pair.follows = true;
  return pair;
}
// Teeth that press far into each other, wherever they are drawn.
inline ContactPair teeth(const Flank::Teeth& of, double side, double angle) {
  ContactPair pair = contact(0);
  pair.normal = ImpactLaw{50, 1.5, 0.2};
  pair.profiles = pair.follows = true;
  pair.flank = Flank{of, side, -12, angle};
  return pair;
}
// Of bristles as long as the states drawn, bent by the speeds drawn.
inline const LuGre lugre{.mu = 0.3, .mu_static = 0.4, .stribeck = 5, .stiffness = 0.8, .damping = 0.3, .viscous = 0.05, .damping_speed = 6};
inline const Gonthier gonthier{.mu = 0.9, .mu_static = 1.2, .stribeck = 5, .stiffness = 0.8, .damping = 0.3, .viscous = 0.05, .dwell = 0.7};
inline ContactPair with(ContactPair pair, const FrictionLaw& law) {
  pair.friction = law;
  return pair;
}
inline ContactPair dry(ContactPair pair) {
  pair.friction = Coulomb{0.2, 0.3, 5};
  return pair;
}
// Of bodies whose boundary is massless and about as flexible as the contact.
inline ContactPair seated(ContactPair pair) {
  pair.massless = ResidualFlexibility{Eigen::Matrix2d{{2e-5, 6e-6}, {6e-6, 5e-6}}, Eigen::Matrix2d{{1e-6, -4e-6}, {-4e-6, 3e-5}}};
  return pair;
}
// Of n numbers: aᵀin + Σ sin(in + k) + a product, and its slopes by hand.
inline SignalFunction blend(std::size_t n, double by) {
  return [n, by](double t, const double* in, double* slope) {
    double sum = std::cos(t) + 0.2 * in[0] * in[n - 1];
    for (std::size_t k = 0; k < n; ++k) sum += std::sin(0.5 * in[k] + static_cast<double>(k));
    for (std::size_t k = 0; slope && k < n; ++k) slope[k] = by * 0.5 * std::cos(0.5 * in[k] + static_cast<double>(k));
    if (slope) slope[0] += by * 0.2 * in[n - 1], slope[n - 1] += by * 0.2 * in[0];
    return by * sum;
  };
}
// ẋ = −3 x + y/2 + blend, of the first two numbers and the others.
inline SignalFunction decay(std::size_t n) {
  return [rest = blend(n - 2, 2)](double t, const double* in, double* slope) {
    if (slope) slope[0] = -3, slope[1] = 0.5;
    return -3 * in[0] + 0.5 * in[1] + rest(t, in + 2, slope ? slope + 2 : nullptr);
  };
}
// Sizes that see every kind of signal, between a point on either body, and two own states.
inline Kind sized(const char* name, SizedForce::Way way, bool states) {
  using K = MotionSignal::Kind;
  Kind kind{name, {}, {SizedForce{way, 0, 1, 0, way <= SizedForce::follows ? 1 : -1}}};
  for (int k = K::x; k < K::state; ++k) kind.signals.push_back({static_cast<K>(k), k % 2, 1 - k % 2, 0.1 * k});
  std::vector<int> all(kind.signals.size());
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
  if (states) {
    kind.signals.push_back({K::state, 0}), kind.signals.push_back({K::state, 1});
    kind.states = {{"one", "", 1, 0, 2}, {"other", "", 1, 0, 3}};
    all.push_back(12), all.push_back(13);
  }
  kind.laws = {{blend(all.size(), 5), all}, {blend(3, -4), {0, 6, 11}}};
  if (states) kind.laws.push_back({decay(6), {12, 13, 0, 7, 5, 8}}), kind.laws.push_back({decay(4), {13, 12, 3, 6}});
  return kind;
}
// By a table over an angle, or a map over an angle and a speed, whose samples lie far apart.
inline Kind by_table(const char* name, bool map) {
  using K = MotionSignal::Kind;
  Kind kind{name, {}, {SizedForce{SizedForce::couple, 0, 1, 0, -1}}, {}, {{K::relative_angle, 0, 1}, {K::speed, 1}}};
  const auto input = [](int k) { return SignalFormula(Program{{{Op::input, static_cast<double>(k)}}}); };
  if (map)
    kind.laws = {
        {SignalMap{Bilinear({{-40, 0.31, 40}, {-60, -0.17, 60}, {3, -20, 8, 11, 6, -9, 2, 15, 30}}), {input(0), input(1)}}, {0, 1}}};
  else
    kind.laws = {{SignalTable{Spline({{-40, -3, 0.31, 4, 40}, {3, -20, 8, 11, 6}}), input(0)}, {0}}};
  return kind;
}
inline const std::vector<Kind> kinds{
    {"Nothing"},
    {"Revolute", {Revolute{0, 1}}},
    {"Slot", {Slot{0, 1}}},
    {"Prismatic", {Prismatic{0, 1, -0.4}}},
    {"Weld", {Weld{0, 1, -0.4}}},
    {"Distance", {Distance{0, 1, 0.8}}},
    {"Gear", {Gear{0, 1, 0.3, 0.5, 0.1}}},
    {"RingGear", {Gear{0, 1, 0.7, -0.3, 0.1}}},
    {"Rack", {Rack{0, 1, -0.3, 0.1}}},
    {"RollsOnDisc", {RollsOnDisc{{0, 1, 0.3, 0.5, 0.1}}}},
    {"RollsInDisc", {RollsOnDisc{{0, 1, 0.9, -0.3, 0.1}}}},
    {"RollsOnLine", {RollsOnLine{{0, 1, -0.3, 0.1}}}},
    {"Differential", {relation(true, {{0, 1, 2}, 3}, {{Coordinate::angle, 2, 0, 1}, {Coordinate::angle, 2, 1, -0.6}})}},
    {"Screw", {relation(false, {{0, 1, 2}, 3}, {{Coordinate::displacement, 2, 1, 1}, {Coordinate::angle, 2, 0, -0.2}})}},
    {"Cam", {relation(false, {{0, 1, 2}, 3}, {{Coordinate::angle, 2, 0, 0}, {Coordinate::displacement, 2, 1, 1}}, sine)}},
    {"CurveOverADistance", {relation(true, {{0, 1, 2}, 3}, {{Coordinate::distance, 0, 1, 0.4}, {Coordinate::angle, 2, 1, 1}}, sine)}},
    {"ThreeTerms",
     {relation(false, {{0, 1, 2}, 3},
               {{Coordinate::distance, 0, 1, 1}, {Coordinate::displacement, 1, 0, 0.7}, {Coordinate::angle, 2, 1, 0.3}})}},
    {"AngleDriver", {AngleDriver{0, 1, sine}}},
    {"DistanceDriver", {DistanceDriver{0, 1, sine}}},
    {"PointForce", {}, {PointForce{0, 1, sine, steady, false}}},
    {"FollowerForce", {}, {PointForce{0, 1, sine, steady, true}}},
    {"Torque", {}, {Torque{0, 1, sine}}},
    {"Spring", {}, {Spring{0, 1, 40, 0, 0.5}}},
    {"DampedSpring", {}, {Spring{0, 1, 40, 3, 0.5}}},
    {"TorsionSpring", {}, {TorsionSpring{0, 1, 25, 0, -0.8}}},
    {"DampedTorsionSpring", {}, {TorsionSpring{0, 1, 25, 2, -0.8}}},
    {"Maxwell", {}, {Maxwell{0, 1, 40, 3}}},
    sized("SizedForce", SizedForce::world, false),
    sized("SizedFollower", SizedForce::follows, false),
    sized("SizedCouple", SizedForce::couple, false),
    sized("SizedPull", SizedForce::pull, false),
    sized("SizedByStates", SizedForce::pull, true),
    sized("RestoringByStates", SizedForce::restoring, true),
    by_table("SizedByATable", false),
    by_table("SizedByAMap", true),
    {"BeltSpan", {}, {BeltSpan{0, 1, 0.1, -0.05, 40, 0, -6}}},
    {"DampedBeltSpan", {}, {BeltSpan{0, 1, 0.1, -0.05, 40, 3, -6, 1}}},
    {"Contact", {}, {}, {contact(0)}},
    {"LossyContact", {}, {}, {contact(2)}},
    {"SpringDamperContact", {}, {}, {spring_damper()}},
    {"SpringDamperContactWithFriction", {}, {}, {spring_damper(Ambrosio{0.3, 0, 50})}},
    {"ContactWithFriction", {}, {}, {contact(2, Ambrosio{0.3, 0, 50})}},
    {"ContactInFullSliding", {}, {}, {contact(0.6, Ambrosio{0.3, 1e-6, 2e-6})}},
    {"MasslessBoundary", {}, {}, {seated(contact(0.6))}},
    {"MasslessBoundaryWithFriction", {}, {}, {seated(contact(2, Ambrosio{0.3, 0, 50}))}},
    {"ContactOfGeometricSliding", {}, {}, {contact(0.6, Ambrosio{0.3, 0, 50}, Sliding::geometric)}},
    {"ContactOfDryFriction", {}, {}, {contact(2, Coulomb{0.2, 0.3, 5})}},
    {"DiscOnLineOfDryFriction", {}, {}, {dry(profiles(disc, flat))}},
    {"ContactOfLuGre", {}, {}, {contact(2, lugre)}},
    {"ContactOfGonthier", {}, {}, {contact(2, gonthier)}},
    {"GeometricSlidingOfLuGre", {}, {}, {contact(2, lugre, Sliding::geometric)}},
    {"DiscOnLineOfLuGre", {}, {}, {with(profiles(disc, flat), lugre)}},
    {"LineOnCornerOfGonthier", {}, {}, {with(profiles(flat, corner), gonthier)}},
    {"DiscInHollowOfLuGre", {}, {}, {with(profiles(disc, hollow), lugre)}},
    {"CurveOnLineOfLuGre", {}, {}, {with(profiles(egg, flat), lugre)}},
    {"DiscOnDisc", {}, {}, {profiles(disc, disc)}},
    {"DiscInHollow", {}, {}, {profiles(disc, hollow)}},
    {"HollowRoundDisc", {}, {}, {profiles(hollow, disc)}},
    {"DiscOnLine", {}, {}, {profiles(disc, flat)}},
    {"LineOnDisc", {}, {}, {profiles(flat, disc)}},
    {"CornerOnLine", {}, {}, {profiles(corner, flat)}},
    {"LineOnCorner", {}, {}, {profiles(flat, corner)}},
    {"CornerOnDisc", {}, {}, {profiles(corner, disc)}},
    {"CurveOnDisc", {}, {}, {profiles(egg, disc)}},
    {"DiscOnCurve", {}, {}, {profiles(disc, egg)}},
    {"DiscInHollowCurve", {}, {}, {profiles(disc, egg_hole)}},
    {"CurveOnCurve", {}, {}, {profiles(egg, other_egg)}},
    {"CurveOnLine", {}, {}, {profiles(egg, flat)}},
    {"LineOnCurve", {}, {}, {profiles(flat, egg)}},
    {"Teeth", {}, {}, {teeth(RollsOnDisc{{0, 1, 0.3, 0.5, 0.1}}, 1, 0)}},
    {"SlantedTeeth", {}, {}, {teeth(RollsOnDisc{{0, 1, 0.3, 0.5, 0.1}}, -1, 0.35)}},
    {"TeethInARing", {}, {}, {teeth(RollsOnDisc{{0, 1, 0.3, -0.7, 0.1}}, 1, 0.35)}},
    {"TeethOfARing", {}, {}, {teeth(RollsOnDisc{{0, 1, 0.7, -0.3, 0.1}}, -1, 0.35)}},
    {"TeethOfARack", {}, {}, {teeth(RollsOnLine{{0, 1, 0.3, 0.1}}, 1, 0.35)}},
    {"TeethOfARackOnTheRight", {}, {}, {teeth(RollsOnLine{{0, 1, -0.3, 0.1}}, -1, 0.35)}},
    {"Several",
     {Slot{0, 1}, Revolute{1, 0}},
     {Spring{1, 0, 40, 3, 0.5}, Maxwell{1, 0, 60, 5}, TorsionSpring{0, 1, 25, 2, -0.8}, PointForce{1, 0, sine, steady, true}}},
};

}  // namespace pintle::tangent_test
