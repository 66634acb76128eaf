// SPDX-License-Identifier: MIT
#include "value_files.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/mesh_io.h"
#include "options.h"
#include "task.h"

namespace meshhood::cli {
namespace {

/// Calls `f(key, name)` for each requested file.
template <class F>
void for_each(const ValueFiles& files, F&& f) {
  if (!files.npz.empty()) f("output", files.npz);
  if (!files.ply.empty()) f("ply", files.ply);
  if (!files.vtk.empty()) f("vtk", files.vtk);
}

}  // namespace

void add_value_files(CLI::App& command, ValueFiles& files, const std::string& shown) {
  add_output(command, ".npz", "arrays to write", files.npz);
  const std::string mesh = "mesh to write, with the values of its vertices";
  CLI::Option* ply =
      add_output(command, ".ply", fmt::format("{}; its property quality, which MeshLab shows, is {}", mesh, shown),
                 files.ply, "--ply");
  CLI::Option* vtk =
      add_output(command, ".vtk", fmt::format("{}; ParaView and PyVista show {}", mesh, shown), files.vtk, "--vtk");
  if (CLI::Option* vertices = command.get_option_no_throw("--vertices")) {
    ply->excludes(vertices);
    vtk->excludes(vertices);
  }
}

void check_value_files(const ValueFiles& files) {
  if (files.npz.empty() && !files.has_mesh()) {
    raise(ErrorCode::InvalidOption, "expected --output, --ply or --vtk");
  }
  check_outputs();
}

std::string names_of(const ValueFiles& files) {
  std::string names;
  for_each(files, [&](const char* /*key*/, const std::string& name) {
    names += (names.empty() ? "" : ", ") + printable_name(name);
  });
  return names;
}

Json to_json(const ValueFiles& files) {
  Json names;
  for_each(files, [&](const char* key, const std::string& name) { names[key] = name; });
  return names;
}

float VertexValues::to_float(double value) {
  constexpr auto kMost = static_cast<double>(std::numeric_limits<float>::max());
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  if (std::abs(value) > kMost) return value < 0 ? -kInfinity : kInfinity;
  return static_cast<float>(value);
}

void VertexValues::add_vectors(std::string name, std::span<const double> vectors) {
  std::vector<float>& values = columns_.emplace_back(std::move(name), std::vector<float>()).second;
  values.reserve(vectors.size());
  for (const double value : vectors) values.push_back(to_float(value));
}

void VertexValues::write(const ValueFiles& files, const MeshView& mesh, std::size_t shown,
                         std::span<const std::uint8_t> colors) const {
  std::vector<io::VertexProperty> properties{{columns_[shown].first, columns_[shown].second}};
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (i != shown) properties.push_back({columns_[i].first, columns_[i].second});
  }
  if (!files.vtk.empty()) {
    Task task("writing " + files.vtk);
    io::write_vtk(files.vtk, mesh, {.properties = properties, .progress = task.progress()});
  }
  if (!files.ply.empty()) {
    Task task("writing " + files.ply);
    properties.insert(properties.begin(), {"quality", columns_[shown].second});
    io::write_ply(files.ply, mesh, {.colors = colors, .properties = properties, .progress = task.progress()});
  }
}

}  // namespace meshhood::cli
