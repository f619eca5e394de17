#pragma once

#include "framework/dynamics/model/system.h"

namespace pintle {

/// Own state i of the scene stands at y[own_state(system, i)].
inline int own_state(const System& system, int i) { return system.x_begin() + system.own_x + i; }

/// y's own states ← as they start.
void start_own_states(const System&, Eigen::VectorXd& y);

/// A signal, and a law of signals, in any state. Allocate nothing; a law that is one of the system's need not be among its laws.
double signal_at(const System&, const MotionSignal&, const Eigen::VectorXd& y);
double law_at(const System&, const SignalLaw&, double t, const Eigen::VectorXd& y);

}  // namespace pintle
