// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "simd/joint.h"
#include "simd/kernels.h"

/// The kernels as plain loops, a lane after the other: what those of each instruction set are compared with.
namespace meshhood::test {
namespace plain {

template <class Real>
LaneMask within(const Real* xyz, std::size_t size, const LeafBall& ball) {
  LaneMask result = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const Point p = point(std::span(xyz, 3 * size), i);
    result |= LaneMask{squared_distance(p, ball.center) <= ball.squared_radius} << i;
  }
  return result;
}

template <class Real>
LaneMask squares(const Real* xyz, std::size_t size, const LeafBall& ball, PerLane<double>& out) {
  for (std::size_t i = 0; i < size; ++i) out[i] = squared_distance(point(std::span(xyz, 3 * size), i), ball.center);
  return within(xyz, size, ball);
}

inline LaneMask cross_edges(std::span<const CrossEdge> edges, LaneMask from) {
  LaneMask result = 0;
  for (const CrossEdge& edge : edges) result |= (from >> edge.from & 1U) << edge.to;
  return result;
}

inline LaneMask reachable(const LaneMask* adjacency, LaneMask among, LaneMask from) {
  LaneMask reached = from;
  for (LaneMask todo = from; todo != 0 && reached != among;) {
    const LaneMask added = adjacency[std::countr_zero(todo)] & among & ~reached;
    todo = (todo & (todo - 1)) | added;
    reached |= added;
  }
  return reached;
}

inline GroupContainment classify_group(const Group& group, const TreeBall& ball) {
  GroupContainment result{0, 0};
  for (unsigned i = 0; i < kFanOut; ++i) {
    const float x = ball.x - group.x[i];
    const float y = ball.y - group.y[i];
    const float z = ball.z - group.z[i];
    const float square = (x * x + y * y) + z * z;
    const float far = ball.outer + group.radius[i];
    const float near = ball.inner - group.radius[i];
    const bool outside = square > far * far;
    const bool inside = near > 0 && square < near * near;
    result.inside = static_cast<std::uint8_t>(result.inside | unsigned{inside} << i);
    result.intersecting = static_cast<std::uint8_t>(result.intersecting | unsigned{!outside && !inside} << i);
  }
  return result;
}

inline void classify(const Group* groups, std::span<const std::uint32_t> list, const TreeBall& ball,
                     GroupContainment* out) {
  for (const std::uint32_t group : list) *out++ = classify_group(groups[group], ball);
}

inline unsigned box_squares(const BoxGroup& boxes, const FramePoint& center, float limit, BoxGroup::Row& squares) {
  unsigned near = 0;
  for (unsigned i = 0; i < kFanOut; ++i) {
    const auto gap = [i](float at, const BoxGroup::Row& low, const BoxGroup::Row& high) {
      return at < low[i] ? low[i] - at : std::max(at - high[i], 0.0F);
    };
    const float x = gap(center.x, boxes.low.x, boxes.high.x);
    const float y = gap(center.y, boxes.low.y, boxes.high.y);
    const float z = gap(center.z, boxes.low.z, boxes.high.z);
    squares[i] = (x * x + y * y) + z * z;
    near |= unsigned{squares[i] <= limit} << i;
  }
  return near;
}

inline unsigned box_entries(const BoxGroup& boxes, const BoxRay& ray, float limit, BoxGroup::Row& entries) {
  unsigned met = 0;
  for (unsigned i = 0; i < kFanOut; ++i) {
    float entry = 0;
    float exit = limit;
    const auto cross_slab = [&](const BoxRay::Axis& axis, float low, float high) {
      float enters = (low - axis.low) * axis.inverse;
      float leaves = (high - axis.high) * axis.inverse;
      if (axis.inverse < 0) std::swap(enters, leaves);
      entry = std::max(entry, enters);
      exit = std::min(exit, leaves);
    };
    cross_slab(ray.x, boxes.low.x[i], boxes.high.x[i]);
    cross_slab(ray.y, boxes.low.y[i], boxes.high.y[i]);
    cross_slab(ray.z, boxes.low.z[i], boxes.high.z[i]);
    entries[i] = entry;
    met |= unsigned{entry <= exit * kExitSlack} << i;
  }
  return met;
}

inline VertexId* compress(const VertexId* ids, LaneMask lanes, VertexId* out) {
  for (; lanes != 0; lanes &= lanes - 1) *out++ = ids[std::countr_zero(lanes)];
  return out;
}

/// The words of one vertex: compares it with all balls of the packet.
inline QueryWord compare(const LeafPoints& points, std::size_t lane, const PacketBalls& balls, QueryWord& maybe) {
  QueryWord sure = 0;
  maybe = 0;
  for (std::size_t i = 0; i < kPacketCapacity; ++i) {
    const float along = (points.x[lane] * balls.x[i] + points.y[lane] * balls.y[i]) + points.z[lane] * balls.z[i];
    const float height = along - points.square[lane];
    sure |= QueryWord{height >= balls.surely_inside[i]} << i;
    maybe |= QueryWord{height >= balls.maybe_inside[i]} << i;
  }
  return sure;
}

inline float squared_distance_to_center(const LeafPoints& points, std::size_t lane, const PacketBalls& balls) {
  const float x = points.x[lane] - balls.center.x;
  const float y = points.y[lane] - balls.center.y;
  const float z = points.z[lane] - balls.center.z;
  return (x * x + y * y) + z * z;
}

inline BallWords ball_words(const LeafPoints& points, LaneMask lanes, const PacketBalls& balls,
                            PerLane<QueryWord>& inside, PerLane<QueryWord>& doubts) {
  BallWords result{balls.queries, 0};
  inside = {};
  for (LaneMask left = lanes; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const float square = squared_distance_to_center(points, lane, balls);
    if (square > balls.outside_all) {
      result.all = 0;
    } else if (square < balls.inside_all) {
      inside[lane] = balls.queries;
    } else {
      QueryWord maybe = 0;
      inside[lane] = compare(points, lane, balls, maybe);
      result.all &= inside[lane];
      doubts[lane] = maybe & ~inside[lane];
      result.in_doubt |= LaneMask{doubts[lane] != 0} << lane;
    }
  }
  return result;
}

inline void clear_words(LeafWords& words) {
  words.reached = {};
  words.pending = {};
}

/// Reaches the open neighbors of the lanes `from`; returns those that have gained.
inline LaneMask spread_once(LeafWords& words, const LaneMask* adjacency, LaneMask from, LaneMask open) {
  LaneMask gained = 0;
  for (; from != 0; from &= from - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(from));
    for (LaneMask left = adjacency[lane] & open; left != 0; left &= left - 1) {
      const auto neighbor = static_cast<std::size_t>(std::countr_zero(left));
      const QueryWord grown = words.reached[neighbor] | (words.reached[lane] & words.inside[neighbor]);
      gained |= LaneMask{grown != words.reached[neighbor]} << neighbor;
      words.reached[neighbor] = grown;
    }
  }
  return gained;
}

