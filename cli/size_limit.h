// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "meshhood/batch.h"

namespace meshhood::cli {

/// The size of the answer of a batch.
struct BatchSize {
  std::size_t rows = 0;
  std::uint64_t count = 0;  ///< of vertices in all rows
};

/// An estimate from random rows.
struct BatchEstimate {
  BatchSize mean;
  BatchSize lower;  ///< three standard errors below the mean
};

/// Takes about half a second. Empty for few rows, which are counted as fast.
[[nodiscard]] std::optional<BatchEstimate> estimate(const SearchMethod& method, const BatchQuery& query);

/// How large an output file may become: as the user says, otherwise the free space of its disk; unlimited if that is
/// unknown.
class SizeLimit {
 public:
  SizeLimit(std::string output, std::optional<std::uint64_t> max_bytes);

  /// Throws Error{TooLarge} if `bytes`, the size of the file for an answer of `size`, exceeds the limit. `about` is for
  /// the message: "at least " for a lower bound.
  void check(const BatchSize& size, double bytes, std::string_view about = "") const;

 private:
  std::string output_;
  bool is_free_space_;
  double bytes_ = std::numeric_limits<double>::infinity();
};

}  // namespace meshhood::cli
