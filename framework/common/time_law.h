#pragma once

#include <functional>

namespace pintle {

/// A value with its first and second derivative in time; [u], [u/s], [u/s²].
struct Jet {
  double value = 0, rate = 0, accel = 0;
};

/// A law of time for a driver or a load. Pure: the same t gives the same jet. Drivers use all three numbers (C, C_t and C_tt), loads only
/// the value.
using TimeLaw = std::function<Jet(double t)>;

}  // namespace pintle
