#pragma once

#include <CLI/CLI.hpp>

#include "app/options.h"

namespace pintle::app {

/// Whether another program executes a command, which alone knows its options.
bool is_passed_on(const std::string& command);

/// The options of a command, by its name, and the description in its help of the files it writes.
void add_options(CLI::App& command, Options&);

}  // namespace pintle::app
