#include "meshes/inp.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "meshes/inp_claims.h"
#include "meshes/inp_deck.h"
#include "meshes/quality.h"
#include "meshes/rim.h"

namespace pintle {

namespace {

/// Maps a file's numbers to list indices.
class NumberIndex {
 public:
  explicit NumberIndex(const std::vector<long>& numbers) : order_(numbers.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    const auto by_number = [&](int a, int b) { return numbers[static_cast<std::size_t>(a)] < numbers[static_cast<std::size_t>(b)]; };
    if (!std::is_sorted(numbers.begin(), numbers.end())) std::stable_sort(order_.begin(), order_.end(), by_number);
    for (const int i : order_) sorted_.push_back(numbers[static_cast<std::size_t>(i)]);
  }
  int find(long number) const {  // −1: there is none
    if (sorted_.empty() || number < sorted_.front() || number > sorted_.back()) return -1;
    const std::size_t guess = static_cast<std::size_t>(number - sorted_.front());  // the numbers usually have no gaps
    if (guess < sorted_.size() && sorted_[guess] == number) return order_[guess];
    const auto at = std::lower_bound(sorted_.begin(), sorted_.end(), number);
    return *at == number ? order_[static_cast<std::size_t>(at - sorted_.begin())] : -1;
  }
  /// Adds the indices of the numbers first, first + step, … up to last, where they exist.
  void find_all(long first, long last, long step, std::vector<int>& out) const {
    auto at = std::lower_bound(sorted_.begin(), sorted_.end(), first);
    for (; at != sorted_.end() && *at <= last; ++at)
      if ((*at - first) % step == 0) out.push_back(order_[static_cast<std::size_t>(at - sorted_.begin())]);
  }
  std::pair<int, int> twice() const {  // the indices of a duplicate number, or −1
    const auto at = std::adjacent_find(sorted_.begin(), sorted_.end());
    if (at == sorted_.end()) return {-1, -1};
    const std::size_t k = static_cast<std::size_t>(at - sorted_.begin());
    return {order_[k], order_[k + 1]};
  }

 private:
  std::vector<int> order_;
  std::vector<long> sorted_;
};

using SetKind = InpDeck::SetKind;

constexpr std::size_t most_members = 200'000'000, most_depth = 1000;  // of all sets; of nested sets

struct Builder {
  const InpDeck& queue;
  NumberIndex node_index{queue.node_numbers}, element_index{queue.element_numbers};
  std::map<std::pair<std::string, SetKind>, std::size_t> set_index{};
  struct Members {
    std::vector<int> places{};
    bool whole = false;
  };
  std::map<std::size_t, Members> of_set{};  // by index of the set
  std::size_t total = 0, depth = 0;         // members of all sets; sets being collected
  std::vector<std::size_t> seen = std::vector<std::size_t>(std::max(queue.elements.size(), queue.x.size()));
  std::size_t round = 0;  // seen[p] == round: p is already among the members being collected
  std::map<std::string, std::size_t> group_index{};
  std::vector<int> nodes{};  // of all elements, looked up

  InpPlace place_of_element(int e) const { return queue.elements[static_cast<std::size_t>(e)].place; }
  const InpDeck::Element& element(int e) const { return queue.elements[static_cast<std::size_t>(e)]; }
  int corner(const InpDeck::Element& e, int k) const { return nodes[e.first + static_cast<std::size_t>(k)]; }
  static bool is_plane(const InpDeck::Element& e) { return corners_of(e.kind.shape) > 2; }

  void check_numbers() {
    if (const auto [a, b] = node_index.twice(); b >= 0)
      queue.text.reject(queue.node_places[static_cast<std::size_t>(b)], "node ", queue.node_numbers[static_cast<std::size_t>(b)],
                        " is defined again, first on line ", queue.node_places[static_cast<std::size_t>(a)].line,
                        "; each number may define one node only");
    if (const auto [a, b] = element_index.twice(); b >= 0)
      queue.text.reject(place_of_element(b), "element ", queue.element_numbers[static_cast<std::size_t>(b)],
                        " is defined again, first on line ", place_of_element(a).line, "; each number may define one element only");
  }

  void look_up_nodes() {
    nodes.reserve(queue.element_nodes.size());
    for (std::size_t e = 0; e < queue.elements.size(); ++e) {
      const InpDeck::Element& el = queue.elements[e];
      const std::size_t end = el.first + static_cast<std::size_t>(nodes_of(el.kind.shape));
      for (std::size_t k = el.first; k < end; ++k) {
        const int node = node_index.find(queue.element_nodes[k]);
        if (node < 0)
          queue.text.reject(el.place, "element ", queue.element_numbers[e], " names node ", queue.element_nodes[k],
                            ", which no *NODE defines");
        if (std::find(nodes.begin() + static_cast<std::ptrdiff_t>(el.first), nodes.end(), node) != nodes.end())
          queue.text.reject(el.place, "element ", queue.element_numbers[e], " names node ", queue.element_nodes[k],
                            " twice; collapsed elements are not supported: use a triangle");
        nodes.push_back(node);
      }
      if (el.kind.shape == CellShape::line3) middle_last(el.first);
    }
  }

