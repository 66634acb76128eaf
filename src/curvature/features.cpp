// SPDX-License-Identifier: MIT
#include "meshhood/features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/moments.h"

#include "base/vector.h"
#include "batch/rows.h"
#include "curvature/packet_moments.h"
#include "exact/query/arguments.h"
#include "patch/packet_patches.h"
#include "shared/distance.h"
#include "shared/parallel.h"
#include "shared/text.h"
#include "surface/surface.h"

namespace meshhood::inline v0_1 {
namespace {

/// What a kind follows from.
enum class Source : std::uint8_t { Curvatures, Moments, Patches };

Source source_of(Feature kind) {
  switch (kind) {
    case Feature::Height:
    case Feature::Variation: return Source::Moments;
    case Feature::Area:
    case Feature::Volume:
    case Feature::Gap: return Source::Patches;
    default: return Source::Curvatures;
  }
}

/// Computes a feature from the curvatures, times the radius.
double curvature_feature(Feature kind, double k1, double k2) {
  switch (kind) {
    case Feature::Crease: return std::abs(k1) >= std::abs(k2) ? k1 : k2;
    case Feature::Mean: return (k1 + k2) / 2;
    case Feature::Gaussian: return k1 * k2;
    case Feature::K1: return k1;
    case Feature::K2: return k2;
    case Feature::Curvedness: return curvedness(k1, k2);
    case Feature::ShapeIndex: return shape_index(k1, k2);
    default: return kNan;
  }
}

/// Computes a feature from the neighborhood of one row around a vertex with this normal.
double moment_feature(Feature kind, const PrincipalComponents& found, std::size_t row, const Point& normal,
                      double radius) {
  if (!(found.weight[row] > 0)) return kNan;
  if (kind == Feature::Variation) {
    const double* const variances = &found.variances[3 * row];
    return surface_variation(variances[0], variances[1], variances[2]);
  }
  const double* const center = &found.center[3 * row];
  return -4 * dot({center[0] / radius, center[1] / radius, center[2] / radius}, normal);
}

/// Computes a feature from a patch, in a frame of this scale.
double patch_feature(Feature kind, const RowPatch& patch, double scale) {
  const double r = patch.radius;
  if (kind == Feature::Gap) return patch.gap.face == kNoFace ? kNan : patch.gap.distance / r;
  if (!(patch.area > 0)) return kNan;
  if (kind == Feature::Area) return patch.area / r / r / std::numbers::pi;
  const double in_frame = scale * r;
  return patch.volume / in_frame / in_frame / in_frame / (4 * std::numbers::pi / 3);
}

bool is_length(double radius) { return radius > 0 && std::isfinite(radius); }

void check_is_length(double radius, const std::string& where) {
  if (is_length(radius)) return;
  raise(ErrorCode::InvalidRadius, where + to_text(radius) + ", expected a finite number > 0");
}

void check_radii(const BatchRadius& radius) {
  const std::vector<BatchRadius> passes = radius_of_passes(radius);
  const std::size_t size = radius.list() ? radius.list()->size() : passes.size();
  for (std::size_t i = 0; i < size; ++i) {
    const double r = radius.list() ? (*radius.list())[i] : passes[i].common();
    if (is_length(r)) continue;
    check_is_length(r, radius.list()     ? "row " + std::to_string(i) + ": the radius is "
                       : radius.scales() ? "radius " + std::to_string(i) + ": "
                                         : "radius ");
  }
}

/// Returns the same packet, with rows that are numbered from 0.
PacketAnswer numbered_by_query(PacketAnswer packet) {
  static constexpr auto kQueries = [] {
    std::array<std::size_t, kPacketCapacity> queries{};
    std::iota(queries.begin(), queries.end(), std::size_t{0});
    return queries;
  }();
  packet.rows = std::span(kQueries).first(packet.rows.size());
  return packet;
}

/// Runs one call of `features`. What the kinds are computed from is found for one packet at a time.
class FeatureExtraction {
 public:
  FeatureExtraction(const Surface& surface, const BatchQuery& query, const FeatureOptions& options, unsigned threads)
      : surface_(SurfaceAccess::oriented(surface, threads)),
        kinds_(options.kinds),
        metric_(query.metric),
        curvature_options_{.filter = options.filter} {
    if (kinds_.empty()) raise(ErrorCode::InvalidOption, "there are no kinds of features, expected at least one");
    check_radii(query.radius);
    const bool has_faces = surface.face_count() > 0 || surface.vertex_count() == 0;
    if (needs(Source::Patches)) {
      check_patches(has_faces);
      TaskContext task(threads);
      patches_ = &SurfaceAccess::state(surface).patches(task);
    }
    if (needs(Source::Moments)) {
      if (options.areas.empty() && !has_faces) {
        raise(ErrorCode::InvalidOption, "height and variation of a surface without faces need `areas`");
      }
      const std::span<const double> given = options.areas;
      weights_.emplace(*surface_.index, given.empty() ? surface.vertex_areas() : given, "areas");
    }
    if (metric_ == Metric::Rings) unit_ = mean_edge_length(*surface_.searched);
    values_.resize(query.result_rows(surface.vertex_count(), kinds_.size()) * kinds_.size());
  }

