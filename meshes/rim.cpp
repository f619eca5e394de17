#include "meshes/rim.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace pintle {

namespace {

using Eigen::Vector2d;

/// A closed loop of sides, with the body to their left.
struct Chain {
  std::vector<int> sides;
  double area = 0;  // negative: around a hole
  Vector2d center = Vector2d::Zero();
};

struct Ends {
  int a, b;
};

std::vector<Ends> ends_of(const std::vector<Cells>& cells) {
  std::vector<Ends> ends;
  for (const Cells& c : cells) {
    const std::size_t n = static_cast<std::size_t>(nodes_of(c.shape));
    for (std::size_t s = 0; s < c.size(); ++s) ends.push_back({c.nodes[s * n], c.nodes[s * n + 1]});
  }
  return ends;
}

void measure(const Mesh& mesh, const std::vector<Ends>& ends, Chain& chain) {
  const Vector2d origin = mesh.x.col(ends[static_cast<std::size_t>(chain.sides[0])].a);
  Vector2d moment = Vector2d::Zero();
  for (const int side : chain.sides) {
    const Ends& e = ends[static_cast<std::size_t>(side)];
    const Vector2d p = mesh.x.col(e.a) - origin, q = mesh.x.col(e.b) - origin;
    const double twice = p.x() * q.y() - p.y() * q.x();
    chain.area += twice / 2;
    moment += twice / 6 * (p + q);
  }
  chain.center = origin + moment / chain.area;
}

std::vector<Chain> chains(const Mesh& mesh, const std::vector<Ends>& ends) {
  std::vector<std::pair<int, int>> leaving;  // node, side
  for (std::size_t s = 0; s < ends.size(); ++s) leaving.emplace_back(ends[s].a, static_cast<int>(s));
  std::sort(leaving.begin(), leaving.end());
  std::vector<char> used(ends.size(), 0);
  std::vector<Chain> out;
  for (std::size_t start = 0; start < ends.size(); ++start) {
    if (used[start]) continue;
    Chain chain;
    for (int side = static_cast<int>(start); side >= 0;) {
      used[static_cast<std::size_t>(side)] = 1;
      chain.sides.push_back(side);
      const int node = ends[static_cast<std::size_t>(side)].b;
      side = -1;
      for (auto at = std::lower_bound(leaving.begin(), leaving.end(), std::pair{node, 0});
           at != leaving.end() && at->first == node && side < 0; ++at)
        if (!used[static_cast<std::size_t>(at->second)]) side = at->second;
    }
    measure(mesh, ends, chain);
    out.push_back(std::move(chain));
  }
  return out;
}

std::string free_name(const Mesh& mesh, const std::string& stem, int& number) {
  std::string name;
  do {
    name = stem + " " + std::to_string(++number);
  } while (mesh.group(name));
  return name;
}

}  // namespace

Rim::Rim(const Mesh& mesh) : cells_(outline(mesh)) {
  int side = 0;
  for (const Ends& e : ends_of(cells_)) sorted_.push_back({std::minmax(e.a, e.b), side++});
  std::sort(sorted_.begin(), sorted_.end());
}

int Rim::find(int a, int b) const {
  const std::pair<int, int> key = std::minmax(a, b);
  const auto at = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{key, 0});
  return at != sorted_.end() && at->first == key ? at->second : -1;
}

void Rim::add_to(Group& group, std::vector<int> sides) const {
  std::sort(sides.begin(), sides.end());
  sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
  int begin = 0;
  for (const Cells& c : cells_) {
    const int n = nodes_of(c.shape), end = begin + static_cast<int>(c.size());
    Cells part{c.shape, {}, {}};
    for (auto at = std::lower_bound(sides.begin(), sides.end(), begin); at != sides.end() && *at < end; ++at) {
      const auto from = c.nodes.begin() + static_cast<std::ptrdiff_t>(*at - begin) * n;
      part.nodes.insert(part.nodes.end(), from, from + n);
      part.numbers.push_back(c.numbers[static_cast<std::size_t>(*at - begin)]);
    }
    begin = end;
    group.nodes.insert(group.nodes.end(), part.nodes.begin(), part.nodes.end());
    if (part.size() > 0) group.sides.push_back(std::move(part));
  }
  sort_nodes(group);
}

void name_loops(Mesh& mesh, const Rim& rim) {
  if (mesh.x.cols() == 0) return;
  const std::vector<Ends> ends = ends_of(rim.cells());
  std::vector<char> taken(ends.size(), 0);
  for (const Group& group : mesh.groups)
    for (const Ends& e : ends_of(group.sides))
      if (const int side = rim.find(e.a, e.b); side >= 0) taken[static_cast<std::size_t>(side)] = 1;
  std::vector<Chain> free = chains(mesh, ends);
  std::erase_if(free, [&](const Chain& c) {
    return std::any_of(c.sides.begin(), c.sides.end(), [&](int s) { return taken[static_cast<std::size_t>(s)] != 0; });
  });
  // Centres whose x differs only by rounding, or by the positions of nodes on a rim, count as equal in x.
  const Vector2d low = mesh.x.rowwise().minCoeff(), span = mesh.x.rowwise().maxCoeff() - low;
  const double unit = 1e-3 * span.maxCoeff();
  const auto key = [&](const Chain& c) { return std::tuple{std::lround((c.center.x() - low.x()) / unit), c.center.y()}; };
  std::stable_sort(free.begin(), free.end(), [&](const Chain& a, const Chain& b) { return key(a) < key(b); });
  Group around{"outline", {}, {}};
  std::vector<int> around_sides;
  int holes = 0;
  std::vector<Group> named;
  for (const Chain& chain : free) {
    if (chain.area > 0) {
      around_sides.insert(around_sides.end(), chain.sides.begin(), chain.sides.end());
      continue;
    }
    Group hole{free_name(mesh, "hole", holes), {}, {}};
    rim.add_to(hole, chain.sides);
    named.push_back(std::move(hole));
  }
  if (!around_sides.empty() && !mesh.group("outline")) {
    rim.add_to(around, std::move(around_sides));
    mesh.groups.push_back(std::move(around));
  }
  for (Group& g : named) mesh.groups.push_back(std::move(g));
}

void sort_nodes(Group& group) {
  std::sort(group.nodes.begin(), group.nodes.end());
  group.nodes.erase(std::unique(group.nodes.begin(), group.nodes.end()), group.nodes.end());
}

}  // namespace pintle
