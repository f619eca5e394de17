#include "exact_beam.h"

#include "band.h"
#include "exact_beam_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace pintle_oracle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Newton's last change of places, by the length. The tangent is exact, so what is left is its
/// square; much smaller a change is lost in the rounding of GA γ in slender beams.
constexpr double newton_end = 1e-9;
constexpr int newton_most = 30;

/// Gauss' collocation of three stages: its nodes c, weights b, and A as Butcher writes them.
constexpr int stages = 3;
struct Gauss {
  Eigen::Matrix3d A, A2;
  Vector3d b, c, bA;
  Gauss() {
    const double q = std::sqrt(15.0);
    A << 5.0 / 36, 2.0 / 9 - q / 15, 5.0 / 36 - q / 30,  //
        5.0 / 36 + q / 24, 2.0 / 9, 5.0 / 36 - q / 24,   //
        5.0 / 36 + q / 30, 2.0 / 9 + q / 15, 5.0 / 36;
    b << 5.0 / 18, 4.0 / 9, 5.0 / 18;
    c = A.rowwise().sum();
    A2 = A * A;
    bA = A.transpose() * b;
  }
};
const Gauss gauss;

/// A run's state and the accelerations in the stages of its last step, a column each.
struct Run {
  double t = 0;
  BeamVector z, v;
  Eigen::MatrixXd a;
};

/// J += the stage's tangent by the accelerations of all; stage i of dof k is row stages·k + i.
void add_stage(const BeamMesh& m, const Internal& in, int i, double h, Band& J) {
  for (std::size_t e = 0; e < in.tangents.size(); ++e) {
    const ElementMatrix& K = in.tangents[e];
    for (int c = 0; c < K.cols(); ++c)
      for (int r = 0; r < K.rows(); ++r)
        for (int j = 0; j < stages; ++j)
          J(stages * (m.first[e] + r) + i, stages * (m.first[e] + c) + j) += h * h * gauss.A2(i, j) * K(r, c);
  }
  for (int c = 0; c < m.free; ++c)
    for (BeamSparse::InnerIterator it(m.Mz, c); it; ++it) J(stages * static_cast<int>(it.row()) + i, stages * c + i) += it.value();
}

/// One Newton iteration for the stages' accelerations.
/// @returns the size of the change of the stages' places.
double improve(const BeamMesh& m, Run& run, double h) {
  Band J(stages * m.free, stages * (m.width + 1) - 1);
  Eigen::MatrixXd residual(stages, m.free);
  for (int i = 0; i < stages; ++i) {
    const double t = run.t + gauss.c[i] * h;
    const BeamVector z = run.z + gauss.c[i] * h * run.v + h * h * run.a * gauss.A2.row(i).transpose();
    const Internal in = internal(m, m.T * z + held(m, t, &SectionMotion::place), true);
    add_stage(m, in, i, h, J);
    const BeamVector given = m.M * held(m, t, &SectionMotion::acceleration);
    residual.row(i) = m.Mz * run.a.col(i) - m.T.transpose() * (m.load - in.force - given);
  }
  J.factor();
  const BeamVector change = J.solve(residual.reshaped());
  const Eigen::MatrixXd da = change.reshaped(stages, m.free).transpose();
  run.a -= da;
  const Eigen::MatrixXd dz = h * h * da * gauss.A2.transpose();
  return std::max({size_of_step(m, dz.col(0)), size_of_step(m, dz.col(1)), size_of_step(m, dz.col(2))});
}

void advance(const BeamMesh& m, Run& run, double h) {
  double change = 1;
  for (int i = 0; i < newton_most && change > newton_end; ++i) change = improve(m, run, h);
  if (!(change <= newton_end))
    throw std::runtime_error("exact beam: Newton's method fails in the step from t = " + text(run.t) + " s; shorten the step of " +
                             text(h) + " s");
  run.z += h * run.v + h * h * run.a * gauss.bA;
  run.v += h * run.a * gauss.b;
}

BeamFrame frame(const BeamMesh& m, const Run& run) {
  const BeamVector u = m.T * run.z + held(m, run.t, &SectionMotion::place);
  const BeamVector rate = m.T * run.v + held(m, run.t, &SectionMotion::rate);
  const BeamVector given = held(m, run.t, &SectionMotion::acceleration);
  const Internal in = internal(m, u, false);

  Band mass(m.free, m.width);
  for (int c = 0; c < m.free; ++c)
    for (BeamSparse::InnerIterator it(m.Mz, c); it; ++it) mass(static_cast<int>(it.row()), c) += it.value();
  mass.factor();
  const BeamVector a = mass.solve(m.T.transpose() * (m.load - in.force - m.M * given).eval());
  const BeamVector support = m.M * (m.T * a + given) + in.force - m.load;

  const BeamVector p = m.M * rate;
  Vector3d momentum = Vector3d::Zero();
  for (int i = 0; i < m.nodes; ++i)
    momentum += Vector3d(p[3 * i], p[3 * i + 1], u[3 * i] * p[3 * i + 1] - u[3 * i + 1] * p[3 * i] + p[3 * i + 2]);
  return {.t = run.t,
          .place = Eigen::Map<const Places>(u.data(), 3, m.nodes),
          .rate = Eigen::Map<const Places>(rate.data(), 3, m.nodes),
          .kinetic = 0.5 * rate.dot(p),
          .strain = in.energy,
          .potential = -m.load.dot(u),
          .momentum = momentum,
          .support_a = support.head<3>(),
          .support_b = support.tail<3>()};
}

}  // namespace

