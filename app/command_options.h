#pragma once

#include <CLI/CLI.hpp>

#include "app/options.h"

namespace pintle::app {

/// What a command takes on the command line, by its name, and what its help says of the files that it writes.
void add_options(CLI::App& command, Options&);

}  // namespace pintle::app
