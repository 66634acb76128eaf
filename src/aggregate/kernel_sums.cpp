// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "aggregate/reducers.h"
#include "base/vector.h"
#include "shared/distance.h"
#include "simd/aggregate.h"

namespace meshhood::inline v0_1 {
namespace {

// In smaller balls, relative to the frame, products of four offsets might underflow.
constexpr double kLeastRadius = 0x1p-200;

// The sum over a node is rounded as if each vertex had the weight 1. That is too much where a vertex near the rim has a
// value that is much larger than the others. So a node is summed by its parts if it reaches nearer to the rim than
// `kRim` times the radius, and most of its values are less than the largest by the factor `kUneven`.
constexpr double kRim = 1.0 / 64;
constexpr double kUneven = 64;

Point as_point(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// Multiplies the symmetric matrix of six entries by a vector.
Point product(const std::array<double, 6>& m, const Point& t) {
  const auto& [xx, xy, xz, yy, yz, zz] = m;
  return {xx * t.x + xy * t.y + xz * t.z, xy * t.x + yy * t.y + yz * t.z, xz * t.x + yz * t.y + zz * t.z};
}

void add(Moments& sum, const Moments& moments) {
  sum.zeroth += moments.zeroth;
  sum.trace += moments.trace;
  sum.fourth += moments.fourth;
  for (std::size_t i = 0; i < 3; ++i) sum.first[i] += moments.first[i];
  for (std::size_t i = 0; i < 6; ++i) sum.second[i] += moments.second[i];
  for (std::size_t i = 0; i < 3; ++i) sum.third[i] += moments.third[i];
}

/// Returns the moments of a value `s` at the offset `q`.
Moments moments_of(double s, const Point& q) {
  const double square = dot(q, q);
  const Point first = s * q;
  const Point third = square * first;
  return {s,
          {first.x, first.y, first.z},
          s * square,
          {first.x * q.x, first.x * q.y, first.x * q.z, first.y * q.y, first.y * q.z, first.z * q.z},
          {third.x, third.y, third.z},
          (s * square) * square};
}

/// Returns the same moments about the point that lies at `-t` from the present one: every offset q becomes q + t, and
/// the products are multiplied out.
Moments shifted(const Moments& moments, const Point& t) {
  const double s0 = moments.zeroth;
  const Point s1 = as_point(moments.first);
  const Point s3 = as_point(moments.third);
  const Point matrix_t = product(moments.second, t);
  const double along = dot(t, s1);
  const double square = dot(t, t);
  const Point first = s1 + s0 * t;
  const Point third = s3 + 2.0 * matrix_t + square * s1 + (moments.trace + 2 * along + square * s0) * t;
  const auto& [xx, xy, xz, yy, yz, zz] = moments.second;
  return {
      s0,
      {first.x, first.y, first.z},
      moments.trace + 2 * along + square * s0,
      {xx + 2 * t.x * s1.x + t.x * t.x * s0, xy + t.x * s1.y + t.y * s1.x + t.x * t.y * s0,
       xz + t.x * s1.z + t.z * s1.x + t.x * t.z * s0, yy + 2 * t.y * s1.y + t.y * t.y * s0,
       yz + t.y * s1.z + t.z * s1.y + t.y * t.z * s0, zz + 2 * t.z * s1.z + t.z * t.z * s0},
      {third.x, third.y, third.z},
      moments.fourth + 4 * (dot(t, s3) + dot(t, matrix_t)) + square * (2 * moments.trace + 4 * along + square * s0)};
}

/// Returns the same moments in a unit in which lengths are `factor` times as large.
Moments rescaled(const Moments& moments, double factor) {
  Moments result = moments;
  for (double& value : result.first) value *= factor;
  result.trace = (result.trace * factor) * factor;
  for (double& value : result.second) value = (value * factor) * factor;
  for (double& value : result.third) value = ((value * factor) * factor) * factor;
  result.fourth = (((result.fourth * factor) * factor) * factor) * factor;
  return result;
}

/// Returns the moments of a column over each node, about its center (see `NodeTree::center`), in units of the frame.
std::vector<Moments> moments_by_node(const IndexView& index, const NodeTree& tree, const Column& column) {
  std::vector<Moments> moments(tree.size());
  for (NodeTree::Node node = 0; node < tree.size(); ++node) {
    const Point center = tree.center(node);
    if (tree.is_leaf(node)) {
      const VertexRange vertices = tree.vertices(node);
      std::visit(
          [&](auto xyz) {
            for (std::size_t i = vertices.begin; i < vertices.end; ++i)
              add(moments[node], moments_of(column[i], index.frame.scale * (point(xyz, i) - center)));
          },
          index.positions);
    } else {
      const auto [begin, end] = tree.children(node);
      for (NodeTree::Node child = begin; child < end; ++child)
        add(moments[node], shifted(moments[child], index.frame.scale * (tree.center(child) - center)));
    }
  }
  return moments;
}

PerLane<double> filled(double number) {
  PerLane<double> row;
  row.fill(number);
  return row;
}

/// These weights are polynomials of the square of the distance, so the sum over a node follows from moments of the
/// values over the node (see `AggregateKernels::add_moments`).
struct KernelSums {
  /// Marks the nodes of which few values are much larger than the others, or one is infinite.
  void mark_uneven(const Column& column);

  const IndexView* index;
  const NodeTree* tree;
  SumColumns columns;
  bool squared;
  std::vector<std::vector<Moments>> moments = {};  // by column, then by node
  std::vector<bool> uneven = {};                   // by node, in one of the columns
  std::vector<bool> infinite = {};                 // likewise; their moments are NaN
};

void KernelSums::mark_uneven(const Column& column) {
  uneven.resize(tree->size());
  infinite.resize(tree->size());
  for (NodeTree::Node node = 0; node < tree->size(); ++node) {
    const VertexRange vertices = tree->vertices(node);
    const auto values = std::span(column).subspan(vertices.begin, vertices.size());
    double largest = 0;
    for (const double value : values) largest = std::max(largest, std::abs(value));
    std::size_t small = 0;
    for (const double value : values) small += static_cast<std::size_t>(std::abs(value) < largest / kUneven);
    if (2 * small > values.size()) uneven[node] = true;
    if (std::isinf(largest)) infinite[node] = true;
  }
}

class KernelSumReducer final : public PacketReducer {
 public:
  explicit KernelSumReducer(const KernelSums& tables) : tables_(&tables), sums_(tables.columns.size()) {}

  void begin(const PacketAnswer& packet) override {
    for (RowSums& sums : sums_) sums = {};
    const IndexView& index = *tables_->index;
    for (std::size_t row = 0; row < packet.vertices.size(); ++row) {
      centers_.set(row, index.position_of(packet.vertices[row]));
    }
    set_radii(packet.radii);
  }

  void add_nodes(const NodeTree::Children& nodes, const QueryWord* queries) override {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (queries[k] != 0) add_node(nodes.begin + static_cast<NodeTree::Node>(k), queries[k]);
    }
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    std::visit(
        [&](auto xyz) {
          for (std::size_t k = 0; k < vertices.size(); ++k) {
            if (queries[k] == 0) continue;
            kernels_->set_offsets(point(xyz, vertices.begin + k), centers_, offsets_);
            kernels_->set_weights(offsets_, squares_, tables_->squared, weights_[k]);
          }
        },
        tables_->index->positions);
    tables_->columns.add_weighted(*kernels_, vertices, queries, weights_, sums_);
  }

  void write(std::size_t row, std::span<double> channels) override { tables_->columns.write(sums_, row, channels); }

 private:
  /// The rows whose radius has the same unit.
  struct Unit {
    double unit;
    QueryWord rows;
  };

  void set_radii(std::span<const double> radii) {
    units_.clear();
    least_in_frame_ = kInfinity;
    for (std::size_t row = 0; row < radii.size(); ++row) {
      set_radius(row, radii[row]);
      least_in_frame_ = std::min(least_in_frame_, in_frame_[row]);
      const auto has_unit = [&](const Unit& unit) { return unit.unit == centers_.unit[row]; };
      auto found = std::ranges::find_if(units_, has_unit);
      if (found == units_.end()) found = units_.insert(found, {centers_.unit[row], 0});
      found->rows |= QueryWord{1} << row;
    }
  }

  void set_radius(std::size_t row, double radius) {
    if (radius == given_[row]) return;  // nearly all rows of a call have the same radius
    given_[row] = radius;
    in_frame_[row] = radius * tables_->index->frame.scale;
    const bool has_square = radius > 0 && std::isfinite(radius);
    centers_.unit[row] = has_square ? std::ldexp(1.0, std::min(-std::ilogb(radius), 1000)) : 0;
    radius_[row] = has_square ? radius * centers_.unit[row] : 1;  // with a unit of 0, all weights are 1
    // This is Dekker's product: the parts of the radius have 24 and 29 bits.
    const double square = radius_[row] * radius_[row];
    const auto high = static_cast<double>(static_cast<float>(radius_[row]));
    const double rest = radius_[row] - high;
    squares_.square[row] = square;
    squares_.low[row] = ((high * high - square) + 2 * high * rest) + rest * rest;
    squares_.inverse[row] = 1 / square;
  }

  void add_node(NodeTree::Node node, QueryWord queries) {
    QueryWord inner = tables_->infinite[node] ? 0 : queries & with_moments_for(node);
    if (inner != 0) {
      kernels_->set_offsets(tables_->tree->center(node), centers_, offsets_);
      if (tables_->uneven[node]) inner &= inside_the_rim(node);
    }
    if (inner != 0) add_moments(node, inner);
    if (inner != queries) add_parts(node, queries & ~inner);
  }

  /// Returns the queries in whose balls the sphere of a node lies, away from the rim.
  [[nodiscard]] QueryWord inside_the_rim(NodeTree::Node node) const {
    QueryWord word = 0;
    for (const auto& [unit, rows] : units_) {
      const double size = static_cast<double>(tables_->tree->sphere(node).radius) * from_frame(unit);
      for_each_lane(rows, [&](unsigned row) {
        const double most = radius_[row] * (1 - kRim) - size;
        // NOLINTNEXTLINE(clang-analyzer-core.NullDereference): the checker loses the binding `unit`
        const bool is_inside = unit == 0 || (most > 0 && offsets_.square[row] <= most * most);
        word |= QueryWord{is_inside} << row;
      });
    }
    return word;
  }

  /// `offsets_` must be those of the center of the node.
  void add_moments(NodeTree::Node node, QueryWord inner) {
    for (const auto& [unit, rows] : units_) {
      if ((rows & inner) == 0) continue;
      for (std::size_t i = 0; i < sums_.size(); ++i) {
        const Moments moments = rescaled(tables_->moments[i][node], from_frame(unit));
        kernels_->add_moments(moments, offsets_, squares_, tables_->squared, rows & inner, sums_[i]);
      }
    }
  }

  [[nodiscard]] double from_frame(double unit) const { return unit / tables_->index->frame.scale; }

  /// Returns the queries for which moments of the node are accurate. Its vertices lie in the ball, but its sphere,
  /// whose center is rounded to floats, may be larger. Then offsets from the center are longer than the radius, and
  /// their sums would cancel.
  [[nodiscard]] QueryWord with_moments_for(NodeTree::Node node) const {
    const double least = std::max(static_cast<double>(tables_->tree->sphere(node).radius), kLeastRadius);
    if (least_in_frame_ >= least) return ~QueryWord{0};
    QueryWord word = 0;
    for (const auto& [unit, rows] : units_) {
      for_each_lane(rows, [&](unsigned row) { word |= QueryWord{in_frame_[row] >= least} << row; });
    }
    return word;
  }

  void add_parts(NodeTree::Node node, QueryWord queries) {
    const NodeTree& tree = *tables_->tree;
    if (tree.is_leaf(node)) {
      PerLane<QueryWord> words;
      words.fill(queries);
      add_leaf(tree.vertices(node), words.data());
    } else {
      const auto [begin, end] = tree.children(node);
      for (NodeTree::Node child = begin; child < end; ++child) add_node(child, queries);
    }
  }

  const KernelSums* tables_;
  const AggregateKernels* kernels_ = &aggregate_kernels(best_isa());
  PerLane<double> given_ = filled(kNan);  // the radius of each row, NaN if unknown
  PerLane<double> in_frame_{};
  PerLane<double> radius_ = filled(1);  // in the unit of the row
  KernelRadii squares_{filled(1), {}, filled(1)};
  double least_in_frame_ = 0;
  std::vector<Unit> units_;
  PacketCenters centers_{};
  Offsets offsets_{};
  RowWeights weights_{};
  std::vector<RowSums> sums_;  // by column
};

}  // namespace

ReducerFactory kernel_sum_reducers(const IndexView& index, const NodeTree& tree, SumColumns columns, bool squared) {
  KernelSums tables{&index, &tree, std::move(columns), squared};
  for (std::size_t i = 0; i < tables.columns.size(); ++i) {
    tables.moments.push_back(moments_by_node(index, tree, tables.columns.column(i)));
    tables.mark_uneven(tables.columns.column(i));
  }
  return factory_of<KernelSumReducer>(std::move(tables));
}

double smoothing_radius(double fwhm) {
  check_radius(fwhm, "fwhm: ");
  constexpr double kRadius = 1.5784315224822145;  // sqrt(log2(1000)) / 2
  return kRadius * fwhm;
}

double smoothing_weight(SmoothingKernel kernel, double distance, double radius) {
  if (!(distance <= radius)) return 0;
  if (kernel == SmoothingKernel::Box || distance == 0) return 1;
  const double share = distance / radius;
  if (kernel == SmoothingKernel::Gaussian) return gaussian(share * share);
  // The formula is not 1 - share^2, whose rounding would give a vertex at the radius a weight.
  const double weight = (1 - share) * (1 + share);
  return kernel == SmoothingKernel::Biweight ? weight * weight : weight;
}

}  // namespace meshhood::inline v0_1
