#include "framework/analysis/linearize/state_space.h"

#include <array>

#include "framework/common/dense.h"
#include "framework/common/index.h"
#include "framework/mechanism/result_tables.h"

namespace pintle {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Generalised forces of the loads' inputs, one per column.
MatrixXd load_inputs(const System& system, const Equations& eq, std::vector<std::string>& names) {
  std::vector<VectorXd> columns;
  const auto add = [&](const std::string& name, int a, int b, const Wrench& on_b) {
    VectorXd& v = columns.emplace_back(VectorXd::Zero(system.n()));
    add_wrench(system, eq, b, on_b, v);
    if (a >= 0) add_wrench(system, eq, a, -on_b, v);
    names.push_back(name);
  };
  const auto add_sized = [&](const std::string& name, const SizedForce& f) {  // its law becomes law + u
    constexpr std::array<std::array<const char*, 2>, 5> words{
        {{".fx [N]", ".fy [N]"}, {".along [N]", ".across [N]"}, {".torque [N m]", ""}, {".pull [N]", ""}, {".restoring torque [N m]", ""}}};
    for (const bool other : {false, true}) {
      if (other && f.other < 0) continue;
      const UnitWrenches unit = unit_wrenches(f, other, eq.motion[at(f.a)], eq.motion[at(f.b)]);
      add(name + words[at(f.way)][other ? 1 : 0], -1, f.b, unit.on_b);
      if (f.way > SizedForce::follows) add_wrench(system, eq, f.a, unit.on_a, columns.back());
    }
  };
  for (std::size_t k = 0; k < system.forces.size(); ++k) {
    const std::string& name = system.force_names[k];
    if (const auto* f = std::get_if<PointForce>(&system.forces[k])) {
      const Eigen::Vector2d x = f->follows ? eq.motion[at(f->b)].u : Eigen::Vector2d(1, 0);
      add(name + (f->follows ? ".along [N]" : ".fx [N]"), -1, f->b, {x.x(), x.y(), 0});
      add(name + (f->follows ? ".across [N]" : ".fy [N]"), -1, f->b, {-x.y(), x.x(), 0});
    } else if (const auto* q = std::get_if<Torque>(&system.forces[k])) {
      add(name + ".torque [N m]", q->a, q->b, {0, 0, 1});
    } else if (const auto* sized = std::get_if<SizedForce>(&system.forces[k])) {
      add_sized(name, *sized);
    }
  }
  MatrixXd out(system.n(), static_cast<Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) out.col(static_cast<Index>(k)) = columns[k];
  return out;
}

/// Quantities that depend on the configuration: rows of ∂(measure)/∂q.
struct Measures {
  explicit Measures(const Model& model, const System& of) : system(of) {
    const auto add = [&](const std::string& name) { names.push_back(name); };
    for (const Body& b : system.bodies) add(b.name + ".x [m]"), add(b.name + ".y [m]"), add(b.name + ".angle [rad]");
    points = static_cast<Index>(names.size());
    for (const RecordedPoint& p : model.points) add(p.name + ".x [m]"), add(p.name + ".y [m]");
    springs = static_cast<Index>(names.size());
    first_marker = static_cast<int>(system.markers.size() - model.points.size());
    for (std::size_t k = 0; k < system.forces.size(); ++k) {
      if (acts_along_a_line(system.forces[k])) add(system.force_names[k] + ".length [m]");
      if (std::holds_alternative<TorsionSpring>(system.forces[k])) add(system.force_names[k] + ".twist [rad]");
    }
    for (int c = 0; c < n_clearances(system); ++c) {
      const std::string& name = system.contact_names[at(c)];
      add(name + ".ex [m]"), add(name + ".ey [m]");
    }
  }

  void fill(const Equations& eq, MatrixXd& H) const {
    Index row = 0;
    for (std::size_t b = 0; b < system.bodies.size(); ++b, row += 3) {
      const auto i = static_cast<Index>(3 * b);
      const double c = eq.cos_[static_cast<Index>(b)], s = eq.sin_[static_cast<Index>(b)];
      const Eigen::Vector2d& x = system.bodies[b].x_BO;
      H(row, i) = H(row + 1, i + 1) = H(row + 2, i + 2) = 1;
      H(row, i + 2) = -(s * x.x() + c * x.y());
      H(row + 1, i + 2) = c * x.x() - s * x.y();
    }
    for (int m = first_marker; m < static_cast<int>(system.markers.size()); ++m, row += 2) place(eq, m, 1, row, H);
    for (const Force& f : system.forces) {
      if (acts_along_a_line(f)) {
        const int a = marker_a(f), b = marker_b(f);
        const Eigen::Vector2d d = eq.motion[at(b)].r - eq.motion[at(a)].r;
        const double length = d.norm();
        const Eigen::Vector2d along = length > 0 ? Eigen::Vector2d(d / length) : Eigen::Vector2d(0, 0);
        visit_motion(system, eq, b, [&](int j, const Eigen::Vector3d& p) { H(row, j) += along.dot(p.head<2>()); });
        visit_motion(system, eq, a, [&](int j, const Eigen::Vector3d& p) { H(row, j) -= along.dot(p.head<2>()); });
        ++row;
      } else if (const auto* torsion = std::get_if<TorsionSpring>(&f)) {
        visit_motion(system, eq, torsion->b, [&](int j, const Eigen::Vector3d& p) { H(row, j) += p[2]; });
        visit_motion(system, eq, torsion->a, [&](int j, const Eigen::Vector3d& p) { H(row, j) -= p[2]; });
        ++row;
      }
    }
    for (const ContactPair& c : system.contacts) {
      if (c.profiles) break;
      place(eq, c.a, 1, row, H);
      place(eq, c.b, -1, row, H);
      row += 2;
    }
  }

