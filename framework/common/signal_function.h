#pragma once

#include <functional>

namespace pintle {

/// A function of n signals of the motion and of time: its value and, if `slope` is not nullptr, its n derivatives with respect to them.
/// Pure: the same arguments give the same result.
using SignalFunction = std::function<double(double t, const double* in, double* slope)>;

}  // namespace pintle
