// SPDX-License-Identifier: MIT
// meshhood manual: the manual page and the completions of the shells, made from what --help prints.
#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshhood/version.h"

#include "commands.h"
#include "options.h"
#include "output.h"

namespace meshhood::cli {
namespace {

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// The options of a command, or its arguments without a name, in their order.
std::vector<const CLI::Option*> options_of(const CLI::App& command, bool positional = false) {
  return command.get_options(
      [positional](const CLI::Option* option) { return option->get_positional() == positional; });
}

std::vector<const CLI::App*> commands_of(const CLI::App& program) { return program.get_subcommands({}); }

/// Its spellings, each with the dashes.
std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> all;
  for (const std::string& name : option.get_snames()) all.push_back('-' + name);
  for (const std::string& name : option.get_lnames()) all.push_back("--" + name);
  return all;
}

/// Every option with a value names its type.
bool has_value(const CLI::Option& option) { return !option.get_type_name().empty(); }

/// The type of the value: words in lower case that stand for themselves, and names in upper case, separated by `|`.
std::vector<std::string> alternatives(const CLI::Option& option) {
  return CLI::detail::split(option.get_type_name(), '|');
}

/// The words that may be the value.
std::vector<std::string> words(const CLI::Option& option) {
  std::vector<std::string> found = alternatives(option);
  std::erase_if(found, [](const std::string& word) {
    return word.empty() || !std::all_of(word.begin(), word.end(), [](char c) { return 'a' <= c && c <= 'z'; });
  });
  return found;
}

bool accepts(const CLI::Option& option, std::string_view type) {
  const std::vector<std::string> types = alternatives(option);
  return std::find(types.begin(), types.end(), type) != types.end();
}

bool is_path(const CLI::Option& option) { return accepts(option, "FILE") || accepts(option, "FOLDER"); }

/// What fits on a line.
std::string summary(const std::string& description) { return description.substr(0, description.find(';')); }

// Bash.

std::string names_for_bash(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : options_of(command)) {
    for (const std::string& name : spellings(*option)) names.push_back(name);
  }
  return fmt::format("{}", fmt::join(names, " "));
}

/// The cases of the options whose value is no path, by the word before the cursor.
std::string values_for_bash(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : options_of(command)) {
    if (!has_value(*option) || (is_path(*option) && words(*option).empty())) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : spellings(*option)) patterns.push_back(command.get_name() + ':' + name);
    text += fmt::format("    {}) words='{}'", fmt::join(patterns, " | "), fmt::join(words(*option), " "));
    text += is_path(*option) ? " ;;\n" : "; compopt +o default ;;\n";
  }
  return text;
}

std::string for_bash(const CLI::App& program) {
  std::vector<std::string> commands;
  std::string values;
  std::string options;
  for (const CLI::App* command : commands_of(program)) {
    commands.push_back(command->get_name());
    values += values_for_bash(*command);
    options += fmt::format("      {}) words='{}' ;;\n", command->get_name(), names_for_bash(*command));
    for (const CLI::Option* argument : options_of(*command, true)) {
      if (words(*argument).empty()) continue;
      options += fmt::format("      {}:) words='{}' ;;\n", command->get_name(), fmt::join(words(*argument), " "));
    }
  }
  return fmt::format(R"(# Completion of meshhood in bash.
_meshhood() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} command=${{COMP_WORDS[1]}} words=
  # --option=value is three words.
  if [[ $word == = ]]; then word=; elif [[ $before == = ]]; then before=${{COMP_WORDS[COMP_CWORD-2]}}; fi
  if ((COMP_CWORD == 1)); then
    command=
    words='{} {}'
  fi
  case $command:$before in
{}    *)
      if [[ -n $command && $word != -* ]]; then command+=:; fi
      case $command in
{}      esac ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}}
complete -o default -F _meshhood meshhood
)",
                     fmt::join(commands, " "), names_for_bash(program), values, options);
}

// Zsh.

std::string quoted(const std::string& text) { return '\'' + replaced(text, "'", R"('\'')") + '\''; }

/// What `_arguments` does with a value.
std::string value_for_zsh(const CLI::Option& option) {
  if (!has_value(option)) return {};
  const std::string name = replaced(option.get_type_name(), ":", R"(\:)");
  if (accepts(option, "FOLDER")) return fmt::format(":{}:_files -/", name);
  if (is_path(option)) return fmt::format(":{}:_files", name);
  return fmt::format(":{}:({})", name, fmt::join(words(option), " "));
}

std::string arguments_for_zsh(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* option : options_of(command)) {
    std::string description = summary(option->get_description());
    for (const auto& [from, to] : {std::pair{"[", R"(\[)"}, {"]", R"(\])"}, {":", R"(\:)"}}) {
      description = replaced(description, from, to);
    }
    const std::string rest = quoted(fmt::format("[{}]{}", description, value_for_zsh(*option)));
    const std::vector<std::string> names = spellings(*option);
    const bool repeats = option->get_items_expected_max() > 1;
    const std::string once = repeats ? "'*'" : fmt::format("'({})'", fmt::join(names, " "));
    text += names.size() == 1 ? fmt::format("        {}{}{} \\\n", once, names.front(), rest)
                              : fmt::format("        {}{{{}}}{} \\\n", once, fmt::join(names, ","), rest);
  }
  for (const CLI::Option* argument : options_of(command, true)) {
    if (!words(*argument).empty()) {
      return text + fmt::format("        '1:{}:({})'\n", argument->get_name(true), fmt::join(words(*argument), " "));
    }
  }
  return text + "        '*:file:_files'\n";
}

