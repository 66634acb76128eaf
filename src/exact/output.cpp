// SPDX-License-Identifier: MIT
#include "exact/output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/prefetch.h"

namespace meshhood {
namespace {

constexpr std::size_t kPartsAhead = 4;
constexpr std::size_t kIdsPerLine = kCacheLine / sizeof(VertexId);

void prefetch_ids(const VertexId* first, std::size_t count) {
  // The processor itself prefetches the rest of a long run.
  for (std::size_t i = 0; i < std::min(count, 4 * kIdsPerLine); i += kIdsPerLine) prefetch(first + i);
}

}  // namespace

void write_ids(const VertexSet& set, const IndexView& index, const Kernels& kernels, VertexId* out) {
  const std::span<const VertexSet::Part> parts = set.parts();
  const VertexId* permutation = index.permutation.empty() ? nullptr : index.permutation.data();
  std::array<VertexId, kLeafCapacity> leaf{};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto [begin, end, lanes] = parts[i];
    if (permutation != nullptr && i + kPartsAhead < parts.size()) {
      const VertexSet::Part& next = parts[i + kPartsAhead];
      prefetch_ids(permutation + next.begin, std::size_t{next.end} - next.begin);
    }
    if (parts[i].is_run()) {
      if (permutation != nullptr) {
        out = std::copy(permutation + begin, permutation + end, out);
      } else {
        std::iota(out, out + (end - begin), begin);
        out += end - begin;
      }
    } else {
      if (permutation == nullptr) std::iota(leaf.begin(), leaf.end(), begin);
      out = kernels.compress(permutation != nullptr ? permutation + begin : leaf.data(), lanes, out);
    }
  }
}

void replace_ids(const VertexSet& set, const IndexView& index, const Kernels& kernels, std::vector<VertexId>& out) {
  constexpr std::size_t kFewIds = 8;  // chosen; for more, kernels are faster
  const std::size_t size = set.count();
  if (size <= kFewIds) {
    out.resize(size);
    VertexId* id = out.data();
    set.for_each([&](std::size_t vertex) { *id++ = index.id(vertex); });
  } else {
    out.resize(size + kLeafCapacity);
    write_ids(set, index, kernels, out.data());
    out.resize(size);
  }
}

void append_ids(const VertexSet& set, const IndexView& index, const Kernels& kernels, std::vector<VertexId>& out) {
  const std::size_t before = out.size();
  const std::size_t end = before + set.count();
  out.resize(end + kLeafCapacity);
  write_ids(set, index, kernels, out.data() + before);
  out.resize(end);
}

void write_distances(const VertexSet& set, const IndexView& index, const Point& center, double* out) {
  std::visit(
      [&](auto xyz) {
        set.for_each([&](std::size_t v) { *out++ = std::sqrt(squared_distance(point(xyz, v), center)); });
      },
      index.positions);
}

}  // namespace meshhood
