#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "eigen_layout.h"

namespace pintle {

/// Boxes sorted into the squares of a grid, so that those near a point are found without checking all of them.
class Squares {
 public:
  using Box = Eigen::AlignedBox2d;
  explicit Squares(std::vector<Box> boxes);
  /// Calls f(i) once for each box i that meets `box`, in arbitrary order.
  template <class F>
  void each(const Box& box, F&& f) const {
    if (boxes_.empty() || !all_.intersects(box)) return;
    const auto [x0, y0] = square(box.min());
    const auto [x1, y1] = square(box.max());
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x)
        for (std::size_t k = begin_[at(x, y)]; k < begin_[at(x, y) + 1]; ++k) {
          const Box& other = boxes_[static_cast<std::size_t>(items_[k])];
          if (!other.intersects(box)) continue;
          // A box in several squares is handled in the first of those that both share.
          const auto first = square(other.min().cwiseMax(box.min()));
          if (first == std::pair{x, y}) f(items_[k]);
        }
  }

 private:
  std::size_t at(int x, int y) const { return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(x); }
  std::pair<int, int> square(const Eigen::Vector2d& p) const {
    const auto index = [](double value, int n) { return std::clamp(static_cast<int>(std::clamp(value, 0.0, 1e9)), 0, n - 1); };
    return {index((p.x() - all_.min().x()) / side_, nx_), index((p.y() - all_.min().y()) / side_, ny_)};
  }

  std::vector<Box> boxes_;
  Box all_;
  double side_ = 1;
  int nx_ = 1, ny_ = 1;
  std::vector<std::size_t> begin_;
  std::vector<int> items_;
};

}  // namespace pintle
