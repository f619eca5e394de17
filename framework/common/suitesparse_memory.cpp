#include "framework/common/suitesparse_memory.h"

#include <SuiteSparse_config.h>

#include <cstdlib>
#include <new>

namespace pintle {

namespace {

thread_local bool wanting = false;

void* noted(void* found) {
  wanting = wanting || !found;
  return found;
}

bool install() {
  SuiteSparse_config.malloc_func = [](std::size_t n) { return noted(std::malloc(n)); };
  SuiteSparse_config.calloc_func = [](std::size_t n, std::size_t size) { return noted(std::calloc(n, size)); };
  SuiteSparse_config.realloc_func = [](void* p, std::size_t n) { return noted(std::realloc(p, n)); };
  return true;
}

}  // namespace

SuiteSparseMemory::SuiteSparseMemory() {
  [[maybe_unused]] static const bool installed = install();
  wanting = false;
}

bool SuiteSparseMemory::lacked() const { return wanting; }

void SuiteSparseMemory::require() const {
  if (wanting) throw std::bad_alloc();
}

}  // namespace pintle
