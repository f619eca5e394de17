#pragma once

#include <filesystem>

namespace pintle::app {

/// Checks, before anything is computed, that there is a program to write HDF5. @throws std::runtime_error  with the packages it needs
void require_hdf5();

/// Converts a folder of results to results.h5 in it with that program, which reports its errors. @returns its exit code
int write_hdf5(const std::filesystem::path& directory);

}  // namespace pintle::app
