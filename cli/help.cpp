// SPDX-License-Identifier: MIT
#include "help.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "io/number.h"
#include "system.h"

namespace meshhood::cli {
namespace {

std::size_t terminal_width() {
  constexpr std::size_t kDefault = 80;
  constexpr std::size_t kLeast = 60;                // for a column of names and one of words
  const char* const text = std::getenv("COLUMNS");  // NOLINT(concurrency-mt-unsafe): no thread sets it
  const std::optional<std::uint64_t> columns = text == nullptr ? std::nullopt : io::parse_count(text);
  if (columns && *columns > 0) return std::max<std::size_t>(*columns, kLeast);
  return std::max(terminal_columns().value_or(kDefault), kLeast);
}

/// Breaks lines at blanks. A longer word keeps its length.
std::string wrapped(std::string_view text, std::size_t width) {
  std::string result;
  std::size_t line = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
    if (line > 0 && line + 1 + end > width) {
      result += '\n';
      line = 0;
    }
    if (line > 0) result += ' ';
    line += end + (line > 0 ? 1 : 0);
    result += text.substr(0, end);
    if (end < text.size() && text[end] == '\n') {
      result += '\n';
      line = 0;
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

}  // namespace

HelpFormatter::HelpFormatter() : width_(terminal_width()) {}

std::string HelpFormatter::in_column(const std::string& text) const {
  return wrapped(text, width_ - get_column_width());
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  return in_column(CLI::Formatter::make_option_desc(option));
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  const std::size_t width = get_column_width();
  const std::string margin = fmt::format("\n{:{}}", "", width);
  std::string line = fmt::format("{:{}}", "  " + command->get_display_name(true), width);
  if (line.size() > width) line += margin;
  for (const char c : in_column(command->get_description())) {
    if (c == '\n') {
      line += margin;
    } else {
      line += c;
    }
  }
  return line + '\n';
}

std::string HelpFormatter::make_description(const CLI::App* command) const {
  return wrapped(CLI::Formatter::make_description(command), width_);
}

std::string HelpFormatter::make_footer(const CLI::App* command) const {
  return wrapped(CLI::Formatter::make_footer(command), width_);
}

}  // namespace meshhood::cli
