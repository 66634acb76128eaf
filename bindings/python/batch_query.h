// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/run.h"

#include "arrays.h"
#include "interpreter.h"

namespace meshhood::python {

/// A number; an array, one for each row; or a list, of scales.
using Radius = std::variant<double, Reals, std::vector<double>>;

/// Numbers of faces, and a point of each.
using FacePoints =
    std::pair<nanobind::ndarray<const std::int64_t, nanobind::shape<-1>, nanobind::c_contig, nanobind::device::cpu>,
              Points>;

/// What every call on many vertices has: the rows, all of them without `vertices`, and how it runs.
struct Call {
  std::optional<Ids> vertices;
  std::optional<FacePoints> points;  ///< in place of vertices
  Radius radius;
  Metric metric;
  unsigned threads;
  nanobind::object progress;
  std::uint64_t max_bytes;

  /// Borrows the arrays.
  [[nodiscard]] BatchQuery query() const {
    BatchQuery query{.metric = metric};
    if (vertices) query.vertices = ids_of(*vertices);
    if (const auto* const radii = std::get_if<Reals>(&radius)) {
      query.radius = numbers_of(*radii);
    } else if (const auto* const scales = std::get_if<std::vector<double>>(&radius)) {
      query.radius = BatchRadius::scales(*scales);
    } else {
      query.radius = std::get<double>(radius);
    }
    return query;
  }

  /// Of the points. Borrowed.
  [[nodiscard]] IndicesView faces() const { return std::span(points->first.data(), points->first.size()); }
  [[nodiscard]] std::span<const SpacePoint> face_points() const { return points_of(points->second); }

  /// Made by the thread that will report.
  [[nodiscard]] Run run() const {
    return {.threads = threads, .progress = progress_to(progress), .max_bytes = max_bytes};
  }
};

}  // namespace meshhood::python
