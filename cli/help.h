// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include <CLI/CLI.hpp>

namespace meshhood::cli {

/// The help of CLI11, wrapped to the terminal: to COLUMNS if it is set, to the width of the terminal on standard
/// output, or else to 80 characters.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter();

  std::string make_option_desc(const CLI::Option* option) const override;
  std::string make_subcommand(const CLI::App* command) const override;
  std::string make_description(const CLI::App* command) const override;
  std::string make_footer(const CLI::App* command) const override;

 private:
  [[nodiscard]] std::string in_column(const std::string& text) const;

  std::size_t width_;
};

}  // namespace meshhood::cli
