// SPDX-License-Identifier: MIT
// The cones of a tree, against the triangles in their groups.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "exact/index_access.h"
#include "simd/node_group.h"
#include "support/families.h"
#include "support/random.h"
#include "support/round_meshes.h"
#include "surface/face_tree.h"
#include "surface/surface.h"

namespace meshhood::test {
namespace {

struct Groups {
  std::size_t opposite = 0;  // with a triangle that is opposite to the normal
  std::size_t entered = 0;
};

/// Over all groups, for normals in all directions. Fails where an opposite triangle would be left out.
Groups ask_all(const TestMesh& mesh) {
  const Index index = build(mesh.view());
  const Surface surface(index, mesh.view().faces);
  const SurfaceState& state = SurfaceAccess::state(surface);
  TaskContext alone;
  const FaceTree& tree = state.tree(alone);
  const NormalCones& cones = state.cones(alone);
  const std::size_t triangles = tree.triangles().size();
  Groups sum;
  Random random(1);
  for (int round = 0; round < 100; ++round) {
    const Point along{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Point normal = (1 / length(along)) * along;
    std::size_t size = kFanOut;  // of a group
    for (std::size_t level = 0; level == 0 || size / kFanOut < triangles; ++level, size *= kFanOut) {
      for (std::size_t first = 0; first < triangles; first += size) {
        bool has_opposite = false;
        for (std::size_t i = first; i < std::min(first + size, triangles); ++i) {
          has_opposite |= is_opposite(doubled_area(*state.index, tree.triangles()[i]), normal);
        }
        const bool enters = cones.may_oppose(level, first / size, normal);
        EXPECT_TRUE(enters || !has_opposite) << "level " << level << ", triangle " << first;
        sum.opposite += static_cast<std::size_t>(has_opposite);
        sum.entered += static_cast<std::size_t>(enters);
      }
    }
  }
  return sum;
}

TEST(NormalCones, LeaveOutNoGroupWithAnOppositeTriangle) {
  std::size_t meshes = 0;
  for (const Family& family : families()) {
    SCOPED_TRACE(family.name);
    const TestMesh mesh = make_mesh(family, 4, 300);
    std::size_t most = 0;
    for (std::size_t face = 0; face < mesh.face_count(); ++face) most = std::max(most, mesh.face(face).size());
    if (most < 3) continue;
    ask_all(mesh);
    ++meshes;
  }
  EXPECT_GT(meshes, 5U);
}

// The squares of their vector areas vanish, or have one bit, so that cosines of what is opposite are smaller.
TEST(NormalCones, LeaveOutNoTriangleWhoseDirectionIsLost) {
  for (const double side : {1e-82, 1.61e-81}) {
    TestMesh mesh;
    mesh.add_vertex(-0.75, -0.75, -0.75);  // so that the unit of the frame is 1
    mesh.add_vertex(0.75, 0.75, 0.75);
    for (std::size_t face = 0; face < 64; ++face) {
      const double tilt = face % 2 == 0 ? 0.3 : -0.3;
      const auto at = mesh.add_vertex(0, 0, 0);
      mesh.add_vertex(side * std::cos(tilt), 0, side * std::sin(tilt));
      mesh.add_vertex(0, side, 0);
      mesh.add_face({at, at + 1, at + 2});
    }
    mesh.finish(false);
    EXPECT_GT(ask_all(mesh).opposite, 0U);
  }
}

TEST(NormalCones, LeaveOutMostOfWhatIsNotOpposite) {
  const Groups groups = ask_all(ball(60, 61));
  EXPECT_LT(groups.entered, groups.opposite + groups.opposite / 10);
}

}  // namespace
}  // namespace meshhood::test
