#include "framework/dynamics/model/signal_values.h"

#include <array>

#include "framework/common/index.h"
#include "framework/dynamics/model/marker_motion.h"

namespace pintle {

double signal_at(const System& system, const MotionSignal& signal, const Eigen::VectorXd& y) {
  if (signal.kind == MotionSignal::state) return y[own_state(system, signal.a)] - signal.offset;
  const MovingPoint a = moving_point(system, signal.a, y);
  return signal_value(signal, a, of_two(signal.kind) ? moving_point(system, signal.b, y) : a);
}

void start_own_states(const System& system, Eigen::VectorXd& y) {
  for (std::size_t i = 0; i < system.states.size(); ++i) y[own_state(system, static_cast<int>(i))] = system.states[i].start;
}

double law_at(const System& system, const SignalLaw& law, double t, const Eigen::VectorXd& y) {
  std::array<double, most_law_inputs> in;
  for (std::size_t k = 0; k < law.in.size(); ++k) in[k] = signal_at(system, system.signals[at(law.in[k])], y);
  return law.of(t, in.data(), nullptr);
}

}  // namespace pintle
