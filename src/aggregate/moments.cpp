// SPDX-License-Identifier: MIT
#include "aggregate/moments.h"

#include <variant>

namespace meshhood {
namespace {

Point as_point(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// The symmetric matrix of six entries times a vector.
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

/// The moments of a value `s` at the offset `q`.
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

}  // namespace

// Of q + t in place of q: the products are multiplied out.
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

Moments rescaled(const Moments& moments, double factor) {
  Moments result = moments;
  for (double& value : result.first) value *= factor;
  result.trace = (result.trace * factor) * factor;
  for (double& value : result.second) value = (value * factor) * factor;
  for (double& value : result.third) value = ((value * factor) * factor) * factor;
  result.fourth = (((result.fourth * factor) * factor) * factor) * factor;
  return result;
}

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

}  // namespace meshhood
