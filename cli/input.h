// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/paper.h"
#include "meshhood/serialize.h"

#include "io/mesh_io.h"
#include "io/readers.h"
#include "parts/manifest.h"
#include "task.h"

namespace meshhood::cli {

/// A mesh or an index, and how it is read: --weld and --precision as typed; empty without.
struct Reading {
  std::string file = {};
  std::string weld = {};
  std::string precision = {};
};

// --weld: the mesh with vertices at the same place joined (io/weld.h), in the numbering of the file. The faces name
// only kept vertices. The others have their positions, and are in no face; where an option names one, the kept vertex
// is taken.

/// What was typed, as a number; 0 if none was.
[[nodiscard]] double eps_of(const std::string& weld);

/// EPS for positions that differ by rounding, as a note names it: a thousandth of the mean edge, in one digit.
[[nodiscard]] std::string rounding_eps(double mean_edge);

/// For each vertex the one that it becomes, itself if it is kept. Throws as `io::welded_ids`.
[[nodiscard]] std::vector<VertexId> kept_vertices(const PositionsView& positions, double eps);

/// Which vertices of a mesh have become others.
class Welding {
 public:
  /// Nothing is welded.
  Welding() = default;

  /// Welds the mesh of `file`, as `weld` says, and prints a note. Throws Error{InvalidOption, InvalidMesh}.
  Welding(io::Mesh& mesh, const std::string& weld, const std::string& file);

  /// The vertex that `v` has become.
  [[nodiscard]] VertexId kept(VertexId v) const { return kept_.empty() ? v : kept_[v]; }

  /// By vertex: the one that it has become; empty if all are kept.
  [[nodiscard]] const std::vector<VertexId>& kept() const { return kept_; }

  /// How many are not kept.
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  std::vector<VertexId> kept_;
  std::size_t count_ = 0;
};

/// Whether `read_others_by` has set a reader of other formats.
[[nodiscard]] bool reads_others();

/// The masks of --walls and --ignored, and of vertices without a position: each empty, or #V.
struct OwnedMasks {
  std::vector<std::uint8_t> walls;
  std::vector<std::uint8_t> ignored;
};

/// FILE: a mesh, or an index, which represents the mesh it was built from.
///
/// Each form is derived from the content of the file when it is first needed. Of indexes, only an exact one that was
/// saved with faces has faces. An index of the paper has no edges; commands that need edges call `need_edges` first.
class Input {
 public:
  /// Reads the file, prints the warnings of the reader, and welds the mesh as --weld says. Throws as `io::read_mesh`,
  /// `io::load`, `Welding` and `parts::read_plan`; Error{InvalidOption} if `reading` says anything of an index.
  explicit Input(const Reading& reading, unsigned threads = kAllProcessors);

  /// As on the command line.
  [[nodiscard]] const std::string& name() const { return name_; }

  /// The mesh; null if the file is an index.
  [[nodiscard]] const io::Mesh* mesh() const { return mesh_ ? &*mesh_ : nullptr; }

  /// The content of the file as PLY, if the reader that `read_others_by` has set has read it, which reads it again;
  /// otherwise empty.
  [[nodiscard]] std::string other_as_ply() const;

  /// The header of the index. The file must be an index.
  [[nodiscard]] const IndexHeader& header() const { return *header_; }

  /// Of the index of a part, what its folder says of the whole mesh; otherwise null.
  [[nodiscard]] const parts::Plan* plan() const { return plan_ ? &*plan_ : nullptr; }

  /// Throws Error{InvalidRadius} if the file is the index of a part, which knows no more than its halo, and the radius
  /// is larger.
  void need_halo(double radius) const;

  [[nodiscard]] std::size_t vertex_count() const;

  [[nodiscard]] const Welding& welding() const { return welding_; }

  /// Throws Error{InvalidOption} if the file has no edges. `purpose` is for the message: "--method bfs".
  void need_edges(const std::string& purpose) const;

  /// The same if it has no faces.
  void need_faces(const std::string& purpose) const;

  /// In the numbering of the mesh. Borrowed, as all views below.
  [[nodiscard]] PositionsView positions();

  /// By vertex: the first vertex at its position. Computed at the first use, then kept.
  [[nodiscard]] const std::vector<VertexId>& first_at_position();

  /// The file must have edges.
  [[nodiscard]] GraphView graph();

  /// The mesh; of an index without faces only the vertices, with a warning that a picture has only these.
  [[nodiscard]] MeshView surface();

  /// #V, or empty: the vertices without a position, which `surface` has where another vertex is.
  [[nodiscard]] std::span<const std::uint8_t> unplaced() const;

  /// What all searches leave out, beside vertices without a position. Before the first use of the index.
  void set_masks(OwnedMasks masks);
  [[nodiscard]] bool has_masks() const { return !masks_.walls.empty() || !masks_.ignored.empty(); }
  [[nodiscard]] bool is_wall(VertexId v) const { return !masks_.walls.empty() && masks_.walls[v] != 0; }

  /// Throws Error{InvalidOption} if a vertex has no position, which only searches of the exact index pass by. `method`
  /// is for the message: "--method bfs".
  void need_positions(const std::string& method) const;

  /// Ignores the vertices that have become others by welding, too, which are still at their places. For what finds
  /// vertices by their places, connected or not.
  void ignore_welded();

  /// From now on `exact_index` is what `change` makes of it. Before the first use of the index.
  void change_index(std::function<Index(const Index& index, unsigned threads)> change);

  /// With the masks. The file must have edges.
  [[nodiscard]] const Index& exact_index(unsigned threads = kAllProcessors);

  /// The file must have edges or be an index of the paper.
  [[nodiscard]] const paper::Index& paper_index();

 private:
  std::string name_;
  std::optional<io::Mesh> mesh_;
  Welding welding_;
  std::optional<Adjacency> adjacency_;  // of the mesh
  std::optional<IndexHeader> header_;
  std::optional<parts::Plan> plan_;
  std::optional<Index> exact_;
  OwnedMasks masks_;
  std::optional<Index> masked_;
  std::function<Index(const Index& index, unsigned threads)> change_;
  std::optional<Index> changed_;
  std::optional<GraphData> graph_;  // of the exact index in the file
  std::optional<paper::Index> paper_;
  std::optional<PositionsData> positions_;  // of the paper's index in the file
  std::optional<std::vector<VertexId>> first_at_position_;
};

/// Reads a mesh of at most `max_bytes`, with progress, but does not weld it, and prints the warnings of the reader.
/// Throws as `io::read_mesh`.
[[nodiscard]] io::Mesh read_mesh(const Reading& reading, unsigned threads = kAllProcessors,
                                 std::uint64_t max_bytes = io::ReadOptions{}.max_bytes);

/// Reads and verifies an index, with progress. Throws as `io::load`.
[[nodiscard]] io::LoadedIndex load_index(const std::string& file);

[[nodiscard]] std::string_view kind_name(IndexKind kind);

/// Builds an index of a `MeshView` or a `GraphView`, with progress.
template <class Mesh>
[[nodiscard]] Index build_exact_index(const Mesh& mesh, unsigned threads) {
  Task task("building the index");
  return build(mesh, {.threads = threads, .progress = task.progress()});
}
template <class Mesh>
[[nodiscard]] paper::Index build_paper_index(const Mesh& mesh) {
  Task task("building the index of the paper");
  return paper::build(mesh, {}, {.progress = task.progress()});
}

}  // namespace meshhood::cli
