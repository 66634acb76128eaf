// SPDX-License-Identifier: MIT
#include "batch/position_sort.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace meshhood::inline v0_1 {
namespace {

constexpr unsigned kDigitBits = 11;
constexpr std::size_t kDigits = 1U << kDigitBits;

// The number of rows that one thread counts and moves. Their counts take a sixteenth of the memory of the rows.
constexpr std::size_t kChunk = 1U << 15;

/// How many rows of a chunk have each digit; then the place of the next one.
using Places = std::array<std::size_t, kDigits>;

/// Turns the counts of the chunks into places. Returns false if all `rows` have the same digit.
bool set_places(std::span<Places> chunks, std::size_t rows) {
  Places next{};
  for (const Places& counts : chunks) std::ranges::transform(next, counts, next.begin(), std::plus<>());
  if (std::ranges::find(next, rows) != next.end()) return false;
  std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t{0});
  for (Places& places : chunks) {
    for (std::size_t digit = 0; digit < kDigits; ++digit) {
      next[digit] += std::exchange(places[digit], next[digit]);
    }
  }
  return true;
}

}  // namespace

void sort_by_position(RawVector<std::uint64_t>& rows, TaskContext& task) {
  if (std::ranges::is_sorted(rows, {}, [](std::uint64_t row) { return row >> 32; })) return;
  RawVector<std::uint64_t> next(rows.size());
  std::vector<Places> chunks((rows.size() + kChunk - 1) / kChunk);
  for (unsigned shift = 32; shift < 64; shift += kDigitBits) {
    // Calls `f(place, row)` for all rows, on all threads.
    const auto for_each_row = [&](auto&& f) {
      task.parallel_for(rows.size(), kChunk, [&](unsigned /*thread*/, std::size_t begin, std::size_t end) {
        Places& places = chunks[begin / kChunk];
        for (std::size_t i = begin; i < end; ++i) {
          f(places[static_cast<std::size_t>((rows[i] >> shift) % kDigits)], rows[i]);
        }
      });
    };
    std::ranges::fill(chunks, Places{});
    for_each_row([](std::size_t& count, std::uint64_t) { ++count; });
    if (!set_places(chunks, rows.size())) continue;
    for_each_row([&](std::size_t& place, std::uint64_t row) { next[place++] = row; });
    rows.swap(next);
  }
}

}  // namespace meshhood::inline v0_1
