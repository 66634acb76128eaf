// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/batch.h"
#include "meshhood/run.h"
#include "meshhood/surface.h"

#include "input.h"
#include "io/npz_writer.h"
#include "options.h"
#include "output.h"
#include "table_file.h"
#include "task.h"
#include "vertex_files.h"

/// The commands that compute a quantity of each row: numbers of a vertex at one or several radii. What is read, which
/// rows, the files and what is printed are one for all; a new command is a `Quantity`.
namespace meshhood::cli {

/// The words of every command that computes a row for each vertex: which rows, their radii, and what the searches may
/// pass.
struct RowOptions {
  std::string vertices;  ///< a file with a list; empty for all
  std::string points;    ///< a file with points in space, instead of vertices
  Radii radii;
  std::string row_radii;  ///< a file with a radius for each row, instead
  MaskFiles masks;
  std::string metric = "straight";
  unsigned threads = kAllProcessors;

  [[nodiscard]] bool has_radii() const { return !radii.values.empty() || !row_radii.empty(); }

  /// The length of the first axis of the result.
  [[nodiscard]] std::size_t scale_count() const { return row_radii.empty() ? radii.values.size() : 1; }
};

/// --radius, --radii, --unit, --vertices, --walls, --ignored and --threads. See `add_metric` for the metric.
void add_rows(CLI::App& command, RowOptions& options);

/// Throws Error{InvalidOption} without radii.
void need_radii(const RowOptions& options);

/// What these options mean for an input.
class RowQuery {
 public:
  /// Borrows from `input`, whose masks it sets. Throws as `resolve`, `read_vertex_list` and `read_channel`.
  RowQuery(const RowOptions& options, Input& input);
  RowQuery(const RowQuery&) = delete;  // `rows_` may borrow from `list_`
  RowQuery& operator=(const RowQuery&) = delete;

  /// In the unit of the positions: those of all rows, or one for each row. Empty if none were given.
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }

  /// The number of rows. A row of a vertex that was welded is that of the one that it has become.
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Those of --points, if it is given. Each is a row, of the point of the surface nearest to it.
  [[nodiscard]] const std::optional<std::vector<SpacePoint>>& points() const { return points_; }

  /// The query of all scales, for calls whose results have a leading axis for them; of the first of them; or of another
  /// radius. Borrows from this object.
  [[nodiscard]] BatchRadius all_radii() const { return are_of_rows_ ? of_rows() : BatchRadius::scales(radii_); }
  [[nodiscard]] BatchQuery query() const { return query(all_radii()); }
  [[nodiscard]] BatchQuery query_of_first() const { return query(are_of_rows_ ? of_rows() : radii_[0]); }
  [[nodiscard]] BatchQuery query(BatchRadius radius) const;

  /// For the array `vertices` of the result: none if the rows are those of all vertices. Borrows from this object.
  [[nodiscard]] BatchVertices listed() const { return list_ ? BatchVertices(*list_) : BatchVertices(); }

 private:
  [[nodiscard]] BatchRadius of_rows() const { return radii_; }

  std::optional<std::vector<VertexId>> list_;
  std::optional<std::vector<SpacePoint>> points_;
  BatchVertices rows_;
  Metric metric_;
  std::size_t size_;
  bool are_of_rows_;
  std::vector<double> radii_;
};

/// Writes the array `vertices`, if the query vertices are listed.
void write_vertices(io::NpzWriter& npz, const BatchVertices& rows);

/// Writes the array `radii`: (scales,), or (1, rows) if each row has its own.
void write_radii(io::NpzWriter& npz, const BatchRadius& radius);

/// The names of the files; "" for one that was not requested. A mesh has the values for ParaView, PyVista and MeshLab.
struct ValueFiles {
  TableFile table;
  std::string ply;
  std::string vtk;

  [[nodiscard]] bool has_mesh() const { return !ply.empty() || !vtk.empty(); }
  [[nodiscard]] const std::string& first() const { return !table.name.empty() ? table.name : !ply.empty() ? ply : vtk; }
};

/// What is computed: an array, with `scales` by `channels` by `kinds` numbers of each row, scale after scale.
struct Column {
  std::string name;
  std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::int64_t>, std::vector<std::uint64_t>>
      numbers;
  std::size_t scales = 0;    ///< 0: the array has no axis of scales
  std::size_t channels = 0;  ///< 0: the array has no axis of channels
  bool is_array = true;      ///< of the .npz; otherwise only of text and meshes
  std::size_t kinds = 0;     ///< of the numbers of each channel; 0: the array has no axis of kinds
  bool of_triangle = false;  ///< three channels are of its corners, no vector: text numbers them, and no mesh has them
};

