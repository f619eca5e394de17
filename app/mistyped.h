#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace pintle::app {

/// Which command or option was meant, where the command line could not be read because there is none of the name given; otherwise
/// empty. @param app  after its parse
std::string mistyped(const CLI::App& app, int argc, char** argv);

/// Prints the help that was asked for, or in a line what is wrong with the command line. @returns the exit code
int end_of(const CLI::App& app, const CLI::ParseError&, int argc, char** argv);

}  // namespace pintle::app