  const System& system;
  std::vector<std::string> names;
  Index points = 0, springs = 0;  ///< first rows of each
  int first_marker = 0;

 private:
  void place(const Equations& eq, int marker, double sign, Index row, MatrixXd& H) const {
    visit_motion(system, eq, marker, [&](int j, const Eigen::Vector3d& p) {
      H(row, j) += sign * p[0];
      H(row + 1, j) += sign * p[1];
    });
  }
};

/// δq, δs, δa and generalised loads as linear functions of [p; ṗ; inputs].
struct Maps {
  MatrixXd q, s, a, load;
};

/// For columns [p; ṗ; x; loads; u₁ u̇₁ ü₁ u₂ …], without the effect of p̈ on δa.
Maps maps_of(const MotionAt& here, const FreeMotion& free, const MatrixXd& loads) {
  const Index m = free.m(), x = here.x.g_x.rows(), states = 2 * m + x, forces = loads.cols(), offsets = free.X.cols() - m;
  const auto Z = free.X.leftCols(m), Z1 = free.X1.leftCols(m), Z2 = free.X2.leftCols(m);
  const MatrixXd none = MatrixXd::Zero(loads.rows(), states + forces + 3 * offsets);
  Maps maps{none, none, none, none};
  maps.q.leftCols(m) = Z;
  maps.s.leftCols(m) = Z1;
  maps.s.middleCols(m, m) = Z;
  maps.a.leftCols(m) = Z2;
  maps.a.middleCols(m, m) = 2 * Z1;
  maps.load.middleCols(2 * m, x) = here.x.f_x;
  maps.load.middleCols(states, forces) = loads;
  for (Index k = 0; k < offsets; ++k) {
    const Index u = states + forces + 3 * k;
    maps.q.col(u) = maps.s.col(u + 1) = maps.a.col(u + 2) = free.X.col(m + k);
    maps.s.col(u) = free.X1.col(m + k);
    maps.a.col(u + 1) = 2 * free.X1.col(m + k);
    maps.a.col(u) = free.X2.col(m + k);
  }
  return maps;
}

std::string per_second(const std::string& name, const char* what) {
  const std::size_t unit = name.rfind(" [");
  std::string in = name.substr(unit + 2, name.size() - unit - 3);
  if (const std::size_t blank = in.find(' '); blank != std::string::npos)
    in = "m/s" + in.substr(blank);  // m kg^0.5
  else
    in += "/s";
  return name.substr(0, unit) + what + " [" + in + "]";
}

/// C and D of the outputs, row after row.
class Outputs {
 public:
  Outputs(StateSpace& space, Index rows) : space_(space), all_(rows, space.B.cols() + space.A.cols()) {}
  template <class Row>
  void add(const std::string& name, const Row& row) {
    all_.row(count_++) = row;
    space_.outputs.push_back(name);
  }
  void finish() {
    space_.C = all_.topLeftCorner(count_, space_.A.cols());
    space_.D = all_.topRightCorner(count_, space_.B.cols());
  }

