// SPDX-License-Identifier: MIT
#include "output.h"

#include <cerrno>
#include <cstdio>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "meshhood/error.h"

namespace meshhood::cli {
namespace {

[[noreturn]] void refuse_output(int reason) {
  if (reason == EPIPE) throw BrokenPipe();
  raise(ErrorCode::IoFailure, "standard output: " + std::generic_category().message(reason));
}

}  // namespace

void print_text(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (!written || std::fflush(stdout) != 0) refuse_output(errno);
}

void print_json(const Json& document) {
  print_text(document.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n');
}

void close_output() {
  if (std::fclose(stdout) != 0) refuse_output(errno);
}

std::string printable(std::string_view text) {
  std::string line;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      line += fmt::format("\\x{:02x}", byte);
    } else {
      line += c;
    }
  }
  return line;
}

void Rows::add(std::string_view name, std::string_view value) {
  text_ += fmt::format("{:<{}} {}\n", name, width_, value);
}

void print_error(std::string_view severity, std::string_view text) {
  const std::string line = fmt::format("meshhood: {}{}\n", severity, printable(text));
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace meshhood::cli
