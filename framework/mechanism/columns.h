#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/common/result_columns.h"

/// A table's columns in one list: a function template that calls `out` for each group of columns names them if `out` is a Heading, and
/// appends their values if it is a ValueRow. Neither depends on what a column means.
namespace pintle {

inline constexpr auto no_suffix = [] { return std::string(); };

/// Each call out(owner, columns, values, suffix) adds "owner.name suffix [unit]".
struct Heading {
  std::vector<std::string>& header;

  template <std::size_t n, class Values, class Suffix = decltype(no_suffix)>
  void operator()(const std::string& owner, const Column (&columns)[n], const Values&, const Suffix& suffix = no_suffix) const {
    for (const Column& c : columns) header.push_back(owner + c.name + suffix() + " [" + c.unit + "]");
  }
};

/// values(now): as many as there are columns.
template <class Now>
struct ValueRow {
  Now now;
  std::vector<double>& data;

  template <std::size_t n, class Values, class Suffix = decltype(no_suffix)>
  void operator()(const std::string&, const Column (&)[n], const Values& values, const Suffix& = no_suffix) const {
    const std::array<double, n> row = values(now);
    data.insert(data.end(), row.begin(), row.end());
  }
};

}  // namespace pintle
