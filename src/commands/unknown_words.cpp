#include "commands/unknown_words.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <vector>

#include "core/nearest.h"

namespace clothsim {
namespace {

// "--set=a.b=1" and "-fdemo" name "--set" and "-f"; no option: a number, a lone dash, a plain word.
std::string optionNamedBy(const std::string& word) {
  if (word.starts_with("--")) return word.substr(0, word.find('='));
  const bool isShort =
      word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0;
  return isShort ? word.substr(0, 2) : "";
}

std::vector<std::string> optionsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

std::vector<std::string> commandsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

}  // namespace

std::string unknownWord(const CLI::App& app, std::span<const char* const> words) {
  const CLI::App* command = &app;
  std::string before;  // an option of the viewer, in front of a command
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string word = words[i], name = optionNamedBy(word);
    if (!name.empty()) {
      const CLI::Option* option = command->get_option_no_throw(name);
      if (option == nullptr)
        return (command == &app ? "" : command->get_name() + ": ") + "there is no option " + name +
               didYouMean(name, optionsOf(*command));
      const bool holdsValue = word.size() > name.size();
      if (option->get_items_expected_max() > 0 && !holdsValue) ++i;
      if (before.empty()) before = name;
    } else if (command == &app) {
      const auto commands = app.get_subcommands({});
      const auto named = std::ranges::find(commands, word, &CLI::App::get_name);
      if (named == commands.end())
        return "there is no command \"" + word + "\"" + didYouMean(word, commandsOf(app));
      command = *named;
      if (!before.empty())
        return before + " stands before the command; write it behind: clothsim " + word + " " + before +
               " ...";
    }
  }
  return "";
}

void refuseEmptyValues(CLI::App& app) {
  for (CLI::Option* option : app.get_options())
    if (option->get_items_expected_max() > 0)
      option->check([](const std::string& value) -> std::string {
        return value.empty() ? "expected a value, found \"\"; leave the option out if there is none" : "";
      });
  for (CLI::App* command : app.get_subcommands({})) refuseEmptyValues(*command);
}

}  // namespace clothsim
