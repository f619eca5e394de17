#pragma once

namespace pintle {

/// A law of signals in smooth pieces. Each of its switches (comparisons, kinks and marks of tables) is on one side, an integer. For given
/// sides the law is smooth, also beyond the end of a side, until that side is changed.
class SidedLaw {
 public:
  virtual ~SidedLaw() = default;
  virtual int switches() const = 0;
  /// Steps must end exactly where it switches; otherwise only near it, so that no step passes more than one side.
  virtual bool exact(int k) const = 0;
  /// As a SignalFunction, for the given sides.
  virtual double value(double t, const double* in, double* slope, const int* side) const = 0;
  /// Distance of each switch from the end of its side: negative beyond it. @param left  of `switches()` numbers
  virtual void left(double t, const double* in, const int* side, double* left) const = 0;
  /// The present sides, for a law whose sides are not held.
  virtual void find(double t, const double* in, int* side) const = 0;
  /// The side adjacent to that of switch k, at whose end it is.
  virtual int beyond(int k, double t, const double* in, const int* side) const = 0;
};

}  // namespace pintle
