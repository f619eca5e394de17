#include "tests/contact_laws/disc_in_eye.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elements/material.h"
#include "framework/component/fe/from_mesh.h"
#include "framework/component/fe/loads.h"
#include "framework/component/fe/statics.h"
#include "meshes/lattice.h"

namespace pintle_test {

using namespace pintle;
using std::numbers::pi;

struct PressedHalf {
  Mesh mesh;
  FeModel model;
  Sparse K;
  Supports supports;
};

namespace {

constexpr double longest = 0.1;

/// From 0 to `end`, as long as the growth allows.
std::vector<double> graded(const DiscInEye& d, double end) {
  std::vector<double> out{0};
  while (out.back() < end) out.push_back(out.back() + std::clamp(d.growth * out.back(), d.finest, longest * std::max(1.0, out.back())));
  for (double& v : out) v *= end / out.back();
  return out;
}

/// PressedHalf a ring; the place of contact on its x = 0 edge below. `inwards`: finest at the outer rim.
std::unique_ptr<PressedHalf> half_ring(const DiscInEye& d, double inner, double outer, bool inwards, bool rigid_core) {
  auto half = std::make_unique<PressedHalf>();
  std::vector<double> depth = graded(d, outer - inner), turn = graded(d, pi);
  for (double& r : depth) r = inwards ? outer - r : inner + r;
  std::sort(depth.begin(), depth.end());
  for (double& a : turn) a -= pi / 2;
  const auto at = [](double r, double a) { return Eigen::Vector2d(r * std::cos(a), r * std::sin(a)); };
  half->mesh = lattice_mesh({depth, turn, at, false, {"below", "rim", "above", "bore"}}, CellShape::quadrilateral8);
  const double young = 2 * (1 - d.poisson * d.poisson);
  const Material material{Isotropic{young, d.poisson}, 1};
  half->model = fe_model(half->mesh.x, plane_blocks(half->mesh, {plane_material(material, PlaneState::strain), 1, 1}, ""));
  half->K = Assembler(half->model).stiffness();
  if (rigid_core) {
    const Group& bore = *half->mesh.group("bore");
    add_ports(half->model, {}, {{"middle", Eigen::Vector2d::Zero(), bore.nodes, rim_weights(half->mesh, bore), Coupling::rigid}});
    hold(half->supports, half->model, *half->model.port("middle"), true, false, true);
  }
  for (const char* edge : {"below", "above"})
    for (const int node : half->mesh.group(edge)->nodes)
      if (half->model.independent_of(half->model.begin[static_cast<std::size_t>(node)]) >= 0)
        hold(half->supports, half->model, node, true, false, false);
  return half;
}

}  // namespace

struct PressedDisc::Parts {
  std::unique_ptr<PressedHalf> disc, eye;
  ContactRows rows;
  std::unique_ptr<TouchingBodies> bodies;
  Eigen::VectorXd load;  ///< of force 1 downwards
};

PressedDisc::~PressedDisc() = default;
int PressedDisc::dofs() const { return parts_->disc->model.n() + parts_->eye->model.n(); }
int PressedDisc::rows() const { return static_cast<int>(parts_->rows.gap.size()); }

PressedDisc::PressedDisc(const DiscInEye& d) : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  p.disc = half_ring(d, d.core, 1 - d.clearance, true, d.load_in_the_middle);
  p.eye = half_ring(d, 1, d.outer, false, false);
  for (const int node : p.eye->mesh.group("rim")->nodes) hold(p.eye->supports, p.eye->model, node, true, true, false);
  std::vector<int>& held = p.eye->supports.dofs;
  std::sort(held.begin(), held.end());
  held.erase(std::unique(held.begin(), held.end()), held.end());
  const auto surface = [](const PressedHalf& half, const char* edge) {
    return contact_surface(half.mesh, half.mesh.group(edge)->sides, 1);
  };
  p.rows = contact_rows(p.disc->model, surface(*p.disc, "rim"), p.eye->model, surface(*p.eye, "bore"), {0, -d.clearance});
  p.bodies = std::make_unique<TouchingBodies>(
      std::vector<TouchingBody>{{&p.disc->model, &p.disc->K, p.disc->supports}, {&p.eye->model, &p.eye->K, p.eye->supports}},
      std::vector<TouchingPair>{{0, 1, p.rows}});
  if (d.load_in_the_middle) {
    p.load = Eigen::VectorXd::Zero(p.disc->model.n());
    add_force(p.load, *p.disc->model.port("middle"), {0, -1}, 0);
  } else {
    p.load = acceleration_load(p.disc->model, Assembler(p.disc->model).mass(), {0, -1});
    p.load /= -(rigid_motions(p.disc->model).col(1).dot(p.load));
  }
}

Pressed PressedDisc::press(double force) const {
  const Parts& p = *parts_;
  const TouchingSolution s = p.bodies->solve({p.load * (force / 2), Eigen::VectorXd::Zero(p.eye->model.n())});
  Pressed out;
  out.force = force;
  out.depth = p.load.dot(s.bodies[0].independent);
  out.residual = std::max(s.bodies[0].residual, s.bodies[1].residual);
  std::vector<std::array<double, 2>> curve;
  for (Eigen::Index i = 0; i < p.rows.gap.size(); ++i)
    curve.push_back({std::remainder(p.rows.along[i] + pi / 2, 2 * pi), s.force[0][i] / p.rows.area[i]});
  for (auto& c : curve) c[0] = std::abs(c[0]);
  std::sort(curve.begin(), curve.end());
  std::size_t last = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    out.angle.push_back(curve[i][0]);
    out.pressure.push_back(curve[i][1]);
    out.greatest_pressure = std::max(out.greatest_pressure, curve[i][1]);
    if (curve[i][1] > 0) last = i;
  }
  // p² falls straight to the end of a narrow contact; the first hat without pressure bounds it.
  out.half_angle = curve[last][0];
  if (last >= 1 && last + 1 < curve.size()) {
    const auto [a, pa] = curve[last - 1];
    const auto [b, pb] = curve[last];
    const double next = curve[last + 1][0];
    out.half_angle = pa > pb ? std::min(next, b + (b - a) * pb * pb / (pa * pa - pb * pb)) : next;
  }
  return out;
}

}  // namespace pintle_test
