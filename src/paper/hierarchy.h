// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/fingerprint.h"
#include "meshhood/paper.h"

#include "shared/distance.h"

namespace meshhood::inline v0_1::paper {

/// Numbers below a common bound, each in as few bits as the bound requires. The lowest cluster of each vertex would
/// otherwise take a tenth of the index.
class PackedIds {
 public:
  PackedIds() = default;
  PackedIds(std::size_t size, std::uint64_t bound)
      : width_(bound > 1 ? static_cast<unsigned>(std::bit_width(bound - 1)) : 1),
        // One word more, because reading a number always reads two words.
        words_(size * width_ / 64 + 2) {}

  void set(std::size_t i, std::uint64_t value) {
    const std::size_t bit = i * width_;
    const unsigned shift = bit % 64;
    words_[bit / 64] |= value << shift;
    // Two shifts, because a shift by 64 is undefined.
    words_[bit / 64 + 1] |= value >> 1 >> (63 - shift);
  }

  [[nodiscard]] std::uint64_t operator[](std::size_t i) const {
    const std::size_t bit = i * width_;
    const unsigned shift = bit % 64;
    const std::uint64_t high = words_[bit / 64 + 1] << 1 << (63 - shift);
    return (words_[bit / 64] >> shift | high) & ((std::uint64_t{1} << width_) - 1);
  }

  [[nodiscard]] std::size_t bytes() const { return words_.size() * sizeof(std::uint64_t); }

 private:
  unsigned width_ = 1;  // of one number, in bits; at most 32
  std::vector<std::uint64_t> words_;
};

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

/// The whole index: levels, lowest first, and the vertices in index order. Deviation: it has the positions, where the
/// index of the paper refers to the mesh.
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

/// Computes the bounding sphere of each cluster of `level`, and their mean radius; `positions` are #V by 3, in index
/// order. Deviation: a sphere may be a little larger than the smallest (see `bounding_sphere`).
template <class Real>
void enclose(std::span<const Real> positions, Level<Real>& level);

/// Returns the mean radius of the spheres of `level`; 0 if it has none.
template <class Real>
[[nodiscard]] double mean_radius(const Level<Real>& level);

/// Fills in what follows from the rest of a hierarchy: parents, the vertices of the clusters above the lowest level,
/// and the lowest cluster of each vertex. The hierarchy has the vertices of the clusters of the lowest level, and the
/// children of the others.
template <class Real>
void derive(Hierarchy<Real>& hierarchy);

/// Lays out the levels that are kept, without their spheres.
///
/// xyz         #V by 3, in the caller's order.
/// parents     parents[l][c]: the parent, on level `l + 1`, of cluster `c` on level `l`; a base cluster is its vertex.
/// siblings    siblings[l]: of the clusters of level `l`; levels below `lowest` are not read.
/// lowest      the lowest level to keep; the highest is `parents.size()`.
template <class Real>
[[nodiscard]] Hierarchy<Real> arrange(std::span<const Real> xyz, const std::vector<std::vector<ClusterId>>& parents,
                                      const std::vector<AdjacencyView>& siblings, std::size_t lowest);

/// Gives access to the data of an index: to `build`, to files, and to tests that damage an index on purpose.
struct IndexAccess {
  [[nodiscard]] static Index make(AnyHierarchy hierarchy, const Fingerprint& mesh = {}) {
    return Index(std::make_unique<const Index::Storage>(Index::Storage{std::move(hierarchy), mesh}));
  }

  [[nodiscard]] static const Fingerprint& mesh(const Index& index) { return index.storage_->mesh; }

  [[nodiscard]] static const AnyHierarchy& hierarchy(const Index& index) { return index.storage_->hierarchy; }
};

}  // namespace meshhood::inline v0_1::paper
