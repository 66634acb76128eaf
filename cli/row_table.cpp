// SPDX-License-Identifier: MIT
#include "row_table.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "mesh_file.h"
#include "methods.h"
#include "system.h"

namespace meshhood::cli {
namespace {

std::optional<std::vector<VertexId>> list_of(const std::string& file, const Input& input) {
  if (file.empty()) return std::nullopt;
  if (file.find_first_not_of("0123456789,") == std::string::npos && !std::filesystem::exists(path_of(file))) {
    wrong_option("--vertices {}: expected a file that lists vertices, or - for standard input", file);
  }
  std::vector<VertexId> list = read_vertex_list(file, input.vertex_count());
  for (VertexId& v : list) v = input.welding().kept(v);
  return list;
}

BatchVertices rows_of(const std::optional<std::vector<VertexId>>& list, const Input& input) {
  if (list) return *list;
  return input.welding().count() > 0 ? BatchVertices(input.welding().kept()) : BatchVertices();
}

std::optional<std::vector<SpacePoint>> points_of(const std::string& file) {
  if (file.empty()) return std::nullopt;
  return read_points(file);
}

std::vector<double> radii_of(const RowOptions& options, std::size_t rows, Input& input) {
  if (options.row_radii.empty()) return resolve(options.radii, input);
  std::vector<double> radii = read_channel(options.row_radii, rows, "radii");
  const double unit = length_of_unit(options.radii.unit, input);
  for (std::size_t row = 0; row < rows; ++row) {
    if (!(radii[row] >= 0)) {
      raise(ErrorCode::InvalidRadius, fmt::format("{}: row {}: radius {}, expected a number >= 0",
                                                  printable_name(options.row_radii), row, radii[row]));
    }
    radii[row] *= unit;
    input.need_halo(radii[row]);
  }
  return radii;
}

struct TableCommand {
  QuantityName name;
  std::shared_ptr<Quantity> quantity;
  Reading reading;
  RowOptions rows;
  ValueFiles files;
  bool json = false;
};

/// --output, --csv, --ply and --vtk. A mesh has values of all vertices, so the last two exclude --vertices.
void add_files(CLI::App& command, ValueFiles& files, const std::string& shown) {
  add_table_output(command, ".npz", "arrays or a table to write", files.table);
  const std::string mesh = "mesh to write, with the values of its vertices";
  add_output(command, ".ply", fmt::format("{}; its property quality, which MeshLab shows, is {}", mesh, shown),
             files.ply, "--ply")
      ->excludes("--vertices");
  add_output(command, ".vtk", fmt::format("{}; ParaView and PyVista show {}", mesh, shown), files.vtk, "--vtk")
      ->excludes("--vertices");
}

/// --points, which a mesh has no values of.
void add_points(CLI::App& command, std::string& points) {
  CLI::Option* const option =
      add_file_option(command, "--points",
                      "instead of vertices, the points of the surface nearest to these: text with X Y Z on each line, "
                      "or an array of NumPy (.npy)",
                      points);
  for (const char* other : {"--vertices", "--ply", "--vtk"}) option->excludes(other);
}

void write_column(io::NpzWriter& npz, const Column& column, std::size_t rows) {
  std::vector<std::uint64_t> shape;
  if (column.scales > 0) shape.push_back(column.scales);
  shape.push_back(rows);
  if (column.channels > 0) shape.push_back(column.channels);
  if (column.kinds > 0) shape.push_back(column.kinds);
  const auto write = [&]<class T>(const std::vector<T>& numbers) {
    npz.begin<T>(column.name, shape);
    npz.append<T>(numbers);
  };
  std::visit(write, column.numbers);
}

void write_npz(const std::string& file, const RowTable& table, const std::function<void(io::NpzWriter&)>& begin = {}) {
  const Task task("writing " + file);  // outlives the temporary file
  io::NpzWriter npz(path_of(file));
  if (begin) begin(npz);
  if (!table.kinds.empty()) npz.add_texts("kinds", table.kinds);
  for (const Column& column : table.columns) {
    if (column.is_array) write_column(npz, column, table.rows);
  }
  Task::check_cancelled();
  npz.commit();
}

/// Calls `f(number)` for each number of a property in a row.
template <class F>
void for_each_number(const RowTable& table, const Property& property, std::size_t row, F&& f) {
  const auto read = [&](const auto& numbers) {
    for (std::size_t i = 0; i < property.width; ++i) f(numbers[property.first + row * property.stride + i]);
  };
  std::visit(read, table.columns[property.column].numbers);
}

void write_csv(const std::string& file, const RowTable& table) {
  const Task task("writing " + file);
  std::vector<std::string> names;
  for (const Property& property : table.properties) {
    const std::string& name = property.csv_name.empty() ? property.name : property.csv_name;
    if (property.width == 1) names.push_back(name);
    const bool of_triangle = table.columns[property.column].of_triangle;
    for (const char* axis : of_triangle ? std::array{"0", "1", "2"} : std::array{"x", "y", "z"}) {
      if (property.width == 3) names.push_back(fmt::format("{}_{}", name, axis));
    }
  }
  CsvWriter csv(file, names, table.max_bytes);
  for (std::size_t row = 0; row < table.rows; ++row) {
    for (const Property& property : table.properties) {
      for_each_number(table, property, row, [&](auto number) { csv.add(number); });
    }
    csv.end_row();
    Task::check_cancelled();
  }
  csv.commit();
}

std::vector<float> values_of(const RowTable& table, const Property& property) {
  std::vector<float> values;
  values.reserve(table.rows * property.width);
  for (std::size_t row = 0; row < table.rows; ++row) {
    for_each_number(table, property, row, [&](auto number) {
      values.push_back(to_float(static_cast<double>(number), property.name, row, "a mesh"));
    });
  }
  return values;
}

/// The properties of a mesh. The shown one is the first.
std::vector<Property> mesh_properties(const RowTable& table) {
  std::vector<Property> properties = table.properties;
  const auto is_long = []<class T>(const std::vector<T>&) { return std::is_integral_v<T> && sizeof(T) == 8; };
  std::erase_if(properties, [&](const Property& property) {
    const Column& column = table.columns[property.column];
    return column.of_triangle || std::visit(is_long, column.numbers);
  });
  const auto shown = std::ranges::find(properties, table.shown, &Property::name);
  std::rotate(properties.begin(), shown, std::next(shown));
  return properties;
}

void write_meshes(const ValueFiles& files, const RowTable& table, Input& input) {
  const MeshView mesh = input.surface();
  const std::span<const std::uint8_t> walls = input.unplaced();
  const std::vector<Property> of_mesh = mesh_properties(table);
  std::vector<std::vector<float>> values(of_mesh.size());
  std::vector<io::VertexProperty> properties(of_mesh.size());
  for (std::size_t i = 0; i < of_mesh.size(); ++i) {
    values[i] = values_of(table, of_mesh[i]);
    properties[i] = {of_mesh[i].name, values[i]};
  }
  if (!files.vtk.empty()) {
    Task task("writing " + files.vtk);
    io::write_vtk(path_of(files.vtk), mesh, {.properties = properties, .walls = walls, .progress = task.progress()});
  }
  if (!files.ply.empty()) {
    properties.insert(properties.begin(), {"quality", values.front()});
    write_ply(files.ply, mesh, {.colors = table.colors, .properties = properties, .walls = walls});
  }
}

void run(const TableCommand& options) {
  options.quantity->check(options.rows);
  if (options.files.first().empty()) wrong_option("expected --output, --csv, --ply or --vtk");
  check_outputs();
  Input input(options.reading, options.rows.threads);
  const QuantityName& name = options.name;
  name.needs_faces ? input.need_faces(name.name) : input.need_edges(name.name);
  const RowQuery rows(options.rows, input);
  RowTable table = options.quantity->compute({input, rows, options.rows, options.files});
  Json document;
  std::string names;
  const auto& [output, ply, vtk] = options.files;
  for (const auto& [key, file] : {std::pair{"output", &output.name}, {"ply", &ply}, {"vtk", &vtk}}) {
    if (file->empty()) continue;
    document[key] = *file;
    names += (names.empty() ? "" : ", ") + printable_name(*file);
  }
  document["rows"] = table.rows;
  if (options.rows.row_radii.empty()) document["radii"] = table.radii;
  document.update(table.summary);
  const std::string text = fmt::format("{}: {} rows, radii: {}; {}\n", names, table.rows, table.scales, table.text);
  if (options.files.has_mesh()) write_meshes(options.files, table, input);
  if (!options.files.table.name.empty()) {
    const BatchRadius radius =
        options.rows.row_radii.empty() ? BatchRadius::scales(table.radii) : BatchRadius(table.radii);
    write_rows(options.files.table, std::move(table), rows.listed(), radius);
  }
  print_result(options.json, document, text);
}

/// Of a function.
class PlainQuantity : public Quantity {
 public:
  explicit PlainQuantity(RowTable (*function)(const RowTask&)) : function_(function) {}
  RowTable compute(const RowTask& task) override { return function_(task); }

