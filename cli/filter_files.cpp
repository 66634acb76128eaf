// SPDX-License-Identifier: MIT
#include "filter_files.h"

#include <algorithm>

#include "options.h"
#include "vertex_files.h"

namespace meshhood::cli {
namespace {

std::vector<std::uint8_t> read_mask(const std::string& file, const Input& input) {
  std::vector<std::uint8_t> mask;
  if (file.empty()) return mask;
  mask.assign(input.vertex_count(), 0);
  for (const VertexId v : read_vertex_list(file, input.vertex_count())) mask[input.welding().kept(v)] = 1;
  return mask;
}

std::size_t size_of(const std::vector<std::uint8_t>& mask) {
  return static_cast<std::size_t>(std::count(mask.begin(), mask.end(), 1));
}

}  // namespace

void add_filter(CLI::App& command, FilterFiles& files) {
  add_file_option(command, "--walls", "a list of vertices that no search passes, one in each line", files.walls);
  add_file_option(command, "--ignored", "a list of vertices that a search passes but does not count", files.ignored);
}

FilterMasks::FilterMasks(const FilterFiles& files, const Input& input)
    : walls_(read_mask(files.walls, input)), ignored_(read_mask(files.ignored, input)) {}

void FilterMasks::ignore_welded(const Welding& welding) {
  if (welding.count() == 0) return;
  ignored_.resize(welding.kept().size());
  for (VertexId v = 0; v < ignored_.size(); ++v) ignored_[v] |= static_cast<std::uint8_t>(welding.kept(v) != v);
}

std::size_t FilterMasks::wall_count() const { return size_of(walls_); }

std::size_t FilterMasks::ignored_count() const { return size_of(ignored_); }

}  // namespace meshhood::cli
