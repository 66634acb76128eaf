// SPDX-License-Identifier: MIT
#include "row_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/mesh_io.h"
#include "io/npz_writer.h"
#include "methods.h"
#include "options.h"
#include "task.h"

namespace meshhood::cli {
namespace {

struct TableCommand {
  std::string file;
  Reading reading;
  RowOptions rows;
  ValueFiles files;
  bool json = false;
};

/// Calls `f(key, name)` for each requested file.
template <class F>
void for_each(const ValueFiles& files, F&& f) {
  if (!files.npz.empty()) f("output", files.npz);
  if (!files.ply.empty()) f("ply", files.ply);
  if (!files.vtk.empty()) f("vtk", files.vtk);
}

/// --output, --ply and --vtk. A mesh has values of all vertices, so the last two exclude --vertices.
void add_files(CLI::App& command, ValueFiles& files, const std::string& shown) {
  add_output(command, ".npz", "arrays to write", files.npz);
  const std::string mesh = "mesh to write, with the values of its vertices";
  add_output(command, ".ply", fmt::format("{}; its property quality, which MeshLab shows, is {}", mesh, shown),
             files.ply, "--ply")
      ->excludes("--vertices");
  add_output(command, ".vtk", fmt::format("{}; ParaView and PyVista show {}", mesh, shown), files.vtk, "--vtk")
      ->excludes("--vertices");
}

void write_column(io::NpzWriter& npz, const Column& column, std::size_t rows) {
  std::vector<std::uint64_t> shape;
  if (column.scales > 0) shape.push_back(column.scales);
  shape.push_back(rows);
  if (column.channels > 0) shape.push_back(column.channels);
  const auto write = [&]<class T>(const std::vector<T>& numbers) {
    npz.begin<T>(column.name, shape);
    npz.append<T>(numbers);
  };
  std::visit(write, column.numbers);
}

void write_npz(const TableCommand& options, const RowTable& table, const RowQuery& rows) {
  const std::string& file = options.files.npz;
  Task task("writing " + file);  // outlives the temporary file
  io::NpzWriter npz(file);
  write_radii(npz, options.rows.row_radii.empty() ? BatchRadius::scales(table.radii) : BatchRadius(table.radii));
  write_vertices(npz, rows.listed());
  if (!table.kinds.empty()) npz.add_texts("kinds", table.kinds);
  for (const Column& column : table.columns) {
    if (column.is_array) write_column(npz, column, table.rows);
  }
  Task::check_cancelled();
  npz.commit();
}

/// Infinite if it is too large.
float to_float(double value) {
  constexpr auto kMost = static_cast<double>(std::numeric_limits<float>::max());
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (std::abs(value) > kMost) return value < 0 ? -kInfinity : kInfinity;
  return static_cast<float>(value);
}

std::vector<float> values_of(const RowTable& table, const Property& property) {
  std::vector<float> values;
  values.reserve(table.rows * property.width);
  const auto copy = [&](const auto& numbers) {
    for (std::size_t row = 0; row < table.rows; ++row) {
      for (std::size_t i = 0; i < property.width; ++i) {
        values.push_back(to_float(static_cast<double>(numbers[property.first + row * property.stride + i])));
      }
    }
  };
  std::visit(copy, table.columns[property.column].numbers);
  return values;
}

/// The shown property is the first.
void write_meshes(const ValueFiles& files, RowTable& table, const MeshView& mesh) {
  const auto shown = std::ranges::find(table.properties, table.shown, &Property::name);
  std::rotate(table.properties.begin(), shown, std::next(shown));
  std::vector<std::vector<float>> values;
  for (const Property& property : table.properties) values.push_back(values_of(table, property));
  std::vector<io::VertexProperty> properties;
  for (std::size_t i = 0; i < values.size(); ++i) properties.push_back({table.properties[i].name, values[i]});
  if (!files.vtk.empty()) {
    Task task("writing " + files.vtk);
    io::write_vtk(files.vtk, mesh, {.properties = properties, .progress = task.progress()});
  }
  if (!files.ply.empty()) {
    Task task("writing " + files.ply);
    properties.insert(properties.begin(), {"quality", values.front()});
    io::write_ply(files.ply, mesh, {.colors = table.colors, .properties = properties, .progress = task.progress()});
  }
}

void run(const TableCommand& options, const QuantityName& name, Quantity& quantity) {
  quantity.check();
  if (options.files.first().empty()) raise(ErrorCode::InvalidOption, "expected --output, --ply or --vtk");
  check_outputs();
  Input input(options.file, options.reading, options.rows.threads);
  name.needs_faces ? input.need_faces(name.name) : input.need_edges(name.name);
  const RowQuery rows(options.rows, input);
  RowTable table = quantity.compute({input, rows, options.rows, options.files});
  if (!options.files.npz.empty()) write_npz(options, table, rows);
  if (options.files.has_mesh()) write_meshes(options.files, table, input.surface());
  Json document;
  for_each(options.files, [&](const char* key, const std::string& file) { document[key] = file; });
  document.update(table.summary);
  print_result(options.json, document, table.text);
}

}  // namespace

std::string names_of(const ValueFiles& files) {
  std::string names;
  for_each(files, [&](const char* /*key*/, const std::string& name) {
    names += (names.empty() ? "" : ", ") + printable_name(name);
  });
  return names;
}

void RowTable::add_property(std::string name, std::string_view column, std::size_t scale, std::size_t channel,
                            std::size_t width) {
  const auto found = std::ranges::find(columns, column, &Column::name);
  const std::size_t stride = std::max<std::size_t>(1, found->channels);
  properties.push_back({std::move(name), static_cast<std::size_t>(found - columns.begin()),
                        scale * rows * stride + channel, stride, width});
}

void RowTable::add_properties(std::initializer_list<std::string_view> names) {
  for (std::size_t scale = 0; scale < columns.front().scales; ++scale) {
    for (const std::string_view name : names) {
      const std::size_t channels = std::ranges::find(columns, name, &Column::name)->channels;
      add_property(fmt::format("{}_{}", name, scale), name, scale, 0, std::max<std::size_t>(1, channels));
    }
  }
}

void RowTask::for_each_scale(std::string_view description,
                             const std::function<void(const BatchQuery&, const Run&)>& compute) const {
  const std::size_t scales = options.scale_count();
  Task task(description, {"rows", static_cast<double>(scales)});
  for (std::size_t i = 0; i < scales; ++i) {
    compute(rows.query_of_scale(i), {.threads = options.threads, .progress = task.progress(i, scales)});
  }
}

void add_quantity(CLI::App& program, const QuantityName& name, std::shared_ptr<Quantity> quantity) {
  auto options = std::make_shared<TableCommand>();
  CLI::App* command = program.add_subcommand(name.name, name.description);
  name.needs_faces ? add_surface(*command, options->file) : add_file(*command, options->file);
  add_reading(*command, options->reading);
  add_rows(*command, options->rows);
  if (name.has_metric) add_metric(*command, options->rows.metric);
  quantity->add_options(*command);
  add_files(*command, options->files, name.shown);
  add_json(*command, options->json);
  command->callback([options, name, quantity] { run(*options, name, *quantity); });
}

}  // namespace meshhood::cli
