// SPDX-License-Identifier: MIT
// The time to refit an index after its vertices have moved, beside the time to build it again: all vertices, those
// under a brush, and as many anywhere. "In place" is an update of an animation: `refit_in_place`, and `rebind` of a
// searcher. Then the time of queries with the refitted index and a new one. Interleaved in one run, on one thread.
//
//   bench_refit MESH [CHANGED VERTICES]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/meshhood.h"

#include "measure/timing.h"
#include "mesh_argument.h"
#include "program.h"

namespace meshhood::bench {
namespace {

constexpr int kRounds = 5;
const Run kOneThread{.threads = 1};

/// The shortest processor time of a call, in milliseconds.
struct Shortest {
  double milliseconds = std::numeric_limits<double>::infinity();

  template <class F>
  void round(F&& call) {
    const double start = measure::processor_time();
    call();
    milliseconds = std::min(milliseconds, 1e3 * (measure::processor_time() - start));
  }
};

std::vector<double> copy_positions(const MeshView& mesh) {
  std::vector<double> xyz;
  mesh.positions.visit([&](const auto& all) {
    for (std::size_t v = 0; v < all.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) xyz.push_back(static_cast<double>(all(v, axis)));
    }
  });
  return xyz;
}

/// Squared distance from vertex `center`.
std::vector<double> squares_from(const std::vector<double>& xyz, std::size_t center) {
  std::vector<double> squares(xyz.size() / 3);
  for (std::size_t v = 0; v < squares.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double d = xyz[3 * v + axis] - xyz[3 * center + axis];
      squares[v] += d * d;
    }
  }
  return squares;
}

/// The `count` vertices nearest to one vertex.
std::vector<VertexId> under_brush(const std::vector<double>& xyz, std::size_t count) {
  const std::vector<double> squares = squares_from(xyz, xyz.size() / 3 * 2 / 5);
  std::vector<VertexId> ids(squares.size());
  std::iota(ids.begin(), ids.end(), VertexId{0});
  std::nth_element(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(count), ids.end(),
                   [&](VertexId a, VertexId b) { return squares[a] < squares[b]; });
  ids.resize(count);
  return ids;
}

std::vector<VertexId> anywhere(std::size_t vertices, std::size_t count) {
  std::vector<VertexId> ids(count);
  for (std::size_t i = 0; i < count; ++i) ids[i] = static_cast<VertexId>(i * 2654435761U % vertices);
  return ids;
}

/// Bends the mesh along its first axis by a wave.
std::vector<double> bent(std::vector<double> xyz, double height) {
  double low = xyz[0];
  double high = xyz[0];
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    low = std::min(low, xyz[i]);
    high = std::max(high, xyz[i]);
  }
  for (std::size_t i = 0; i < xyz.size(); i += 3) {
    xyz[i + 2] += height * (high - low) * std::sin(6 * (xyz[i] - low) / (high - low));
  }
  return xyz;
}

/// Moves the vertices a little towards the middle, so that they stay in the frame.
std::vector<double> dented(std::vector<double> xyz, const std::vector<VertexId>& changed) {
  for (const VertexId v : changed) {
    for (std::size_t axis = 0; axis < 3; ++axis) xyz[3 * std::size_t{v} + axis] *= 0.999;
  }
  return xyz;
}

/// Frames of an animation: an index, and a searcher that goes on with each of its states.
struct Animation {
  explicit Animation(Index from) : index(std::move(from)) {}

  /// Some frames, each of which moves the vertices there or back, as `move(index, back)` does; ends where it began.
  template <class Move>
  void frames(Shortest& time, Move&& move) {
    for (int frame = 0; frame < 6; ++frame) {
      time.round([&] {
        move(index, frame % 2 != 0);
        searcher.rebind(index);
      });
    }
  }

  Index index;
  Searcher searcher{index};
  Shortest all;
  Shortest brush;
  Shortest scattered;
};

class Refits {
 public:
  Refits(const MeshView& mesh, std::size_t changed)
      : faces_(mesh.faces), xyz_(copy_positions(mesh)), graph_(adjacency(mesh)), index_(build_at(xyz_)) {
    changed_ = std::min(changed, xyz_.size() / 3 - 1);
  }

