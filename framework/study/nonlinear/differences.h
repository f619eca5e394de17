#pragma once

#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// A derivative by differences, and how far each of its entries may be off.
struct BoundedDerivative {
  Eigen::MatrixXd value, error;
};

/// The most accurate of derivatives by central differences of distances d, 10 d, 100 d … Noise of the map that is differentiated enters as
/// 1/d, its curvature as d². So a change from one to the next bounds both: the noise left at the longer distance is a tenth of it, the
/// curvature at the shorter one a hundredth. Changes by less than `floor` do not count as accuracy.
/// @pre there is one; of a single one the error is NaN
BoundedDerivative best_of_distances(const std::vector<Eigen::MatrixXd>&, double floor);

}  // namespace pintle
