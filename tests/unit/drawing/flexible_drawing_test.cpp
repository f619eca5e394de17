// Shapes put in by hand, whose displacement and stress are known in closed form, on small bodies.
#include "framework/drawing/flexible_drawing.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "framework/bodies/modal_basis.h"
#include "framework/scene/error.h"
#include "framework/scene/yaml/reader.h"
#include "tests/refusal.h"

namespace pintle::flexible_drawing_test {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

constexpr double young = 200e9, poisson = 0.3;
/// Relative: differences of displacements that cancel in strains of a few hundred nodes.
constexpr double rounding = 1e-9;

/// A plate 0.4 m × 0.2 m.
const std::string plate =
    "bodies:\n"
    "  part:\n"
    "    plate: {thickness: 10 mm, young: 200 GPa, poisson: 0.3, density: 8000 kg/m^3,\n"
    "            grid: {corners: [[0, 0], [0.4, 0], [0.4, 0.2], [0, 0.2]], cells: [4, 2]}}\n"
    "    points: {A: [0, 0], M: [0.2, 0.1], B: [0.4, 0.2]}\n";

/// A beam 2 m long, its section 0.1 m high and 0.05 m wide.
std::string beam(const std::string& rest = "") {
  return "bodies:\n"
         "  part:\n"
         "    beam: {from: A, to: B, section: {rectangle: [0.1, 0.05]}, elements: 8, theory: "
         "euler,\n"
         "           young: 200 GPa, poisson: 0.3, density: 8000 kg/m^3" +
         rest +
         "}\n"
         "    points: {A: [0, 0], M: [1, 0], B: [2, 0]}\n";
}
constexpr double EA = young * 0.1 * 0.05, EI = young * 0.05 * 0.001 / 12;

struct Body {
  Scene scene;
  ElasticBody elastic;
  explicit Body(const std::string& text) : scene(read_scene_text(text, "test.yaml")), elastic(elastic_body(scene, scene.bodies[0])) {}
  Vector2d centre() const {
    const RigidInertia inertia = rigid_inertia(elastic.model, elastic.M);
    return inertia.c / inertia.m;
  }
};

/// Nodal values [u_x u_y φ] of a field of place; plates take the first two.
using Motion = std::function<Eigen::Vector3d(const Vector2d&)>;

ModalModel shapes(const Body& body, const std::vector<Motion>& fields) {
  const FeModel& model = body.elastic.model;
  ModalModel modes;
  modes.shapes.resize(model.N(), static_cast<Eigen::Index>(fields.size()));
  for (std::size_t k = 0; k < fields.size(); ++k)
    for (int i = 0; i < model.x.cols(); ++i) {
      const int begin = model.begin[static_cast<std::size_t>(i)];
      const int dofs = model.begin[static_cast<std::size_t>(i) + 1] - begin;
      modes.shapes.col(static_cast<Eigen::Index>(k)).segment(begin, dofs) = fields[k](model.x.col(i)).head(dofs);
    }
  return modes;
}

/// Along x, free to thin: σx = E.
Eigen::Vector3d stretch(const Vector2d& x) { return {x.x(), -poisson * x.y(), 0}; }
/// τxy = G.
Eigen::Vector3d shear(const Vector2d& x) { return {x.y(), 0, 0}; }
/// A beam along x of curvature 1 to the left: M = EI.
Eigen::Vector3d curl(const Vector2d& x) { return {0, x.x() * x.x() / 2, x.x()}; }
/// Of curvature x: M = EI x, V = −EI.
Eigen::Vector3d cubic(const Vector2d& x) { return {0, x.x() * x.x() * x.x() / 6, x.x() * x.x() / 2}; }

const Eigen::MatrixXd& field(const DrawnBody& body, const std::string& name) {
  for (const Field& f : body.fields)
    if (f.name == name) return f.values;
  ADD_FAILURE() << "no field " << name;
  static const Eigen::MatrixXd none;
  return none;
}

FlexiblePose pose(const VectorXd& eta, const VectorXd& speed) { return {{3, -1}, {0.5, 2}, 0.7, -6, eta, speed}; }

TEST(FlexibleDrawing, UnbentBodyIsDrawnWhereItsFrameIs) {
  const Body body(plate);
  const FlexibleDrawing drawing(body.elastic, shapes(body, {stretch, shear}), {0.2, 0.1});
  const FlexiblePose at = pose(VectorXd::Zero(2), VectorXd::Zero(2));
  const DrawnBody drawn = drawing.at(at, 1000);
  EXPECT_EQ(drawn.name, "part");
  ASSERT_EQ(drawn.points.cols(), body.elastic.mesh.x.cols());
  for (Eigen::Index i = 0; i < drawn.points.cols(); ++i) {
    const Vector2d d = Eigen::Rotation2Dd(at.angle) * (body.elastic.mesh.x.col(i) - Vector2d(0.2, 0.1));
    EXPECT_NEAR((drawn.points.col(i) - at.r - d).norm(), 0, 1e-15);
    const Vector2d v = at.v + at.w * Vector2d(-d.y(), d.x());
    EXPECT_NEAR((field(drawn, "velocity [m/s]").col(i) - v).norm(), 0, 1e-14);
  }
  EXPECT_EQ(field(drawn, "displacement [m]").norm(), 0);
  EXPECT_EQ(field(drawn, "von Mises [Pa]").norm(), 0);
  EXPECT_NEAR(drawing.size(), std::hypot(0.4, 0.2), 1e-15);
}

TEST(FlexibleDrawing, VelocityIsTheRateOfTheTruePlace) {
  // Central differences err by h²/6 of the third rate, some 6³ times lengths below 3 m.
  constexpr double h = 1e-5, difference = 1e-7;
  for (const std::string& text : {plate, beam()}) {
    const Body body(text);
    const FlexibleDrawing drawing(body.elastic, shapes(body, {stretch, curl}), body.centre());
    const VectorXd eta = Eigen::Vector2d(0.03, -0.02), speed = Eigen::Vector2d(-0.4, 0.9);
    const FlexiblePose now = pose(eta, speed);
    const auto moved = [&](double t) {
      FlexiblePose p = now;
      p.r += t * p.v;
      p.angle += t * p.w;
      p.eta += t * speed;
      return drawing.at(p, 1).points;
    };
    const Eigen::Matrix2Xd rate = (moved(h) - moved(-h)) / (2 * h);
    // Whatever is drawn, the velocity is that of the material.
    for (const double exaggeration : {1.0, 40.0}) {
      const Eigen::MatrixXd velocity = field(drawing.at(now, exaggeration), "velocity [m/s]");
      EXPECT_LT((velocity - rate).cwiseAbs().maxCoeff(), difference);
    }
  }
}

TEST(FlexibleDrawing, ExaggerationMovesPointsAlongTheirDisplacementAndNoFields) {
  const Body body(beam());
  const FlexibleDrawing drawing(body.elastic, shapes(body, {curl}), body.centre());
  const FlexiblePose at = pose(VectorXd::Constant(1, 1e-3), VectorXd::Constant(1, 2));
  const DrawnBody real = drawing.at(at, 1), drawn = drawing.at(at, 50), rigid = drawing.at(at, 0);
  const Eigen::Matrix2Xd u = field(real, "displacement [m]");
  EXPECT_LT((real.points - rigid.points - u).norm(), 1e-14);
  EXPECT_LT((drawn.points - rigid.points - 50 * u).norm(), 1e-14);
  for (const Field& f : real.fields) EXPECT_EQ(f.values, field(drawn, f.name)) << f.name;
  EXPECT_DOUBLE_EQ(drawing.largest_displacement(at.eta), u.colwise().norm().maxCoeff());
  // The tip's displacement is 2 mm across, and its section's outer fibre turns by 2 mrad.
  EXPECT_NEAR(drawing.largest_displacement(at.eta), 1e-3 * std::hypot(2, 0.1), 1e-15);
}

TEST(FlexibleDrawing, PlateShowsTheStressOfItsStrainHoweverItIsTurned) {
  const Body body(plate);
  const FlexibleDrawing drawing(body.elastic, shapes(body, {stretch, shear}), body.centre());
  const DrawnBody drawn = drawing.at(pose(Vector2d(2e-4, -3e-4), Vector2d::Zero()), 1);
  const double sigma = 2e-4 * young, tau = 3e-4 * young / (2 * (1 + poisson));
  const double radius = std::hypot(sigma / 2, tau), mises = std::sqrt(sigma * sigma + 3 * tau * tau);
  for (Eigen::Index i = 0; i < drawn.points.cols(); ++i) {
    EXPECT_NEAR(field(drawn, "von Mises [Pa]")(0, i), mises, rounding * mises);
    EXPECT_NEAR(field(drawn, "principal 1 [Pa]")(0, i), sigma / 2 + radius, rounding * mises);
    EXPECT_NEAR(field(drawn, "principal 2 [Pa]")(0, i), sigma / 2 - radius, rounding * mises);
  }
  EXPECT_EQ(drawn.fields.size(), 5u);
}

TEST(FlexibleDrawing, BeamShowsBendingAcrossItsHeightAndItsSectionForces) {
  const Body body(beam());
  const FlexibleDrawing drawing(body.elastic, shapes(body, {stretch, cubic}), body.centre());
  const double epsilon = -1e-5, kappa = 4e-4;
  FlexiblePose at = pose(Vector2d(epsilon, kappa), Vector2d::Zero());
  const DrawnBody drawn = drawing.at(at, 1);
  const Eigen::MatrixXd forces = field(drawn, "section force [N]"), moment = field(drawn, "section moment [N m]");
  at.eta.setZero();
  const Eigen::Matrix2Xd x =
      (Eigen::Rotation2Dd(-at.angle).toRotationMatrix() * (drawing.at(at, 1).points.colwise() - at.r)).colwise() + body.centre();
  const double scale = young * 0.05 * kappa * 2;
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const double sigma = young * (epsilon - kappa * x(0, i) * x(1, i));
    EXPECT_NEAR(x(1, i), 0.05 * static_cast<double>(i % 3 - 1), 1e-15);  // right, axis, left
    EXPECT_NEAR(forces(0, i), EA * epsilon, rounding * EA * kappa);
    EXPECT_NEAR(forces(1, i), -EI * kappa, rounding * EI * kappa * 64);  // third differences of u
    EXPECT_NEAR(moment(0, i), EI * kappa * x(0, i), rounding * EI * kappa * 8);
    EXPECT_NEAR(field(drawn, "von Mises [Pa]")(0, i), std::abs(sigma), rounding * scale);
    EXPECT_NEAR(field(drawn, "principal 1 [Pa]")(0, i), std::max(sigma, 0.0), rounding * scale);
    EXPECT_NEAR(field(drawn, "principal 2 [Pa]")(0, i), std::min(sigma, 0.0), rounding * scale);
  }
}

