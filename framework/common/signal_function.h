#pragma once

#include <functional>

namespace pintle {

/// A function of n numbers of the motion and of time: its value; where `slope` is no nullptr, its n derivatives in them too.
/// Pure: the same numbers give the same answer.
using SignalFunction = std::function<double(double t, const double* in, double* slope)>;

}  // namespace pintle
