// SPDX-License-Identifier: MIT
#include "exact/search/output.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "base/prefetch.h"

namespace meshhood {
namespace {

constexpr std::size_t kPiecesAhead = 4;
constexpr std::size_t kIdsPerLine = 64 / sizeof(VertexId);

/// The number of lanes. As std::popcount, which is a call into a library where the oldest processors are compiled for.
std::size_t size_of(LaneMask lanes) {
  lanes -= lanes >> 1 & 0x55555555U;
  lanes = (lanes & 0x33333333U) + (lanes >> 2 & 0x33333333U);
  return ((lanes + (lanes >> 4)) & 0x0F0F0F0FU) * 0x01010101U >> 24;
}

void fetch_ids(const VertexId* first, std::size_t count) {
  // What follows in a long run, the processor fetches by itself.
  for (std::size_t i = 0; i < std::min(count, 4 * kIdsPerLine); i += kIdsPerLine) prefetch(first + i);
}

VertexId* copy_runs(const VertexSet& answer, const VertexId* permutation, VertexId* out) {
  for (std::size_t i = 0; i < answer.runs.size(); ++i) {
    if (i + kPiecesAhead < answer.runs.size()) {
      const VertexRange next = answer.runs[i + kPiecesAhead];
      fetch_ids(permutation + next.begin, std::size_t{next.end} - next.begin);
    }
    const VertexRange run = answer.runs[i];
    out = std::copy(permutation + run.begin, permutation + run.end, out);
  }
  return out;
}

VertexId* copy_subsets(const VertexSet& answer, const IndexView& index, const Kernels& kernels, VertexId* out) {
  const VertexId* permutation = index.permutation.data();
  for (std::size_t i = 0; i < answer.subsets.size(); ++i) {
    if (i + kPiecesAhead < answer.subsets.size()) {
      fetch_ids(permutation + index.leaf_begin[answer.subsets[i + kPiecesAhead].leaf], kLeafCapacity);
    }
    const LeafSubset& subset = answer.subsets[i];
    out = kernels.compress(permutation + index.leaf_begin[subset.leaf], subset.lanes, out);
  }
  return out;
}

/// Where the caller's order is that of the index.
void write_places(const VertexSet& answer, const IndexView& index, const Kernels& kernels, VertexId* out) {
  for (const VertexRange& run : answer.runs) {
    std::iota(out, out + (run.end - run.begin), run.begin);
    out += run.end - run.begin;
  }
  std::array<VertexId, kLeafCapacity> leaf{};
  for (const LeafSubset& subset : answer.subsets) {
    std::iota(leaf.begin(), leaf.end(), index.leaf_begin[subset.leaf]);
    out = kernels.compress(leaf.data(), subset.lanes, out);
  }
}

}  // namespace

std::size_t count(const VertexSet& answer) {
  std::size_t result = 0;
  for (const VertexRange& run : answer.runs) result += std::size_t{run.end} - run.begin;
  for (const LeafSubset& subset : answer.subsets) result += size_of(subset.lanes);
  return result;
}

void write_ids(const VertexSet& answer, const IndexView& index, const Kernels& kernels, VertexId* out) {
  if (index.permutation.empty()) {
    write_places(answer, index, kernels, out);
  } else {
    VertexId* end = copy_runs(answer, index.permutation.data(), out);
    copy_subsets(answer, index, kernels, end);
  }
}

void write_distances(const VertexSet& answer, const IndexView& index, const Point& centre, double* out) {
  std::visit(
      [&](auto xyz) {
        const auto append = [&](std::size_t vertex) {
          *out++ = std::sqrt(squared_distance(point(xyz, vertex), centre));
        };
        for (const VertexRange& run : answer.runs) {
          for (VertexId vertex = run.begin; vertex < run.end; ++vertex) append(vertex);
        }
        for (const LeafSubset& subset : answer.subsets) {
          const std::size_t first = index.leaf_begin[subset.leaf];
          for (LaneMask left = subset.lanes; left != 0; left &= left - 1) {
            append(first + static_cast<std::size_t>(std::countr_zero(left)));
          }
        }
      },
      index.positions);
}

void append_subsets_as_runs(const IndexView& index, VertexSet& answer) {
  for (const LeafSubset& subset : answer.subsets) {
    const VertexId first = index.leaf_begin[subset.leaf];
    for (std::uint64_t left = subset.lanes; left != 0;) {
      const auto begin = static_cast<unsigned>(std::countr_zero(left));
      const auto end = begin + static_cast<unsigned>(std::countr_one(left >> begin));
      answer.runs.push_back({static_cast<VertexId>(first + begin), static_cast<VertexId>(first + end)});
      left = left >> end << end;
    }
  }
  answer.subsets.clear();
}

}  // namespace meshhood
