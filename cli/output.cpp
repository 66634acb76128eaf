// SPDX-License-Identifier: MIT
#include "output.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "io/system.h"
#include "system.h"

namespace meshhood::cli {
namespace {

bool is_output_kept = false;

[[noreturn]] void fail(int error_number) {
  if (is_closed_pipe(error_number)) io::raise_errno(io::kStandardOutput, EPIPE);
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

std::string bytes_text(double bytes, int digits) {
  constexpr std::array<std::string_view, 6> kUnits{"bytes", "kB", "MB", "GB", "TB", "PB"};
  if (bytes < 1000) return fmt::format("{:.0f} bytes", bytes);
  std::size_t unit = 0;
  // 999.6 kB would be rounded to 1e+03 kB.
  const double most = 1000 - std::pow(10.0, 3 - digits) / 2;
  for (; bytes >= most && unit + 1 < kUnits.size(); ++unit) bytes /= 1000;
  return fmt::format("{:.{}g} {}", bytes, digits, kUnits[unit]);
}

}  // namespace meshhood::cli
