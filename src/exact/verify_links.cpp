// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "exact/verify.h"

namespace meshhood::inline v0_1::file {
namespace {

/// Returns a cross edge as one number, which orders cross edges by `from`, then `to`.
unsigned number_of(unsigned from, unsigned to) { return from * kLeafCapacity + to; }

class LinkCheck {
 public:
  LinkCheck(const IndexView& index, const SectionReader& file)
      : index_(index),
        file_(file),
        links_(index.links.size() - 1),
        cross_edges_(index.cross_edges.size() - kLeafCapacity) {}

  void run() {
    check_ends();
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) check_leaf(leaf);
    check_connected();
    check_count();
    check_back();
    verify_padding(index_.cross_edges.subspan(cross_edges_), file_);
  }

 private:
  [[nodiscard]] std::size_t begin(std::size_t leaf) const { return index_.leaves[leaf].first_link; }
  [[nodiscard]] std::size_t end(std::size_t leaf) const { return index_.leaves[leaf + 1].first_link; }

  /// The links of consecutive leaves must follow one another without a gap, up to the last link.
  void check_ends() const {
    if (begin(0) != 0) file_.refuse(&index_.leaves.front().first_link, "the links of leaf 0 do not begin at link 0");
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) {
      if (begin(leaf) > end(leaf) || end(leaf) > links_) {
        file_.refuse(&index_.leaves[leaf + 1].first_link,
                     "leaf " + std::to_string(leaf) + ": links " + std::to_string(begin(leaf)) + " to " +
                         std::to_string(end(leaf)) + ", but there are " + std::to_string(links_) + " links");
      }
    }
    if (index_.leaves.back().first_link != links_) {
      file_.refuse(&index_.leaves.back().first_link, "the links end at " +
                                                         std::to_string(index_.leaves.back().first_link) +
                                                         ", but there are " + std::to_string(links_) + " links");
    }
    const Link& last = index_.links.back();
    if (index_.links.front().first_cross_edge != 0 || last.leaf != 0 || last.boundary != 0 ||
        last.first_cross_edge != cross_edges_) {
      file_.refuse(&last, "the last record does not mark the end of " + std::to_string(cross_edges_) + " cross edges");
    }
  }

  void check_leaf(std::size_t leaf) const {
    for (std::size_t i = begin(leaf); i < end(leaf); ++i) {
      const Link& link = index_.links[i];
      const bool is_next = i == begin(leaf) || index_.links[i - 1].leaf < link.leaf;
      if (link.leaf >= index_.leaf_count() || link.leaf == leaf || !is_next) {
        file_.refuse(&link, name(leaf, link) + ": expected another of " + std::to_string(index_.leaf_count()) +
                                " leaves, in ascending order");
      }
      if (link.first_cross_edge >= index_.links[i + 1].first_cross_edge ||
          index_.links[i + 1].first_cross_edge > cross_edges_) {
        file_.refuse(&link.first_cross_edge,
                     name(leaf, link) + ": cross edges " + std::to_string(link.first_cross_edge) + " to " +
                         std::to_string(index_.links[i + 1].first_cross_edge) + " of " + std::to_string(cross_edges_));
      }
      check_cross_edges(leaf, i);
    }
  }

  void check_cross_edges(std::size_t leaf, std::size_t i) const {
    const Link& link = index_.links[i];
    LaneMask boundary = 0;
    int last = -1;
    for (const CrossEdge& cross_edge : index_.cross_edges_of(link)) {
      if (cross_edge.from >= index_.leaves[leaf].size || cross_edge.to >= index_.leaves[link.leaf].size) {
        file_.refuse(&cross_edge, name(leaf, link) + ": cross edge from lane " + std::to_string(cross_edge.from) +
                                      " to lane " + std::to_string(cross_edge.to) + ", but a leaf has no such lane");
      }
      const auto number = static_cast<int>(number_of(cross_edge.from, cross_edge.to));
      if (number <= last) file_.refuse(&cross_edge, name(leaf, link) + ": the cross edges are not in ascending order");
      last = number;
      boundary |= LaneMask{1} << cross_edge.from;
    }
    if (boundary != link.boundary) {
      file_.refuse(&link.boundary, name(leaf, link) + ": the boundary does not match the cross edges");
    }
  }

  /// The search takes a node whose links it follows as a connected whole.
  void check_connected() const {
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) {
      if (index_.leaves[leaf].connected || begin(leaf) == end(leaf)) continue;
      file_.refuse(&index_.leaves[leaf], "leaf " + std::to_string(leaf) + ": it has links, but is not connected");
    }
  }

  /// `extract_graph` needs the number of neighbors to fit into its type.
  void check_count() const {
    std::uint64_t neighbors = cross_edges_;
    for (const LaneMask row : index_.adjacency) neighbors += static_cast<std::uint64_t>(std::popcount(row));
    if (neighbors > kMaxNeighbors) {
      file_.refuse(&index_.links.back(),
                   std::to_string(neighbors) + " neighbors, but the limit is " + std::to_string(kMaxNeighbors));
    }
  }

  /// The loop visits leaves in ascending order, and so do the links of each leaf: the link back to this leaf must be
  /// the next one of the linked leaf that has not been matched yet.
  void check_back() {
    std::vector<std::uint32_t> next;
    next.reserve(index_.leaf_count());
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) next.push_back(index_.leaves[leaf].first_link);
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) {
      for (std::size_t i = begin(leaf); i < end(leaf); ++i) {
        const Link& link = index_.links[i];
        const std::size_t back = next[link.leaf]++;
        if (back >= end(link.leaf) || index_.links[back].leaf != leaf || !has_same_edges(link, index_.links[back])) {
          file_.refuse(&link, name(leaf, link) + ": no link back with the same edges");
        }
      }
    }
  }

  [[nodiscard]] bool has_same_edges(const Link& link, const Link& back) {
    reversed_.clear();
    for (const CrossEdge& edge : index_.cross_edges_of(back)) reversed_.push_back(number_of(edge.to, edge.from));
    std::sort(reversed_.begin(), reversed_.end());
    const auto there = index_.cross_edges_of(link);
    return std::equal(there.begin(), there.end(), reversed_.begin(), reversed_.end(),
                      [](const CrossEdge& c, unsigned number) { return number_of(c.from, c.to) == number; });
  }

  static std::string name(std::size_t leaf, const Link& link) {
    return "link from leaf " + std::to_string(leaf) + " to leaf " + std::to_string(link.leaf);
  }

  const IndexView& index_;
  const SectionReader& file_;
  std::size_t links_;
  std::size_t cross_edges_;
  std::vector<unsigned> reversed_;
};

}  // namespace

void verify_links(const IndexView& index, const SectionReader& file) { LinkCheck(index, file).run(); }

}  // namespace meshhood::inline v0_1::file
