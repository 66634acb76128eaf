// SPDX-License-Identifier: MIT
#include "size_limit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/messages.h"
#include "io/system.h"
#include "output.h"
#include "system.h"

namespace meshhood::cli {
namespace {

std::optional<double> free_space(const std::filesystem::path& output) {
  if (output == io::kStandardOutput) return std::nullopt;
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(output, ignored);
  const bool is_special = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  const std::filesystem::path folder = output.has_parent_path() ? output.parent_path() : ".";
  std::error_code unknown;
  const std::filesystem::space_info space = std::filesystem::space(folder, unknown);
  if (is_special || unknown || space.capacity == 0) return std::nullopt;
  return static_cast<double>(space.available);
}

/// The sizes of rows, one after the other.
struct Sample {
  double rows = 0;
  double sum = 0;
  double squares = 0;

  void add(double size) {
    rows += 1;
    sum += size;
    squares += size * size;
  }

  [[nodiscard]] double mean() const { return sum / rows; }
  [[nodiscard]] double standard_error() const {
    return std::sqrt(std::max(0.0, squares / rows - mean() * mean()) / rows);
  }
};

}  // namespace

std::optional<BatchEstimate> estimate(const SearchMethod& method, const BatchQuery& query) {
  constexpr std::size_t kSamples = 256;
  constexpr std::size_t kSamplesPerStep = 4;
  // Vertices, about half a second. Counted rather than timed, so that every machine draws the same sample.
  constexpr double kMostWork = 0x1p26;
  const std::size_t rows = query.vertices.count(method.vertex_count());
  if (rows <= kSamples) return std::nullopt;
  std::mt19937_64 random(1);
  std::vector<VertexId> vertices(kSamplesPerStep);
  std::vector<double> radii(kSamplesPerStep);
  const BatchRadius radius = query.radius.list() ? BatchRadius(radii) : query.radius;
  Sample sample;
  // A call of a scan, or of a search that copies the positions, also takes a time that grows with the mesh.
  const auto work_of_call = static_cast<double>(method.vertex_count());
  for (double work = 0; sample.rows < kSamples && work < kMostWork;
       work = sample.sum + work_of_call * sample.rows / kSamplesPerStep) {
    for (std::size_t i = 0; i < kSamplesPerStep; ++i) {
      const std::size_t row = random() % rows;
      vertices[i] = query.vertices[row];
      if (query.radius.list()) radii[i] = (*query.radius.list())[row];
    }
    for (const std::uint64_t size : counts(method, {.vertices = vertices, .radius = radius, .metric = query.metric})) {
      sample.add(static_cast<double>(size));
    }
  }
  const auto of_all_rows = [rows](double size) {
    return BatchSize{rows, static_cast<std::uint64_t>(static_cast<double>(rows) * size)};
  };
  return BatchEstimate{of_all_rows(sample.mean()),
                       of_all_rows(std::max(0.0, sample.mean() - 3 * sample.standard_error()))};
}

SizeLimit::SizeLimit(std::string output, std::optional<std::uint64_t> max_bytes)
    : output_(std::move(output)), is_free_space_(!max_bytes) {
  if (max_bytes) {
    bytes_ = static_cast<double>(*max_bytes);
  } else if (const std::optional<double> space = free_space(path_of(output_))) {
    bytes_ = *space;
  }
}

void SizeLimit::check(const BatchSize& size, double bytes, std::string_view about) const {
  if (bytes <= bytes_) return;
  constexpr int kDigits = 4;  // of two numbers that may be close
  const std::string limit = is_free_space_ ? fmt::format("the disk has {} free", bytes_text(bytes_, kDigits))
                                           : fmt::format("the limit is {}", bytes_text(bytes_, kDigits));
  raise(
      ErrorCode::TooLarge,
      fmt::format("{}: {} rows with {}{} vertices take {}{}, but {}; --max-bytes sets another limit",
                  io::printable_name(output_), size.rows, about, size.count, about, bytes_text(bytes, kDigits), limit));
}

}  // namespace meshhood::cli
