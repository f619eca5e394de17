#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace pintle::app {

/// The command or option that was probably meant, if the command line has an unknown name; otherwise empty. @param app  after its parse
std::string mistyped(const CLI::App& app, int argc, char** argv);

/// Prints the requested help, or in one line the error in the command line. @returns the exit code
int end_of(const CLI::App& app, const CLI::ParseError&, int argc, char** argv);

}  // namespace pintle::app
