// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "meshhood/metric.h"
#include "meshhood/start.h"

#include "shared/distance.h"

/// The arguments of queries that start anywhere. Each check throws unless its argument is as the public header says;
/// the message begins with `where`.
namespace meshhood::inline v0_1 {

/// The beginning of a message: an argument, and the row of it.
[[nodiscard]] std::string named(std::string_view name, std::optional<std::size_t> row);

/// Error{InvalidOption}: the coordinate that is not finite or too large. `name`, `row`: of the argument.
void check_point(const SpacePoint& p, std::string_view name, std::optional<std::size_t> row = {});

/// The same for each row of an argument.
void check_points(std::span<const SpacePoint> points, std::string_view name);

/// Error{VertexOutOfRange}: `name` and the vertex.
void check_vertex(VertexId v, std::size_t vertices, std::string_view name);

/// Error{InvalidOption, VertexOutOfRange}.
void check_start(const Start& start, std::size_t vertices, std::string_view where);

/// Error{InvalidRadius} unless the radii are valid and strictly ascend.
void check_ascending(std::span<const double> radii);

/// Error{InvalidOption} unless `k`, how many vertices are wanted, is at least 1.
void check_k(std::size_t k);

/// Error{InvalidOption} in space, of a question about what is connected.
void check_connects(Metric metric);

/// Error{InvalidOption} unless there is a finite number >= 0 for each vertex. `name`: of the argument.
void check_weights(std::span<const double> weights, std::size_t vertices, std::string_view name = "weights");

/// Whether distances by the metric are lengths along edges, or numbers of edges.
[[nodiscard]] constexpr bool is_along_edges(Metric metric) { return metric == Metric::Path || metric == Metric::Rings; }

}  // namespace meshhood::inline v0_1
