// SPDX-License-Identifier: MIT
#include "exact/query/local_graph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <variant>

#include "base/distance.h"
#include "exact/search/vertex_set.h"

namespace meshhood {
namespace {

constexpr std::size_t kEdgesAtOnce = 4;
constexpr std::size_t kMostOwnEdges = kLeafCapacity * (kLeafCapacity - 1) / 2;

/// The edges within a leaf, each once.
struct OwnEdges {
  std::array<CrossEdge, kMostOwnEdges + kEdgesAtOnce> edges;
  std::size_t count = 0;

  explicit OwnEdges(std::span<const LaneMask> adjacency) {
    constexpr LaneMask kNotEmpty = LaneMask{1} << (kLeafCapacity - 1);
    for (unsigned lane = 0; lane < adjacency.size(); ++lane) {
      // How many there are cannot be predicted, so some are written at once, and only counted if they exist.
      for (LaneMask left = adjacency[lane] & ~first_lanes(lane + 1); left != 0;) {
        const std::size_t found = std::min(count_of(left), kEdgesAtOnce);
        for (std::size_t i = 0; i < kEdgesAtOnce; ++i, left &= left - 1) {
          const auto to = static_cast<std::uint8_t>(std::countr_zero(left | kNotEmpty));
          edges[count + i] = {static_cast<std::uint8_t>(lane), to};
        }
        count += found;
      }
    }
  }
};

}  // namespace

LocalGraph::LocalGraph(const IndexView& index) : index_(&index), numbers_(index.leaf_count()) {}

void LocalGraph::clear() {
  leaves_.clear();
  rows_.clear();
  edge_count_ = 0;
  if (++search_ == 0) {
    std::fill(numbers_.begin(), numbers_.end(), Number{});
    search_ = 1;
  }
}

std::uint32_t LocalGraph::meet(LeafId leaf) {
  Number& number = numbers_[leaf];
  if (number.search == search_) return number.number;
  number = {search_, static_cast<std::uint32_t>(leaves_.size())};
  const Leaf& record = index_->leaves[leaf];
  leaves_.push_back({0, leaf, record.first, false});
  rows_.resize(rows_.size() + kLeafCapacity + 1);
  fetch_lines(&index_->links[record.first_link], 2);
  fetch_lines(&index_->adjacency[record.first], 2);
  prefetch_positions(*index_, record.first, record.size);
  return number.number;
}

void LocalGraph::add_rows(std::uint32_t number) {
  const LeafId id = leaves_[number].leaf;
  const Leaf& leaf = index_->leaves[id];
  const std::span<const Link> links = index_->links_of(id);
  leaves_[number].first_edge = edge_count_;
  leaves_[number].has_rows = true;
  std::array<std::uint32_t, kLeafCapacity + 1> ends{};
  count_edges(leaf, links, ends);
  std::uint32_t begin = 0;
  for (std::uint32_t& end : ends) begin += std::exchange(end, begin);
  std::copy(ends.begin(), ends.end(), &rows_[std::size_t{number} * (kLeafCapacity + 1)]);
  if (edges_.size() < edge_count_ + begin) edges_.resize(edge_count_ + begin);
  Edge* const edges = edges_.data() + edge_count_;
  edge_count_ += begin;
  std::visit(
      [&](auto xyz) {
        std::array<Point, kLeafCapacity> points;
        for (std::size_t lane = 0; lane < leaf.size; ++lane) points[lane] = point(xyz, leaf.first + lane);
        add_own_edges(number, std::span(points).first(leaf.size), edges, ends);
        add_cross_edges(xyz, links, points, edges, ends);
      },
      index_->positions);
}

void LocalGraph::count_edges(const Leaf& leaf, std::span<const Link> links, Rows counts) const {
  for (unsigned lane = 0; lane < leaf.size; ++lane) {
    counts[lane] = static_cast<std::uint32_t>(count_of(index_->adjacency[leaf.first + lane]));
  }
  if (links.empty()) return;
  // Those of all links lie one after the other.
  const std::size_t end = (&links.back() + 1)->first_cross_edge;
  for (std::size_t i = links.front().first_cross_edge; i < end; ++i) ++counts[index_->cross_edges[i].from];
}

void LocalGraph::add_own_edges(std::uint32_t number, std::span<const Point> points, Edge* edges, Rows ends) const {
  const std::uint32_t first = kLeafCapacity * number;
  const OwnEdges own(index_->adjacency.subspan(leaves_[number].first, points.size()));
  for (std::size_t i = 0; i < own.count; ++i) {
    const auto [a, b] = own.edges[i];
    const double length = std::sqrt(squared_distance(points[a], points[b]));
    edges[ends[a]++] = {length, first + b};
    edges[ends[b]++] = {length, first + a};
  }
}

template <class Real>
void LocalGraph::add_cross_edges(std::span<const Real> xyz, std::span<const Link> links, std::span<const Point> points,
                                 Edge* edges, Rows ends) {
  for (const Link& link : links) {
    const std::uint32_t first = kLeafCapacity * meet(link.leaf);
    const std::size_t vertex = index_->leaf_begin[link.leaf];
    for (const CrossEdge& edge : index_->cross_edges_of(link)) {
      const double length = std::sqrt(squared_distance(points[edge.from], point(xyz, vertex + edge.to)));
      edges[ends[edge.from]++] = {length, first + edge.to};
    }
  }
}

double LocalGraph::mean_length() const {
  double sum = 0;
  for (const Edge& edge : std::span(edges_).first(edge_count_)) sum += edge.length;
  return edge_count_ == 0 ? 0 : sum / static_cast<double>(edge_count_);
}

}  // namespace meshhood
