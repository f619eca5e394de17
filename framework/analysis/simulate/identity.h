#pragma once

#include <string>

#include "framework/configuration/assemble.h"

namespace pintle {

/// Checksums of everything that determines the motion, as a line of JSON: the numbers of the built system (masses, shapes, joints, laws …)
/// and its start; the entries of the scene, except `title`, `run.until` and `output`; the files that they name; and, to explain numerical
/// differences, the program and BLAS used. Laws defined in C++ are sampled.
std::string identity(const Scene&, const Model&, const Assembly&);

/// Why a state saved by the first cannot be continued by the second, and the remedy; empty: it can.
std::string difference(const std::string& saved, const std::string& now);

}  // namespace pintle
