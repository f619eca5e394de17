#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>
#include <Eigen/LU>

#include "eigen_layout.h"
#include "framework/dynamics/model/flexible.h"
#include "framework/dynamics/model/marker_motion.h"
#include "framework/dynamics/model/system.h"
#include "framework/dynamics/solvers/schur.h"

namespace pintle {

/// Forces that the accelerations determine, and the effect of each on the motion: normal forces of closed rigid contacts; friction of these
/// and of contacts that stick, each directly after its normal force; then all friction in joints, whether it sticks or slides. See
/// sticking.h.
struct Sticking {
  struct Column {
    std::size_t at;  ///< its index in State::friction
    bool normal;     ///< a normal force; else friction
    bool holds;      ///< keeps its gap closed, or its slip at 0
  };
  std::vector<Column> of;
  Eigen::MatrixXd J;       ///< n × of: ∂(opening speed or slip)/∂s, one column each
  Eigen::MatrixXd a;       ///< n × of: accelerations caused by 1 N
  Eigen::MatrixXd lambda;  ///< n_rows × of: multipliers caused by 1 N
};

/// Scratch for solving for the scene's own states.
struct OwnScratch {
  Eigen::MatrixXd slopes, A;
  Eigen::VectorXd left, change;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;
};

/// Scratch of one evaluation of the equations of motion, sized by the system; one per thread.
///   M a + Cqᵀ λ = f(q, s, t),   Cq a = γ,   Cq s = −Ct,   C = 0.
/// Allocates nothing after construction while the rows are few enough for a dense solver.
struct Equations {
  explicit Equations(const System&);

  /// An end of a joint on a moving body, with the indices it needs.
  struct End {
    std::size_t joint, at;  ///< L[at] and B[at] are its share of the joint's rows
    int marker, q, row, m;  ///< marker; first coordinate; first row; rows
    int flexible;           ///< index into `flexible`, −1 for a rigid body
    bool bends;             ///< B_eta can be nonzero
  };
  std::vector<End> ends;
  /// One row of an end, for products: three entries of L or B, numbered over all blocks, at coordinate q.
  struct EndRow {
    int row, q, at, marker;
  };
  std::vector<EndRow> end_rows;
  /// The data that `pose` needs of a marker on a rigid body or the ground. Kept small because memory access limits large systems.
  struct Point {
    int body;
    double x, y, angle;
  };
  std::vector<Point> points;  ///< of each marker
  struct JointRow {
    int joint, i;
  };
  std::vector<JointRow> joint_rows;       ///< of each constraint row
  Eigen::VectorXd W;                      ///< M⁻¹ of rigid bodies, diagonal, n_rigid
  std::vector<FlexibleInertia> flexible;  ///< of each flexible body
  std::vector<int> flexible_of;           ///< per body, index into `flexible` or −1

  std::vector<MarkerMotion> motion;      ///< of each marker
  std::vector<bool> directed;            ///< per marker: a joint or a following force needs its direction u
  std::vector<ConstraintRows> rows;      ///< of each joint, as functions of the poses of its markers
  std::vector<ConstraintRows::Block> L;  ///< … and their derivatives, one block per end of a joint
  std::vector<int> released;             ///< rows of joints released by events: all zero, λ = 0
  std::vector<Schur::Block> B;           ///< rows of Cq, one block per end: L J on [x y θ] …
  std::vector<RowBlock> B_eta;           ///< … and on η; empty for a rigid body
  std::vector<Schur::Block> B_hat;       ///< both in the metric of M⁻¹: see to_metric
  std::vector<RowBlock> B_eta_hat;
  Schur schur;
  Eigen::VectorXd C;             ///< position violation [m or rad], n_rows
  Eigen::VectorXd Cdot;          ///< velocity violation Cq s + Ct, n_rows
  Eigen::VectorXd f, a, lambda;  ///< forces, accelerations, multipliers
  std::vector<ContactEffect> contact;
  std::vector<ForceEffect> force;
  std::vector<double> signals, laws;  ///< values of the system's signals and laws
  std::vector<int> law_sides;         ///< the side on which each switching law is held; empty: each chooses its own
  OwnScratch own;
  std::vector<JointFrictionEffect> friction;  ///< of friction in joints
  Sticking sticking;
  bool regular = true;  ///< false: the accelerations cannot be computed here
  bool uneven = false;  ///< inertias so different that λ and a need iterative refinement
  int permanent = 0;    ///< permanently redundant rows: implied by others in every configuration so far

