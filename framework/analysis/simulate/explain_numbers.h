#pragma once

#include <string>

#include "framework/integration/integrator.h"

namespace pintle {

/// What a run that cannot go on suffers from, where its numbers show it; else empty.
std::string explain_numbers(const System&, const Integrator&);

}  // namespace pintle
