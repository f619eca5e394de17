#pragma once

#include <cstddef>
#include <exception>

namespace pintle {

/// Limits for meshing. A body that needs more is rejected.
struct MesherLimits {
  double seconds = 600;                      ///< elapsed time [s]
  std::size_t bytes = std::size_t{8} << 30;  ///< of memory
  bool (*stop)() = nullptr;                  ///< called ten times a second by threads waiting for a mesh; true: stop
};

/// Applies to the whole process. Set it before bodies are made.
void set_mesher_limits(const MesherLimits&);
MesherLimits mesher_limits();

/// `stop` returned true. Not an error in the body.
struct MeshingStopped : std::exception {
  const char* what() const noexcept override { return "meshing was stopped"; }
};

}  // namespace pintle
