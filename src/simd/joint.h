// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "meshhood/mesh.h"

#include "base/frame.h"
#include "simd/kernels.h"
#include "simd/leaf.h"

/// The inner loops of the joint search, which answers up to 32 queries of one leaf at once. As in `Kernels`, each
/// function gives the same result on every processor, bit for bit.
namespace meshhood::inline v0_1 {

static_assert(kPacketCapacity == kLeafCapacity);

/// The state of a leaf in a packet: words for each vertex.
struct LeafWords {
  PerLane<QueryWord> inside;   // the queries whose ball holds the vertex
  PerLane<QueryWord> reached;  // the queries whose answer holds the vertex, so far
  PerLane<QueryWord> pending;  // the queries that reach a neighbor in another leaf; not yet compared with `inside`
};

/// The queries that reached each vertex of a leaf for the first time in the last step.
using FreshWords = PerLane<QueryWord>;

/// The vertices of a leaf in frame units, relative to the center of a group. Lanes without a vertex hold zeros.
struct LeafPoints : PointPerLane<float> {
  PerLane<float> square;  // of the length
};

/// The center of a group in the unit of the mesh, which floats hold exactly, and the scale of the frame.
struct FloatCenter {
  float x;
  float y;
  float z;
  float scale;  // a power of two
};

/// The balls of a packet, relative to the same center. A vertex p is compared with the ball around q by `2 p.q - p.p`,
/// which is at least `q.q - r^2` where p is inside. The points are twice the query vertices.
struct PacketBalls : PointPerLane<float> {
  PerLane<float> surely_inside;  // >=; infinite for queries that do not exist
  PerLane<float> maybe_inside;   // >=; likewise
  // The center of the leaf of the queries, and bounds on squared distances from it.
  FramePoint center;
  float inside_all;   // a vertex nearer than this is in all balls
  float outside_all;  // a vertex farther than this is in none
  QueryWord queries;  // those that exist
};

struct BallWords {
  QueryWord all;      // the queries whose ball holds every vertex of the leaf; without those in doubt
  LaneMask in_doubt;  // the lanes whose word in `doubts` is not 0
};

struct SpreadWords {
  LaneMask gained;  // the lanes whose word in `reached` has grown
  bool closed;      // every vertex is reached by all queries that hold it: nothing can be added
};

/// A leaf of an answer: its words, and its first vertex in index order.
struct LeafOfWords {
  std::uint32_t words;
  std::uint32_t first;
};

/// The leaves `begin .. end - 1`. Their vertices follow each other in index order.
struct LeafRun {
  std::uint32_t begin;
  std::uint32_t end;

  friend bool operator==(const LeafRun&, const LeafRun&) = default;
};

/// A part of the answer of a packet: leaves that some queries have as a whole, or one leaf with a word for each vertex.
struct Piece {
  LeafRun leaves;
  QueryWord queries;         // those that have all vertices; 0 for a leaf with words
  const QueryWord* reached;  // the 32 words of a leaf, of which those without a vertex are 0; else null

  [[nodiscard]] bool is_run() const { return reached == nullptr; }
};

struct JointKernels {
  /// Converts `size` vertices, three coordinates each, to points relative to the center. Reads 32 vertices.
  void (*convert_points)(const float* xyz, unsigned size, const FloatCenter& center, LeafPoints& points);

  /// Sets `reached` and `pending` to 0. A compiler might do it by a call or a string instruction, which takes longer.
  void (*clear_words)(LeafWords& words);

  /// Fills `inside` with the queries that surely hold each vertex, and `doubts` of the lanes `in_doubt` with those that
  /// only the exact predicate can decide. `lanes` has the vertices that exist; the others get empty words.
  BallWords (*ball_words)(const LeafPoints& points, LaneMask lanes, const PacketBalls& balls,
                          PerLane<QueryWord>& inside, PerLane<QueryWord>& doubts);

  /// Moves what is pending to `reached`, and on along the edges within the leaf, for each query through the vertices in
  /// its ball. `whole` has the queries that reach all vertices if they reach one. Reads all 32 rows of `adjacency`.
  SpreadWords (*spread_words)(LeafWords& words, const LaneMask* adjacency, QueryWord whole);

  /// Takes one step along the edges, for the queries `alive`: what is pending, and what is fresh at a neighbor within
  /// the leaf, becomes reached and fresh at the lanes `open` where it was not reached before. `from` has the lanes
  /// whose words were fresh, and so reached. Returns the lanes with fresh words. Reads all 32 rows of `adjacency`, and
  /// no `inside`.
  LaneMask (*step_words)(LeafWords& words, FreshWords& fresh, const LaneMask* adjacency, LaneMask from, LaneMask open,
                         QueryWord alive);

  /// Adds to `counts` how many vertices each query reaches in the leaves of `list`.
  void (*count_words)(const LeafWords* words, std::span<const LeafOfWords> list, PerLane<std::uint64_t>& counts);

  /// Returns the vertices of a leaf that the query reaches. `reached` has 32 words.
  LaneMask (*lanes_of)(const QueryWord* reached, unsigned query);

  /// Writes the vertices that the query has in `pieces`, as `permutation` names them, or by their numbers where it is
  /// null. `leaf_begin` has the first vertex of each leaf. `out` has room for exactly these.
  void (*write_row)(std::span<const Piece> pieces, const VertexId* leaf_begin, unsigned query,
                    const VertexId* permutation, std::span<VertexId> out);
};

/// Pushes words over the edges between two leaves. It is scalar on every processor, because a link has six edges on
/// average.
inline void push_words(std::span<const CrossEdge> edges, const PerLane<QueryWord>& reached,
                       PerLane<QueryWord>& pending) {
  for (const CrossEdge& edge : edges) pending[edge.to] |= reached[edge.from];
}

/// Returns the kernels for `isa`, which the processor must have.
[[nodiscard]] const JointKernels& joint_kernels(Isa isa);

/// The lengths of the shortest paths to a vertex so far, for each query of a packet; infinite if there is none.
using PathLengths = PerLane<double>;

/// An edge to a vertex, by the number that the search gives it.
struct PathEdge {
  double length;
  std::uint32_t end;
};

/// The inner loops of shortest paths from up to 32 vertices at once.
struct PathKernels {
  /// Follows up to 32 edges from a vertex, for all queries: where the path over an edge is shorter, its length replaces
  /// that at the end of the edge. Returns the set of edges, by their place in `edges`, at whose ends some length became
  /// shorter. `all` has the lengths by vertex, `from` those of the vertex, which is the end of none of the edges.
  std::uint32_t (*follow_edges)(const PathLengths& from, std::span<const PathEdge> edges, PathLengths* all);

  /// Returns the queries whose path to a vertex is at most as long as their limit.
  QueryWord (*within_limits)(const PathLengths& lengths, const PathLengths& limits);
};

/// Returns the kernels for `isa`, which the processor must have.
[[nodiscard]] const PathKernels& path_kernels(Isa isa);

}  // namespace meshhood::inline v0_1
