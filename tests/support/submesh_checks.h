// SPDX-License-Identifier: MIT
// Faces, submeshes and rims of regions, compared with passes over all faces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/surface.h"

#include "support/region_oracle.h"
#include "support/test_mesh.h"

namespace meshhood::test {

using MeshEdge = std::array<VertexId, 2>;
using EdgePair = std::pair<MeshEdge, MeshEdge>;

inline EdgePair undirected(const MeshEdge& a, const MeshEdge& b) { return {std::min(a, b), std::max(a, b)}; }

/// For each face: where its boundary leaves the region, and where it last entered it before that.
inline std::multiset<EdgePair> segments_of_all_faces(const TestMesh& mesh, const std::set<VertexId>& region) {
  std::multiset<EdgePair> segments;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const std::size_t size = face.size();
    for (std::size_t i = 0; size >= 3 && i < size; ++i) {
      const MeshEdge leaving{face[i], face[(i + 1) % size]};
      if (!region.contains(leaving[0]) || region.contains(leaving[1])) continue;
      std::size_t entry = i;
      while (region.contains(face[(entry + size - 1) % size])) entry = (entry + size - 1) % size;
      const MeshEdge entering{face[entry], face[(entry + size - 1) % size]};
      if (leaving != entering) segments.insert(undirected(leaving, entering));
    }
  }
  return segments;
}

inline std::multiset<EdgePair> segments_of_rim(const Rim& rim) {
  std::multiset<EdgePair> segments;
  for (std::size_t line = 0; line < rim.size(); ++line) {
    for (std::size_t i = rim.offsets[line]; i < rim.offsets[line + 1]; ++i) {
      const bool is_last = i + 1 == rim.offsets[line + 1];
      if (is_last && rim.closed[line] == 0) continue;
      segments.insert(undirected(rim.edges[i], rim.edges[is_last ? rim.offsets[line] : i + 1]));
    }
  }
  return segments;
}

/// A region of a mesh, found by the oracle.
struct FoundRegion {
  const TestMesh& mesh;
  const Surface& surface;
  PlainStart start;
  double radius;
  std::vector<VertexId> ids;
};

inline void expect_faces_of_vertices(const FoundRegion& region) {
  const auto& [mesh, surface, start, radius, ids] = region;
  const auto is_in = [&all_ids = ids](VertexId v) { return std::binary_search(all_ids.begin(), all_ids.end(), v); };
  std::vector<std::size_t> all;
  std::vector<std::size_t> any;
  for (std::size_t f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (!face.empty() && std::all_of(face.begin(), face.end(), is_in)) all.push_back(f);
    if (std::any_of(face.begin(), face.end(), is_in)) any.push_back(f);
  }
  ASSERT_EQ(surface.faces(ids), all);
  ASSERT_EQ(surface.faces(ids, Corners::Any), any);
  for (const auto& [corners, faces] : {std::pair(Corners::All, all), std::pair(Corners::Any, any)}) {
    const Submesh part = surface.submesh(ids, corners);
    ASSERT_EQ(part.faces, faces);
    ASSERT_EQ(part.offsets.size(), faces.size() + 1);
    std::set<VertexId> used;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      std::vector<VertexId> face;
      for (std::size_t k = part.offsets[i]; k < part.offsets[i + 1]; ++k) {
        face.push_back(part.vertices.at(part.corners[k]));
      }
      ASSERT_THAT(face, testing::ElementsAreArray(mesh.face(faces[i])));
      used.insert(face.begin(), face.end());
    }
    ASSERT_THAT(part.vertices, testing::ElementsAreArray(used));
  }
}

inline void expect_rim_of_segments(const FoundRegion& region) {
  const Rim rim = region.surface.rim(region.ids, region.start.center, region.radius);
  ASSERT_EQ(rim.points.size(), rim.edges.size());
  ASSERT_EQ(rim.offsets.size(), rim.size() + 1);
  const std::multiset<EdgePair> segments = segments_of_rim(rim);
  ASSERT_EQ(segments, segments_of_all_faces(region.mesh, {region.ids.begin(), region.ids.end()}));
  std::map<MeshEdge, int> degree;
  for (const auto& [a, b] : segments) {
    ++degree[a];
    ++degree[b];
  }
  for (std::size_t line = 0; line < rim.size(); ++line) {
    for (std::size_t i = rim.offsets[line]; i < rim.offsets[line + 1]; ++i) {
      const bool is_end = i == rim.offsets[line] || i + 1 == rim.offsets[line + 1];
      ASSERT_EQ(degree[rim.edges[i]] != 2, is_end && rim.closed[line] == 0);
    }
  }
}

inline void expect_rim_at_radius(const FoundRegion& region) {
  const auto& [mesh, surface, start, radius, ids] = region;
  const Rim rim = surface.rim(ids, start.center, radius);
  for (std::size_t i = 0; i < rim.points.size(); ++i) {
    const auto a = position(mesh, rim.edges[i][0]);
    const auto b = position(mesh, rim.edges[i][1]);
    const auto from_center = [&center = start.center](const SpacePoint& p) {
      return std::hypot(p[0] - center[0], p[1] - center[1], p[2] - center[2]);
    };
    const bool ends_at_a_wall = start.walls[rim.edges[i][1]] != 0 && from_center(b) <= radius;
    double scale = radius;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      scale = std::max({scale, std::abs(a[axis]), std::abs(b[axis]), std::abs(start.center[axis])});
      const auto [low, high] = std::minmax(a[axis], b[axis]);
      ASSERT_GE(rim.points[i][axis], low - 1e-14 * scale);
      ASSERT_LE(rim.points[i][axis], high + 1e-14 * scale);
    }
    if (ends_at_a_wall) {
      ASSERT_EQ(rim.points[i], b);
    } else {
      // Where squares underflow, the predicate takes small distances for 0.
      ASSERT_NEAR(from_center(rim.points[i]), radius, 1e-14 * scale + 1e-160);
    }
  }
}

}  // namespace meshhood::test