  // Abaqus numbers the middle node of a line second, Gmsh last; its position decides.
  void middle_last(std::size_t first) {
    const auto miss = [&](std::size_t middle, std::size_t a, std::size_t b) {
      const auto i = [&](std::size_t k) { return static_cast<std::size_t>(nodes[first + k]); };
      return std::hypot(queue.x[i(middle)] - (queue.x[i(a)] + queue.x[i(b)]) / 2, queue.y[i(middle)] - (queue.y[i(a)] + queue.y[i(b)]) / 2);
    };
    if (miss(1, 0, 2) < miss(2, 0, 1)) std::swap(nodes[first + 1], nodes[first + 2]);
  }

  Mesh cells(double scale) const {
    Mesh mesh;
    mesh.x.resize(2, static_cast<Eigen::Index>(queue.x.size()));
    for (std::size_t i = 0; i < queue.x.size(); ++i) mesh.x.col(static_cast<Eigen::Index>(i)) << scale * queue.x[i], scale * queue.y[i];
    mesh.node_numbers = queue.node_numbers;
    const bool plane = std::any_of(queue.elements.begin(), queue.elements.end(), is_plane);
    for (std::size_t e = 0; e < queue.elements.size(); ++e) {
      const InpDeck::Element& el = queue.elements[e];
      if (is_plane(el) != plane) continue;
      auto block = std::find_if(mesh.cells.begin(), mesh.cells.end(), [&](const Cells& c) { return c.shape == el.kind.shape; });
      if (block == mesh.cells.end()) block = mesh.cells.insert(mesh.cells.end(), Cells{el.kind.shape, {}, {}});
      const auto first = nodes.begin() + static_cast<std::ptrdiff_t>(el.first);
      block->nodes.insert(block->nodes.end(), first, first + nodes_of(el.kind.shape));
      block->numbers.push_back(queue.element_numbers[e]);
    }
    return mesh;
  }

  std::size_t set_of(const InpDeck::Item& item, SetKind kind, const std::string& name) const {
    const auto found = set_index.find({upper(name), kind});
    if (found == set_index.end())
      queue.text.reject(item.place, "there is no ", kind == SetKind::node ? "node" : "element", " set \"", name,
                        "\"; define it, or correct the name");
    return found->second;
  }

  // The indices of a set's members, in the order listed, including those of the sets it names; each once.
  const std::vector<int>& members(std::size_t s) {
    const auto [known, is_new] = of_set.try_emplace(s);
    const InpDeck::Set& set = queue.sets[s];
    Members& m = known->second;
    if (is_new) {
      if (++depth > most_depth)
        queue.text.reject(set.place, "the set \"", set.name, "\" is nested in other sets more than ", most_depth,
                          " levels deep; name it directly");
      for (const InpDeck::Item& item : set.items) add_members(item, set, m.places);
      drop_repeated(m.places);
      m.whole = true;
      --depth;
      if ((total += m.places.size()) > most_members)
        queue.text.reject(set.place, "the sets up to \"", set.name, "\" have more than ", most_members,
                          " members; remove sets that are not needed");
    }
    if (!m.whole) queue.text.reject(set.place, "the set \"", set.name, "\" contains itself; remove that entry");
    return m.places;
  }

  void add_members(const InpDeck::Item& item, const InpDeck::Set& set, std::vector<int>& out) {
    const bool node = set.kind == SetKind::node;
    const NumberIndex& index = node ? node_index : element_index;
    if (item.label == "ELSET") {
      for (const int e : members(set_of(item, SetKind::element, item.name)))
        for (int k = 0; k < nodes_of(element(e).kind.shape); ++k) out.push_back(corner(element(e), k));
    } else if (!item.name.empty()) {
      const std::vector<int>& more = members(set_of(item, set.kind, item.name));
      out.insert(out.end(), more.begin(), more.end());
    } else if (item.step > 0) {
      index.find_all(item.number, item.last, item.step, out);
    } else {
      const int at = index.find(item.number);
      if (at < 0)
        queue.text.reject(item.place, "the set \"", set.name, "\" names ", node ? "node " : "element ", item.number,
                          ", which is not defined");
      out.push_back(at);
    }
  }

  void drop_repeated(std::vector<int>& places) {
    ++round;
    std::erase_if(places, [&](int p) { return std::exchange(seen[static_cast<std::size_t>(p)], round) == round; });
  }

  // The side of the element meant by a surface's label: 0 to 3, −1 for all free ones.
  int side_of(const InpDeck::Item& item, const InpDeck::Element& e) const {
    if (item.label.empty()) return -1;
    const int number = item.label.size() == 2 ? item.label[1] - '0' : 0, corners = corners_of(e.kind.shape);
    int side = -1;
    if (item.label[0] == 'E' && e.kind.shell) side = number - 1;
    if (item.label[0] == 'S') side = e.kind.shell ? number - 3 : number - 1;
    if (side < 0 || side >= corners)
      queue.text.reject(item.place, "\"", item.label, "\" is no side of ", e.kind.shell ? "a shell" : "an element", " with ", corners,
                        " corners; its sides are ", e.kind.shell ? "E1" : "S1", " to ", e.kind.shell ? "E" : "S", corners,
                        e.kind.shell ? " (S1 and S2 are its faces)" : "");
    return side;
  }

