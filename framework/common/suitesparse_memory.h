#pragma once

namespace pintle {

/// If memory is insufficient for one ordering of unknowns, SuiteSparse silently uses another, and results then differ in their last digits.
/// This class detects, from its construction on and for its thread, whether that may have happened.
class SuiteSparseMemory {
 public:
  SuiteSparseMemory();
  bool lacked() const;
  /// @throws std::bad_alloc  SuiteSparse has run out of memory since
  void require() const;
};

}  // namespace pintle