 private:
  StateSpace& space_;
  MatrixXd all_;
  Index count_ = 0;
};

/// Forces of springs. @param x  the first internal state among the states
void add_spring_forces(const System& system, const Measures& measures, const MatrixXd& value, const MatrixXd& rate, Index x, Outputs& out) {
  Index row = measures.springs;
  for (std::size_t k = 0; k < system.forces.size(); ++k) {
    if (const auto* s = std::get_if<Spring>(&system.forces[k])) {
      out.add(system.force_names[k] + ".pull [N]", s->k * value.row(row) + s->c * rate.row(row));
      ++row;
    } else if (const auto* series = std::get_if<Maxwell>(&system.forces[k])) {
      VectorXd pull = series->k * value.row(row).transpose();
      pull[x + system.force_x[k]] -= series->k;
      out.add(system.force_names[k] + ".pull [N]", pull.transpose());
      ++row;
    } else if (const auto* r = std::get_if<TorsionSpring>(&system.forces[k])) {
      out.add(system.force_names[k] + ".restoring torque [N m]", r->k * value.row(row) + r->c * rate.row(row));
      ++row;
    }
  }
}

void add_efforts(const System& system, const MotionAt& here, const FreeMotion& free, const Maps& maps, Outputs& out) {
  if (free.dependent.empty()) return;
  const MatrixXd left = here.M * maps.a + here.D * maps.s + here.K * maps.q - maps.load;
  const VectorXd measure = system.scale(free.dependent);
  const MatrixXd square = measure.asDiagonal() * free.Cq(Eigen::all, free.dependent).transpose() * system.row_scale.asDiagonal();
  const MatrixXd effort =  // −δλ, from Cqᵀ δλ = −left in the dependent rows
      system.row_scale.asDiagonal() * square.partialPivLu().solve(measure.asDiagonal() * left(free.dependent, Eigen::all));
  for (std::size_t k = 0; k < system.joints.size(); ++k)
    if (is_driver(system.joints[k]))
      out.add(system.joint_names[k] + (is_angle_row(system.joints[k], 0) ? ".torque [N m]" : ".thrust [N]"),
              effort.row(system.row_begin[k]));
}

}  // namespace

bool acts_along_a_line(const Force& f) { return std::holds_alternative<Spring>(f) || std::holds_alternative<Maxwell>(f); }

std::vector<int> driven_rows(const System& system) {
  std::vector<int> out;
  for (std::size_t k = 0; k < system.joints.size(); ++k)
    if (is_driver(system.joints[k])) out.push_back(system.row_begin[k]);
  return out;
}

StateSpace state_space(const Model& model, const System& system, const MotionAt& here, const FreeMotion& free, const SmallMotion& motion,
                       const std::vector<std::string>& coordinates) {
  StateSpace out;
  const MatrixXd loads = load_inputs(system, here.eq, out.inputs);
  const Index m = free.m(), offsets = free.X.cols() - m, forces = loads.cols(), inputs = forces + 3 * offsets, x = here.x.g_x.rows(),
              states = 2 * m + x, all = states + inputs;
  for (const int i : free.independent) out.states.push_back(coordinates[at(i)]);
  for (const int i : free.independent) out.states.push_back(per_second(coordinates[at(i)], " rate"));
  out.states.insert(out.states.end(), here.x_names.begin(), here.x_names.end());
  for (std::size_t k = 0; k < system.joints.size(); ++k)
    if (is_driver(system.joints[k])) {
      const std::string name = system.joint_names[k], unit = is_angle_row(system.joints[k], 0) ? "rad" : "m";
      out.inputs.insert(out.inputs.end(), {name + ".offset [" + unit + "]", name + ".offset rate [" + unit + "/s]",
                                           name + ".offset acceleration [" + unit + "/s^2]"});
    }

  Maps maps = maps_of(here, free, loads);
  const auto Z = free.X.leftCols(m);
  // p̈ from Zᵀ(M δa + D δs + K δq − load) = 0, where only M Z p̈ is not yet in the maps.
  MatrixXd p2(m, all);
  if (m > 0) p2 = -motion.M.llt().solve(Z.transpose() * (here.M * maps.a + here.D * maps.s + here.K * maps.q - maps.load));
  maps.a += Z * p2;
  MatrixXd rates = MatrixXd::Zero(states, all);  // of [p; ṗ; x]
  rates.block(0, m, m, m).setIdentity();
  rates.middleRows(m, m) = p2;
  rates.bottomRows(x) = here.x.g_q * maps.q + here.x.g_s * maps.s;
  rates.block(2 * m, 2 * m, x, x) += here.x.g_x;
  out.A = rates.leftCols(states);
  out.B = rates.rightCols(inputs);

  const Measures measures(model, system);
  const auto rows = static_cast<Index>(measures.names.size());
  const Derivatives H = along(system, here, rows, system.n(), [&](const Equations& eq, MatrixXd& to) { measures.fill(eq, to); });
  const MatrixXd value = H.value * maps.q, rate = H.value * maps.s + H.rate * maps.q;
  Outputs outputs(out, 3 * rows + offsets);
  for (Index i = 0; i < rows; ++i) outputs.add(measures.names[at(i)], value.row(i));
  for (Index i = measures.points; i < measures.springs; ++i) {
    const std::string& name = measures.names[at(i)];  // "rod.P.x [m]" to "rod.P.vx [m/s]"
    outputs.add(name.substr(0, name.size() - 5) + "v" + name.substr(name.size() - 5, 1) + " [m/s]", rate.row(i));
  }
  add_spring_forces(system, measures, value, rate, 2 * m, outputs);
  if (free.full_rank) add_efforts(system, here, free, maps, outputs);
  outputs.finish();
  for (MatrixXd* each : {&out.A, &out.B, &out.C, &out.D}) each->array() += 0.0;  // no negative zeros
  return out;
}

}  // namespace pintle
