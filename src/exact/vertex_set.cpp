// SPDX-License-Identifier: MIT
#include "exact/vertex_set.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "base/prefetch.h"
#include "base/ranges.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::size_t kPartsAhead = 4;
constexpr std::size_t kIdsPerLine = kCacheLine / sizeof(VertexId);

void prefetch_ids(const VertexId* first, std::size_t count) {
  // The processor prefetches the rest of a long run.
  for (std::size_t i = 0; i < std::min(count, 4 * kIdsPerLine); i += kIdsPerLine) prefetch(first + i);
}

}  // namespace

void VertexSet::assign(std::span<const LeafSubset> subsets) {
  clear();
  sorted_.assign(subsets.begin(), subsets.end());
  std::sort(sorted_.begin(), sorted_.end(), [](const LeafSubset& a, const LeafSubset& b) { return a.leaf < b.leaf; });
  for (std::size_t i = 0, end = 0; i < sorted_.size(); i = end) {
    LeafSubset all = sorted_[i];
    for (end = i + 1; end < sorted_.size() && sorted_[end].leaf == all.leaf; ++end) all.lanes |= sorted_[end].lanes;
    add_lanes(all);
  }
}

void VertexSet::align_to_leaves() {
  unaligned_.assign(parts().begin(), parts().end());
  clear();
  LeafSubset last{0, 0};
  VertexRange leaf = vertices_of(0);
  const auto move_to = [&](LeafId next) {
    if (last.lanes != 0) add_lanes(leaf, last.lanes);
    last = {next, 0};
    leaf = vertices_of(next);
  };
  // Most moves are to the next leaf; a lookup for each would take as long as the search.
  const auto move_to_vertex = [&](VertexId vertex) {
    if (vertex < leaf.end) return;
    const bool is_next = vertex < vertices_of(last.leaf + 1).end;
    move_to(is_next ? last.leaf + 1 : leaf_of(index_->slot_at(vertex)));
  };
  for (const Part& part : unaligned_) {
    LaneMask lanes = part.lanes;
    while (lanes != 0) {
      const auto first = static_cast<unsigned>(std::countr_zero(lanes));
      move_to_vertex(static_cast<VertexId>(part.begin + first));
      const LaneMask later = leaf.end < part.end ? ~first_lanes(leaf.end - part.begin) : 0;
      const LaneMask now = lanes & ~later;
      last.lanes |= leaf.begin < part.begin ? now << (part.begin - leaf.begin) : now >> (leaf.begin - part.begin);
      lanes &= later;
    }
    if (!part.is_run()) continue;
    VertexId begin = part.begin;
    while (begin < part.end) {
      move_to_vertex(begin);
      if (begin == leaf.begin && leaf.end < part.end) {
        move_to(leaf_of(index_->slot_at(part.end - 1)));
        add(VertexRange{begin, leaf.begin});
        begin = leaf.begin;
      }
      const VertexId end = std::min(part.end, leaf.end);
      last.lanes |= first_lanes(end - begin) << (begin - leaf.begin);  // NOLINT(clang-analyzer-core.BitwiseShift)
      begin = end;
    }
  }
  add_lanes(leaf, last.lanes);
}

void VertexSet::collect(std::vector<LeafSubset>& found) const {
  for (const Part& part : parts()) {
    LeafId leaf = leaf_of(index_->slot_at(part.begin));
    for (; leaf + 1 < index_->leaf_begin.size() && index_->leaf_begin[leaf] < part.end; ++leaf) {
      const auto all = first_lanes(static_cast<unsigned>(vertices_of(leaf).size()));
      found.push_back({leaf, part.is_run() ? all : part.lanes});
    }
  }
}

void VertexSet::leave_out(std::span<const LaneMask> by_leaf) {
  sorted_.clear();
  collect(sorted_);
  clear();
  for (const auto& [leaf, lanes] : sorted_) add_lanes({leaf, lanes & ~by_leaf[leaf]});
}

void VertexSet::assign_difference(const VertexSet& all, const VertexSet& part) {
  clear();
  auto taken = part.parts().begin();
  for (Part rest : all.parts()) {
    const auto is_taken = [&] { return taken != part.parts().end() && taken->begin < rest.end; };
    if (rest.is_run()) {
      for (; is_taken(); ++taken) {
        if (rest.begin < taken->begin) add(VertexRange{rest.begin, taken->begin});
        if (!taken->is_run()) {
          const LaneMask left = first_lanes(taken->end - taken->begin) & ~taken->lanes;
          add(Part{taken->begin, taken->end, left});
        }
        rest.begin = taken->end;
      }
      if (rest.begin < rest.end) add(VertexRange{rest.begin, rest.end});
    } else {
      for (; is_taken(); ++taken) rest.lanes &= ~taken->lanes;
      if (rest.lanes != 0) add(rest);
    }
  }
}

std::span<const VertexRange> VertexSet::ranges() {
  ranges_.clear();
  for (const Part& part : parts()) {
    if (part.is_run()) {
      append_to(ranges_, VertexRange{part.begin, part.end});
      continue;
    }
    for (std::uint64_t left = part.lanes; left != 0;) {
      const auto begin = static_cast<unsigned>(std::countr_zero(left));
      const auto end = begin + static_cast<unsigned>(std::countr_one(left >> begin));
      append_to(ranges_,
                VertexRange{static_cast<VertexId>(part.begin + begin), static_cast<VertexId>(part.begin + end)});
      left = left >> end << end;
    }
  }
  return ranges_;
}

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

}  // namespace meshhood::inline v0_1
