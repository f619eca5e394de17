#include "framework/dynamics/solvers/pattern.h"

#include <cstddef>
#include <numeric>

#include "framework/common/index.h"

namespace pintle {

namespace {

// Indices in `in` sorted by key; equal keys keep their order.
template <class Key>
std::vector<int> sorted(int keys, const std::vector<int>& in, Key key) {
  std::vector<int> begin(at(keys) + 1, 0), out(in.size());
  for (int i : in) ++begin[at(key(i)) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  for (int i : in) out[at(begin[at(key(i))]++)] = i;
  return out;
}

}  // namespace

Pattern compress(int size, const std::vector<Pattern::Place>& places, std::vector<int>& where) {
  std::vector<int> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  order = sorted(size, order, [&](int i) { return places[at(i)].row; });
  order = sorted(size, order, [&](int i) { return places[at(i)].column; });
  Pattern pattern;
  pattern.column_begin.assign(at(size) + 1, 0);
  where.resize(places.size());
  const Pattern::Place* last = nullptr;
  for (int i : order) {
    const Pattern::Place& place = places[at(i)];
    if (!last || last->row != place.row || last->column != place.column) {
      pattern.row.push_back(place.row);
      ++pattern.column_begin[at(place.column) + 1];
    }
    where[at(i)] = pattern.entries() - 1;
    last = &place;
  }
  std::partial_sum(pattern.column_begin.begin(), pattern.column_begin.end(), pattern.column_begin.begin());
  return pattern;
}

}  // namespace pintle