  long evaluations = 0, factorizations = 0;

  Eigen::VectorXd gamma;              ///< right-hand side at acceleration level, Cq a = γ
  Eigen::VectorXd mu, g, cos_, sin_;  ///< work
};

/// Poses of the markers, C and Cq. q is the first n numbers of y.
void pose(const System&, double t, const Eigen::VectorXd& y, Equations&);
/// Speeds of the markers, Ct, κ and Ċ. After pose.
void speed(const System&, double t, const Eigen::VectorXd& y, Equations&);
/// Inertia of flexible bodies. After pose.
void update_mass(const System&, const Eigen::VectorXd& y, Equations&);
/// update_mass, inverts the inertia of flexible bodies and factors S. After pose; sets `regular`.
void factor(const System&, const Eigen::VectorXd& y, Equations&);
/// f: gravity, velocity-dependent inertia forces, force elements, contacts. After speed and update_mass.
void apply_forces(const System&, const State&, Equations&);
/// γ, the right-hand side at acceleration level: Cq a = γ. After speed.
void acceleration_side(const Equations&, Eigen::VectorXd& gamma);
/// Loads, λ, a. After speed and factor. Clears `regular` where rows contradict each other, and in a singular configuration that the speeds
/// do not lead out of.
void accelerate(const System&, const State&, Equations&);
/// a ← accelerations due to the forces a with the joints acting, λ ← the corresponding multipliers. After factor.
void respond(const System&, Equations&, Eigen::VectorXd& a, Eigen::VectorXd& lambda);
/// out += M v, n. After update_mass.
void add_mass_times(const System&, const Equations&, const Eigen::VectorXd& v, Eigen::VectorXd& out);
/// out += Cqᵀ x, x of n_rows. After pose.
void add_reaction(const Equations&, const Eigen::VectorXd& x, Eigen::VectorXd& out);
/// ẋ of an owner. After apply_forces.
const std::array<double, most_internal>& internal_rates(const Equations&, const InternalStates&);
/// ẏ = [s, a, ẋ, ż] after accelerate; ż are the powers of the energy ledger, such as the losses of contacts.
void fill_derivative(const System&, const Eigen::VectorXd& y, const Equations&, Eigen::VectorXd& dy);

/// All of the above in order, without Ċ. @returns false if the accelerations cannot be computed
bool evaluate(const System&, const State&, Equations&, Eigen::VectorXd& dy);

/// Largest |C| over the mechanism's length, and |Ċ| over its length and fastest angular rate.
double position_violation(const System&, const Equations&);
double velocity_violation(const System&, const Eigen::VectorXd& y, const Equations&);
/// Largest ratio of a speed to its scale, never 0 [1/s].
double fastest_rate(const System&, const Eigen::VectorXd& y);
/// Smallest |C|, over the mechanism's length, that the rounding of coordinates allows after many turns or far from the origin.
double angle_rounding(const System&, const Eigen::VectorXd& y);

/// Newton's iteration for q on C = 0, then s on Ċ = 0, at time t. `factor()` prepares, at a pose, what `subtract(violation, x)` needs to
/// remove a violation from x, the coordinates or the speeds in y; `subtract` returns the largest change over its scale. `factor` returns
/// false where this is impossible. Leaves pose and speed at the corrected state. Near a singular configuration, where motions branch and a
/// small violation requires a large correction, it iterates down to rounding, because the error is amplified. It does not jump to another
/// branch: it fails if Newton's method does not converge fast, and leaves the speeds unchanged if the correction would change their
/// direction.
/// @returns false if it does not converge
template <class Factor, class Subtract>
bool onto_constraints(const System& system, double t, Eigen::VectorXd& y, Equations& eq, Factor factor, Subtract subtract) {
  constexpr double still_good = 1e-8;  // it fails if rounding, after many turns, exceeds this
  const double known = angle_rounding(system, y), enough = std::max(1e-13, known), good = std::max(1e-11, std::min(8 * known, still_good));
  constexpr double contracts = 0.1;                // a jump between branches leaves at least a quarter of the violation
  constexpr double amplified = 1e3, turns = 1e-6;  // relative to the violation; to the fastest speed
  constexpr double digits = 1e-15;
  constexpr int most = 8;
  double worst = 0;
  bool near = false, last = false;
  for (int i = 0; i < most; ++i) {
    pose(system, t, y, eq);
    if (!factor()) return false;
    const double before = worst;
    worst = position_violation(system, eq);
    near = eq.schur.near_singular(eq.permanent);
    if (worst <= enough || (i > 0 && worst <= good && worst > 0.1 * before)) {
      if (last || !near || worst <= std::max(digits, known)) break;
      last = true;
    } else if (i > 0 && eq.schur.weak() && worst > contracts * before) {
      return false;
    }
    subtract(eq.C, y.data());
  }
  if (!(worst <= good)) return false;
  speed(system, t, y, eq);
  for (int i = 0; i < 2; ++i) {
    const double violation = velocity_violation(system, y, eq);  // relative to the fastest speed
    if (violation <= (near ? digits : 1e-13)) break;
    const double fastest = fastest_rate(system, y);
    const double change = subtract(eq.Cdot, y.data() + system.n());
    if (eq.schur.weak() && change > turns * fastest && change > amplified * violation * fastest) {
      eq.Cdot = -eq.Cdot;
      subtract(eq.Cdot, y.data() + system.n());
      i = 2;
    }
    speed(system, t, y, eq);
  }
  return true;
}

/// Projects q, then s, onto C = 0 and Ċ = 0 in the metric of M; leaves pose, speed and factor as for the corrected state. @returns false if
/// it does not converge
bool project(const System&, double t, Eigen::VectorXd& y, Equations&);

/// v ← n coordinates or speeds v projected onto Cq v = 0 in the metric of M. After factor.
void keep_allowed(const System&, Equations&, double* v);

/// put(column of q, [∂r_x, ∂r_y, ∂angle]) for each coordinate that moves a marker. After pose.
template <class Put>
void visit_motion(const System& system, const Equations& eq, int marker, Put put) {
  const Marker& m = system.markers[static_cast<std::size_t>(marker)];
  if (m.body == ground) return;
  const MarkerMotion& motion = eq.motion[static_cast<std::size_t>(marker)];
  put(3 * m.body, Eigen::Vector3d(1, 0, 0));
  put(3 * m.body + 1, Eigen::Vector3d(0, 1, 0));
  put(3 * m.body + 2, Eigen::Vector3d(-motion.d.y(), motion.d.x(), 1));
  const int begin = system.eta_begin[static_cast<std::size_t>(m.body)];
  for (int i = 0; i < static_cast<int>(motion.flex.cols()); ++i)
    put(begin + i, Eigen::Vector3d(motion.flex(0, i), motion.flex(1, i), m.slope[i]));
}

/// put(row, column, value) for each entry of Cq, zeros included. After pose.
template <class Put>
void visit_jacobian(const Equations& eq, Put put) {
  for (const Equations::End& end : eq.ends)
    for (int r = 0; r < end.m; ++r) {
      for (int c = 0; c < 3; ++c) put(end.row + r, end.q + c, eq.B[end.at](r, c));
      if (end.flexible < 0) continue;
      const FlexibleInertia& body = eq.flexible[static_cast<std::size_t>(end.flexible)];
      for (int c = 0; c < body.n; ++c) put(end.row + r, body.begin + c, eq.B_eta[end.at](r, c));
    }
}

/// Effect of clearance joint c in an evaluated state: that of its contact, or of its massless link. The link's normal force is that of the
/// constraint row and acts at the centres; it is negative if the link pushes: a wall would have to pull.
ContactEffect clearance_effect(const System&, const Equations&, std::size_t c);

/// Wrench of a joint at one of its ends, −L_iᵀλ.
Wrench reaction(const System&, const Equations&, std::size_t joint, std::size_t end);

/// v ← v + a marker's wrench in its body's coordinates.
void add_wrench(const System&, const Equations&, int marker, const Wrench&, Eigen::VectorXd& v);

}  // namespace pintle
