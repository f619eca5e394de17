#include <cstdlib>
#include <stdexcept>

#include "meshes/inp.h"
#include "meshes/wire.h"
#include "tests/fuzz/file.h"
#include "tests/fuzz/targets.h"

namespace pintle {

void fuzz_inp(std::string_view bytes) {
  Mesh mesh;
  try {
    mesh = read_inp(fuzz_folder().write("deck.inp", bytes));
  } catch (const std::invalid_argument&) {
    return;
  } catch (const std::runtime_error&) {
    return;
  }
  unpacked_mesh(packed(mesh));  // judges that cells and groups name nodes that there are
}

}  // namespace pintle
