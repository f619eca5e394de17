#pragma once

#include <string>

#include "framework/scene/units/expression.h"

namespace pintle {

/// "1%", "0.01" or "1e-3": a share greater than 0 and at most 1. @throws ExpressionError
double read_share(const std::string&);
/// "0.5 s", "10 min", "2 h": a positive computing time, in seconds. @throws ExpressionError
double read_duration(const std::string&);

}  // namespace pintle