std::string for_zsh(const CLI::App& program) {
  const auto entry = [](const std::string& name, const std::string& description) {
    return fmt::format("      {}\n", quoted(name + ':' + summary(description)));
  };
  std::string commands;
  std::string options;
  std::string cases;
  for (const CLI::Option* option : options_of(program)) {
    for (const std::string& name : spellings(*option)) options += entry(name, option->get_description());
  }
  for (const CLI::App* command : commands_of(program)) {
    commands += entry(command->get_name(), command->get_description());
    cases +=
        fmt::format("    {})\n      _arguments \\\n{}      ;;\n", command->get_name(), arguments_for_zsh(*command));
  }
  return fmt::format(R"(#compdef meshhood
# Completion of meshhood in zsh.
_meshhood() {{
  if ((CURRENT == 2)); then
    local -a commands=(
{}    )
    local -a options=(
{}    )
    _describe command commands
    _describe -o option options
    return
  fi
  shift words
  ((CURRENT--))
  case $words[1] in
{}  esac
}}
_meshhood "$@"
)",
                     commands, options, cases);
}

// Fish.

std::string option_for_fish(const CLI::Option& option, std::string_view condition) {
  std::string text = fmt::format("complete -c meshhood -n '{}'", condition);
  for (const std::string& name : option.get_snames()) text += " -s " + name;
  for (const std::string& name : option.get_lnames()) text += " -l " + name;
  if (has_value(option)) text += is_path(option) ? " -r -F" : " -x";
  if (!words(option).empty()) text += fmt::format(" -a '{}'", fmt::join(words(option), " "));
  return text + " -d " + quoted(summary(option.get_description())) + '\n';
}

std::string for_fish(const CLI::App& program) {
  std::string text = "# Completion of meshhood in fish.\n";
  for (const CLI::Option* option : options_of(program)) text += option_for_fish(*option, "__fish_use_subcommand");
  for (const CLI::App* command : commands_of(program)) {
    text += fmt::format("complete -c meshhood -n __fish_use_subcommand -f -a {} -d {}\n", command->get_name(),
                        quoted(summary(command->get_description())));
    const std::string condition = "__fish_seen_subcommand_from " + command->get_name();
    for (const CLI::Option* option : options_of(*command)) text += option_for_fish(*option, condition);
    for (const CLI::Option* argument : options_of(*command, true)) {
      if (words(*argument).empty()) continue;
      text += fmt::format("complete -c meshhood -n '{}' -f -a '{}'\n", condition, fmt::join(words(*argument), " "));
    }
  }
  return text;
}

// The manual page.

/// A line of roff: it must not begin with a control character, and a dash is no hyphen.
std::string roff(const std::string& text) {
  const std::string escaped = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  return escaped.starts_with('.') || escaped.starts_with('\'') ? "\\&" + escaped : escaped;
}

std::string option_for_man(const CLI::Option& option, bool positional) {
  std::string text = ".TP\n\\fB";
  text += positional ? roff(option.get_name(true)) : fmt::format("{}", fmt::join(spellings(option), "\\fR, \\fB"));
  text = positional ? text : replaced(text, "-", "\\-");
  text += "\\fR";
  if (!option.get_option_text().empty()) {
    text += "\\fI" + roff(option.get_option_text()) + "\\fR";
  } else if (has_value(option)) {
    text += " \\fI" + roff(option.get_type_name()) + "\\fR";
  }
  std::string description = roff(option.get_description());
  if (!option.get_default_str().empty()) description += fmt::format(" (default: {})", roff(option.get_default_str()));
  if (option.get_required() && !positional) description += " (required)";
  return text + '\n' + description + '\n';
}

std::string command_for_man(const CLI::App& command) {
  std::string text = fmt::format(".SS \"meshhood {}", roff(command.get_name()));
  for (const CLI::Option* argument : options_of(command, true)) {
    const std::string name = roff(argument->get_name(true));
    text += argument->get_required() ? ' ' + name : " [" + name + ']';
  }
  text += " [OPTIONS]\"\n" + roff(command.get_description()) + ".\n";
  for (const CLI::Option* argument : options_of(command, true)) text += option_for_man(*argument, true);
  for (const CLI::Option* option : options_of(command)) text += option_for_man(*option, false);
  return text;
}

std::string for_man(const CLI::App& program) {
  std::string text = fmt::format(".TH MESHHOOD 1 \"\" \"meshhood {}\" \"User Commands\"\n", kVersion);
  text += ".SH NAME\nmeshhood \\- neighborhoods on polygonal meshes\n";
  text += ".SH SYNOPSIS\n\\fBmeshhood\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n";
  text += ".SH DESCRIPTION\n" + roff(program.get_description()) + '\n';
  text += ".PP\n" + replaced(roff(program.get_footer()), "\n", "\n.PP\n") + '\n';
  text += ".SH OPTIONS\n";
  for (const CLI::Option* option : options_of(program)) text += option_for_man(*option, false);
  text += ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(program)) text += command_for_man(*command);
  return text;
}

constexpr Names<std::string (*)(const CLI::App&), 4> kManuals{
    {{"man", for_man}, {"bash", for_bash}, {"zsh", for_zsh}, {"fish", for_fish}}};

}  // namespace

void add_manual(CLI::App& program) {
  auto kind = std::make_shared<std::string>();
  CLI::App* command = program.add_subcommand(
      "manual", "Print the manual page, or the completions for a shell; make install installs all");
  add_choice(*command, "KIND", "man: the manual page; bash, zsh, fish: the completions for this shell",
             names_of(kManuals), *kind)
      ->required();
  command->callback([kind, &program] { print_text(value_of(kManuals, *kind)(program)); });
}

}  // namespace meshhood::cli
