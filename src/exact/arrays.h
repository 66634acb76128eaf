// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "meshhood/adjacency.h"

#include "exact/layout.h"
#include "shared/raw_vector.h"

namespace meshhood::inline v0_1 {

/// The arrays of an `IndexView` that follow from the edges and from the division into leaves. Indexes that `refit` has
/// made share them.
struct ConnectivityData {
  RawVector<VertexId> permutation;
  RawVector<std::uint32_t> slot;
  std::vector<VertexId> leaf_begin;
  std::vector<Link> links;
  std::vector<CrossEdge> cross_edges;
  RawVector<LaneMask> adjacency;
  std::vector<std::uint32_t> levels;
  std::vector<GroupRecord> records;
  std::vector<NodeId> parents;
  std::vector<NodeLink> node_links;
};

/// Positions in index order, padded.
using OrderedPositions = std::variant<RawVector<float>, RawVector<double>>;

/// The arrays that change with the positions.
struct GeometryData {
  Frame frame;
  OrderedPositions positions;
  std::vector<Leaf> leaves;
  std::vector<Group> groups;
  std::vector<double> mean_radii;
};

/// All arrays of an `IndexView`, filled by `build`.
struct IndexData : ConnectivityData, GeometryData {};

[[nodiscard]] PositionsInOrder view_of(const OrderedPositions& positions);

/// A view of `data`, which must outlive it. Without `tree` if the groups are not filled yet.
[[nodiscard]] IndexView view_of(const IndexData& data);

/// A view that owns `data`.
[[nodiscard]] std::shared_ptr<IndexView> make_view(IndexData data);

/// Makes `view` own `geometry`, and refer to it. If memory runs out, `view` is as it was.
void set_geometry(IndexView& view, std::shared_ptr<GeometryData> geometry);

}  // namespace meshhood::inline v0_1
