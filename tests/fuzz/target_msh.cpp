#include <cstdlib>
#include <stdexcept>

#include "meshes/gmsh.h"
#include "meshes/limits.h"
#include "meshes/wire.h"
#include "tests/fuzz/file.h"
#include "tests/fuzz/targets.h"

namespace pintle {

// Gmsh reads it in the mesher's process, where it may crash: what comes out of that must be a refusal or a mesh.
void fuzz_msh(std::string_view bytes) {
  MesherLimits limits;
  limits.seconds = 8, limits.bytes = std::size_t{1} << 30;
  set_mesher_limits(limits);
  Mesh mesh;
  try {
    mesh = read_geometry(fuzz_folder().write("mesh.msh", bytes), {});
  } catch (const std::invalid_argument&) {
    return;
  } catch (const std::runtime_error&) {
    return;
  }
  if (!mesh.x.allFinite()) std::abort();
  unpacked_mesh(packed(mesh));  // judges that cells and groups name nodes that there are
}

}  // namespace pintle
