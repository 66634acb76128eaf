// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/index.h"
#include "meshhood/reference.h"
#include "meshhood/search.h"

#include "exact/index_access.h"
#include "exact/query/single_queries.h"

namespace meshhood::test {

/// Every instruction set with kernels that this processor has.
inline std::vector<Isa> available_isas() {
  std::vector<Isa> all;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(best_isa()); ++i) all.push_back(static_cast<Isa>(i));
  return all;
}

/// The next smaller double, the number itself, and the next larger double.
inline std::vector<double> around(double radius) {
  return {std::nextafter(radius, 0.0), radius, std::nextafter(radius, std::numeric_limits<double>::infinity())};
}

/// A searcher for each kernel.
inline std::vector<Searcher> searchers_of(const Index& index) {
  std::vector<Searcher> searchers;
  for (const Isa isa : available_isas()) {
    searchers.emplace_back(index);
    SearcherAccess::set_isa(searchers.back(), isa);
  }
  return searchers;
}

/// An index of a mesh and the reference search, which other tests compare with the oracle.
class ExactAnswer {
 public:
  explicit ExactAnswer(const MeshView& mesh) : ExactAnswer(mesh, build(mesh)) {}

  /// `index`: made in another way than by `build`.
  ExactAnswer(const MeshView& mesh, Index index)
      : mesh_(mesh),
        reference_(mesh),
        index_(std::move(index)),
        searchers_(searchers_of(index_)),
        stamp_(index_.vertex_count()) {}

  /// Compares ids, count, ranges and distances of one query with the reference; the kernels take turns.
  void query(VertexId v, double radius) {
    Searcher& searcher = searchers_[queries_++ % searchers_.size()];
    reference_.neighborhood(v, radius, expected_);
    searcher.neighborhood(v, radius, ids_, distances_);
    const bool right = same_set() && right_distances(v) && searcher.count(v, radius) == expected_.size() &&
                       right_ranges(searcher.ranges(v, radius));
    EXPECT_TRUE(right) << "vertex " << v << ", radius " << radius << ": " << ids_.size() << " vertices instead of "
                       << expected_.size();
    mismatches_ += static_cast<std::size_t>(!right);
  }

  [[nodiscard]] const Index& index() const { return index_; }
  [[nodiscard]] const IndexView& storage() const { return IndexAccess::view(index_); }
  [[nodiscard]] std::vector<Searcher>& searchers() { return searchers_; }
  [[nodiscard]] const std::vector<VertexId>& answer() const { return ids_; }
  [[nodiscard]] GraphView graph() const { return {mesh_.positions, reference_.adjacency()}; }
  [[nodiscard]] std::size_t queries() const { return queries_; }
  [[nodiscard]] std::size_t mismatches() const { return mismatches_; }

 private:
  bool same_set() {
    ++round_;
    for (const VertexId w : expected_) stamp_[w] = round_;
    for (const VertexId w : ids_) {
      if (w >= stamp_.size() || stamp_[w] != round_) return false;
      stamp_[w] = 0;  // a second occurrence is an error
    }
    return ids_.size() == expected_.size();
  }

  bool right_distances(VertexId v) {
    if (distances_.size() != ids_.size()) return false;
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      if (distances_[i] != distance(mesh_.positions, v, ids_[i])) return false;
    }
    return true;
  }

  bool right_ranges(std::span<const VertexRange> ranges) {
    ids_.clear();
    for (const VertexRange& range : ranges) {
      if (range.begin >= range.end || range.end > index_.vertex_count()) return false;
      for (std::size_t i = range.begin; i < range.end; ++i) ids_.push_back(index_.permutation()[i]);
    }
    return same_set();
  }

  MeshView mesh_;
  ReferenceSearcher reference_;
  Index index_;
  std::vector<Searcher> searchers_;
  std::vector<std::uint64_t> stamp_;  // by vertex: the round that expects it
  std::uint64_t round_ = 0;
  std::vector<VertexId> expected_;
  std::vector<VertexId> ids_;
  std::vector<double> distances_;
  std::size_t queries_ = 0;
  std::size_t mismatches_ = 0;
};

}  // namespace meshhood::test
