#pragma once

namespace pintle {

/// Where memory does not suffice for one ordering of unknowns, SuiteSparse takes another without a word, and results then differ in
/// their last digits. From its construction on this remembers, for its thread, whether that may have been.
class SuiteSparseMemory {
 public:
  SuiteSparseMemory();
  bool lacked() const;
  /// @throws std::bad_alloc  SuiteSparse lacked memory since
  void require() const;
};

}  // namespace pintle
