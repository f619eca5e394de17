#pragma once

#include <cstddef>
#include <exception>

namespace pintle {

/// What a mesh may take. A body that needs more is refused.
struct MesherLimits {
  double seconds = 600;                      ///< by the clock
  std::size_t bytes = std::size_t{8} << 30;  ///< of memory
  bool (*stop)() = nullptr;                  ///< asked ten times a second by the threads that wait for a mesh; true: leave it
};

/// Holds for the whole process. Set them before bodies are made.
void set_mesher_limits(const MesherLimits&);
MesherLimits mesher_limits();

/// `stop` said so. Not an error of the body's.
struct MeshingStopped : std::exception {
  const char* what() const noexcept override { return "meshing was stopped"; }
};

}  // namespace pintle
