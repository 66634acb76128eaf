// SPDX-License-Identifier: MIT
#include <cstdint>
#include <numeric>

#include "meshhood/index.h"

#include "io/index_io.h"
#include "io/mesh_io.h"
#include "io/npz_writer.h"
#include "shapes/shapes.h"
#include "support/save_trial.h"

namespace meshhood::test {
namespace {

const shapes::Shape& shape(Version version) {
  static const shapes::Shape large = shapes::find_kind("sphere")->make(15000);
  static const shapes::Shape small = shapes::find_kind("grid")->make(9000);
  return version == Version::Old ? large : small;
}

void save_ply(const std::filesystem::path& file, Version version) { io::write_ply(file, shape(version).view()); }

void save_vtk(const std::filesystem::path& file, Version version) { io::write_vtk(file, shape(version).view()); }

void save_npz(const std::filesystem::path& file, Version version) {
  std::vector<std::int64_t> numbers(version == Version::Old ? 50000 : 40000);
  std::iota(numbers.begin(), numbers.end(), 0);
  io::NpzWriter npz(file);
  npz.add_text("format", "csr");
  npz.add<std::int64_t>("indices", numbers);
  npz.commit();
}

void save_index(const std::filesystem::path& file, Version version) {
  static const Index large = build(shape(Version::Old).view());
  static const Index small = build(shape(Version::New).view());
  io::save(file, version == Version::Old ? large : small);
}

}  // namespace

const std::vector<Saver>& savers() {
  static const std::vector<Saver> all = {
      {"Index", save_index}, {"Ply", save_ply}, {"Vtk", save_vtk}, {"Npz", save_npz}};
  return all;
}

}  // namespace meshhood::test
