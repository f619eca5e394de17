#include "tests/siconos/siconos_systems.h"

#include <Friction_cst.h>
#include <SiconosKernel.hpp>
#include <SolverOptions.h>

#include <cmath>
#include <memory>

namespace siconos_judge {

namespace {

constexpr double g = 9.81;

std::shared_ptr<SiconosVector> vector(const std::vector<double>& values) {
  auto out = std::make_shared<SiconosVector>(static_cast<unsigned>(values.size()));
  for (unsigned i = 0; i < values.size(); ++i) out->setValue(i, values[i]);
  return out;
}

std::vector<double> values(const SiconosVector& v) {
  std::vector<double> out;
  for (unsigned i = 0; i < v.size(); ++i) out.push_back(v(i));
  return out;
}

struct Contact {
  std::shared_ptr<Relation> relation;
  double e, mu;
};

std::vector<Sample> run(const std::shared_ptr<LagrangianDS>& body, const std::vector<Contact>& contacts, double step, double until) {
  constexpr double fine = 1e-12;
  auto model = std::make_shared<NonSmoothDynamicalSystem>(0, until + step / 2);
  model->insertDynamicalSystem(body);
  for (const Contact& c : contacts)
    model->link(std::make_shared<Interaction>(std::make_shared<NewtonImpactFrictionNSL>(c.e, 0.0, c.mu, 2), c.relation), body);
  auto problem = std::make_shared<FrictionContact>(2, SICONOS_FRICTION_2D_NSGS);
  problem->numericsSolverOptions()->dparam[SICONOS_DPARAM_TOL] = fine;
  problem->numericsSolverOptions()->iparam[SICONOS_IPARAM_MAX_ITER] = 10000;
  const auto stepper =
      std::make_shared<TimeStepping>(model, std::make_shared<TimeDiscretisation>(0.0, step), std::make_shared<MoreauJeanOSI>(0.5), problem);
  stepper->setNewtonTolerance(10 * fine);
  stepper->setNewtonMaxIteration(30);
  std::vector<Sample> out;
  while (stepper->hasNextEvent()) {
    stepper->computeOneStep();
    out.push_back({step * static_cast<double>(out.size() + 1), values(*body->q()), values(*body->velocity())});
    stepper->nextStep();
  }
  return out;
}

// Two rows of constants: gap and place along.
std::shared_ptr<Relation> linear(const std::vector<std::vector<double>>& rows) {
  auto C = std::make_shared<SimpleMatrix>(2, static_cast<unsigned>(rows[0].size()));
  for (unsigned i = 0; i < 2; ++i)
    for (unsigned j = 0; j < rows[i].size(); ++j) C->setValue(i, j, rows[i][j]);
  return std::make_shared<LagrangianLinearTIR>(C);
}

std::shared_ptr<LagrangianLinearTIDS> point(const std::vector<double>& q, const std::vector<double>& v, const std::vector<double>& force) {
  auto mass = std::make_shared<SimpleMatrix>(2, 2);
  mass->eye();
  auto out = std::make_shared<LagrangianLinearTIDS>(vector(q), vector(v), mass);
  out->setFExtPtr(vector(force));
  return out;
}

}  // namespace

std::vector<Sample> bouncing_disc(double height, double e, double step, double until) {
  return run(point({height, 0}, {0, 0}, {-g, 0}), {{linear({{1, 0}, {0, 1}}), e, 0}}, step, until);
}

std::vector<Sample> block_on_slope(double angle, double mu, double speed, double step, double until) {
  return run(point({0, 0}, {speed, 0}, {-g * std::sin(angle), -g * std::cos(angle)}), {{linear({{0, 1}, {1, 0}}), 0, mu}}, step, until);
}

namespace {

constexpr double l1 = 0.153, l2 = 0.306, half_length = 0.05, half_height = 0.025, clearance = 0.001;
constexpr double m1 = 0.038, m2 = 0.038, m3 = 0.076, J1 = 7.4e-5, J2 = 5.9e-4, J3 = 2.7e-6;

// Lagrange's equations of the three absolute angles.
struct SliderCrank : LagrangianDS {
  SliderCrank() : LagrangianDS(vector({0, 0, 0}), vector({150, -75, 0})) {
    _mass = std::make_shared<SimpleMatrix>(3, 3);
    _fInt = std::make_shared<SiconosVector>(3);
    _fGyr = std::make_shared<SiconosVector>(3);
  }
  static double coupling() { return (m2 / 2 + m3) * l1 * l2; }
  void computeMass() override { computeMass(_q[0]); }
  void computeMass(std::shared_ptr<SiconosVector> q) override {
    const double k = coupling() * std::cos((*q)(0) - (*q)(1));
    _mass->zero();
    _mass->setValue(0, 0, J1 + (m1 / 4 + m2 + m3) * l1 * l1), _mass->setValue(0, 1, k);
    _mass->setValue(1, 0, k), _mass->setValue(1, 1, J2 + (m2 / 4 + m3) * l2 * l2);
    _mass->setValue(2, 2, J3);
  }
  void computeFGyr() override { computeFGyr(_q[0], _q[1]); }
  void computeFGyr(std::shared_ptr<SiconosVector> q, std::shared_ptr<SiconosVector> v) override {
    const double k = coupling() * std::sin((*q)(0) - (*q)(1));
    _fGyr->setValue(0, k * (*v)(1) * (*v)(1)), _fGyr->setValue(1, -k * (*v)(0) * (*v)(0)), _fGyr->setValue(2, 0);
  }
  void computeFInt(double t) override { computeFInt(t, _q[0], _q[1]); }
  void computeFInt(double, std::shared_ptr<SiconosVector> q, std::shared_ptr<SiconosVector>) override {
    _fInt->setValue(0, (m1 / 2 + m2 + m3) * g * l1 * std::cos((*q)(0)));
    _fInt->setValue(1, (m2 / 2 + m3) * g * l2 * std::cos((*q)(1)));
    _fInt->setValue(2, 0);
  }
};

// A corner of the slider under the upper wall (side 1) or over the lower one (−1): its gap, and its place along the wall.
struct Corner : LagrangianScleronomousR {
  double x, y, side;
  Corner(double end, double of) : x(end * half_length), y(of * half_height), side(of) { _jachq = std::make_shared<SimpleMatrix>(2, 3); }
  void computeh(const BlockVector& q, BlockVector&, SiconosVector& out) override {
    const double height = l1 * std::sin(q(0)) + l2 * std::sin(q(1)) + std::sin(q(2)) * x + std::cos(q(2)) * y;
    out.setValue(0, half_height + clearance - side * height);
    out.setValue(1, l1 * std::cos(q(0)) + l2 * std::cos(q(1)) + std::cos(q(2)) * x - std::sin(q(2)) * y);
  }
  void computeJachq(const BlockVector& q, BlockVector&) override {
    _jachq->setValue(0, 0, -side * l1 * std::cos(q(0))), _jachq->setValue(0, 1, -side * l2 * std::cos(q(1)));
    _jachq->setValue(0, 2, -side * (std::cos(q(2)) * x - std::sin(q(2)) * y));
    _jachq->setValue(1, 0, -l1 * std::sin(q(0))), _jachq->setValue(1, 1, -l2 * std::sin(q(1)));
    _jachq->setValue(1, 2, -std::sin(q(2)) * x - std::cos(q(2)) * y);
  }
};

}  // namespace

std::vector<Sample> slider_crank(double step, double until) {
  std::vector<Contact> corners;
  for (const double end : {-1.0, 1.0})
    for (const double side : {-1.0, 1.0}) corners.push_back({std::make_shared<Corner>(end, side), 0.4, 0.01});
  return run(std::make_shared<SliderCrank>(), corners, step, until);
}

}  // namespace siconos_judge
