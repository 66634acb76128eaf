// SPDX-License-Identifier: MIT
#pragma once

#include <variant>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/mesh.h"

namespace meshhood::python {

/// A copy of what an index is made from, so that the caller may change or drop the arrays, and other methods may be
/// asked later.
class Data {
 public:
  /// Throws Error{InvalidMesh, TooLarge}, beginning with the argument: `V` or `F`.
  explicit Data(const MeshView& mesh);

  [[nodiscard]] GraphView view() const;
  [[nodiscard]] PositionsView positions() const;

 private:
  std::variant<std::vector<float>, std::vector<double>> positions_;  ///< #V by 3
  Adjacency adjacency_;
};

}  // namespace meshhood::python
