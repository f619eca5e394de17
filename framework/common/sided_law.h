#pragma once

namespace pintle {

/// A law of signals in smooth pieces. Each of its switches, which are its comparisons, its kinks and the marks of its tables, is on one
/// side, a whole number; given these the law is smooth, and goes on so past the end of a side until that is changed.
class SidedLaw {
 public:
  virtual ~SidedLaw() = default;
  virtual int switches() const = 0;
  /// Steps end where it switches; else they need only come near, so that none passes more than one side.
  virtual bool exact(int k) const = 0;
  /// As a SignalFunction, on the sides given.
  virtual double value(double t, const double* in, double* slope, const int* side) const = 0;
  /// How far each switch is from the end of its side: below 0 past it. @param left  of `switches()` numbers
  virtual void left(double t, const double* in, const int* side, double* left) const = 0;
  /// The sides on which a law without sides finds itself.
  virtual void find(double t, const double* in, int* side) const = 0;
  /// The side next to that of switch k, where it is at its end.
  virtual int beyond(int k, double t, const double* in, const int* side) const = 0;
};

}  // namespace pintle
