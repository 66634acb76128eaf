// SPDX-License-Identifier: MIT
#include "meshhood/index.h"

#include <string>
#include <utility>

#include "meshhood/error.h"

#include "exact/index_access.h"
#include "exact/layout.h"
#include "exact/weighted_graph.h"

namespace meshhood::inline v0_1 {
namespace {

template <class T>
std::size_t bytes_of(std::span<const T> values) {
  return values.size_bytes();
}

std::size_t bytes_of(const PositionsInOrder& positions) {
  return std::visit([](auto xyz) { return xyz.size_bytes(); }, positions);
}

}  // namespace

Index::Index(std::shared_ptr<IndexView> view) : view_(std::move(view)), graph_(std::make_shared<KeptGraph>()) {}

IndexView& Index::view() const {
  IndexView& view = *view_;
  if (!view.is_current()) BoundIndex::raise_outdated();
  return view;
}

void BoundIndex::raise_outdated() {
  raise(ErrorCode::InvalidOption,
        "the index was refitted in place, expected `rebind` of the searcher, `refit_in_place` of the surface, or a new "
        "masked index, before the next call");
}

const IndexView& IndexAccess::whole(const Index& index, const char* done) {
  const IndexView& view = index.view();
  if (!view.is_derived) return view;
  raise(ErrorCode::InvalidOption, std::string("an index with masks or surface paths is not ") + done +
                                      ", expected the index that it was made from");
}

std::size_t Index::vertex_count() const { return view().vertex_count(); }

PositionsView Index::positions() const& {
  return std::visit([&](auto xyz) { return PositionsView(xyz.first(3 * vertex_count())); }, view().positions);
}

std::span<const VertexId> Index::permutation() const& {
  const std::span<const VertexId> padded = view().permutation;
  return padded.empty() ? padded : padded.first(view().vertex_count());
}

std::span<const VertexId> Index::leaf_starts() const& { return view().leaf_begin; }

std::optional<FacesView> Index::faces() const& {
  const std::optional<StoredFaces>& faces = view().faces;
  if (!faces) return std::nullopt;
  return faces->view();
}

std::vector<LevelSummary> Index::levels() const {
  std::vector<LevelSummary> result;
  for (const TreeLevel& level : view().tree) {
    result.push_back({.level = static_cast<int>(result.size()),
                      .clusters = level.nodes,
                      .mean_vertices = static_cast<double>(level.vertices) / static_cast<double>(level.nodes),
                      .mean_radius = level.mean_radius / view().frame.scale,
                      .mean_siblings = 0,
                      .bytes = level.groups * (sizeof(Group) + sizeof(GroupRecord))});
  }
  if (result.empty()) return result;
  // Links between nodes above the leaves are not counted. The last link is an end marker.
  LevelSummary& leaves = result.front();
  leaves.mean_siblings = static_cast<double>(view().links.size() - 1) / static_cast<double>(leaves.clusters);
  leaves.bytes += bytes_of(view().leaves) + bytes_of(view().leaf_begin);
  return result;
}

IndexBytes Index::bytes() const {
  IndexBytes result;
  for_each_array([&](ArrayInfo info, const auto& array) { result.*info.bytes += bytes_of(array); }, view());
  return result;
}

}  // namespace meshhood::inline v0_1