/// The lanes in which the words differ.
inline LaneMask differing(const PerLane<QueryWord>& a, const PerLane<QueryWord>& b) {
  LaneMask lanes = 0;
  for (std::size_t i = 0; i < kLeafCapacity; ++i) lanes |= LaneMask{a[i] != b[i]} << i;
  return lanes;
}

/// Moves what is pending to `reached`; returns the lanes that gained.
inline LaneMask take_pending(LeafWords& words, QueryWord whole) {
  const PerLane<QueryWord> before = words.reached;
  QueryWord any = 0;
  for (std::size_t i = 0; i < kLeafCapacity; ++i) {
    words.reached[i] |= words.pending[i] & words.inside[i];
    any |= words.reached[i];
  }
  for (std::size_t i = 0; i < kLeafCapacity; ++i) words.reached[i] |= any & whole & words.inside[i];
  words.pending = {};
  return differing(words.reached, before);
}

inline SpreadWords spread_words(LeafWords& words, const LaneMask* adjacency, QueryWord whole) {
  SpreadWords result{take_pending(words, whole), false};
  LaneMask open = differing(words.reached, words.inside);
  for (LaneMask fresh = result.gained; fresh != 0 && open != 0; open = differing(words.reached, words.inside)) {
    fresh = spread_once(words, adjacency, fresh, open);
    result.gained |= fresh;
  }
  result.closed = open == 0;
  return result;
}

