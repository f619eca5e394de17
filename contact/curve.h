#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// A point of a curve with the material to its left.
struct CurvePoint {
  Eigen::Vector2d at;                                                 ///< [m]
  Eigen::Vector2d along;                                              ///< unit vector in the direction of the curve
  double curvature;                                                   ///< > 0 turning left: the surface is round; < 0: hollow [1/m]
  double speed;                                                       ///< d(length)/d(parameter), –
  Eigen::Vector2d normal() const { return {along.y(), -along.x()}; }  ///< out of the material
};

/// The cubic spline through points, with continuous curvature; its parameter is the length of the chords [m]. A closed one is periodic; an
/// open one has no knot at its second and last but one points. With points h apart, its error relative to a smooth curve is O(h⁴), that of
/// its direction O(h³), of its curvature O(h²): de Boor, A Practical Guide to Splines (1978), ch. V.
class SmoothCurve {
 public:
  /// @pre three points or more, four or more for an open curve; neighbouring points differ
  SmoothCurve(std::vector<Eigen::Vector2d> points, bool closed);
  /// @param s  from 0 to length() [m]
  CurvePoint at(double s) const;
  double length() const { return knots_.back(); }              ///< of all chords [m]
  const std::vector<double>& knots() const { return knots_; }  ///< the parameter at each point, for a closed curve also at its end
  const std::vector<Eigen::Vector2d>& points() const { return points_; }
  /// Parameters at which the curvature changes its sign, in rising order.
  std::vector<double> inflections() const;

 private:
  struct Cubic {
    Eigen::Vector2d p, d, m, j;  ///< p + d t + m t²/2 + j t³/6
  };
  std::vector<Eigen::Vector2d> points_;
  std::vector<double> knots_;
  std::vector<Cubic> cubics_;
};

/// A part of a curve that bends in one direction and turns by at most an eighth of a turn. Beyond its ends it continues along the circles
/// of curvature there by at most another eighth, and then straight.
class CurveSpan {
 public:
  CurveSpan(std::shared_ptr<const SmoothCurve>, double begin, double end);
  CurvePoint at(double s) const;  ///< for any parameter
  double begin() const { return begin_; }
  double end() const { return end_; }
  double first_bend() const { return first_bend_; }                     ///< parameter before which it is straight [m]
  double last_bend() const { return last_bend_; }                       ///< … and after which [m]
  double turn() const { return turn_; }                                 ///< to the left, from begin to end [rad]
  double least_radius() const { return least_radius_; }                 ///< least radius of curvature, at most the curve's length [m]
  const std::vector<double>& knots() const { return curve_->knots(); }  ///< of the complete curve
  /// All numbers that define it.
  std::vector<double> numbers() const;

 private:
  CurvePoint beyond(const CurvePoint& end, double past, double bends_until) const;
  std::shared_ptr<const SmoothCurve> curve_;
  double begin_, end_, first_bend_ = 0, last_bend_ = 0, turn_ = 0, least_radius_ = 0;
  CurvePoint at_begin_, at_end_;
};

/// The complete curve divided into spans, in order.
std::vector<CurveSpan> spans_of(const std::shared_ptr<const SmoothCurve>&);

}  // namespace pintle
