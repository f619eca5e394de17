#pragma once

#include <limits>
#include <string>

#include "framework/drawing/vtk.h"

namespace pintle {

/// Of a field, over all bodies of a frame that have it.
struct FieldRange {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  /// Where a value lies between the two, 0 to 1.
  double share(double value) const { return greatest > least ? (value - least) / (greatest - least) : 0; }
};

/// Values of a field at a body's points, vectors by their length; empty if it has no such field.
Eigen::RowVectorXd values(const DrawnBody&, const std::string& field);

/// @throws std::invalid_argument  no body has such a field (those they have)
FieldRange range_of(const Drawing&, const std::string& field);

}  // namespace pintle
