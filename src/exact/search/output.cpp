// SPDX-License-Identifier: MIT
#include "exact/search/output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/prefetch.h"

namespace meshhood {
namespace {

constexpr std::size_t kRunsAhead = 4;  // or subsets
constexpr std::size_t kIdsPerLine = kCacheLine / sizeof(VertexId);

void prefetch_ids(const VertexId* first, std::size_t count) {
  // The processor itself prefetches the rest of a long run.
  for (std::size_t i = 0; i < std::min(count, 4 * kIdsPerLine); i += kIdsPerLine) prefetch(first + i);
}

VertexId* write_runs(std::span<const VertexRange> runs, const VertexId* permutation, VertexId* out) {
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (i + kRunsAhead < runs.size()) {
      const VertexRange next = runs[i + kRunsAhead];
      prefetch_ids(permutation + next.begin, std::size_t{next.end} - next.begin);
    }
    out = std::copy(permutation + runs[i].begin, permutation + runs[i].end, out);
  }
  return out;
}

void write_subsets(std::span<const LeafSubset> subsets, const IndexView& index, const Kernels& kernels, VertexId* out) {
  const VertexId* permutation = index.permutation.data();
  for (std::size_t i = 0; i < subsets.size(); ++i) {
    if (i + kRunsAhead < subsets.size()) {
      prefetch_ids(permutation + index.leaf_begin[subsets[i + kRunsAhead].leaf], kLeafCapacity);
    }
    out = kernels.compress(permutation + index.leaf_begin[subsets[i].leaf], subsets[i].lanes, out);
  }
}

/// For an index whose order is the caller's.
void write_index_order(const VertexSet& set, const IndexView& index, const Kernels& kernels, VertexId* out) {
  for (const VertexRange& run : set.runs()) {
    std::iota(out, out + (run.end - run.begin), run.begin);
    out += run.end - run.begin;
  }
  std::array<VertexId, kLeafCapacity> leaf{};
  for (const LeafSubset& subset : set.subsets()) {
    std::iota(leaf.begin(), leaf.end(), index.leaf_begin[subset.leaf]);
    out = kernels.compress(leaf.data(), subset.lanes, out);
  }
}

}  // namespace

void write_ids(const VertexSet& set, const IndexView& index, const Kernels& kernels, VertexId* out) {
  if (index.permutation.empty()) {
    write_index_order(set, index, kernels, out);
  } else {
    out = write_runs(set.runs(), index.permutation.data(), out);
    write_subsets(set.subsets(), index, kernels, out);
  }
}

void write_distances(const VertexSet& set, const IndexView& index, const Point& center, double* out) {
  std::visit(
      [&](auto xyz) {
        set.for_each([&](std::size_t v) { *out++ = std::sqrt(squared_distance(point(xyz, v), center)); });
      },
      index.positions);
}

}  // namespace meshhood
