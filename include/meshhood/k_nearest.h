// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/metric.h"
#include "meshhood/run.h"
#include "meshhood/unconnected.h"

/// Finds the nearest connected vertices of many vertices in one call: a number of them, or as many as cover an area.
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

struct NearestOptions {
  /// The order of vertices. Straight: by connecting radius (see `Searcher::nearest_connected`), then by distance, then
  /// by id. Path: by path distance; rings: by number of edges; each then by place in index order. `Space`, in which
  /// nothing is connected, is Error{InvalidOption}.
  Metric metric = Metric::Straight;

  /// The largest connecting radius, path distance or number of edges of an answer; >= 0 or infinite.
  double radius = std::numeric_limits<double>::infinity();
};

/// Lists of #rows by k.
struct KNearest {
  std::vector<VertexId> ids;      ///< `kNoVertex` where a row has fewer than k vertices
  std::vector<double> distances;  ///< by the metric; infinite there
};

/// Returns the `k` >= 1 nearest connected vertices of each of `vertices`, itself included; all if there are fewer.
///
/// The row of a wall is empty. A row depends on the index, its vertex, `k` and the options alone, and begins with the
/// row for any smaller `k`. Takes O(k log k) a row on most surfaces. Each thread owns a search of the metric; straight,
/// rows that lie close together share a part of it, so they take less time than as many calls of `Searcher`.
///
/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption, TooLarge, Cancelled}, naming the row; TooLarge if the
/// result exceeds `run.max_bytes`, or rows times k is more than 2^40; on a machine of 32 bits, more than 2^28.
[[nodiscard]] KNearest k_nearest(const Index& index, const BatchVertices& vertices, std::size_t k,
                                 const NearestOptions& options = {}, const Run& run = {});

/// Does the same in memory of the caller. `allocate` is called once, on the calling thread, after the arguments are
/// checked. All of the memory is written unless the call throws. Throws as above, Error{InvalidOption} if the memory
/// does not have the requested size, and what `allocate` throws.
void k_nearest(const Index& index, const BatchVertices& vertices, std::size_t k, const BatchAllocator& allocate,
               const NearestOptions& options = {}, const Run& run = {});

/// Returns a disc of fixed area around each of `vertices`: of the nearest connected vertices, in the order and with the
/// distances of `k_nearest`, the first whose areas add up to at least `area`; all if they do not.
///
/// areas  of each vertex, such as `vertex_areas`: #V, >= 0 and finite.
/// area   > 0 and finite, in the unit of `areas`.
///
/// Takes O(k log k) for a row of k vertices on most surfaces; the result is held twice while its rows are joined.
/// Throws as `k_nearest`; Error{InvalidOption} also for `area` and `areas`, naming the vertex. A result above
/// `run.max_bytes` is refused as that of `neighborhoods`.
[[nodiscard]] Neighborhoods discs(const Index& index, const BatchVertices& vertices, double area,
                                  std::span<const double> areas, const NearestOptions& options = {},
                                  const Run& run = {});

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
