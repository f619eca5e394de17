#pragma once

/// What this process has on the heap, seen at malloc and its kin, which operator new, Eigen and C
/// libraries all end in.
namespace pintle {

/// Allocations since the start; a block made larger counts.
long heap_allocations();
/// Bytes in blocks that are not freed; −1 where this cannot be had.
long heap_in_use();

/// Allocations while f runs.
template <class F>
long allocated(F f) {
  const long before = heap_allocations();
  f();
  return heap_allocations() - before;
}

}  // namespace pintle
