// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/frame.h"
#include "base/vector.h"
#include "exact/layout.h"
#include "exact/stored_faces.h"
#include "patch/triangles.h"
#include "shared/distance.h"
#include "surface/box_tree.h"

namespace meshhood {

using ClusterId = std::uint32_t;

/// Sums over the triangles of a cluster. Lengths are in the frame, points in the unit of the mesh.
struct Cluster {
  BoundingBox box;
  double radius;  // of a bounding sphere about the center
  double area;
  Point vector_area;           // the sum of area times normal
  double moment;               // the sum of area times the distance of the plane from `center`, along the normal
  std::uint32_t first_link;    // in `Clusters::links`
  std::uint32_t first_hub;     // in `Clusters::hubs`
  std::uint32_t first_corner;  // in `Clusters::corners`
  bool has_border;

  [[nodiscard]] Point center() const { return 0.5 * box.low + 0.5 * box.high; }
};

/// The triangles of one other cluster that share a corner with a cluster, if that is no hub.
struct ClusterLink {
  ClusterId cluster;
  std::uint32_t first;  // in `Clusters::linked`
};

/// What a search takes at once where it lies inside a ball, and finds at once where it lies far away.
struct Clusters {
  /// A corner of more triangles is a hub: links do not list its triangles, which many clusters would.
  static constexpr std::size_t kMostLinked = 64;

  std::vector<Cluster> clusters;             // and one more, for the end of the last links, hubs and corners
  std::vector<ClusterLink> links;            // and one more, for the end of the last triangles
  std::vector<TriangleId> linked;            // ascending
  std::vector<std::uint32_t> hubs;           // places
  std::vector<std::uint32_t> corners;        // the places at each cluster, ascending
  std::vector<ClusterId> of_triangle;        // the cluster of each
  std::vector<std::uint32_t> first_of_leaf;  // by leaf, and one more: in `of_leaf`
  std::vector<ClusterId> of_leaf;            // those with a corner in it, ascending
  BoxTree boxes;                             // of the clusters

  Clusters(const IndexView& index, const Triangles& triangles);

  [[nodiscard]] std::size_t bytes() const;

  [[nodiscard]] std::size_t size() const { return clusters.size() - 1; }

  [[nodiscard]] std::span<const ClusterLink> links_of(ClusterId cluster) const {
    return std::span(links).subspan(clusters[cluster].first_link,
                                    clusters[cluster + std::size_t{1}].first_link - clusters[cluster].first_link);
  }

  [[nodiscard]] std::span<const std::uint32_t> hubs_of(ClusterId cluster) const {
    return std::span(hubs).subspan(clusters[cluster].first_hub,
                                   clusters[cluster + std::size_t{1}].first_hub - clusters[cluster].first_hub);
  }

  [[nodiscard]] std::span<const std::uint32_t> corners_of(ClusterId cluster) const {
    return std::span(corners).subspan(clusters[cluster].first_corner,
                                      clusters[cluster + std::size_t{1}].first_corner - clusters[cluster].first_corner);
  }

  [[nodiscard]] std::span<const ClusterId> at_leaf(LeafId leaf) const {
    return std::span(of_leaf).subspan(first_of_leaf[leaf], first_of_leaf[leaf + std::size_t{1}] - first_of_leaf[leaf]);
  }

  /// `link` must be an element of `links`.
  [[nodiscard]] std::span<const TriangleId> linked_by(const ClusterLink& link) const {
    return std::span(linked).subspan(link.first, (&link + 1)->first - link.first);
  }

 private:
  void link(const Triangles& triangles, ClusterId cluster);
  void list_by_leaf(const IndexView& index);
};

/// What all searches of the patches of a surface share. The walls of the index are left out.
struct PatchState {
  /// Borrows the index and the faces.
  PatchState(const IndexView& given, const StoredFaces& all)
      : index(&given), faces(&all), triangles(given, all), clusters(given, triangles) {}

  const IndexView* index;
  const StoredFaces* faces;
  Triangles triangles;
  Clusters clusters;

  /// Whether the vertices of a patch that are in its ball are the neighborhood of its center, but for loose edges,
  /// diagonals, and sides that dip into the ball.
  [[nodiscard]] bool follows_neighborhoods() const { return triangles.are_of_index && index->ignored.empty(); }

  [[nodiscard]] std::size_t bytes() const { return triangles.bytes() + clusters.bytes(); }
};

}  // namespace meshhood
