// SPDX-License-Identifier: MIT
#include "weld.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/messages.h"
#include "io/number.h"
#include "io/weld.h"
#include "output.h"

namespace meshhood::cli {
namespace {

/// What CLI11 stores for a flag without a value.
constexpr const char* kNoValue = "true";

}  // namespace

CLI::Option* add_weld(CLI::App& command, std::string& weld) {
  return command
      .add_flag(
          "--weld", weld,
          "of a mesh: join vertices at equal positions, or at most EPS apart; they keep their numbers, and results "
          "name the first of them")
      ->option_text("[=EPS]");
}

double eps_of(const std::string& weld) {
  if (weld == kNoValue) return 0;
  if (const auto number = io::parse_real<double>(weld)) return *number;
  raise(ErrorCode::InvalidOption, fmt::format("--weld={}, expected a finite number >= 0", io::quote(weld)));
}

std::string rounding_eps(double mean_edge) { return fmt::format("{:.1g}", mean_edge / 1000); }

std::vector<VertexId> kept_vertices(const PositionsView& positions, double eps) {
  std::vector<VertexId> kept = io::welded_ids(positions, eps);
  std::vector<VertexId> first;
  for (std::size_t v = 0; v < kept.size(); ++v) {
    if (kept[v] == first.size()) first.push_back(static_cast<VertexId>(v));
    kept[v] = first[kept[v]];
  }
  return kept;
}

std::vector<VertexId> kept_vertices(const io::Mesh& mesh, double eps) {
  if (mesh.walls.empty()) return kept_vertices(mesh.view().positions, eps);
  std::vector<VertexId> kept(mesh.walls.size());
  std::iota(kept.begin(), kept.end(), VertexId{0});
  std::vector<VertexId> others;
  std::copy_if(kept.begin(), kept.end(), std::back_inserter(others), [&](VertexId v) { return mesh.walls[v] == 0; });
  std::visit(
      [&]<class Real>(const std::vector<Real>& all) {
        std::vector<Real> xyz;
        for (const std::size_t v : others) xyz.insert(xyz.end(), &all[3 * v], &all[3 * v] + 3);
        const std::vector<VertexId> kept_others = kept_vertices(xyz, eps);
        for (std::size_t i = 0; i < others.size(); ++i) kept[others[i]] = others[kept_others[i]];
      },
      mesh.positions);
  return kept;
}

Welding::Welding(io::Mesh& mesh, const std::string& weld, const std::string& file) {
  if (weld.empty()) return;
  kept_ = kept_vertices(mesh, eps_of(weld));
  for (std::uint32_t& corner : mesh.corners) corner = kept_[corner];
  for (std::size_t v = 0; v < kept_.size(); ++v) count_ += kept_[v] == v ? 0 : 1;
  print_error("note: ",
              fmt::format("{}: {} of {} vertices welded; all keep their numbers", file, count_, kept_.size()));
}

void check_weld(const std::string& weld, const std::string& method) {
  if (weld.empty() || method != "ball") return;
  raise(ErrorCode::InvalidOption,
        "--weld: expected another --method than ball, which knows no faces, so that welding has no effect on it");
}

}  // namespace meshhood::cli
