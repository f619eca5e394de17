#pragma once

#include <vector>

#include <Eigen/Core>

#include "eigen_layout.h"

namespace pintle {

/// A derivative by differences, with the estimated error of each entry.
struct BoundedDerivative {
  Eigen::MatrixXd value, error;
};

/// The most accurate of derivatives by central differences of distances d, 10 d, 100 d … The error due to noise of the map is proportional
/// to 1/d, that due to its curvature to d². So a change from one to the next shows both: the noise left at the longer distance is a tenth
/// of it, the curvature error at the shorter one a hundredth. Noise is random, so the error takes three times what the changes show; about
/// one case of ten still exceeds it. Changes by less than `floor` do not count as accuracy.
/// @pre there is at least one; for a single one the error is NaN
BoundedDerivative best_of_distances(const std::vector<Eigen::MatrixXd>&, double floor);

}  // namespace pintle
