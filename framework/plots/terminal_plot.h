#pragma once

#include <string>

#include "framework/plots/plot.h"

namespace pintle {

/// Curves as text, in Braille dots: two across and four up in each character.
/// @param columns, rows  characters of the whole picture; too few are raised to what its words need
std::string terminal_plot(const Panel&, int columns, int rows);

}  // namespace pintle
