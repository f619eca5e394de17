#include "elements/material.h"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace pintle {
namespace {

using Eigen::Matrix3d;
using Eigen::RowVector3d;

void require(bool holds, const char* name, double value, const std::string& rule) {
  if (holds && std::isfinite(value)) return;
  std::ostringstream text;
  text << "material: " << name << " = " << value << ", must be " << rule;
  throw std::invalid_argument(text.str());
}

void validate(const Isotropic& m) {
  require(m.young > 0, "young", m.young, "positive [Pa]");
  require(m.poisson > -1 && m.poisson < 0.5, "poisson", m.poisson, "above −1 and below 0.5; take 0.4999 for a nearly incompressible solid");
}

// Requires a positive definite compliance in the 1–2 plane.
void validate(const Orthotropic& m) {
  require(m.young_1 > 0, "young_1", m.young_1, "positive [Pa]");
  require(m.young_2 > 0, "young_2", m.young_2, "positive [Pa]");
  require(m.shear_12 > 0, "shear_12", m.shear_12, "positive [Pa]");
  require(std::isfinite(m.angle), "angle", m.angle, "finite [rad]");
  require(m.poisson_12 * m.poisson_12 * m.young_2 < m.young_1, "poisson_12", m.poisson_12,
          "below √(young_1/young_2) in size; given for pull along 2 it is poisson_21, which "
          "young_1/young_2 times gives poisson_12");
}

void validate(const Material& m) {
  require(m.density >= 0, "density", m.density, "positive, or 0 for no mass [kg/m³]");
  std::visit([](const auto& elastic) { validate(elastic); }, m.elastic);
}

PlaneMaterial plane(const Isotropic& m, PlaneState state) {
  const double E = m.young, nu = m.poisson, G = E / (2 * (1 + nu));
  const bool strain = state == PlaneState::strain;
  const double across = strain ? E * nu / ((1 + nu) * (1 - 2 * nu)) : E * nu / (1 - nu * nu);
  const double along = across + 2 * G;
  PlaneMaterial out;
  out.D << along, across, 0, across, along, 0, 0, 0, G;
  out.Dz = (strain ? across : 0) * RowVector3d(1, 1, 0);
  return out;
}

/// Compliance in the 1–2 plane, and the stress σ₃ = s₁σ₁ + s₂σ₂ that keeps ε₃ = 0.
struct InPlane {
  double S11, S12, S22, s1, s2;
};

InPlane compliance(const Orthotropic& m, PlaneState state) {
  InPlane c{1 / m.young_1, -m.poisson_12 / m.young_1, 1 / m.young_2, 0, 0};
  if (state == PlaneState::stress) return c;
  if (!m.young_3 || !m.poisson_13 || !m.poisson_23)
    throw std::invalid_argument(std::string("material: orthotropic in plane strain lacks") + (m.young_3 ? "" : " young_3") +
                                (m.poisson_13 ? "" : " poisson_13") + (m.poisson_23 ? "" : " poisson_23") +
                                "; give it, or take plane stress");
  const double E3 = *m.young_3;
  require(E3 > 0, "young_3", E3, "positive [Pa]");
  c.s1 = E3 * *m.poisson_13 / m.young_1;
  c.s2 = E3 * *m.poisson_23 / m.young_2;
  c.S11 -= c.s1 * c.s1 / E3;
  c.S12 -= c.s1 * c.s2 / E3;
  c.S22 -= c.s2 * c.s2 / E3;
  require(c.S11 > 0, "poisson_13", *m.poisson_13, "below √(young_1/young_3) in size");
  require(c.S22 > 0, "poisson_23", *m.poisson_23, "below √(young_2/young_3) in size");
  require(c.S12 * c.S12 < c.S11 * c.S22, "poisson_12", m.poisson_12,
          "smaller for the given poisson_13 and poisson_23: the solid would not resist every strain");
  return c;
}

PlaneMaterial plane(const Orthotropic& m, PlaneState state) {
  const InPlane S = compliance(m, state);
  const double det = S.S11 * S.S22 - S.S12 * S.S12;
  Matrix3d D;
  D << S.S22 / det, -S.S12 / det, 0, -S.S12 / det, S.S11 / det, 0, 0, 0, m.shear_12;
  const RowVector3d Dz = RowVector3d(S.s1, S.s2, 0) * D;

  const double c = std::cos(m.angle), s = std::sin(m.angle);
  Matrix3d turn;  // strain in the solid's axes = turn · strain in the body's
  turn << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
  D = turn.transpose() * D * turn;
  return {(D + D.transpose()) / 2, Dz * turn};
}

BeamModuli along(const Isotropic& m, double) { return {m.young, m.young / (2 * (1 + m.poisson)), m.poisson}; }

BeamModuli along(const Orthotropic& m, double direction) {
  const double c = std::cos(direction - m.angle), s = std::sin(direction - m.angle);
  const double S11 = 1 / m.young_1, S12 = -m.poisson_12 / m.young_1, S22 = 1 / m.young_2;
  const double S66 = 1 / m.shear_12, cc = c * c, ss = s * s;
  const double E = 1 / (S11 * cc * cc + (2 * S12 + S66) * cc * ss + S22 * ss * ss);
  const double G = 1 / (4 * (S11 - 2 * S12 + S22) * cc * ss + S66 * (cc - ss) * (cc - ss));
  return {E, G, E / (2 * G) - 1};
}

}  // namespace

PlaneMaterial plane_material(const Material& m, PlaneState state) {
  validate(m);
  return std::visit([&](const auto& elastic) { return plane(elastic, state); }, m.elastic);
}

BeamModuli beam_moduli(const Material& m, double direction) {
  validate(m);
  return std::visit([&](const auto& elastic) { return along(elastic, direction); }, m.elastic);
}

}  // namespace pintle