/// Of points of the surface: the faces, the distances, the points, the vertices of the triangles, whose name is given,
/// and the barycentric coordinates in these. Faces and vertices are -1 where there is no point.
[[nodiscard]] std::vector<Column> columns_of(const std::vector<SurfacePoint>& points, const std::string& vertices,
                                             std::size_t scales = 0);

/// The same of one point, as JSON has it.
[[nodiscard]] Json json_of(const SurfacePoint& point);

/// One number of each row, or a vector of three: of a table of text, and unless its numbers have 64 bits, which float
/// does not keep, of a mesh.
struct Property {
  std::string name;
  std::size_t column;
  std::size_t first;   ///< the place of that of row 0
  std::size_t stride;  ///< from one row to the next
  std::size_t width = 1;
  std::string csv_name = {};  ///< instead of `name`; or empty
};

/// The result of a quantity.
struct RowTable {
  std::size_t rows;
  std::size_t scales = 1;
  std::vector<double> radii = {};             ///< of the scales, or with --radii of the rows
  std::vector<std::string> scale_names = {};  ///< the radii as typed; empty with --radii
  std::vector<std::string> kinds = {};        ///< names on the last axis, an array of their own; or empty
  std::vector<Column> columns = {};
  std::vector<Property> properties = {};
  std::string shown = {};                       ///< the property that a program shows at once, MeshLab as `quality`
  std::vector<std::uint8_t> colors = {};        ///< #V by 3 for PLY, or empty
  Json summary = {};                            ///< what JSON says beside the files, rows and radii
  std::string text = {};                        ///< the same for people
  bool of_vertices = true;                      ///< otherwise columns say of what the rows are
  std::optional<std::uint64_t> max_bytes = {};  ///< of a table of text

  /// A property of a channel of the column of this name, at a scale; of three channels with `width` 3.
  void add_property(std::string name, std::string_view column, std::size_t scale = 0, std::size_t channel = 0,
                    std::size_t width = 1);

  /// At a scale, `name_0`, and in a table of text `name_r2.5` if its radius was typed so. Both end in `end`.
  void add_property_of_scale(std::string_view name, std::string_view column, std::size_t scale, std::size_t channel = 0,
                             std::size_t width = 1, std::string_view end = "");

  /// At each scale, the properties of these columns by their names.
  void add_properties(std::initializer_list<std::string_view> names);
};

/// Writes the arrays of a table, or the properties as text.
void write_table(const TableFile& file, const RowTable& table);

/// The same with the vertex of each row, and the radii. As text, the vertex is the first property, and the radius the
/// second if each row has its own.
void write_rows(const TableFile& file, RowTable table, const BatchVertices& listed, const BatchRadius& radius);

/// What is asked: the input, whose masks are set, its rows, and the options of all quantities.
struct RowTask {
  Input& input;
  const RowQuery& rows;
  const RowOptions& options;
  const ValueFiles& files;

  /// One for each scale that --radius or --radii name.
  [[nodiscard]] RowTable table() const {
    return {.rows = rows.size(),
            .scales = options.scale_count(),
            .radii = rows.radii(),
            .scale_names = options.radii.values};
  }

  /// What `find(run)` returns, which finds all scales. `description` is for the display of the progress.
  template <class F>
  [[nodiscard]] auto while_shown(std::string_view description, std::size_t scales, const F& find) const {
    Task shown(description, {"rows", static_cast<double>(scales)});
    return find(Run{.threads = options.threads, .progress = shown.progress()});
  }
};

/// A command that writes a table.
class Quantity {
 public:
  virtual ~Quantity() = default;

  /// The options that only this one has.
  virtual void add_options(CLI::App& /*command*/) {}

  /// Throws Error{InvalidOption} if they contradict each other, or without radii. Before anything is read.
  virtual void check(const RowOptions& rows) const { need_radii(rows); }

  [[nodiscard]] virtual RowTable compute(const RowTask& task) = 0;
};

struct QuantityName {
  std::string name;
  std::string description;
  std::string shown;        ///< the value that programs show at once, for the help
  bool needs_faces = true;  ///< otherwise edges
  bool of_patch = false;    ///< not of a set of vertices: --points, and no --metric
  bool takes_space = true;  ///< as --metric
};

/// Adds the command `name`.
void add_quantity(CLI::App& program, const QuantityName& name, const std::shared_ptr<Quantity>& quantity);

/// The same for a quantity that has no options of its own.
void add_quantity(CLI::App& program, const QuantityName& name, RowTable (*compute)(const RowTask&));

}  // namespace meshhood::cli
