#pragma once

#include <CLI/CLI.hpp>

#include "app/options.h"

namespace pintle::app {

/// Whether a separate program executes the command and reads its options.
bool is_passed_on(const std::string& command);

/// Adds the options of a command, by its name, and to its help the description of the files that it writes.
void add_options(CLI::App& command, Options&);

}  // namespace pintle::app
