// SPDX-License-Identifier: MIT
#include <cstdint>
#include <numeric>

#include "cli/npz_writer.h"
#include "io/mesh_io.h"
#include "shapes/shapes.h"
#include "support/save_trial.h"

namespace meshhood::test {
namespace {

const shapes::Shape& shape(Version version) {
  static const shapes::Shape kOld = shapes::find_kind("sphere")->make(15000);
  static const shapes::Shape kNew = shapes::find_kind("grid")->make(9000);
  return version == Version::Old ? kOld : kNew;
}

void save_ply(const std::filesystem::path& file, Version version) { io::write_ply(file, shape(version).view()); }

void save_npz(const std::filesystem::path& file, Version version) {
  std::vector<std::int64_t> numbers(version == Version::Old ? 50000 : 40000);
  std::iota(numbers.begin(), numbers.end(), 0);
  cli::NpzWriter npz(file);
  npz.add_text("format", "csr");
  npz.add<std::int64_t>("indices", numbers);
  npz.commit();
}

}  // namespace

const std::vector<Saver>& savers() {
  static const std::vector<Saver> kSavers = {{"Ply", save_ply}, {"Npz", save_npz}};
  return kSavers;
}

}  // namespace meshhood::test
