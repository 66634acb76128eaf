// SPDX-License-Identifier: MIT
#include "meshhood/features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/moments.h"

#include "base/vector.h"
#include "batch/rows.h"
#include "patch/patches.h"
#include "shared/distance.h"
#include "shared/text.h"
#include "surface/surface.h"

namespace meshhood {
namespace {

constexpr double kNoFeature = std::numeric_limits<double>::quiet_NaN();

/// What a kind follows from.
enum class Source : std::uint8_t { Curvatures, Moments, Patches };
constexpr std::array kSources{Source::Curvatures, Source::Moments, Source::Patches};

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

double crease(double k1, double k2) { return std::abs(k1) >= std::abs(k2) ? k1 : k2; }

/// From the curvatures, times the radius.
double curvature_feature(Feature kind, double k1, double k2) {
  switch (kind) {
    case Feature::Crease: return crease(k1, k2);
    case Feature::Mean: return (k1 + k2) / 2;
    case Feature::Gaussian: return k1 * k2;
    case Feature::K1: return k1;
    case Feature::K2: return k2;
    case Feature::Curvedness: return curvedness(k1, k2);
    case Feature::ShapeIndex: return shape_index(k1, k2);
    default: return kNoFeature;
  }
}

/// From the neighborhood of one row around a vertex with this normal.
double moment_feature(Feature kind, const PrincipalComponents& found, std::size_t row, const Point& normal,
                      double radius) {
  if (!(found.weight[row] > 0)) return kNoFeature;
  if (kind == Feature::Variation) {
    const double* const variances = &found.variances[3 * row];
    return surface_variation(variances[0], variances[1], variances[2]);
  }
  const double* const center = &found.center[3 * row];
  return -4 * dot({center[0] / radius, center[1] / radius, center[2] / radius}, normal);
}

double patch_feature(Feature kind, const FoundPatch& patch, double radius) {
  if (kind == Feature::Gap) {
    const SurfacePoint gap = patch.gap();
    return gap.face == kNoFace ? kNoFeature : gap.distance / radius;
  }
  const double area = patch.area();
  if (!(area > 0)) return kNoFeature;
  if (kind == Feature::Area) return area / radius / radius / std::numbers::pi;
  return patch.volume() / radius / radius / radius / (4 * std::numbers::pi / 3);
}

/// What one call of `features` computes, radius by radius.
class FeatureExtraction {
 public:
  FeatureExtraction(const Surface& surface, const BatchQuery& query, FeatureOptions options, const Run& run)
      : surface_(surface),
        state_(SurfaceAccess::oriented(surface, run.threads)),
        radii_(radius_of_passes(query.radius)),
        metric_(query.metric),
        options_(std::move(options)),
        run_(run),
        rows_(surface.vertex_count()) {
    if (const auto& list = query.vertices.list()) {
      listed_.assign(list->begin(), list->end());
      rows_ = listed_.size();
      vertices_ = listed_;
    }
    if (const auto& list = query.radius.list()) {
      radius_of_row_.assign(list->begin(), list->end());
      radii_ = {BatchRadius(radius_of_row_)};
    }
    check();
    if (metric_ == Metric::Rings) unit_ = mean_edge_length(*state_.searched);
  }

  std::vector<double> run() {
    const std::size_t of_radius = rows_ * options_.kinds.size();
    std::vector<double> result(radii_.size() * of_radius);
    for (std::size_t i = 0; i < radii_.size(); ++i) {
      const auto values = std::span(result).subspan(i * of_radius, of_radius);
      if (needs(Source::Curvatures)) write_curvatures(radii_[i], values);
      if (needs(Source::Moments)) write_moments(radii_[i], values);
      if (needs(Source::Patches)) write_patches(radii_[i], values);
    }
    return result;
  }

 private:
  [[nodiscard]] bool needs(Source source) const {
    return std::ranges::any_of(options_.kinds, [&](Feature kind) { return source_of(kind) == source; });
  }

  /// In the unit of the positions. A ring is as wide as an edge is long.
  [[nodiscard]] double radius_at(const BatchRadius& radius, std::size_t row) const {
    return unit_ * (radius.list() ? radius_of_row_[row] : radius.common());
  }

  static void check(double radius, const std::string& where) {
    if (radius > 0 && std::isfinite(radius)) return;
    raise(ErrorCode::InvalidRadius, where + to_text(radius) + ", expected a finite number > 0");
  }

  void check() {
    if (options_.kinds.empty())
      raise(ErrorCode::InvalidOption, "there are no kinds of features, expected at least one");
    for (std::size_t i = 0; i < radius_of_row_.size(); ++i) {
      check(radius_of_row_[i], "row " + std::to_string(i) + ": the radius is ");
    }
    for (std::size_t i = 0; i < radii_.size(); ++i) {
      if (!radii_[i].list()) check(radii_[i].common(), "radius " + std::to_string(i) + ": ");
    }
    check_patches();
    if (!needs(Source::Moments) || !options_.areas.empty()) return;
    if (!has_faces()) raise(ErrorCode::InvalidOption, "height and variation of a surface without faces need `areas`");
    options_.areas = surface_.vertex_areas();
  }

