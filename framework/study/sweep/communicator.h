#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pintle {

/// Processes, possibly on many machines, that run a sweep together; process 0 distributes the cases. Used by one thread of each.
class Communicator {
 public:
  virtual ~Communicator() = default;
  virtual int rank() const = 0;  ///< of this process, from 0
  virtual int size() const = 0;
  /// @pre not to itself
  virtual void send(int to, std::span<const std::int64_t>) = 0;
  /// The next message, or nothing if none has arrived; does not wait.
  virtual bool receive(int& from, std::vector<std::int64_t>&) = 0;
};

}  // namespace pintle
