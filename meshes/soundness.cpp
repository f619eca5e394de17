#include "meshes/soundness.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

#include "meshes/cell_sides.h"
#include "meshes/squares.h"

namespace pintle {

namespace {

using Box = Squares::Box;
using Eigen::Vector2d;

constexpr double nearness = 1e-6;  ///< relative to a side's length: a nearer point is on it
constexpr double doubtful = 1e-3;  ///< nearer points are suspicious

std::size_t index(int i) { return static_cast<std::size_t>(i); }

struct Check {
  const Mesh& mesh;
  std::vector<CellView> cells = cell_views(mesh);
  std::vector<SideView> rim{};  ///< sides of a single cell
  Soundness found{};

  std::string place(const Vector2d& p) const {
    std::ostringstream s;
    s << "(" << p.x() << ", " << p.y() << ") m";
    return s.str();
  }
  Vector2d at(int node) const { return mesh.x.col(node); }
  std::string node(int i) const { return std::to_string(mesh.node_numbers[index(i)]); }
  std::string nodes(int a, int b) const { return node(a) + " and " + node(b); }
  std::string cell(int c) const { return "cell " + std::to_string(cells[index(c)].number) + " (" + name_of(cells[index(c)].shape) + ")"; }
  double length(const SideView& s) const { return (at(s.a) - at(s.b)).norm(); }
  /// "; 3 in all" if there is more than one.
  static std::string in_all(std::size_t count) { return count > 1 ? "; there are " + std::to_string(count) + " such places" : ""; }

  std::vector<int> corners(int c) const {
    const CellView& view = cells[index(c)];
    std::vector<int> out(view.nodes, view.nodes + corners_of(view.shape));
    std::sort(out.begin(), out.end());
    return out;
  }

  // Sides between the same two corners: a single one is on the rim, two belong to neighbours and have opposite directions.
  void meetings() {
    const std::vector<SideView> sides = paired_sides(cells);
    std::set<std::pair<int, int>> twice, stacked;
    std::vector<std::pair<SideView, SideView>> cracked;
    std::vector<std::array<SideView, 3>> crowded;
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
      const SideView& s = sides[i];
      for (end = i + 1; end < sides.size() && std::minmax(sides[end].a, sides[end].b) == std::minmax(s.a, s.b);) ++end;
      if (end == i + 1) rim.push_back(s);
      bool one_way = false;
      for (std::size_t p = i; p < end; ++p)
        for (std::size_t q = p + 1; q < end; ++q) {
          if (sides[p].a != sides[q].a) continue;
          one_way = true;
          const std::pair cells_here{sides[p].cell, sides[q].cell};
          (corners(sides[p].cell) == corners(sides[q].cell) ? twice : stacked).insert(cells_here);
        }
      if (end > i + 2 && !one_way) crowded.push_back({sides[i], sides[i + 1], sides[i + 2]});
      if (end == i + 2 && !one_way && s.middle != sides[i + 1].middle) cracked.emplace_back(s, sides[i + 1]);
    }
    std::sort(rim.begin(), rim.end(), [](const SideView& p, const SideView& q) { return p.cell < q.cell; });
    if (!twice.empty()) {
      const auto [a, b] = *twice.begin();
      found.faults.push_back("cells " + std::to_string(cells[index(a)].number) + " and " + std::to_string(cells[index(b)].number) +
                             " have the same corners, near " + place(at(cells[index(a)].nodes[0])) + ": the material there counts twice" +
                             in_all(twice.size()) +
                             "; remove one of each pair (a .msh of version 2 writes a surface once for each of its physical groups)");
    } else if (!stacked.empty()) {
      const auto [a, b] = *stacked.begin();
      found.faults.push_back(cell(a) + " and " + cell(b) + " lie on the same side of a side that they share, near " +
                             place(at(cells[index(a)].nodes[0])) + ": they overlap" + in_all(stacked.size()) + "; correct their nodes");
    }
    if (!crowded.empty()) {
      const auto& [a, b, c] = crowded.front();
      found.faults.push_back("more than two cells meet at the side between nodes " + nodes(a.a, a.b) + ", near " + place(at(a.a)) + ": " +
                             cell(a.cell) + ", " + cell(b.cell) + " and " + cell(c.cell) + in_all(crowded.size()) +
                             "; remove the extra cells");
    }
    if (!cracked.empty()) {
      const auto& [a, b] = cracked.front();
      const auto middle = [&](const SideView& s) {
        return s.middle < 0 ? std::string("no middle node") : "the middle node " + node(s.middle);
      };
      found.faults.push_back(cell(a.cell) + " and " + cell(b.cell) + " share the side between nodes " + nodes(a.a, a.b) + ", near " +
                             place(at(a.a)) + ", but one has " + middle(a) + " there and the other " + middle(b) +
                             ": the side opens under load" + in_all(cracked.size()) +
                             "; mesh both with cells of the same order and shared nodes");
    }
  }

