#include "framework/report/drawn_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "framework/common/index.h"

namespace pintle {

namespace {

using Corners = std::array<int, 3>;

/// Divides cells into triangles by their corners, those of second order also by the middles of their sides.
std::vector<Corners> triangles_of(const std::vector<Cells>& all) {
  std::vector<Corners> out;
  for (const Cells& cells : all) {
    const int n = nodes_of(cells.shape), corners = corners_of(cells.shape);
    const bool middles = n >= 2 * corners;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const int* const node = cells.nodes.data() + c * at(n);
      std::vector<int> round;  // the cell's outline
      for (int k = 0; k < corners; ++k) {
        round.push_back(node[k]);
        if (middles) round.push_back(node[corners + k]);
      }
      if (!middles) {
        for (std::size_t k = 1; k + 1 < round.size(); ++k) out.push_back({round[0], round[k], round[k + 1]});
        continue;
      }
      for (std::size_t k = 0; k < round.size(); k += 2)
        out.push_back({round[k], round[k + 1], round[(k + round.size() - 1) % round.size()]});
      for (std::size_t k = 3; k + 1 < round.size(); k += 2) out.push_back({round[1], round[k], round[k + 2]});
    }
  }
  return out;
}

/// For each point, the first point found in the same square of a grid.
std::vector<int> first_in_square(const Eigen::Matrix2Xd& x, double width) {
  std::map<std::pair<long, long>, int> first;
  std::vector<int> out;
  for (int p = 0; p < x.cols(); ++p) {
    const std::pair square(std::lround(x(0, p) / width), std::lround(x(1, p) / width));
    out.push_back(first.try_emplace(square, p).first->second);
  }
  return out;
}

std::size_t distinct(std::vector<int> x) {
  std::ranges::sort(x);
  return static_cast<std::size_t>(std::unique(x.begin(), x.end()) - x.begin());
}

std::vector<std::array<int, 2>> rim_of(const std::vector<Corners>& triangles) {
  std::map<std::array<int, 2>, int> sides;
  for (const Corners& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(t[k], t[(k + 1) % 3]);
      ++sides[{a, b}];
    }
  std::vector<std::array<int, 2>> out;
  for (const auto& [side, count] : sides)
    if (count == 1) out.push_back(side);
  return out;
}

/// Merges coinciding points: ribbons of beams have separate points where they meet.
void join_coinciding(const Eigen::Matrix2Xd& x, double size, std::vector<int>& stands_for) {
  const std::vector<int> same = first_in_square(x, 1e-9 * size);
  for (int& p : stands_for) p = same[at(p)];
}

}  // namespace

DrawnMesh drawn_mesh(const Eigen::Matrix2Xd& x, const std::vector<Cells>& cells, double size, std::size_t most) {
  std::vector<int> stands_for(at(x.cols()));
  for (std::size_t p = 0; p < stands_for.size(); ++p) stands_for[p] = static_cast<int>(p);
  join_coinciding(x, size, stands_for);
  for (double width = size / 1000; distinct(stands_for) > most; width *= 1.3) stands_for = first_in_square(x, width);

  DrawnMesh out;
  std::map<int, int> number;
  const auto numbered = [&](int point) {
    const auto [at_it, is_new] = number.try_emplace(stands_for[at(point)], static_cast<int>(out.points.size()));
    if (is_new) out.points.push_back(at_it->first);
    return at_it->second;
  };
  for (const Corners& t : triangles_of(cells)) {
    const Corners drawn{numbered(t[0]), numbered(t[1]), numbered(t[2])};
    if (drawn[0] != drawn[1] && drawn[1] != drawn[2] && drawn[2] != drawn[0]) out.triangles.push_back(drawn);
  }
  out.rim = rim_of(out.triangles);
  return out;
}

}  // namespace pintle
