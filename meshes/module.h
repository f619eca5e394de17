#pragma once

#include <string>

namespace pintle {

/// A part of the library that stands in a shared object of its own, libpintle_NAME.so, because what it links takes
/// longer to load than many a run takes: it is loaded when it is first called for, and stays.
///
/// It is sought where the program, or the library if that is shared, seeks its own libraries (RUNPATH), then where
/// the system does (LD_LIBRARY_PATH and the rest). CMake sets RUNPATH for whoever links pintle::pintle.
/// @returns what its function pintle_NAME() returns: a table of functions, the first member of which is the version
///     it was built as, a `const char*`
/// @throws std::runtime_error  it cannot be found or loaded, or belongs to another version
const void* load_module(const char* name);

/// Path of a program that stands beside the modules.  @throws std::runtime_error  it is not there
std::string program_beside_modules(const std::string& name);
/// Of a file there, to be read; installed ones need not be programs.  @throws std::runtime_error  likewise
std::string file_beside_modules(const std::string& name);

/// The table of a module; Table begins with `const char* version`.
template <class Table>
const Table& module_table(const char* name) {
  return *static_cast<const Table*>(load_module(name));
}

}  // namespace pintle
