// SPDX-License-Identifier: MIT
#include "index_parts.h"

#include <vector>

#include <fmt/format.h>

#include "quantity.h"

namespace meshhood::cli {
namespace {

Json to_json(const std::vector<LevelSummary>& levels) {
  Json list = Json::array();
  for (const LevelSummary& level : levels) {
    list.push_back({{"level", level.level},
                    {"clusters", level.clusters},
                    {"mean_vertices", level.mean_vertices},
                    {"mean_radius", level.mean_radius},
                    {"mean_siblings", level.mean_siblings},
                    {"bytes", level.bytes}});
  }
  return list;
}

std::string to_text(const std::vector<LevelSummary>& levels) {
  std::string text = "level  clusters  mean vertices  mean radius  mean siblings     bytes\n";
  for (const LevelSummary& level : levels) {
    text += fmt::format("{:5}  {:8}  {:13.2f}  {:11.4g}  {:13.2f}  {:8}\n", level.level, level.clusters,
                        level.mean_vertices, level.mean_radius, level.mean_siblings, level.bytes);
  }
  return text;
}

}  // namespace

std::string_view kind_name(IndexKind kind) { return kind == IndexKind::Exact ? "exact" : "paper"; }

std::string_view precision_name(const IndexHeader& header) { return header.is_double ? "double" : "float"; }

Json json_of(const Index& index) {
  const IndexBytes bytes = index.bytes();
  return {{"bytes", bytes.total()}, {"positions", bytes.positions}, {"permutation", bytes.permutation},
          {"graph", bytes.graph},   {"tree", bytes.tree},           {"levels", to_json(index.levels())}};
}

Json json_of(const paper::Index& index) {
  return {{"bytes", index.bytes().total()}, {"levels", to_json(index.levels())}};
}

std::string text_of(const Index& index) {
  const IndexBytes bytes = index.bytes();
  std::string text = fmt::format("exact index: {}\n", bytes_text(static_cast<double>(bytes.total())));
  const auto row = [&](std::string_view part, std::size_t size) { text += fmt::format("{:<11}  {:9}\n", part, size); };
  row("positions", bytes.positions);
  row("permutation", bytes.permutation);
  row("graph", bytes.graph);
  row("tree", bytes.tree);
  return text + to_text(index.levels());
}

std::string text_of(const paper::Index& index) {
  return fmt::format("index of the paper: {}\n", bytes_text(static_cast<double>(index.bytes().total()))) +
         to_text(index.levels());
}

}  // namespace meshhood::cli
