#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace pintle {

/// A function's entry, as told by its address; overloads are chosen by their type.
template <class Function>
const void* entry_of(Function* function) {
  return reinterpret_cast<const void*>(function);
}

/// What a piece of work ran.
struct Stepped {
  long instructions = 0;
  std::vector<long> entered;  ///< how often each watched function was entered (unless the compiler inlined it)
};

/// Does the work in a child process, one machine instruction at a time: exact, the same each time, and without any
/// counters in the code. Some 10⁵ instructions a second; the work should not ask the system for anything.
/// @returns nothing where processes may not be traced
std::optional<Stepped> stepped(const std::function<void()>& work, const std::vector<const void*>& watched = {});

}  // namespace pintle