inline LaneMask step_words(LeafWords& words, FreshWords& fresh, const LaneMask* adjacency, LaneMask from, LaneMask open,
                           QueryWord alive) {
  PerLane<QueryWord> arriving = words.pending;
  for_each_lane(from, [&](unsigned lane) {
    for_each_lane(adjacency[lane], [&](unsigned neighbor) { arriving[neighbor] |= fresh[lane]; });
  });
  LaneMask lanes = 0;
  for (unsigned lane = 0; lane < kLeafCapacity; ++lane) {
    fresh[lane] = (open >> lane & 1U) != 0 ? arriving[lane] & alive & ~words.reached[lane] : 0;
    words.reached[lane] |= fresh[lane];
    lanes |= LaneMask{fresh[lane] != 0} << lane;
  }
  words.pending = {};
  return lanes;
}

inline void count_words(const LeafWords* words, std::span<const LeafOfWords> list, PerLane<std::uint64_t>& counts) {
  for (const LeafOfWords& leaf : list) {
    for (const QueryWord word : words[leaf.words].reached) {
      for_each_query(word, [&](std::size_t query) { ++counts[query]; });
    }
  }
}

inline LaneMask lanes_of(const QueryWord* reached, unsigned query) {
  LaneMask lanes = 0;
  for (std::size_t i = 0; i < kLeafCapacity; ++i) lanes |= LaneMask{(reached[i] >> query & 1U) != 0} << i;
  return lanes;
}

inline void write_row(std::span<const Piece> pieces, const VertexId* leaf_begin, unsigned query,
                      const VertexId* permutation, std::span<VertexId> out) {
  VertexId* next = out.data();
  const auto write = [&](std::uint32_t vertex) {
    *next++ = permutation == nullptr ? static_cast<VertexId>(vertex) : permutation[vertex];
  };
  for (const auto& [leaves, queries, reached] : pieces) {
    const std::uint32_t first = leaf_begin[leaves.begin];
    if (reached != nullptr) {
      for_each_lane(lanes_of(reached, query), [&](unsigned lane) { write(first + lane); });
    } else if ((queries >> query & 1U) != 0) {
      for (std::uint32_t vertex = first; vertex < leaf_begin[leaves.end]; ++vertex) write(vertex);
    }
  }
}

inline void convert_points(const float* xyz, unsigned size, const FloatCenter& center, LeafPoints& points) {
  points = {};
  for (std::size_t i = 0; i < size; ++i) {
    const float x = (xyz[3 * i] - center.x) * center.scale;
    const float y = (xyz[3 * i + 1] - center.y) * center.scale;
    const float z = (xyz[3 * i + 2] - center.z) * center.scale;
    points.x[i] = x;
    points.y[i] = y;
    points.z[i] = z;
    points.square[i] = (x * x + y * y) + z * z;
  }
}

}  // namespace plain

inline constexpr Kernels kPlainKernels{
    plain::within<float>, plain::within<double>, plain::squares<float>, plain::squares<double>, plain::cross_edges,
    plain::reachable,     plain::classify,       plain::box_squares,    plain::box_entries,     plain::compress};
inline constexpr JointKernels kPlainJointKernels{plain::convert_points, plain::clear_words, plain::ball_words,
                                                 plain::spread_words,   plain::step_words,  plain::count_words,
                                                 plain::lanes_of,       plain::write_row};

}  // namespace meshhood::test