  void run() {
    const std::vector<VertexId> brush = under_brush(xyz_, changed_);
    const std::vector<VertexId> spread = anywhere(xyz_.size() / 3, changed_);
    const std::vector<double> all_moved = bent(xyz_, 0.1);
    const std::vector<double> brush_moved = dented(xyz_, brush);
    const std::vector<double> spread_moved = dented(xyz_, spread);
    Animation animation(build_at(xyz_));
    Shortest built;
    Shortest all;
    Shortest with_copy;
    for (int round = 0; round < kRounds; ++round) {
      built.round([&] { static_cast<void>(build_at(all_moved)); });
      all.round([&] { static_cast<void>(refit(index_, all_moved, kOneThread)); });
      with_copy.round([&] { static_cast<void>(refit(index_, brush_moved, brush, kOneThread)); });
      animation.frames(animation.all,
                       [&](Index& index, bool back) { index.refit_in_place(back ? xyz_ : all_moved, kOneThread); });
      animation.frames(animation.brush, [&](Index& index, bool back) {
        index.refit_in_place(back ? xyz_ : brush_moved, brush, kOneThread);
      });
      animation.frames(animation.scattered, [&](Index& index, bool back) {
        index.refit_in_place(back ? xyz_ : spread_moved, spread, kOneThread);
      });
    }
    std::printf("%zu vertices, %zu of them changed; milliseconds\n", xyz_.size() / 3, changed_);
    std::printf("build                      %9.3f\n", built.milliseconds);
    const auto print = [&](const char* what, const Shortest& time) {
      std::printf("%-26s %9.3f  build / this: %6.1f  all / this: %6.1f\n", what, time.milliseconds,
                  built.milliseconds / time.milliseconds, all.milliseconds / time.milliseconds);
    };
    print("refit, all", all);
    print("refit, all, in place", animation.all);
    print("refit, brush, with a copy", with_copy);
    print("refit, brush, in place", animation.brush);
    print("refit, anywhere, in place", animation.scattered);
    compare_queries();
  }

 private:
  [[nodiscard]] Index build_at(const std::vector<double>& xyz) const {
    return build(MeshView{xyz, faces_}, kOneThread);
  }

  /// Microseconds of a query at 20 mean edges, with refitted indexes and with new ones.
  void compare_queries() {
    std::printf("\ndeformation        gain by quality()   refitted us   new us   refitted / new\n");
    for (const double height : {0.02, 0.1, 0.5, 2.0}) {
      const std::vector<double> moved = bent(xyz_, height);
      const Index refitted = refit(index_, moved);
      const Index built = build_at(moved);
      const double radius = 20 * mean_edge_length({moved, graph_.view()});
      Shortest old_time;
      Shortest new_time;
      for (int round = 0; round < 3; ++round) {
        old_time.round([&] { run_queries(refitted, radius); });
        new_time.round([&] { run_queries(built, radius); });
      }
      std::printf("wave of %4.2f %24.2f %13.1f %8.1f %16.2f\n", height, quality(refitted).gain,
                  1e3 * old_time.milliseconds / kQueries, 1e3 * new_time.milliseconds / kQueries,
                  old_time.milliseconds / new_time.milliseconds);
    }
  }

  static void run_queries(const Index& index, double radius) {
    Searcher searcher(index);
    for (const VertexId v : anywhere(index.vertex_count(), kQueries)) static_cast<void>(searcher.count(v, radius));
  }

  static constexpr std::size_t kQueries = 2000;

  FacesView faces_;
  std::vector<double> xyz_;
  Adjacency graph_;
  Index index_;
  std::size_t changed_ = 0;
};

int run(const Arguments& arguments) {
  const MeshArgument mesh(arguments.front());
  Refits(mesh.view(), arguments.size() > 1 ? std::stoul(arguments[1]) : 10'000).run();
  return 0;
}

}  // namespace
}  // namespace meshhood::bench

int main(int argc, char** argv) {
  return meshhood::bench::run_program(argc, argv, {"bench_refit MESH [CHANGED VERTICES]", 1}, meshhood::bench::run);
}
