#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "framework/analysis/simulate/simulate.h"

namespace pintle {

/// The columns of a run, by their names without units.
class Columns {
 public:
  explicit Columns(const Run& run) : run_(run) {}

  /// Index in the table, or −1. `exact`: only the unit may follow; otherwise also " on BODY".
  static int index(const Table& table, const std::string& name) {
    for (std::size_t c = 0; c < table.columns(); ++c)
      if (table.header[c].starts_with(name + " [") || table.header[c].starts_with(name + " on ")) return static_cast<int>(c);
    return -1;
  }
  bool has(const std::string& name) const { return index(run_.trajectory, name) >= 0; }
  std::vector<double> times() const { return column(run_.trajectory, 0); }
  /// Empty if there is no column of this name.
  std::vector<double> motion(const std::string& name) const {
    const int c = index(run_.trajectory, name);
    return c < 0 ? std::vector<double>{} : column(run_.trajectory, static_cast<std::size_t>(c));
  }
  std::vector<double> book(const std::string& name) const {
    const int c = index(run_.ledger, name);
    return c < 0 ? std::vector<double>{} : column(run_.ledger, static_cast<std::size_t>(c));
  }
  /// Sum of the energy-balance columns whose names without unit satisfy `wanted`.
  std::vector<double> sum(const std::function<bool(const std::string&)>& wanted) const {
    std::vector<double> out(run_.ledger.rows(), 0.0);
    for (std::size_t c = 0; c < run_.ledger.columns(); ++c) {
      const std::string& header = run_.ledger.header[c];
      if (!wanted(header.substr(0, header.rfind(" [")))) continue;
      const std::vector<double> values = column(run_.ledger, c);
      for (std::size_t r = 0; r < out.size(); ++r) out[r] += values[r];
    }
    return out;
  }

 private:
  static std::vector<double> column(const Table& table, std::size_t c) {
    std::vector<double> out(table.rows());
    for (std::size_t r = 0; r < out.size(); ++r) out[r] = table.data[r * table.columns() + c];
    return out;
  }
  const Run& run_;
};

}  // namespace pintle
