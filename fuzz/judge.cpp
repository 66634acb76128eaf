// SPDX-License-Identifier: MIT
#include "judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <vector>

#include "meshhood/meshhood.h"

#include "support/exact_answer.h"
#include "support/oracle.h"
#include "support/paper_bounds.h"

namespace meshhood::fuzz {
namespace {

using test::Random;

void expect_sound(const std::vector<std::string>& faults, const char* index) {
  if (!faults.empty()) fail(std::string(index) + " index: " + faults.front());
}

paper::BuildOptions draw_options(Random& random) {
  constexpr std::array kGrowth{0.0, 1.0, 4.0, 16.0};
  return {.levels = static_cast<int>(1 + random.below(8)),
          .discard = static_cast<int>(random.below(4)),
          .fusion_growth = kGrowth[random.below(kGrowth.size())]};
}

/// All indexes of one mesh, and its oracle.
class Judge {
 public:
  Judge(const test::TestMesh& mesh, Random& random)
      : random_(random),
        oracle_(mesh),
        exact_(mesh.view()),
        along_edges_(exact_.index(), Metric::Path),
        searcher_(exact_.index()),
        paper_(paper::build(mesh.view(), draw_options(random))),
        paper_searcher_(paper_),
        bounds_(mesh.size()) {
    expect_sound(exact_.index().check(mesh.view()), "exact");
    expect_sound(paper_.check(mesh.view()), "paper's");
  }

  /// The search along the edges, against the relaxation of all edges until nothing changes.
  void query_along_edges() {
    const auto v = static_cast<VertexId>(random_.below(oracle_.size()));
    const std::vector<double> least = path_distances(v);
    const double radius = least[random_.below(least.size())];
    along_edges_.neighborhood(v, radius, answer_, distances_);
    const auto inside = [&](double length) { return length <= radius && std::isfinite(length); };
    bool right = answer_.size() == static_cast<std::size_t>(std::ranges::count_if(least, inside));
    for (std::size_t i = 0; right && i < answer_.size(); ++i) right = distances_[i] == least[answer_[i]];
    if (!right || !std::ranges::is_sorted(distances_)) refuse("path", v, radius);
  }

  void query() {
    const auto v = static_cast<VertexId>(random_.below(oracle_.size()));
    const double radius = draw_radius(v);
    const std::vector<std::uint32_t> expected = oracle_.exact(v, radius);
    exact_.query(v, radius);
    answer_.assign(exact_.answer().begin(), exact_.answer().end());
    std::sort(answer_.begin(), answer_.end());
    if (exact_.mismatches() != 0 || answer_ != expected) refuse("exact", v, radius);
    searcher_.neighborhood(v, radius, answer_);
    std::sort(answer_.begin(), answer_.end());
    if (answer_ != expected) refuse("searcher's", v, radius);

    const double radius_ratio = std::ldexp(1.0, static_cast<int>(random_.below(20)) - 4);
    paper_searcher_.set_options({.radius_ratio = radius_ratio});
    paper_searcher_.neighborhood(v, radius, answer_);
    const auto inside = [&](VertexId w) {
      return oracle_.distance(v, w) <= radius && oracle_.component(v) == oracle_.component(w);
    };
    if (!bounds_.holds(expected, answer_, inside)) refuse("paper's", v, radius);
  }

 private:
  [[noreturn]] static void refuse(const char* index, VertexId v, double radius) {
    std::array<char, 32> text{};
    static_cast<void>(std::snprintf(text.data(), text.size(), "%a", radius));
    fail(std::string(index) + " answer differs: vertex " + std::to_string(v) + ", radius " + text.data());
  }

  [[nodiscard]] std::vector<double> path_distances(VertexId v) const {
    std::vector<double> least(oracle_.size(), std::numeric_limits<double>::infinity());
    least[v] = 0;
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      for (VertexId a = 0; a < least.size(); ++a) {
        for (const VertexId b : oracle_.neighbors(a)) {
          const double through = least[a] + oracle_.distance(a, b);
          has_changed |= through < least[b];
          least[b] = std::min(least[b], through);
        }
      }
    }
    return least;
  }

  /// Zero, infinity, and values around the distance of a vertex.
  double draw_radius(VertexId v) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double tie = oracle_.distance(v, random_.below(oracle_.size()));
    switch (random_.below(6)) {
      case 0: return random_.below(2) == 0 ? 0.0 : kInfinity;
      case 1: return std::nextafter(tie, kInfinity);
      case 2: return std::nextafter(tie, 0.0);
      case 3: return tie * random_.uniform(0, 2);
      default: return tie;
    }
  }

  Random& random_;
  test::Oracle oracle_;
  test::ExactAnswer exact_;  // whose searchers search over leaves only
  Searcher along_edges_;
  Searcher searcher_;  // soon also over vertices, because the mesh is small
  paper::Index paper_;
  paper::Searcher paper_searcher_;
  test::PaperBounds bounds_;
  std::vector<VertexId> answer_;
  std::vector<double> distances_;
};

}  // namespace

void fail(const std::string& what) {
  static_cast<void>(std::fprintf(stderr, "meshhood: %s\n", what.c_str()));
  std::abort();
}

void judge(const test::TestMesh& mesh, Random& random, std::size_t queries) {
  Judge judge(mesh, random);
  for (std::size_t i = 0; mesh.size() > 0 && i < queries; ++i) {
    judge.query();
    if (i % 16 == 0) judge.query_along_edges();
  }
}

}  // namespace meshhood::fuzz
