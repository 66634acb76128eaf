// SPDX-License-Identifier: MIT
#include "shard.h"

#include <cstdlib>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/messages.h"
#include "io/number.h"

namespace meshhood::cli {
namespace {

constexpr const char* kTaskVariable = "SLURM_ARRAY_TASK_ID";

std::optional<std::uint64_t> task_of_array() {
  const char* const text = std::getenv(kTaskVariable);  // NOLINT(concurrency-mt-unsafe): no thread sets it
  return text == nullptr ? std::nullopt : io::parse_count(text);
}

}  // namespace

Shard parse_shard(const std::string& text) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();  // so that no product overflows
  const auto slash = text.find('/');
  const std::string_view first = std::string_view(text).substr(0, slash);
  const bool is_slurm = first == "slurm";
  const std::optional<std::uint64_t> number = is_slurm ? task_of_array() : io::parse_count(first);
  const std::optional<std::uint64_t> count =
      slash == std::string::npos ? std::nullopt : io::parse_count(std::string_view(text).substr(slash + 1));
  if (is_slurm && count && !number) {
    raise(ErrorCode::InvalidOption, fmt::format("--shard {}: {} is not set to a number", text, kTaskVariable));
  }
  if (!number || !count || *count == 0 || *count > kMost) {
    raise(ErrorCode::InvalidOption,
          fmt::format("--shard {}, expected i/N or slurm/N, with i from 1 to N", io::quote(text)));
  }
  if (*number == 0 || *number > *count) {
    const std::string advice = is_slurm ? fmt::format(": submit the array with --array=1-{}", *count) : "";
    raise(ErrorCode::InvalidOption, fmt::format("--shard: number {}, expected 1 to {}{}", *number, *count, advice));
  }
  return {*number, *count};
}

}  // namespace meshhood::cli
