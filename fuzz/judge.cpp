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
        paper_(paper::build(mesh.view(), draw_options(random))),
        paper_searcher_(paper_),
        bounds_(mesh.size()) {
    expect_sound(exact_.index().check(mesh.view()), "exact");
    expect_sound(paper_.check(mesh.view()), "paper's");
  }

  void query() {
    const auto v = static_cast<VertexId>(random_.below(oracle_.size()));
    const double radius = draw_radius(v);
    const std::vector<std::uint32_t> expected = oracle_.exact(v, radius);
    exact_.query(v, radius);
    answer_.assign(exact_.answer().begin(), exact_.answer().end());
    std::sort(answer_.begin(), answer_.end());
    if (exact_.mismatches() != 0 || answer_ != expected) refuse("exact", v, radius);

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
  test::ExactAnswer exact_;
  paper::Index paper_;
  paper::Searcher paper_searcher_;
  test::PaperBounds bounds_;
  std::vector<VertexId> answer_;
};

}  // namespace

void fail(const std::string& what) {
  static_cast<void>(std::fprintf(stderr, "meshhood: %s\n", what.c_str()));
  std::abort();
}

void judge(const test::TestMesh& mesh, Random& random, std::size_t queries) {
  Judge judge(mesh, random);
  for (std::size_t i = 0; mesh.size() > 0 && i < queries; ++i) judge.query();
}

}  // namespace meshhood::fuzz
