#include "app/mistyped.h"

#include <vector>

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
    for (const std::string& name : option->get_lnames()) out.push_back("--" + name);
  return out;
}

}  // namespace

std::string mistyped(const CLI::App& app, int argc, char** argv) {
  const std::vector<const CLI::App*> parsed = [&] {
    std::vector<const CLI::App*> out;
    for (const CLI::App* command : app.get_subcommands()) out.push_back(command);
    return out;
  }();
  if (parsed.empty()) {
    if (argc < 2 || is_option(argv[1])) return "";
    return "\"" + std::string(argv[1]) + "\" is no command." + did_you_mean(argv[1], command_names(app)) + " pintle --help lists them.";
  }
  const std::string name = parsed.front()->get_name();
  for (const std::string& word : app.remaining(true))
    if (is_option(word)) {
      const std::string option = word.substr(0, word.find('='));
      return name + " has no option " + option + "." + did_you_mean(option, option_names(*parsed.front())) + " pintle " + name +
             " --help tells what each does.";
    }
  return "";
}

}  // namespace pintle::app
