// SPDX-License-Identifier: MIT
#include "output.h"

#include <cerrno>
#include <cstdio>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "system.h"

namespace meshhood::cli {
namespace {

bool is_output_kept = false;

[[noreturn]] void fail(int error_number) {
  if (is_closed_pipe(error_number)) throw OutputClosed();
  io::raise_errno("standard output", error_number);
}

}  // namespace

void keep_standard_output_for_file() { is_output_kept = true; }

void print_text(std::string_view text) {
  if (is_output_kept) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    return;
  }
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0) fail(errno);
}

void print_json(const Json& document) {
  print_text(document.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n');
}

void print_result(bool json, const Json& document, std::string_view text) {
  json ? print_json(document) : print_text(text);
}

void close_output() {
  if (std::fclose(stdout) != 0) fail(errno);
}

void print_error(std::string_view severity, std::string_view text) {
  const std::string line = fmt::format("meshhood: {}{}\n", severity, printable_name(text));
  std::fwrite(line.data(), 1, line.size(), stderr);
}

void Rows::add(std::string_view name, std::string_view value) {
  text_ += fmt::format("{:<{}} {}\n", name, width_, value);
}

}  // namespace meshhood::cli
