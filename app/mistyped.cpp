#include "app/mistyped.h"

#include <iostream>
#include <vector>

#include "app/options.h"
#include "framework/common/nearest.h"

namespace pintle::app {

namespace {

bool is_option(const std::string& word) { return word.size() > 1 && word.front() == '-'; }

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> out;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) out.push_back(command->get_name());
  return out;
}

std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> out;
  for (const CLI::Option* option : command.get_options([](const CLI::Option* o) { return o->nonpositional(); }))
    for (const std::string& name : option->get_lnames())
      if (!option->get_group().empty()) out.push_back("--" + name);  // options without a group belong to another command
  return out;
}

/// Names of commands: those nearest to the written one, otherwise all.
std::string meant(const std::string& word, const std::vector<std::string>& commands) {
  const std::string best = nearest(word, commands);
  std::vector<std::string> near;
  for (const std::string& command : commands)
    if (!best.empty() && edit_distance(word, command) == edit_distance(word, best)) near.push_back('"' + command + '"');
  return near.size() > 1 ? " Did you mean " + listed(near) + "?" : did_you_mean(word, commands);
}

std::string full_name(const std::string& command) { return command.starts_with("pintle") ? command : "pintle " + command; }

/// The command named, or the program itself if it has only one.
const CLI::App* command_of(const CLI::App& app) {
  const auto named = app.get_subcommands();
  if (!named.empty()) return named.front();
  return command_names(app).empty() ? &app : nullptr;
}

}  // namespace

std::string mistyped(const CLI::App& app, int argc, char** argv) {
  const CLI::App* const command = command_of(app);
  if (command == nullptr) {
    if (argc < 2 || is_option(argv[1])) return "";
    return "\"" + std::string(argv[1]) + "\" is not a command." + meant(argv[1], command_names(app)) + " pintle --help lists them.";
  }
  const std::string full = full_name(command->get_name());
  for (const std::string& word : app.remaining(true))
    if (is_option(word)) {
      const std::string option = word.substr(0, word.find('='));
      const std::string name = full.substr(full.find(' ') + 1);
      if (option == "--hdf5") return name + " has no option --hdf5; `pintle hdf5 DIR` turns the tables of a folder of results into HDF5";
      return name + " has no option " + option + "." + did_you_mean(option, option_names(*command)) + " " + full + " --help explains each.";
    }
  return "";
}

int end_of(const CLI::App& app, const CLI::ParseError& e, int argc, char** argv) {
  if (e.get_exit_code() == 0) return app.exit(e);
  std::string words = mistyped(app, argc, argv);
  if (words.empty()) {
    const CLI::App* const command = command_of(app);
    words = std::string(e.what()) + "; " + (command ? full_name(command->get_name()) : "pintle") + " --help lists the arguments";
  }
  std::cerr << "pintle: " << words << "\n";
  return bad_scene;
}

}  // namespace pintle::app
