#include <cstdlib>
#include <stdexcept>
#include <string>

#include "meshes/wire.h"
#include "tests/fuzz/targets.h"

namespace pintle {

void fuzz_wire(std::string_view bytes) {
  try {
    const Mesh mesh = unpacked_mesh(bytes);
    if (packed(mesh) != std::string(bytes)) std::abort();
  } catch (const std::runtime_error&) {
  }
  try {
    unpacked_task(bytes);
  } catch (const std::runtime_error&) {
  }
}

}  // namespace pintle
