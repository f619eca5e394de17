#pragma once

#include <complex>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"
#include "framework/analysis/linearize/small_motion.h"
#include "framework/configuration/assemble.h"

namespace pintle {

/// How the coefficients of a small motion change along the reference motion.
enum class Coefficients {
  constant,  ///< constant in the world's axes
  turning,   ///< constant in axes that rotate steadily about the world's origin
  frozen     ///< they change; given for the instant, in the world's axes
};

/// x' = A x + B u,  y = C x + D u. x: independent coordinates, then their rates, then internal states; u: loads, and for each driver an
/// offset of its law with its first and second rate; all as deviations from the motion.
struct StateSpace {
  Eigen::MatrixXd A, B, C, D;
  std::vector<std::string> states, inputs, outputs;  ///< "name [unit]"
};

/// A clearance joint in the small motion.
struct LinearContact {
  std::string name;
  bool closed;                ///< an open one contributes nothing
  double depth, force;        ///< at the state [m], [N]
  double stiffness, damping;  ///< ∂force/∂depth [N/m], ∂force/∂rate [N s/m], at the latched approach speed
  double impact_rate;         ///< that speed [m/s]
  std::size_t pair;           ///< its index in System::contacts
};

/// A solution  q = shape exp(root t)  of the small motion; of an oscillating pair the root with positive
/// imaginary part.
struct LinearMode {
  enum class Kind { oscillating, decaying, growing, zero } kind = Kind::oscillating;
  std::complex<double> root;  ///< [1/s]; exactly 0 for a zero mode
  double uncertainty = 0;     ///< of the root, from rounding of the coefficients and their remaining change [1/s]
  int roots = 2;              ///< number of roots that it represents
  Eigen::VectorXcd shape;     ///< n; normalised so that the coordinate that moves most, relative to its scale, is 1 · its scale
  std::string carrier;        ///< the coordinate that moves most in the body with the greatest kinetic energy
  double share = 0;           ///< share of that body in the kinetic energy

  double frequency() const;  ///< |Im root|/2π [Hz]
  double natural() const;    ///< |root|/2π [Hz]
  double damping() const;    ///< −Re root/|root|; 0 for a zero mode
};
const char* kind_text(LinearMode::Kind);

/// Complete result of a linearisation. Theory: docs/theory/linearisation.md.
struct Linearization {
  State about;
  Coefficients coefficients = Coefficients::constant;
  double turn = 0;               ///< rotation rate of the axes of the coordinates [rad/s]
  double drift = 0;              ///< largest relative change of a coefficient while the motion continues for …
  double window = 0;             ///< … [s]; 0 at rest, where nothing changes
  std::vector<int> independent;  ///< indices into q
  SmallMotion motion;            ///< the equations of p
  Eigen::MatrixXd Z;             ///< δq = Z p, n × m
  StateSpace space;
  std::vector<LinearMode> modes;  ///< by size of the root, zero modes first
  std::vector<LinearContact> contacts;
  std::vector<std::string> coordinates;  ///< "name [unit]" of each of q
  std::vector<std::string> notes;        ///< remarks for the reader, in words
};

/// Whether laws of drivers and loads continue in time, or are held at their values at the state's instant.
enum class Laws { go_on, hold };

/// Largest number of coordinates for a linearisation; all matrices are dense.
inline constexpr int most_linearized = 1500;

/// The small motion about a state that satisfies the constraints, as the mechanism moves there.
/// @throws SceneError     more than `most_linearized` coordinates
/// @throws AssemblyError  a singular configuration, or unconstrained motion without mass
Linearization linearize(const Scene&, const Model&, const State&, Laws = Laws::go_on);

/// The state to linearise about. Flexible bodies start undeformed; where drivers rotate the mechanism steadily, they are deformed here to
/// their equilibrium in the rotating axes. Otherwise it is the assembled start. `note` says which, and what deformation is left out; empty
/// where no body bends or nothing moves.
struct LinearizedStart {
  State state;
  std::string note;
};
LinearizedStart linearized_start(const Scene&, const Model&, const Assembly&);

/// The state that a run reaches. @throws std::runtime_error  saying when and why the run failed
State state_at(const Model&, const State& start, double t);

/// linearized.csv, shapes.csv and mode_motions.csv (of the first `shapes` modes), A.csv, B.csv, C.csv, D.csv, linearized.json.
/// @throws std::runtime_error  naming the path that cannot be written
void write_linearization(const std::filesystem::path& directory, const Scene&, const Model&, const Linearization&, int shapes);
std::string linearized_json(const Scene&, const Linearization&);

/// The mechanism displaced along a mode at a phase of its period, such that its largest coordinate moves by a tenth of the mechanism's
/// length or by 0.1 rad; joints are kept closed where possible. @returns its state, contacts open
State displaced(const Model&, const Linearization&, const LinearMode&, double phase);

}  // namespace pintle
