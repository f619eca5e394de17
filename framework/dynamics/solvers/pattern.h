#pragma once

#include <vector>

namespace pintle {

/// Positions of the entries of a square sparse matrix, column by column with ascending rows, as in SuiteSparse; built once, filled many
/// times.
struct Pattern {
  struct Place {
    int row, column;
  };
  std::vector<int> column_begin;  ///< size + 1
  std::vector<int> row;           ///< of each entry

  int size() const { return static_cast<int>(column_begin.size()) - 1; }
  int entries() const { return static_cast<int>(row.size()); }
};

/// The pattern of summands at `places`; where[i] ← the entry that summand i belongs to. Several summands may share a place. Time and memory
/// are linear in the size and the number of places.
/// @pre 0 ≤ row, column < size
Pattern compress(int size, const std::vector<Pattern::Place>& places, std::vector<int>& where);

}  // namespace pintle
