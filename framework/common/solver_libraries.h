#pragma once

namespace pintle {

/// A function of CHOLMOD, SPQR, LAPACK, BLAS or OpenMP, by its name. Loading these libraries takes longer than many runs take, so it is done
/// when the first of their functions is called: solver_libraries.cpp defines those that are used.
/// @param load  load the libraries if that has not been done
/// @returns null: they are not loaded, or have no such function
/// @throws std::runtime_error  they cannot be loaded
void* solver_function(const char* name, bool load);

}  // namespace pintle
