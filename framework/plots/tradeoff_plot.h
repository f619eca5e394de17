#pragma once

#include <string>

#include "framework/study/tradeoff/tradeoff.h"

namespace pintle {

/// Error against time of every setting, the front, and the recommended setting, as the text of an SVG picture.
std::string tradeoff_svg(const TradeReport&);

}  // namespace pintle