  std::vector<double> run(const BatchQuery& query, const Run& run) {
    const std::vector<std::vector<Source>> searches = sources_of_searches();
    for (std::size_t i = 0; i < searches.size(); ++i) {
      Run part = run;
      if (run.progress) {
        part.progress = [&, i](std::size_t done, std::size_t total) {
          return run.progress(i * total + done, searches.size() * total);
        };
      }
      const bool is_of_patches = searches[i].front() == Source::Patches;
      const auto make_writer = [&](unsigned /*thread*/) { return writer_of(searches[i]); };
      for_each_packet(is_of_patches ? patches_->searched : *surface_.searched, query, make_writer, part);
    }
    return std::move(values_);
  }

 private:
  /// Returns what each search finds. Ignored vertices are in patches, but in no neighborhood: then patches are searched
  /// alone.
  [[nodiscard]] std::vector<std::vector<Source>> sources_of_searches() const {
    std::vector<std::vector<Source>> searches(1);
    for (const Source source : {Source::Curvatures, Source::Moments, Source::Patches}) {
      if (!needs(source)) continue;
      const bool is_apart = source == Source::Patches && !surface_.index->ignored.empty() && !searches[0].empty();
      if (is_apart) searches.emplace_back();
      searches.back().push_back(source);
    }
    return searches;
  }

  PacketVisitor writer_of(const std::vector<Source>& sources) {
    std::vector<PacketVisitor> writers;
    for (const Source source : sources) {
      switch (source) {
        case Source::Curvatures: writers.push_back(curvature_writer()); break;
        case Source::Moments: writers.push_back(moment_writer()); break;
        case Source::Patches: writers.push_back(patch_writer()); break;
      }
    }
    return [writers](const PacketAnswer& packet) {
      for (const PacketVisitor& write : writers) write(packet);
    };
  }

  [[nodiscard]] bool needs(Source source) const {
    return std::ranges::any_of(kinds_, [&](Feature kind) { return source_of(kind) == source; });
  }

  void check_patches(bool has_faces) const {
    const std::string kinds = "area, volume and gap are of the surface in a ball: ";
    if (metric_ != Metric::Straight) raise(ErrorCode::InvalidOption, kinds + "expected the straight metric");
    if (!has_faces) raise(ErrorCode::InvalidOption, kinds + "expected a surface with faces");
  }

  /// Writes `value(kind)` for the kinds of a source.
  template <class F>
  void write_row(Source source, std::size_t row, const F& value) {
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
      if (source_of(kinds_[i]) == source) values_[row * kinds_.size() + i] = value(kinds_[i]);
    }
  }

  /// Writes `value(kind, query, radius)` for the rows of a packet. A ring is as wide as an edge is long.
  template <class F>
  void write(Source source, const PacketAnswer& packet, const F& value) {
    for (std::size_t q = 0; q < packet.rows.size(); ++q) {
      const double radius = unit_ * packet.radii[q];
      write_row(source, packet.rows[q], [&](Feature kind) { return value(kind, q, radius); });
    }
  }

  PacketVisitor curvature_writer() {
    const auto k = std::make_shared<Curvatures>(make_curvatures(kPacketCapacity));
    const PacketVisitor fit = curvature_visitor(surface_, metric_, curvature_options_, memory_of(*k));
    return [this, k, fit](const PacketAnswer& packet) {
      fit(numbered_by_query(packet));
      write(Source::Curvatures, packet, [&](Feature kind, std::size_t q, double radius) {
        const bool has_fit = k->state[q] != CurvatureState::TooFew && k->state[q] != CurvatureState::NoNormal;
        return has_fit ? curvature_feature(kind, radius * k->k1[q], radius * k->k2[q]) : kNan;
      });
    };
  }

  PacketVisitor moment_writer() {
    const auto found = std::make_shared<PrincipalComponents>(make_components(kPacketCapacity));
    const PacketVisitor find = component_visitor(*surface_.searched, metric_, *weights_, *found);
    return [this, found, find](const PacketAnswer& packet) {
      find(numbered_by_query(packet));
      write(Source::Moments, packet, [&](Feature kind, std::size_t q, double radius) {
        return moment_feature(kind, *found, q, surface_.normal(surface_.index->place(packet.vertices[q])), radius);
      });
    };
  }

