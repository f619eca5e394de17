#pragma once

#include <string>

namespace pintle {

/// A part of the library in a separate shared object, libpintle_NAME.so, because its libraries take longer to load than many runs take: it
/// is loaded when first needed, and stays loaded.
///
/// It is searched for in the RUNPATH of the program, or of the library if that is shared, then in the folders of the system
/// (LD_LIBRARY_PATH etc.). CMake sets RUNPATH for targets that link pintle::pintle.
/// @returns the result of its function pintle_NAME(): a table of functions, whose first member is the version it was built as, a `const
/// char*`
/// @throws std::runtime_error  it cannot be found or loaded, or belongs to another version
const void* load_module(const char* name);

/// Path of a program located next to the modules.  @throws std::runtime_error  it does not exist
std::string program_beside_modules(const std::string& name);
/// Path of a data file located there; when installed it need not be executable.  @throws std::runtime_error  likewise
std::string file_beside_modules(const std::string& name);

/// The table of a module; Table begins with `const char* version`.
template <class Table>
const Table& module_table(const char* name) {
  return *static_cast<const Table*>(load_module(name));
}

}  // namespace pintle
