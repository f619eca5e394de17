#pragma once

/// Every header that has types of Eigen in it includes this. Eigen aligns its types, and takes their memory, by the processor
/// that it is compiled for: 16 bytes on plain x86-64, 32 with AVX2, 64 with AVX-512. A program compiled for another processor
/// than the library would not find the members of our structures where the library put them, nor free what it allocated.
/// The CMake target pintle::pintle sets what makes both the same for all processors.

#include <Eigen/Core>

#if EIGEN_MAX_STATIC_ALIGN_BYTES != 16 || EIGEN_MAX_ALIGN_BYTES != 64 || EIGEN_DEFAULT_ALIGN_BYTES != 64
#error \
    "Eigen would lay out its types otherwise than the library pintle: link the CMake target pintle::pintle, or compile the whole program with -DEIGEN_MAX_ALIGN_BYTES=64 -DEIGEN_MAX_STATIC_ALIGN_BYTES=16"
#endif
