#pragma once

#include <string>

#include "framework/configuration/assemble.h"

namespace pintle {

/// Sums over all that the motion follows from, as a line of JSON: the numbers of the system that was built (masses, shapes,
/// joints, laws …) and where it starts; the scene's words, entry by entry, but for `title`, `run.until` and `output`; the files
/// that they name; and, to say why numbers may differ, what program and BLAS made them. Of laws made in C++ it sees samples.
std::string identity(const Scene&, const Model&, const Assembly&);

/// What of the first keeps a state that was saved by it from being gone on from by the second, and the remedy; empty: nothing.
std::string difference(const std::string& saved, const std::string& now);

}  // namespace pintle
