// SPDX-License-Identifier: MIT
// A path over a surface has edges, and straight lines over two triangles that share a side. Both are edges of a graph
// in which the index then searches paths as along the edges of the mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/surface.h"

#include "base/lists.h"
#include "base/vector.h"
#include "exact/index_access.h"
#include "exact/weighted_graph.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr double kNoLine = kInfinity;

/// Returns the elements of each vertex, sorted. `for_each` is that of `gather_rows`.
template <class T, class ForEach>
Lists<T, std::size_t> sorted_lists(std::size_t vertices, ForEach&& for_each) {
  auto lists = gather_lists<T, std::size_t>(vertices, for_each);
  for (std::size_t v = 0; v < vertices; ++v) {
    std::ranges::sort(std::span(lists.elements).subspan(lists.offsets[v], lists[v].size()));
  }
  return lists;
}

/// A side of a triangle from a vertex to one with a larger number.
struct SharedSide {
  VertexId to;
  VertexId opposite;  // corner of the triangle

  friend auto operator<=>(const SharedSide&, const SharedSide&) = default;
};

struct Line {
  VertexId to;
  double length;

  friend auto operator<=>(const Line&, const Line&) = default;
};

/// Returns the length of the straight line from `c` to `d` over the triangles abc and bad, unfolded into a plane. It is
/// infinite if the line does not cross the side ab between its ends: then a shortest path over the two has edges only.
double unfolded_length(const Point& a, const Point& b, const Point& c, const Point& d) {
  const double side = length(b - a);
  if (side == 0) return kNoLine;
  // Returns coordinates along the side, and away from it.
  const auto in_plane = [&](const Point& p) {
    const double along = dot(p - a, b - a) / side;
    return std::pair(along, length(p - a - along / side * (b - a)));
  };
  const auto [along_c, away_c] = in_plane(c);
  const auto [along_d, away_d] = in_plane(d);
  const double away = away_c + away_d;
  if (away == 0) return kNoLine;
  const double crossing = (along_c * away_d + along_d * away_c) / away;
  if (!(0 < crossing && crossing < side)) return kNoLine;
  const double along = along_c - along_d;
  return std::sqrt(along * along + away * away);
}

/// Makes the graph of the edges of the index and the lines over the triangles of a surface.
class SurfaceGraph {
 public:
  SurfaceGraph(const SurfaceState& surface, TaskContext& task)
      : index_(*surface.index),
        faces_(surface.faces()),
        triangles_(triangles_of_leaves(index_, faces_, task).elements),
        edges_(&edges_of(surface)) {}

  [[nodiscard]] WeightedGraph make() const {
    const auto sides = sorted_lists<SharedSide>(index_.vertex_count(), [&](auto&& f) { for_each_side(f); });
    const auto lines = sorted_lists<Line>(index_.vertex_count(), [&](auto&& f) {
      for_each_edge(f);
      for_each_line(sides, [&](VertexId c, VertexId d, double length) {
        f(c, {d, length});
        f(d, {c, length});
      });
    });
    Adjacency edges;
    std::vector<double> lengths;
    // The lists are kept, and hardly ever shorter than this: growing ones would keep up to twice the memory.
    edges.offsets.reserve(lines.size() + 1);
    edges.neighbors.reserve(lines.elements.size());
    lengths.reserve(lines.elements.size());
    edges.offsets.push_back(0);
    for (VertexId v = 0; v < lines.size(); ++v) {
      for (const auto& [to, length] : lines[v]) {
        const bool is_longer = edges.neighbors.size() > edges.offsets.back() && edges.neighbors.back() == to;
        if (is_longer) continue;
        edges.neighbors.push_back(to);
        lengths.push_back(length);
      }
      if (edges.neighbors.size() > kMaxNeighbors) {
        raise(ErrorCode::TooLarge, "more than " + std::to_string(kMaxNeighbors) + " edges and lines, counted twice");
      }
      edges.offsets.push_back(static_cast<EdgeOffset>(edges.neighbors.size()));
    }
    return {std::make_shared<const Adjacency>(std::move(edges)), std::move(lengths)};
  }

