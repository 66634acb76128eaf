// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "io/input_buffer.h"
#include "io/mesh_builder.h"
#include "io/messages.h"
#include "io/readers.h"
#include "io/welder.h"

namespace meshhood::inline v0_1::io {

/// Reads all facets of an ASCII STL file, of any number of solids and in any letter case. A solid may be empty. `end
/// facet` as two words is read with a warning. The
/// format allows only triangles: a facet of more vertices is kept as a polygon, so that no vertex is lost, and one of
/// fewer is left out, both with a warning.
template <class Real>
void read_stl_text(InputBuffer& input, const ReaderOptions& options, MeshBuilder& builder, Welder<Real>& weld);

/// Appends a facet of an ASCII or binary file.
template <class Real>
void append_triangle(const std::array<std::array<Real, 3>, 3>& corners, const Location& location, MeshBuilder& builder,
                     Welder<Real>& weld) {
  const auto& [a, b, c] = corners;
  if (a == b || b == c || c == a) builder.warnings.add("facets in which two corners coincide", location);
  for (const auto& corner : corners) weld.append(corner);
  builder.faces.end_face(3);
}

extern template void read_stl_text(InputBuffer& input, const ReaderOptions& options, MeshBuilder& builder,
                                   Welder<float>& weld);
extern template void read_stl_text(InputBuffer& input, const ReaderOptions& options, MeshBuilder& builder,
                                   Welder<double>& weld);

}  // namespace meshhood::inline v0_1::io
