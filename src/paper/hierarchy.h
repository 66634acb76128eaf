// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "meshhood/fingerprint.h"
#include "meshhood/paper.h"

#include "paper/packed_ids.h"
#include "shared/distance.h"

namespace meshhood::paper {

/// A level of the finished index (3.1). Clusters are numbered so that the children of each cluster, and its vertices,
/// are contiguous.
template <class Real>
struct Level {
  int number = 0;                      // the base level is 0
  double mean_radius = 0;              // `ar` of sec. 3.3
  std::vector<Sphere<Real>> spheres;   // by cluster
  std::vector<VertexId> first_vertex;  // in index order; one entry more than clusters
  std::vector<ClusterId> first_child;  // on the level below; one entry more than clusters, empty on the lowest level
  std::vector<ClusterId> parent;       // on the level above; empty on the highest level
  Adjacency siblings;

  [[nodiscard]] std::size_t size() const { return first_vertex.empty() ? 0 : first_vertex.size() - 1; }
};

/// The whole index: levels, lowest first, and the vertices in index order.
template <class Real>
struct Hierarchy {
  std::vector<Real> positions;     // #V by 3, in index order
  std::vector<VertexId> vertices;  // in index order: the caller's vertex
  PackedIds lowest_cluster;        // by vertex: its cluster on the lowest level
  std::vector<Level<Real>> levels;
};

using AnyHierarchy = std::variant<Hierarchy<float>, Hierarchy<double>>;

struct Index::Storage {
  AnyHierarchy hierarchy;
  Fingerprint mesh;  // computed by the build, because the graph is not kept
};

}  // namespace meshhood::paper
