// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "meshhood/metric.h"
#include "meshhood/start.h"

#include "shared/distance.h"

/// Checks the arguments of queries that start anywhere. Each check throws unless its argument is as the public header
/// says; the message begins with `where`.
namespace meshhood::inline v0_1 {

/// Checks each row of an argument.
void check_points(std::span<const SpacePoint> points, std::string_view name);

/// Throws Error{VertexOutOfRange}, naming `name` and the vertex.
void check_vertex(VertexId v, std::size_t vertices, std::string_view name);

/// Throws Error{InvalidOption, VertexOutOfRange}.
void check_start(const Start& start, std::size_t vertices, std::string_view where);

/// Throws Error{InvalidRadius} unless the radii are valid and strictly ascend.
void check_ascending(std::span<const double> radii);

/// Throws Error{InvalidOption} unless `k`, how many vertices are wanted, is at least 1.
void check_k(std::size_t k);

/// Throws Error{InvalidOption} in space, for a question about what is connected.
void check_connects(Metric metric);

/// Throws Error{InvalidOption} unless there is a finite number >= 0 for each vertex. `name` is that of the argument.
void check_weights(std::span<const double> weights, std::size_t vertices, std::string_view name = "weights");

/// Returns whether distances by the metric are lengths along edges, or numbers of edges.
[[nodiscard]] constexpr bool is_along_edges(Metric metric) { return metric == Metric::Path || metric == Metric::Rings; }

}  // namespace meshhood::inline v0_1
