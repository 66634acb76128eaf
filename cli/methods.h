// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "meshhood/batch.h"
#include "meshhood/paper.h"

#include "input.h"
#include "options.h"
#include "shared/row_order.h"

/// How a search finds vertices, measures their distances and orders them, by names.
namespace meshhood::cli {

/// Paths along the surface are those of another index (see `choose_metric`).
inline constexpr Names<Metric, 5> kMetrics{{{"straight", Metric::Straight},
                                            {"path", Metric::Path},
                                            {"surface", Metric::Path},
                                            {"rings", Metric::Rings},
                                            {"space", Metric::Space}}};

/// The orders of rows of a batch. Those of an index are found in its order, except along the edges.
inline constexpr Names<RowSort, 3> kSorts{
    {{"id", RowSort::Id}, {"index", RowSort::None}, {"distance", RowSort::Distance}}};

struct MethodOptions {
  std::string method = "exact";
  std::string metric = "straight";
  std::string sort = "id";  ///< the order of the vertices of an answer

  [[nodiscard]] bool is_straight() const { return metric == "straight"; }
};

/// --method, --metric and --sort.
void add_method(CLI::App& command, MethodOptions& options);

/// --metric alone, of a command that always searches by the index. What asks for connections does not take space.
void add_metric(CLI::App& command, std::string& metric, bool takes_space = true);

/// The metric by which the index of the input then searches, which this may change: before it is first used. Throws
/// Error{InvalidOption} if the metric needs faces, and the input has none.
[[nodiscard]] Metric choose_metric(const std::string& name, Input& input);

/// A searcher of the index of the input by a metric. Throws as `choose_metric`.
[[nodiscard]] Searcher make_searcher(const std::string& metric, Input& input);

/// Throws Error{InvalidOption} if the metric has no radii of this unit.
void check_metric(const std::string& name, const std::string& unit);

/// Throws Error{InvalidOption} if the options contradict each other, masks, --weld, or the unit of the radius.
void check_method(const MethodOptions& options, const Reading& reading, bool has_masks, const std::string& unit);

/// The method by the straight metric; queries of the exact index have their own. Borrows `input`. `settings` are those
/// of the method paper; `threads` build the index. Throws Error{InvalidOption} if it needs edges and there are none.
[[nodiscard]] SearchMethod method_of(const MethodOptions& options, Input& input,
                                     const paper::QueryOptions& settings = {}, unsigned threads = kAllProcessors);

/// The order that --sort names. Borrows `input`, which must have edges if it is "index".
[[nodiscard]] RowOrder row_order(const std::string& sort, Input& input);

}  // namespace meshhood::cli
