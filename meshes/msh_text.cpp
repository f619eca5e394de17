#include "meshes/msh_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "meshes/reject.h"

namespace pintle {

namespace {

using Place = std::array<double, 3>;

/// The next word of a line; empty: there is none.
std::string_view word(std::string_view& line) {
  constexpr const char* blanks = " \t\r";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view out = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(out.size());
  return out;
}

template <class T>
bool number(std::string_view& line, T& value) {
  std::string_view text = word(line);
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool tiny = error == std::errc::result_out_of_range && text.find("e-") != text.npos;  // below the range of double
  if (tiny) value = 0;
  return (error == std::errc() || tiny) && end == text.data() + text.size();
}

struct Msh {
  const std::string& name;
  std::string_view rest;
  long line = 0;
  std::unordered_map<long, std::pair<Place, long>> nodes{};                ///< place and line of each number
  std::unordered_map<long, std::pair<std::string_view, long>> elements{};  ///< its nodes as written, and line

  /// The next line that is not blank.
  bool next(std::string_view& out) {
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      out = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      ++line;
      if (std::string_view seen = out; !word(seen).empty()) return true;
    }
    return false;
  }
  template <class... Parts>
  [[noreturn]] void fail(const Parts&... parts) const {
    reject(name, ":", line, ": ", parts..., "; write the file again");
  }

  /// The next line of a section.
  std::string_view entry(const char* what, long count) {
    std::string_view out;
    if (!next(out)) fail("the file ends where ", what, " ", count, " of its section is expected");
    if (out.starts_with('$')) fail("the section ends before ", what, " ", count, ", although its count includes it");
    return out;
  }
  template <class... T>
  void read(std::string_view text, const char* what, T&... values) const {
    if (!(number(text, values) && ...)) fail("is no ", what);
  }
  void end(const char* section, const char* what) {
    std::string_view out;
    if (!next(out) || !out.starts_with(section)) fail("there are more ", what, " than the section's count says");
  }

  void add_node(long of, const Place& at) {
    for (const double x : at)
      if (!std::isfinite(x)) fail("the place of node ", of, " is not finite");
    const auto [found, fresh] = nodes.try_emplace(of, at, line);
    if (!fresh && found->second.first != at)
      fail("node ", of, " is at (", at[0], ", ", at[1], "), but in line ", found->second.second, " at (", found->second.first[0], ", ",
           found->second.first[1], "): each number may define one node only");
  }

  void add_element(long of, std::string_view its_nodes) {
    its_nodes.remove_prefix(std::min(its_nodes.find_first_not_of(" \t\r"), its_nodes.size()));
    its_nodes.remove_suffix(its_nodes.size() - std::min(its_nodes.find_last_not_of(" \t\r") + 1, its_nodes.size()));
    const auto [found, fresh] = elements.try_emplace(of, its_nodes, line);
    if (!fresh && found->second.first != its_nodes)
      fail("element ", of, " has other nodes than in line ", found->second.second,
           ": each number may define one element only, and Gmsh would ignore one");
  }

  // Version 2: a count, then one line each.
  void nodes_2() {
    long count = 0;
    read(entry("the count", 1), "count of nodes", count);
    for (long k = 1, of = 0; k <= count; ++k) {
      Place at{};
      read(entry("node", k), "node: a number and three coordinates", of, at[0], at[1], at[2]);
      add_node(of, at);
    }
    end("$EndNodes", "nodes");
  }
  void elements_2() {
    long count = 0;
    read(entry("the count", 1), "count of elements", count);
    for (long k = 1, of = 0, type = 0, tags = 0; k <= count; ++k) {
      std::string_view text = entry("element", k);
      if (!number(text, of) || !number(text, type) || !number(text, tags))
        fail("is no element: its number, type, number of tags, tags and nodes");
      for (; tags > 0 && !text.empty(); --tags) word(text);
      add_element(of, text);
    }
    end("$EndElements", "elements");
  }
  // Version 4.1: blocks, each with a heading and its count.
  void nodes_4() {
    long blocks = 0, dim = 0, tag = 0, parametric = 0, count = 0;
    read(entry("the heading", 1), "heading of nodes", blocks);
    for (long b = 1; b <= blocks; ++b) {
      read(entry("block", b), "heading of a block of nodes", dim, tag, parametric, count);
      if (count < 0) fail("a block cannot have ", count, " nodes");
      std::vector<long> numbers;
      for (long k = 1, of = 0; k <= count; ++k) read(entry("node", k), "number of a node", of), numbers.push_back(of);
      for (const long of : numbers) {
        Place at{};
        read(entry("node", of), "place of a node: three coordinates", at[0], at[1], at[2]);
        add_node(of, at);
      }
    }
    end("$EndNodes", "nodes");
  }
  void elements_4() {
    long blocks = 0, dim = 0, tag = 0, type = 0, count = 0;
    read(entry("the heading", 1), "heading of elements", blocks);
    for (long b = 1; b <= blocks; ++b) {
      read(entry("block", b), "heading of a block of elements", dim, tag, type, count);
      if (count < 0) fail("a block cannot have ", count, " elements");
      for (long k = 1, of = 0; k <= count; ++k) {
        std::string_view text = entry("element", k);
        if (!number(text, of)) fail("is no element: its number and nodes");
        add_element(of, text);
      }
    }
    end("$EndElements", "elements");
  }
};

}  // namespace

void validate_msh(const std::string& name, std::string_view text) {
  Msh file{name, text};
  std::string_view line, version;
  if (!file.next(line) || !file.next(line)) return;
  version = word(line);
  const bool two = version == "2" || version.starts_with("2."), four = version == "4.1";
  if ((!two && !four) || word(line) != "0") return;
  while (file.next(line)) {
    if (line.starts_with("$Nodes")) two ? file.nodes_2() : file.nodes_4();
    if (line.starts_with("$Elements")) two ? file.elements_2() : file.elements_4();
  }
}

}  // namespace pintle