  PacketVisitor patch_writer() {
    const auto has = [this](Feature kind) { return std::ranges::find(kinds_, kind) != kinds_.end(); };
    const PatchParts parts{.measures = has(Feature::Area) || has(Feature::Volume), .gaps = has(Feature::Gap)};
    return patch_visitor(*patches_, parts, [this](std::size_t row, const RowPatch& patch) {
      const double scale = patches_->index->frame.scale;
      write_row(Source::Patches, row, [&](Feature kind) { return patch_feature(kind, patch, scale); });
    });
  }

  OrientedIndex surface_;
  std::vector<Feature> kinds_;
  Metric metric_;
  double unit_ = 1;  // of the radii
  CurvatureOptions curvature_options_;
  std::optional<MomentWeights> weights_;  // if a kind needs them
  const PatchState* patches_ = nullptr;   // likewise
  std::vector<double> values_;
};

void check_count(std::size_t count) {
  constexpr std::size_t kMost = 1000;
  if (count >= 1 && count <= kMost) return;
  raise(ErrorCode::InvalidOption, std::to_string(count) + " radii, expected 1 to " + std::to_string(kMost));
}

/// Radii `begin` to `end` - 1, at which a feature lasts.
struct Streak {
  std::size_t begin;
  std::size_t end;

  [[nodiscard]] std::size_t size() const { return end - begin; }
};

/// Returns the longest run of values of one sign that are as strong as the threshold.
template <class ValueAt>
Streak longest_streak(std::size_t radii, double threshold, const ValueAt& value) {
  Streak longest{0, 0};
  Streak run{0, 0};
  for (std::size_t i = 0; i < radii; ++i) {
    const bool strong = std::abs(value(i)) >= threshold;
    const bool continues = strong && run.end == i && run.size() > 0 && (value(i) > 0) == (value(i - 1) > 0);
    if (strong) run = {continues ? run.begin : i, i + 1};
    if (run.size() > longest.size()) longest = run;
  }
  return longest;
}

}  // namespace

std::vector<double> features(const Surface& surface, const BatchQuery& query, const FeatureOptions& options,
                             const Run& run) {
  return FeatureExtraction(surface, query, options, run.threads).run(query, run);
}

std::vector<double> geometric_radii(double smallest, double largest, std::size_t count) {
  check_is_length(smallest, "radius ");
  check_is_length(largest, "radius ");
  check_count(count);
  if (smallest > largest) {
    raise(ErrorCode::InvalidRadius,
          "the smallest radius is " + to_text(smallest) + ", but the largest " + to_text(largest));
  }
  if (count == 1) return {largest};
  std::vector<double> radii;
  // Exponents are kept apart, because the quotient of the radii may overflow, and products with denormals lose digits.
  int low = 0;
  int high = 0;
  const double first = std::frexp(smallest, &low);
  const double octaves = std::log2(std::frexp(largest, &high) / first) + (high - low);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const double octave = octaves * static_cast<double>(i) / static_cast<double>(count - 1);
    const double whole = std::floor(octave);
    radii.push_back(std::ldexp(first * std::exp2(octave - whole), low + static_cast<int>(whole)));
  }
  radii.push_back(largest);
  return radii;
}

Persistence persistence(std::span<const double> values, std::span<const double> radii, double threshold) {
  if (radii.empty() || values.size() % radii.size() != 0) {
    raise(ErrorCode::InvalidOption, std::to_string(values.size()) + " values for " + std::to_string(radii.size()) +
                                        " radii, expected as many for each");
  }
  if (!(threshold > 0)) raise(ErrorCode::InvalidOption, "threshold " + to_text(threshold) + ", expected a number > 0");
  check_ascending(radii);
  const std::size_t rows = values.size() / radii.size();
  Persistence result{std::vector<std::int32_t>(rows), std::vector<double>(rows), std::vector<double>(rows)};
  for (std::size_t row = 0; row < rows; ++row) {
    const auto value = [&](std::size_t i) { return values[i * rows + row]; };
    const Streak run = longest_streak(radii.size(), threshold, value);
    if (run.size() == 0) continue;
    std::size_t best = run.begin;
    for (std::size_t i = run.begin; i < run.end; ++i) {
      if (std::abs(value(i)) > std::abs(value(best))) best = i;
    }
    const auto scales = static_cast<std::int32_t>(run.size());
    result.scales[row] = value(best) > 0 ? scales : -scales;
    result.strength[row] = value(best);
    result.radius[row] = radii[best];
  }
  return result;
}

}  // namespace meshhood::inline v0_1
