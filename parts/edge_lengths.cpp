// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <queue>
#include <string>
#include <utility>
#include <vector>

#include "parts/corner_positions.h"
#include "parts/spill.h"
#include "parts/survey.h"

namespace meshhood::parts {
namespace {

/// An edge: its ends, `a` < `b`, and its length.
struct Edge {
  std::uint64_t a = 0;
  std::uint64_t b = 0;
  double length = 0;

  [[nodiscard]] std::pair<std::uint64_t, std::uint64_t> ends() const { return {a, b}; }
};

/// The distinct edges of a chunk, sorted.
std::vector<Edge> edges_of(const FaceChunk& chunk, const CornerPositions& vertices) {
  std::vector<Edge> edges;
  edges.reserve(chunk.corners.size());
  for (std::size_t face = 0; face < chunk.size(); ++face) {
    const auto corners = chunk.face(face);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const auto [a, b] = std::minmax({corners[i], corners[i == 0 ? corners.size() - 1 : i - 1]});
      if (a != b) edges.push_back({a, b, 0});
    }
  }
  std::ranges::sort(edges, {}, &Edge::ends);
  const auto repeats = std::ranges::unique(edges, {}, &Edge::ends);
  edges.erase(repeats.begin(), repeats.end());
  for (Edge& edge : edges) edge.length = std::sqrt(squared_distance(vertices[edge.a], vertices[edge.b]));
  return edges;
}

/// A sorted run in a file, and its first edge that is left.
struct SortedRun {
  SpillReader rest;
  Edge front = {};
};

/// Calls `f` with the distinct edges of all runs, in order.
template <class F>
void merge(std::vector<SortedRun> runs, F&& f) {
  const auto is_later = [](const SortedRun* s, const SortedRun* t) { return t->front.ends() < s->front.ends(); };
  std::priority_queue<SortedRun*, std::vector<SortedRun*>, decltype(is_later)> queue(is_later);
  for (SortedRun& run : runs) {
    if (run.rest.next(run.front)) queue.push(&run);
  }
  Edge last;  // its ends are equal, unlike those of any edge
  while (!queue.empty()) {
    SortedRun* const run = queue.top();
    queue.pop();
    if (run->front.ends() != last.ends()) f(run->front);
    last = run->front;
    if (run->rest.next(run->front)) queue.push(run);
  }
}

}  // namespace

double mean_edge_length(ChunkedMesh& mesh, const std::filesystem::path& folder, std::size_t chunk_corners,
                        std::uint64_t corners, Stages& stages) {
  std::vector<Spill> spills;  // one for each run, as their number is not known
  FaceChunk chunk;
  std::uint64_t done = 0;
  mesh.rewind_faces();
  while (mesh.read_faces(chunk_corners, chunk)) {
    const CornerPositions vertices(mesh, chunk);
    Spill& spill = spills.emplace_back(folder, "edges" + std::to_string(spills.size()), 1, std::size_t{1} << 16);
    for (const Edge& edge : edges_of(chunk, vertices)) spill.append(0, edge);
    spill.flush();
    stages.report(done += chunk.corners.size(), corners);
  }
  chunk = {};
  const std::size_t buffer = std::max<std::size_t>(1024, 32 * chunk_corners / std::max<std::size_t>(1, spills.size()));
  std::vector<SortedRun> runs;
  runs.reserve(spills.size());
  for (const Spill& spill : spills) runs.push_back({SpillReader(spill, 0, std::min(buffer, std::size_t{1} << 22))});
  double sum = 0;
  std::uint64_t count = 0;
  merge(std::move(runs), [&](const Edge& edge) {
    constexpr std::uint64_t kBetweenReports = std::uint64_t{1} << 16;
    sum += edge.length;
    if (++count % kBetweenReports == 0) stages.report(done, corners);
  });
  for (const Spill& spill : spills) std::filesystem::remove(spill.file(0));
  return count == 0 ? 0.0 : sum / static_cast<double>(count);
}

}  // namespace meshhood::parts