  void add_free(std::vector<int>& sides, const Rim& rim, const InpDeck::Element& e, int k) const {
    const int at = rim.find(corner(e, k), corner(e, (k + 1) % corners_of(e.kind.shape)));
    if (at >= 0) sides.push_back(at);
  }

  std::vector<int> surface_sides(const InpDeck::Set& set, const Rim& rim) {
    std::vector<int> sides;
    for (const InpDeck::Item& item : set.items) {
      const std::vector<int> elements = [&] {
        if (!item.name.empty()) return members(set_of(item, SetKind::element, item.name));
        const int e = element_index.find(item.number);
        if (e < 0) queue.text.reject(item.place, "the surface \"", set.name, "\" names element ", item.number, ", which is not defined");
        return std::vector<int>{e};
      }();
      for (const int e : elements) {
        if (!is_plane(element(e))) continue;
        const int side = side_of(item, element(e));
        const int corners = corners_of(element(e).kind.shape);
        for (int k = 0; k < corners; ++k)
          if (side < 0 || k == side) add_free(sides, rim, element(e), k);
      }
    }
    return sides;
  }

  // Sides of all plane elements, the lower corner first, sorted.
  std::vector<std::pair<int, int>> plane_sides() const {
    std::vector<std::pair<int, int>> sides;
    for (const InpDeck::Element& e : queue.elements)
      for (int k = 0, n = corners_of(e.kind.shape); is_plane(e) && k < n; ++k)
        sides.emplace_back(std::minmax(corner(e, k), corner(e, (k + 1) % n)));
    std::sort(sides.begin(), sides.end());
    return sides;
  }

  /// @pre groups() has run
  InpElements of_elements() {
    const bool lines = !std::all_of(queue.elements.begin(), queue.elements.end(), is_plane);
    return {[this](const std::string& name) {
              const auto found = set_index.find({upper(name), SetKind::element});
              return found == set_index.end() ? std::vector<int>{} : members(found->second);
            },
            [this, sides = lines ? plane_sides() : std::vector<std::pair<int, int>>{}](int e) {
              return std::binary_search(sides.begin(), sides.end(),
                                        std::pair<int, int>(std::minmax(corner(element(e), 0), corner(element(e), 1))));
            }};
  }

  Group& group_named(Mesh& mesh, const std::string& name) {
    const auto [known, is_new] = group_index.try_emplace(upper(name), mesh.groups.size());
    if (is_new) mesh.groups.push_back({name, {}, {}});
    return mesh.groups[known->second];
  }

  void groups(Mesh& mesh, const Rim& rim) {
    for (std::size_t s = 0; s < queue.sets.size(); ++s) set_index[{upper(queue.sets[s].name), queue.sets[s].kind}] = s;
    for (std::size_t s = 0; s < queue.sets.size(); ++s) {
      const InpDeck::Set& set = queue.sets[s];
      Group& group = group_named(mesh, set.name);
      if (set.kind == SetKind::surface) {
        rim.add_to(group, surface_sides(set, rim));
        continue;
      }
      std::vector<int> sides;
      for (const int i : members(s)) {
        if (set.kind == SetKind::node) {
          group.nodes.push_back(i);
          continue;
        }
        const InpDeck::Element& e = element(i);
        for (int k = 0; k < nodes_of(e.kind.shape); ++k) group.nodes.push_back(corner(e, k));
        if (!is_plane(e)) add_free(sides, rim, e, 0);
      }
      rim.add_to(group, std::move(sides));
    }
  }
};

}  // namespace

Mesh read_inp(const std::filesystem::path& path, double scale, const std::filesystem::path& folder, InpClaims* claims) {
  if (!(scale > 0) || !std::isfinite(scale))
    throw std::invalid_argument(path.string() + ": scale = " + std::to_string(scale) + ", must be positive: m per unit of the file");
  const InpDeck queue = read_inp_deck(path, folder.empty() ? path.parent_path() : folder);
  if (queue.elements.empty())
    throw std::invalid_argument(path.string() + ": no *ELEMENT in it; it needs plane elements or beams between its nodes");
  Builder builder{queue};
  builder.check_numbers();
  builder.look_up_nodes();
  Mesh mesh = builder.cells(scale);
  if (mesh.plane()) orient(mesh);  // a cell in the opposite direction would look like a hole
  const Rim rim(mesh);
  builder.groups(mesh, rim);
  InpClaims said = inp_claims(queue, builder.of_elements());
  if (claims) *claims = std::move(said);
  name_loops(mesh, rim);
  drop_unused_nodes(mesh);
  std::erase_if(mesh.groups, [](const Group& g) { return g.nodes.empty(); });
  return mesh;
}

}  // namespace pintle
