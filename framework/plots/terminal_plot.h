#pragma once

#include <string>

#include "framework/plots/plot.h"

namespace pintle {

/// Curves as text, in Braille dots: two across and four down in each character.
/// @param columns, rows  size of the whole picture in characters; increased if too small for its labels
std::string terminal_plot(const Panel&, int columns, int rows);

}  // namespace pintle