 private:
  RowTable (*function_)(const RowTask&);
};

}  // namespace

void add_rows(CLI::App& command, RowOptions& options) {
  CLI::Option* const radius = add_radii(command, options.radii)->required(false);
  add_file_option(command, "--radii",
                  "instead of --radius, one for each row: text with a number per line, or an array of NumPy (.npy)",
                  options.row_radii)
      ->excludes(radius);
  add_file_option(command, "-v,--vertices", "text file with the query vertices, one per line (default: all)",
                  options.vertices);
  add_masks(command, options.masks);
  add_threads(command, options.threads);
}

void need_radii(const RowOptions& options) {
  if (!options.has_radii()) wrong_option("expected --radius or --radii");
}

RowQuery::RowQuery(const RowOptions& options, Input& input)
    : list_(list_of(options.vertices, input)),
      points_(points_of(options.points)),
      rows_(rows_of(list_, input)),
      metric_(choose_metric(options.metric, input)),
      size_(points_ ? points_->size() : rows_.count(input.vertex_count())),
      are_of_rows_(!options.row_radii.empty()),
      radii_(radii_of(options, size_, input)) {
  check_metric(options.metric, options.radii.unit);
  input.set_masks(read_masks(options.masks, input));
  if (metric_ == Metric::Space) input.ignore_welded();
}

BatchQuery RowQuery::query(BatchRadius radius) const {
  return {.vertices = rows_, .radius = std::move(radius), .metric = metric_};
}

void write_vertices(io::NpzWriter& npz, const BatchVertices& rows) {
  if (!rows.list()) return;
  npz.add_converted<std::int64_t>("vertices", *rows.list());
}

void write_radii(io::NpzWriter& npz, const BatchRadius& radius) {
  if (radius.scales()) return npz.add<double>("radii", *radius.scales());
  npz.begin<double>("radii", std::array<std::uint64_t, 2>{1, radius.list()->size()});
  npz.append<double>(*radius.list());
}

std::vector<Column> columns_of(const std::vector<SurfacePoint>& points, const std::string& vertices,
                               std::size_t scales) {
  std::vector<std::int64_t> faces;
  std::vector<double> distances;
  std::vector<double> places;
  std::vector<std::int64_t> corners;
  std::vector<double> barycentric;
  for (const SurfacePoint& one : points) {
    faces.push_back(one.face == kNoFace ? -1 : static_cast<std::int64_t>(one.face));
    distances.push_back(one.distance);
    places.insert(places.end(), one.point.begin(), one.point.end());
    for (const VertexId v : one.vertices) corners.push_back(v == kNoVertex ? -1 : std::int64_t{v});
    barycentric.insert(barycentric.end(), one.barycentric.begin(), one.barycentric.end());
  }
  std::vector<Column> columns{{"face", std::move(faces), scales},
                              {"distance", std::move(distances), scales},
                              {"point", std::move(places), scales, 3},
                              {vertices, std::move(corners), scales, 3},
                              {"barycentric", std::move(barycentric), scales, 3}};
  columns[3].of_triangle = columns[4].of_triangle = true;
  return columns;
}

Json json_of(const SurfacePoint& point) {
  return {{"face", point.face},
          {"vertices", point.vertices},
          {"barycentric", point.barycentric},
          {"point", point.point},
          {"distance", point.distance}};
}

void write_table(const TableFile& file, const RowTable& table) {
  file.is_csv() ? write_csv(file.name, table) : write_npz(file.name, table);
}

void write_rows(const TableFile& file, RowTable table, const BatchVertices& listed, const BatchRadius& radius) {
  if (!file.is_csv()) {
    return write_npz(file.name, table, [&](io::NpzWriter& npz) {
      write_radii(npz, radius);
      write_vertices(npz, listed);
    });
  }
  const auto add_first = [&](const std::string& name, auto numbers) {
    table.properties.insert(table.properties.begin(), {name, table.columns.size(), 0, 1});
    table.columns.push_back({.name = name, .numbers = std::move(numbers)});
  };
  if (radius.list()) add_first("radius", std::vector<double>(radius.list()->begin(), radius.list()->end()));
  if (table.of_vertices) {
    std::vector<std::int64_t> vertices(table.rows);
    for (std::size_t row = 0; row < table.rows; ++row) vertices[row] = listed[row];
    add_first("vertex", std::move(vertices));
  }
  write_csv(file.name, table);
}

void RowTable::add_property(std::string name, std::string_view column, std::size_t scale, std::size_t channel,
                            std::size_t width) {
  const auto found = std::ranges::find(columns, column, &Column::name);
  const std::size_t stride = std::max<std::size_t>(1, found->channels) * std::max<std::size_t>(1, found->kinds);
  properties.push_back({std::move(name), static_cast<std::size_t>(found - columns.begin()),
                        scale * rows * stride + channel, stride, width});
}

void RowTable::add_property_of_scale(std::string_view name, std::string_view column, std::size_t scale,
                                     std::size_t channel, std::size_t width, std::string_view end) {
  add_property(fmt::format("{}_{}{}", name, scale, end), column, scale, channel, width);
  if (!scale_names.empty()) properties.back().csv_name = fmt::format("{}_r{}{}", name, scale_names[scale], end);
}

void RowTable::add_properties(std::initializer_list<std::string_view> names) {
  for (std::size_t scale = 0; scale < scales; ++scale) {
    for (const std::string_view name : names) {
      const std::size_t channels = std::ranges::find(columns, name, &Column::name)->channels;
      add_property_of_scale(name, name, scale, 0, std::max<std::size_t>(1, channels));
    }
  }
}

void add_quantity(CLI::App& program, const QuantityName& name, RowTable (*compute)(const RowTask&)) {
  add_quantity(program, name, std::make_shared<PlainQuantity>(compute));
}

void add_quantity(CLI::App& program, const QuantityName& name, const std::shared_ptr<Quantity>& quantity) {
  const auto [command, options] = add_command(program, name.name, name.description, run);
  options.name = name;
  options.quantity = quantity;
  name.needs_faces ? add_surface(command, options.reading) : add_file(command, options.reading);
  add_rows(command, options.rows);
  if (!name.of_patch) add_metric(command, options.rows.metric, name.takes_space);
  quantity->add_options(command);
  add_files(command, options.files, name.shown);
  if (name.of_patch) add_points(command, options.rows.points);
  add_json(command, options.json);
}

}  // namespace meshhood::cli