  void check_patches() const {
    if (!needs(Source::Patches)) return;
    const std::string kinds = "area, volume and gap are of the surface in a ball: ";
    if (metric_ != Metric::Straight) raise(ErrorCode::InvalidOption, kinds + "expected the straight metric");
    if (!has_faces()) raise(ErrorCode::InvalidOption, kinds + "expected a surface with faces");
  }

  [[nodiscard]] bool has_faces() const { return surface_.face_count() > 0 || surface_.vertex_count() == 0; }

  [[nodiscard]] BatchQuery query_of(const BatchRadius& radius) const {
    return {.vertices = vertices_, .radius = radius, .metric = metric_};
  }

  /// `value(kind, row, radius)` for the kinds of a source.
  template <class F>
  void write(Source source, const BatchRadius& radius_of_rows, std::span<double> values, const F& value) const {
    for (std::size_t row = 0; row < rows_; ++row) {
      const double radius = radius_at(radius_of_rows, row);
      write_row(source, row, values, [&](Feature kind) { return value(kind, row, radius); });
    }
  }

  /// `value(kind)`.
  template <class F>
  void write_row(Source source, std::size_t row, std::span<double> values, const F& value) const {
    const std::size_t kinds = options_.kinds.size();
    for (std::size_t i = 0; i < kinds; ++i) {
      const Feature kind = options_.kinds[i];
      if (source_of(kind) == source) values[row * kinds + i] = value(kind);
    }
  }

  void write_curvatures(const BatchRadius& radii, std::span<double> values) {
    const Curvatures k = curvatures(surface_, query_of(radii), {.filter = options_.filter}, next_pass());
    write(Source::Curvatures, radii, values, [&](Feature kind, std::size_t row, double radius) {
      const bool has_fit = k.state[row] != CurvatureState::TooFew && k.state[row] != CurvatureState::NoNormal;
      return has_fit ? curvature_feature(kind, radius * k.k1[row], radius * k.k2[row]) : kNoFeature;
    });
  }

  void write_moments(const BatchRadius& radii, std::span<double> values) {
    const PrincipalComponents found =
        principal_components(*state_.searched, query_of(radii), {.weights = options_.areas}, next_pass());
    write(Source::Moments, radii, values, [&](Feature kind, std::size_t row, double radius) {
      return moment_feature(kind, found, row, state_.normal(state_.index->place(vertices_[row])), radius);
    });
  }

  void write_patches(const BatchRadius& radii, std::span<double> values) {
    const bool measures = std::ranges::any_of(
        options_.kinds, [](Feature kind) { return kind == Feature::Area || kind == Feature::Volume; });
    for_each_patch(surface_, query_of(radii), measures, next_pass(), [&](std::size_t row, const FoundPatch& patch) {
      write_row(Source::Patches, row, values, [&](Feature kind) { return patch_feature(kind, patch, patch.radius()); });
    });
  }

  Run next_pass() {
    Run pass{.threads = run_.threads};
    if (!run_.progress) return pass;
    std::size_t passes = 0;
    for (const Source source : kSources) {
      if (needs(source)) passes += radii_.size();
    }
    pass.progress = [this, passes, before = passes_begun_++ * rows_](std::size_t done, std::size_t /*total*/) {
      return run_.progress(before + done, passes * rows_);
    };
    return pass;
  }

  const Surface& surface_;
  OrientedIndex state_;
  std::vector<BatchRadius> radii_;  // of the passes
  Metric metric_;
  double unit_ = 1;  // of the radii
  FeatureOptions options_;
  const Run& run_;
  std::vector<VertexId> listed_;
  BatchVertices vertices_;
  std::vector<double> radius_of_row_;  // if there is one for each
  std::size_t rows_;
  std::size_t passes_begun_ = 0;
};

void check_largest(double radius) {
  if (radius > 0 && std::isfinite(radius)) return;
  raise(ErrorCode::InvalidRadius, "radius " + to_text(radius) + ", expected a finite number > 0");
}

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

/// The longest run of values of one sign that are as strong as the threshold.
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
  return FeatureExtraction(surface, query, options, run).run();
}

std::vector<double> geometric_radii(double smallest, double largest, std::size_t count) {
  check_largest(smallest);
  check_largest(largest);
  check_count(count);
  if (smallest > largest) {
    raise(ErrorCode::InvalidRadius,
          "the smallest radius is " + to_text(smallest) + ", but the largest " + to_text(largest));
  }
  if (count == 1) return {largest};
  std::vector<double> radii;
  // Exponents apart, because the quotient of the radii may overflow, and products with a denormal number lose digits.
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
  for (std::size_t i = 1; i < radii.size(); ++i) {
    if (radii[i] > radii[i - 1]) continue;
    raise(ErrorCode::InvalidRadius, "radius " + std::to_string(i) + ": " + to_text(radii[i]) + " after " +
                                        to_text(radii[i - 1]) + ", expected ascending radii");
  }
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

}  // namespace meshhood