  // A node that is in the middle of one cell's side and at a corner of others: two short sides along a long one.
  void corners_in_middles() {
    std::vector<int> corner_of(index(static_cast<int>(mesh.x.cols())), -1);
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (int k = 0; k < corners_of(cells[c].shape); ++k) corner_of[index(cells[c].nodes[k])] = static_cast<int>(c);
    std::size_t count = 0;
    std::string first;
    for (std::size_t c = 0; c < cells.size(); ++c)
      for (int k = corners_of(cells[c].shape); k < nodes_of(cells[c].shape); ++k) {
        const int n = cells[c].nodes[k];
        if (corner_of[index(n)] < 0) continue;
        if (++count == 1)
          first = "node " + node(n) + " at " + place(at(n)) + " is in the middle of a side of " + cell(static_cast<int>(c)) +
                  ", but a corner of " + cell(corner_of[index(n)]);
      }
    if (count > 0)
      found.faults.push_back(first + ": the side opens under load" + in_all(count) +
                             "; mesh both with cells of the same order, side to side");
  }

  Squares rim_squares() const {
    std::vector<Box> boxes;
    for (const SideView& s : rim) {
      Box box(at(s.a).cwiseMin(at(s.b)), at(s.a).cwiseMax(at(s.b)));
      if (s.middle >= 0) box.extend(at(s.middle));
      boxes.push_back(inflated(box, 0.15 * (s.middle >= 0) + doubtful));  // a parabola may leave the box of its nodes
    }
    return Squares(std::move(boxes));
  }
  static Box inflated(const Box& box, double part) {
    const Vector2d by = Vector2d::Constant(part * box.diagonal().norm());
    return Box(box.min() - by, box.max() + by);
  }

