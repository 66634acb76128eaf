// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "exact/verify.h"

namespace meshhood::file {
namespace {

/// An edge across a link as one number, ascending as cross_edges do.
unsigned number_of(unsigned mine, unsigned other) { return mine * kLeafCapacity + other; }

class LinkCheck {
 public:
  LinkCheck(const IndexView& index, const SectionReader& file)
      : index_(index),
        file_(file),
        links_(index.links.size() - 1),
        crossings_(index.cross_edges.size() - kLeafCapacity) {}

  void run() {
    check_ends();
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) check_leaf(leaf);
    check_count();
    check_back();
    verify_padding(index_.cross_edges.subspan(crossings_), file_);
  }

 private:
  [[nodiscard]] std::size_t begin(std::size_t leaf) const { return index_.leaves[leaf].first_link; }
  [[nodiscard]] std::size_t end(std::size_t leaf) const { return index_.leaves[leaf + 1].first_link; }

  [[nodiscard]] std::span<const CrossEdge> cross_edges(std::size_t link) const {
    const std::size_t first = index_.links[link].first_cross_edge;
    return index_.cross_edges.subspan(first, index_.links[link + 1].first_cross_edge - first);
  }

  /// Leaves have links, and links have cross_edges, without a gap and to the last.
  void check_ends() const {
    if (begin(0) != 0) file_.refuse(&index_.leaves.front().first_link, "links of leaf 0 do not begin with link 0");
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) {
      if (begin(leaf) > end(leaf) || end(leaf) > links_) {
        file_.refuse(&index_.leaves[leaf + 1].first_link,
                     "leaf " + std::to_string(leaf) + ": links from " + std::to_string(begin(leaf)) + " to " +
                         std::to_string(end(leaf)) + ", but there are " + std::to_string(links_));
      }
    }
    if (index_.leaves.back().first_link != links_) {
      file_.refuse(&index_.leaves.back().first_link, "links end with " +
                                                         std::to_string(index_.leaves.back().first_link) +
                                                         ", but there are " + std::to_string(links_));
    }
    const Link& last = index_.links.back();
    if (index_.links.front().first_cross_edge != 0 || last.leaf != 0 || last.boundary != 0 ||
        last.first_cross_edge != crossings_) {
      file_.refuse(&last, "not the end of " + std::to_string(crossings_) + " crossings that begin with 0");
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
          index_.links[i + 1].first_cross_edge > crossings_) {
        file_.refuse(&link.first_cross_edge,
                     name(leaf, link) + ": crossings from " + std::to_string(link.first_cross_edge) + " to " +
                         std::to_string(index_.links[i + 1].first_cross_edge) + " of " + std::to_string(crossings_));
      }
      check_crossings(leaf, i);
    }
  }

  void check_crossings(std::size_t leaf, std::size_t i) const {
    const Link& link = index_.links[i];
    LaneMask boundary = 0;
    int last = -1;
    for (const CrossEdge& cross_edge : cross_edges(i)) {
      if (cross_edge.from >= index_.leaves[leaf].size || cross_edge.to >= index_.leaves[link.leaf].size) {
        file_.refuse(&cross_edge, name(leaf, link) + ": a crossing from lane " + std::to_string(cross_edge.from) +
                                      " to " + std::to_string(cross_edge.to) + ", which the leaves do not have");
      }
      const auto number = static_cast<int>(number_of(cross_edge.from, cross_edge.to));
      if (number <= last) file_.refuse(&cross_edge, name(leaf, link) + ": crossings do not ascend");
      last = number;
      boundary |= LaneMask{1} << cross_edge.from;
    }
    if (boundary != link.boundary)
      file_.refuse(&link.boundary, name(leaf, link) + ": a border that is not where they cross");
  }

  /// What `graph` gives has room in its own type.
  void check_count() const {
    std::uint64_t neighbors = crossings_;
    for (const LaneMask row : index_.adjacency) neighbors += static_cast<std::uint64_t>(std::popcount(row));
    if (neighbors > kMaxNeighbors) {
      file_.refuse(&index_.links.back(),
                   std::to_string(neighbors) + " neighbours, but the limit is " + std::to_string(kMaxNeighbors));
    }
  }

  /// As leaves come in ascending order, the links back to them must follow one another in each leaf.
  void check_back() {
    std::vector<std::uint32_t> next;
    next.reserve(index_.leaf_count());
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) next.push_back(index_.leaves[leaf].first_link);
    for (std::size_t leaf = 0; leaf < index_.leaf_count(); ++leaf) {
      for (std::size_t i = begin(leaf); i < end(leaf); ++i) {
        const Link& link = index_.links[i];
        const std::size_t back = next[link.leaf]++;
        if (back >= end(link.leaf) || index_.links[back].leaf != leaf || !is_same_edge_list(i, back)) {
          file_.refuse(&link, name(leaf, link) + ": not the same edges lead back");
        }
      }
    }
  }

  [[nodiscard]] bool is_same_edge_list(std::size_t link, std::size_t back) {
    reversed_.clear();
    for (const CrossEdge& cross_edge : cross_edges(back))
      reversed_.push_back(number_of(cross_edge.to, cross_edge.from));
    std::sort(reversed_.begin(), reversed_.end());
    const auto there = cross_edges(link);
    return std::equal(there.begin(), there.end(), reversed_.begin(), reversed_.end(),
                      [](const CrossEdge& c, unsigned number) { return number_of(c.from, c.to) == number; });
  }

  static std::string name(std::size_t leaf, const Link& link) {
    return "a link from leaf " + std::to_string(leaf) + " to " + std::to_string(link.leaf);
  }

  const IndexView& index_;
  const SectionReader& file_;
  std::size_t links_;
  std::size_t crossings_;
  std::vector<unsigned> reversed_;
};

}  // namespace

void verify_links(const IndexView& index, const SectionReader& file) { LinkCheck(index, file).run(); }

}  // namespace meshhood::file