 private:
  static const WeightedGraph& edges_of(const SurfaceState& surface) {
    return IndexAccess::share_graph(surface.searched)->paths_of(*surface.index);
  }

  template <class F>
  void for_each_edge(F&& f) const {
    const auto& [edges, lengths] = *edges_;
    for (std::size_t v = 0; v < index_.vertex_count(); ++v) {
      for (std::size_t k = edges->offsets[v]; k < edges->offsets[v + 1]; ++k) {
        f(static_cast<VertexId>(v), {edges->neighbors[k], lengths[k]});
      }
    }
  }

  [[nodiscard]] bool is_edge(VertexId a, VertexId b) const {
    return std::ranges::binary_search(edges_->edges->view()[a], b);
  }

  /// Returns whether lines may run over a face without a wall: none of its sides is cut.
  [[nodiscard]] bool is_open(std::span<const VertexId> corners) const {
    auto previous = static_cast<VertexId>(index_.place(corners.back()));
    return std::ranges::all_of(corners, [&](VertexId corner) {
      const auto place = static_cast<VertexId>(index_.place(corner));
      const VertexId before = std::exchange(previous, place);
      return before == place || is_edge(before, place);
    });
  }

  /// Calls `f` with the sides of the triangles of open faces, of three corners each.
  template <class F>
  void for_each_side(F&& f) const {
    for (const auto& [corners, face, diagonals] : triangles_) {
      const auto [first, second, third] = corners;
      if (first == second || second == third || third == first || !is_open(faces_[face])) continue;
      for (unsigned i = 0; i < 3; ++i) {
        const auto [a, b] =
            std::minmax({static_cast<VertexId>(corners[i]), static_cast<VertexId>(corners[(i + 1) % 3])});
        f(a, {b, static_cast<VertexId>(corners[(i + 2) % 3])});
      }
    }
  }

  /// Calls `f` with lines across sides that have exactly two opposite corners, and with the sides within a polygon.
  template <class F>
  void for_each_line(const Lists<SharedSide, std::size_t>& sides, F&& f) const {
    for (VertexId a = 0; a < sides.size(); ++a) {
      const std::span<const SharedSide> row = sides[a];
      for (auto first = row.begin(); first != row.end();) {
        const VertexId b = first->to;
        const auto end = std::find_if(first, row.end(), [&](const SharedSide& side) { return side.to != b; });
        if (!is_edge(a, b)) f(a, b, length(index_.position(b) - index_.position(a)));
        const VertexId c = first->opposite;
        const VertexId d = std::prev(end)->opposite;
        const auto is_one = [&](const SharedSide& side) { return side.opposite == c || side.opposite == d; };
        if (c != d && std::all_of(first, end, is_one)) {  // a face may be listed twice
          const double length =
              unfolded_length(index_.position(a), index_.position(b), index_.position(c), index_.position(d));
          if (length != kNoLine) f(c, d, length);
        }
        first = end;
      }
    }
  }

  const IndexView& index_;
  const StoredFaces& faces_;
  std::vector<Triangle> triangles_;
  const WeightedGraph* edges_;
};

}  // namespace

Index surface_paths(const Surface& surface, const Run& run) {
  const SurfaceState& state = SurfaceAccess::state(surface);
  TaskContext task(run.threads, run.progress, 1);
  auto view = std::make_shared<IndexView>(*state.index);
  view->owner = std::make_shared<const IndexView>(*view);
  view->is_derived = true;
  view->geometry = nullptr;
  WeightedGraph lines = SurfaceGraph(state, task).make();
  auto graph = std::make_shared<KeptGraph>(IndexAccess::share_graph(state.searched)->edges(), std::move(lines));
  task.finish();
  return IndexAccess::make(std::move(view), std::move(graph));
}

}  // namespace meshhood::inline v0_1