  std::vector<int> rim_nodes() const {
    std::vector<int> out;
    for (const SideView& s : rim) {
      out.insert(out.end(), {s.a, s.b});
      if (s.middle >= 0) out.push_back(s.middle);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  bool has(int c, int n) const {
    const CellView& view = cells[index(c)];
    return std::find(view.nodes, view.nodes + nodes_of(view.shape), n) != view.nodes + nodes_of(view.shape);
  }

  // Nodes of the rim that coincide with another node, or lie on a side to which they do not belong.
  void strangers() {
    struct Hanging {
      int node, side;
    };
    std::vector<Hanging> hanging, near;
    std::vector<std::pair<int, int>> pairs;
    const Squares squares = rim_squares();
    for (const int n : rim_nodes())
      squares.each(Box(at(n), at(n)), [&](int k) {
        const SideView& s = rim[index(k)];
        if (n == s.a || n == s.b || n == s.middle) return;
        for (const int other : {s.a, s.b, s.middle})
          if (other >= 0 && (at(other) - at(n)).norm() <= doubtful * length(s)) {
            pairs.push_back(std::minmax(n, other));
            return;
          }
        double t = 0;
        const double gap = distance(mesh, s, at(n), t);
        if (has(s.cell, n) || gap > doubtful * length(s)) return;
        if (gap <= nearness * length(s))
          hanging.push_back({n, k});
        else if (beyond(s, t, at(n)))
          near.push_back({n, k});
      });
    const auto first = [](const Hanging& p, const Hanging& q) { return std::pair(p.node, p.side) < std::pair(q.node, q.side); };
    std::sort(hanging.begin(), hanging.end(), first);
    std::sort(near.begin(), near.end(), first);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    const auto described = [&](const Hanging& h) {
      const SideView& s = rim[index(h.side)];
      return "node " + node(h.node) + " at " + place(at(h.node)) + " lies on the side between nodes " + nodes(s.a, s.b) + " of " +
             cell(s.cell);
    };
    if (!hanging.empty())
      found.faults.push_back(described(hanging.front()) + " but is not a node of that cell: the side opens under load" +
                             in_all(hanging.size()) + "; mesh so that cells meet side to side");
    else if (!near.empty())
      found.warnings_of.push_back(described(near.front()) + ", within a thousandth of its length, but is not joined to it" +
                                  in_all(near.size()) + "; if the cells should be joined there, mesh so that they meet side to side");
    slits(pairs);
  }

  // Whether p is to the right of the side, outside its cell.
  bool beyond(const SideView& s, double t, const Vector2d& p) const {
    const double h = 1e-3, low = std::max(0.0, t - h), high = std::min(1.0, t + h);
    const Vector2d along = on_side(mesh, s, high) - on_side(mesh, s, low), off = p - on_side(mesh, s, t);
    return along.x() * off.y() - along.y() * off.x() < 0;
  }

  void slits(const std::vector<std::pair<int, int>>& pairs) {
    if (pairs.empty()) return;
    std::vector<int> same(index(static_cast<int>(mesh.x.cols())));
    std::iota(same.begin(), same.end(), 0);
    for (const auto& [low, high] : pairs) same[index(high)] = std::min(same[index(high)], same[index(low)]);
    std::map<std::pair<int, int>, std::vector<int>> on;  // sides between the same points
    for (std::size_t k = 0; k < rim.size(); ++k)
      on[std::minmax(same[index(rim[k].a)], same[index(rim[k].b)])].push_back(static_cast<int>(k));
    std::vector<std::pair<int, int>> shut;
    for (const auto& [ends, sides] : on)
      if (sides.size() > 1) shut.emplace_back(sides[0], sides[1]);
    std::sort(shut.begin(), shut.end());
    const auto& [a, b] = pairs.front();
    std::string text;
    if (shut.empty()) {
      text = "nodes " + nodes(a, b) + " both lie at " + place(at(a)) + " and are not joined";
    } else {
      const SideView &p = rim[index(shut.front().first)], &q = rim[index(shut.front().second)];
      text = "sides of " + cell(p.cell) + " and " + cell(q.cell) + " lie on each other near " + place(at(p.a)) + ", from nodes " +
             nodes(p.a, p.b) + " and from nodes " + nodes(q.a, q.b) + ", and are not joined: the body has a slit there";
    }
    found.warnings_of.push_back(text + in_all(std::max(pairs.size(), shut.size())) +
                                "; merge nodes at the same position, unless a crack is intended");
  }

  // Corners where more than two sides of the rim end: cells can rotate about them.
  void hinges() {
    std::vector<int> ends(index(static_cast<int>(mesh.x.cols())), 0);
    for (const SideView& s : rim) ++ends[index(s.a)], ++ends[index(s.b)];
    std::size_t count = 0;
    int first = -1;
    for (std::size_t n = 0; n < ends.size(); ++n)
      if (ends[n] > 2 && count++ == 0) first = static_cast<int>(n);
    if (count > 0)
      found.warnings_of.push_back("at node " + node(first) + ", " + place(at(first)) +
                                  ", cells share only this node and can turn about it like a hinge" + in_all(count) +
                                  "; join them along a side");
  }

  // Crossing a side of the rim changes the number of cells covering a point by one. So any doubly covered region has such a side on its
  // boundary, and slightly to the left of it there are two cells.
  void overlaps() {
    std::vector<Box> boxes;
    for (const CellView& view : cells) {
      Box box;
      for (int k = 0; k < nodes_of(view.shape); ++k) box.extend(at(view.nodes[k]));
      boxes.push_back(nodes_of(view.shape) > corners_of(view.shape) ? inflated(box, 0.15) : box);
    }
    const Squares squares(std::move(boxes));
    std::map<std::pair<int, int>, Vector2d> over;
    for (const SideView& s : rim) {
      const CellView& own = cells[index(s.cell)];
      Vector2d middle = Vector2d::Zero();
      for (int k = 0; k < corners_of(own.shape); ++k) middle += at(own.nodes[k]) / corners_of(own.shape);
      for (const double t : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        const Vector2d p = on_side(mesh, s, t) * 0.95 + middle * 0.05;
        if (!covers(mesh, own, p)) continue;
        squares.each(Box(p, p), [&](int c) {
          if (c != s.cell && covers(mesh, cells[index(c)], p)) over.try_emplace(std::minmax(c, s.cell), p);
        });
      }
    }
    if (over.empty()) return;
    const auto& [pair, p] = *over.begin();
    found.faults.push_back(cell(pair.first) + " and " + cell(pair.second) + " overlap at " + place(p) +
                           ": the material there counts twice" + in_all(over.size()) + "; remove one of them, or correct their nodes");
  }
};

}  // namespace

Soundness soundness(const Mesh& mesh) {
  Check check{mesh};
  check.meetings();
  if (check.found.faults.empty()) check.overlaps();
  check.corners_in_middles();
  if (!check.found.faults.empty()) return check.found;
  check.strangers();
  check.hinges();
  return check.found;
}

std::optional<std::pair<int, int>> unjoined(const Mesh& mesh, const std::vector<int>& piece) {
  if (mesh.x.cols() == 0) return {};
  const double size = (mesh.x.rowwise().maxCoeff() - mesh.x.rowwise().minCoeff()).norm();
  const double near = nearness * size / std::sqrt(static_cast<double>(mesh.x.cols()));
  std::vector<Box> boxes;
  for (Eigen::Index i = 0; i < mesh.x.cols(); ++i) boxes.emplace_back(mesh.x.col(i).array() - near, mesh.x.col(i).array() + near);
  const Squares squares(boxes);
  std::optional<std::pair<int, int>> found;
  for (int i = 0; i < mesh.x.cols() && !found; ++i)
    squares.each(Box(mesh.x.col(i), mesh.x.col(i)), [&](int k) {
      if (piece[index(k)] != piece[index(i)]) found = std::minmax(i, k);
    });
  return found;
}

}  // namespace pintle