BeamStart rigid_start(const Place& place_a, const Place& rate_a) {
  return [place_a, rate_a](double s) {
    const Vector2d e(std::cos(place_a[2]), std::sin(place_a[2]));
    SectionMotion at{.place = place_a, .rate = rate_a};
    at.place.head<2>() += s * e;
    at.rate.head<2>() += s * rate_a[2] * Vector2d(-e[1], e[0]);
    return at;
  };
}

MotionLaw crank_pin(const Vector2d& centre, double radius, std::function<Vector3d(double t)> turn) {
  return [centre, radius, turn = std::move(turn)](double t) {
    const Vector3d angle = turn(t);
    const Vector2d e(std::cos(angle[0]), std::sin(angle[0])), n(-e[1], e[0]);
    SectionMotion at{.place = {0, 0, angle[0]}, .rate = {0, 0, angle[1]}, .acceleration = {0, 0, angle[2]}};
    at.place.head<2>() = centre + radius * e;
    at.rate.head<2>() = radius * angle[1] * n;
    at.acceleration.head<2>() = radius * (angle[2] * n - angle[1] * angle[1] * e);
    return at;
  };
}

Places static_shape(const ExactBeam& beam, const BeamStart& start, int load_steps) {
  if (load_steps < 1) throw std::invalid_argument("exact beam: load_steps = " + std::to_string(load_steps) + ", must be ≥ 1");
  const BeamMesh m = build(beam, start);
  const BeamVector g = held(m, 0, &SectionMotion::place);
  BeamVector z = initial(m, start).z;
  for (int step = 1; step <= load_steps; ++step) {
    double change = 1;
    for (int i = 0; i < newton_most && change > newton_end; ++i) {
      Band K(m.free, m.width);
      const Internal in = internal(m, m.T * z + g, true);
      for (std::size_t e = 0; e < in.tangents.size(); ++e) {
        const ElementMatrix& Ke = in.tangents[e];
        for (int c = 0; c < Ke.cols(); ++c)
          for (int r = 0; r < Ke.rows(); ++r) K(m.first[e] + r, m.first[e] + c) += Ke(r, c);
      }
      K.factor();
      const BeamVector dz = K.solve(m.T.transpose() * (m.load * (double(step) / load_steps) - in.force).eval());
      z += dz;
      change = size_of_step(m, dz);
    }
    if (!(change <= newton_end))
      throw std::runtime_error("exact beam: no equilibrium at load step " + text(step) + " of " + std::to_string(load_steps) +
                               "; hold the ends or take more load steps");
  }
  const BeamVector u = m.T * z + g;
  return Eigen::Map<const Places>(u.data(), 3, m.nodes);
}

std::vector<BeamFrame> simulate(const ExactBeam& beam, const BeamStart& start, const std::vector<double>& times, double step) {
  if (!(step > 0)) throw std::invalid_argument("exact beam: step = " + text(step) + " s, must be > 0");
  const BeamMesh m = build(beam, start);
  StartCoordinates at = initial(m, start);
  Run run{.t = 0, .z = std::move(at.z), .v = std::move(at.rate), .a = Eigen::MatrixXd::Zero(m.free, stages)};
  std::vector<BeamFrame> frames;
  for (const double until : times) {
    const double from = run.t;
    if (!(until >= from)) throw std::invalid_argument("exact beam: times must ascend from 0; t = " + text(until) + " s does not");
    const int steps = static_cast<int>(std::ceil((until - from) / step * (1 - 1e-12)));
    for (int i = 0; i < steps; ++i) {
      advance(m, run, (until - from) / steps);
      run.t = from + (until - from) * (i + 1) / steps;
    }
    frames.push_back(frame(m, run));
  }
  return frames;
}

Place place_at(const ExactBeam& beam, const Places& places, double s) {
  const double at = std::clamp(s / beam.length, 0.0, 1.0) * beam.elements;
  const int e = std::min(static_cast<int>(at), beam.elements - 1);
  const ShapeValues shape = shape_at(beam.degree, at - e, 0);
  Place sum = Place::Zero();
  for (int i = 0; i <= beam.degree; ++i) sum += shape.value[std::size_t(i)] * places.col(e * beam.degree + i);
  return sum;
}

Converged converge(ExactBeam beam, const BeamStart& start, const std::vector<double>& times, double step, double tolerance, int doublings) {
  std::vector<BeamFrame> coarse = simulate(beam, start, times, step);
  for (int i = 0; i < doublings; ++i) {
    beam.elements *= 2;
    step /= 2;
    std::vector<BeamFrame> fine = simulate(beam, start, times, step);
    double change = 0;
    for (std::size_t k = 0; k < times.size(); ++k)
      for (Eigen::Index n = 0; n < coarse[k].place.cols(); n += beam.degree) {
        const Place moved = fine[k].place.col(2 * n) - coarse[k].place.col(n);
        change = std::max(change, moved.head<2>().norm() / beam.length);
      }
    if (change <= tolerance) return {beam, std::move(fine), step, change};
    coarse = std::move(fine);
  }
  throw std::runtime_error("exact beam: not converged with " + std::to_string(beam.elements) + " elements and steps of " + text(step) +
                           " s; start finer or allow more doublings");
}

}  // namespace pintle_oracle
