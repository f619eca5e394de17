// Grassberger and Procaccia's dimension of sets whose dimension is known.
#include "framework/study/nonlinear/dimension.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace pintle {
namespace {

using Points = std::vector<std::vector<double>>;
constexpr double same = 1e-6;

/// Even numbers from 0 to 1, alike on all machines.
class Even {
 public:
  double operator()() { return static_cast<double>(engine_()) / 4294967296.0; }

 private:
  std::mt19937 engine_{1};
};

// Of n coordinates C is (2r - r^2)^n: at C = 0.02 the slope of ln C over ln r is n(1 - r)/(1 - r/2), 0.99 on a line and 1.92 in a square,
// and nearer to n below. 2000 points have 2000 pairs at C = 0.001, known to 5 %: 0.05/ln 20 of the slope.
TEST(CorrelationDimension, IsOneOnALineAndTwoInASquare) {
  Even even;
  Points line, square;
  for (int k = 0; k < 2000; ++k) {
    const double x = even();
    line.push_back({x, 3 - 2 * x});
    square.push_back({x, 7 * even()});
  }
  EXPECT_NEAR(correlation_dimension(line, same), 1, 0.01 + 0.05);
  EXPECT_NEAR(correlation_dimension(square, same), 2, 0.08 + 0.1);
}

// 1.21 (Grassberger and Procaccia 1983); its slope swings over r by some 0.05.
TEST(CorrelationDimension, IsThatOfHenonsMap) {
  Points points;
  double x = 0, y = 0.9;
  for (int k = 0; k < 2100; ++k) {
    const double next = 1 - 1.4 * x * x + 0.3 * y;
    y = x, x = next;
    if (k >= 100) points.push_back({x, y});
  }
  EXPECT_NEAR(correlation_dimension(points, same), 1.21, 0.1);
}

TEST(CorrelationDimension, IsZeroOfWhatComesAgain) {
  Points still(600, {1.0, -2.0}), four, settling;
  for (int k = 0; k < 600; ++k) {
    four.push_back({std::cos(k * std::acos(0.0)), 1});
    settling.push_back({1 + 1e-8 * std::exp(-0.01 * k), 1});
  }
  EXPECT_EQ(correlation_dimension(still, same), 0);
  EXPECT_EQ(correlation_dimension(four, same), 0);
  EXPECT_EQ(correlation_dimension(settling, same), 0);
}

// Points along a slow line lie near those before and after them; without these a square walked slowly through is a square.
TEST(CorrelationDimension, DoesNotCountNeighboursInTime) {
  Even even;
  Points walked;
  for (int k = 0; k < 200; ++k) {
    const double x = even(), y = even();
    for (int j = 0; j < 10; ++j) walked.push_back({x + 1e-5 * j, y});
  }
  EXPECT_GT(correlation_dimension(walked, same), 1.5);
}

TEST(CorrelationDimension, IsNotToldOfFewReturns) {
  EXPECT_TRUE(std::isnan(correlation_dimension(Points(least_of_dimension - 1, {1.0}), same)));
  EXPECT_EQ(correlation_dimension(Points(least_of_dimension, {1.0}), same), 0);
}

}  // namespace
}  // namespace pintle
