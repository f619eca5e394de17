#include "meshes/squares.h"

#include <numeric>

namespace pintle {

Squares::Squares(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  for (const Box& box : boxes_) all_.extend(box);
  if (boxes_.empty()) return;
  // About as many squares as boxes, also along a line.
  const Eigen::Vector2d span = all_.sizes();
  const double count = static_cast<double>(boxes_.size());
  side_ = std::max(std::sqrt(span.x() * span.y() / count), span.maxCoeff() / count);
  if (!(side_ > 0)) side_ = 1;
  nx_ = static_cast<int>(span.x() / side_) + 1;
  ny_ = static_cast<int>(span.y() / side_) + 1;
  begin_.assign(at(0, ny_) + 1, 0);
  const auto for_each = [&](auto&& f) {
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      const auto [x0, y0] = square(boxes_[i].min());
      const auto [x1, y1] = square(boxes_[i].max());
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) f(at(x, y), static_cast<int>(i));
    }
  };
  for_each([&](std::size_t square, int) { ++begin_[square + 1]; });
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  items_.resize(begin_.back());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for_each([&](std::size_t square, int item) { items_[next[square]++] = item; });
}

}  // namespace pintle