TEST(FlexibleDrawing, CompleteBasisShowsTheStaticStress) {
  // Any field at all is a sum of shapes; von Mises stress is not linear and must still agree.
  const Body body(plate);
  std::srand(7);
  const VectorXd u = VectorXd::Random(body.elastic.model.N()) * 1e-6;
  ModalModel modes;
  modes.shapes = Eigen::MatrixXd::Identity(u.size(), u.size());
  const FlexibleDrawing drawing(body.elastic, modes, body.centre());
  const DrawnBody drawn = drawing.at(pose(u, VectorXd::Zero(u.size())), 1);
  const VectorXd expected = stress_field(body.elastic.model, u).von_mises;
  const Eigen::MatrixXd& found = field(drawn, "von Mises [Pa]");
  EXPECT_LT((found.transpose() - expected).norm(), rounding * expected.norm());
}

StressProbe probe(const Body& body, const std::vector<Motion>& fields, const std::string& point) {
  return stress_probe(body.scene, body.elastic, shapes(body, fields), {"part", point, {}});
}

TEST(StressProbe, OfAPlateIsTheStressAtThePoint) {
  const Body body(plate);
  for (const char* point : {"A", "M", "B"}) {
    const StressProbe found = probe(body, {stretch, shear}, point);
    Eigen::Matrix<double, 4, 2> expected = Eigen::Matrix<double, 4, 2>::Zero();
    expected(0, 0) = young;
    expected(2, 1) = young / (2 * (1 + poisson));
    EXPECT_FALSE(found.beam);
    EXPECT_LT((found.sides.at(0).rows - expected).norm(), rounding * young) << point;
  }
}

