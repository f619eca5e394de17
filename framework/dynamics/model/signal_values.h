#pragma once

#include "framework/dynamics/model/system.h"

namespace pintle {

/// Index in y of own state i of the scene.
inline int own_state(const System& system, int i) { return system.x_begin() + system.own_x + i; }

/// Sets the own states in y to their start values.
void start_own_states(const System&, Eigen::VectorXd& y);

/// A signal, and a law of signals, in any state. No allocation; the law need not be in System::laws.
double signal_at(const System&, const MotionSignal&, const Eigen::VectorXd& y);
double law_at(const System&, const SignalLaw&, double t, const Eigen::VectorXd& y);

}  // namespace pintle
