#pragma once

#include <CLI/CLI.hpp>

#include "app/options.h"

namespace pintle::app {

/// The options of a command, by its name, and the description in its help of the files it writes.
void add_options(CLI::App& command, Options&);

}  // namespace pintle::app