TEST(StressProbe, OfABeamIsItsSectionForcesAtThePoint) {
  const Body body(beam());
  for (const auto& [point, x] : {std::pair{"A", 0.0}, {"M", 1.0}, {"B", 2.0}}) {
    const StressProbe found = probe(body, {stretch, cubic}, point);
    Eigen::Matrix<double, 3, 2> expected;
    expected << EA, 0, 0, -EI, 0, EI * x;
    EXPECT_TRUE(found.beam);
    ASSERT_EQ(found.sides.size(), 1u);
    const StressProbe::Side& side = found.sides[0];
    EXPECT_LT((side.rows.col(0) - expected.col(0)).norm(), rounding * EA) << point;
    EXPECT_LT((side.rows.col(1) - expected.col(1)).norm(), rounding * EI * 64) << point;
    EXPECT_NEAR(side.A, 0.005, 1e-17);
    EXPECT_NEAR(side.I, 0.05 * 0.001 / 12, 1e-19);
    EXPECT_EQ(side.distance, 0.05);
  }
}

TEST(StressProbe, OfATaperedBeamHasTheSectionBetweenItsNeighbours) {
  // Height from 0.1 to 0.06 m: at the middle node 0.08 m, A linear in it.
  const Body body(beam(", taper to: {rectangle: [0.06, 0.05]}"));
  const StressProbe found = probe(body, {stretch}, "M");
  ASSERT_EQ(found.sides.size(), 1u);
  EXPECT_NEAR(found.sides[0].A, 0.05 * 0.08, 1e-15);
  EXPECT_NEAR(found.sides[0].distance, 0.04, 1e-15);
}

std::string complaint(const std::string& text, const std::string& point) {
  const Body body(text);
  return pintle_test::refusal_by([&] { probe(body, {stretch}, point); });
}

TEST(StressProbe, IsRefusedWhereThereIsNoMaterial) {
  const std::string disc =
      "bodies:\n  part:\n    plate: {thickness: 10 mm, young: 200 GPa, poisson: 0.3, density: "
      "8000, "
      "link: {disc: {diameter: 0.2, bore: 0.1}}}\n    points: {A: {hole: bore}}\n";
  for (const char* words : {"\"part.A\"", "hole \"bore\"", "name a point of the material"})
    EXPECT_NE(complaint(disc, "A").find(words), std::string::npos) << complaint(disc, "A");
  for (const char* words : {"\"part\"", "origin", "name a point of the material"})
    EXPECT_NE(complaint(disc, "").find(words), std::string::npos) << complaint(disc, "");
  for (const char* words : {"no point \"N\"", "M"})
    EXPECT_NE(complaint(plate, "N").find(words), std::string::npos) << complaint(plate, "N");
}

}  // namespace
}  // namespace pintle::flexible_drawing_test
