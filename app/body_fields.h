#pragma once

#include <limits>
#include <string>

#include "framework/drawing/vtk.h"

namespace pintle {

/// Range of a field over all bodies of a frame that have it.
struct FieldRange {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  /// Position of a value in the range, 0 to 1.
  double share(double value) const { return greatest > least ? (value - least) / (greatest - least) : 0; }
};

/// Values of a field at a body's points, for vectors their magnitude; empty if it has no such field.
Eigen::RowVectorXd values(const DrawnBody&, const std::string& field);

/// @throws std::invalid_argument  no body has such a field (lists the existing ones)
FieldRange range_of(const Drawing&, const std::string& field);

}  // namespace pintle
