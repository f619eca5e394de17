#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace pintle::app {

/// The command or option that was probably meant, if the command line has an unknown name; otherwise empty. @param app  after its parse
std::string mistyped(const CLI::App& app, int argc, char** argv);

/// Prints the requested help, or the error in the command line in one line. @returns the exit code
int end_of(const CLI::App& app, const CLI::ParseError&, int argc, char** argv);

/// Parses the command line of a program with one command, then calls f().
/// @returns the exit code of f(), or that of a wrong command line, which is reported
template <class F>
int parse_and_run(CLI::App& app, int argc, char** argv, const F& f) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return end_of(app, e, argc, argv);
  }
  return f();
}

}  // namespace pintle::app
