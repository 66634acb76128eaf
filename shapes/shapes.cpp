// SPDX-License-Identifier: MIT
#include "shapes.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "meshhood/error.h"

#include "families.h"

namespace meshhood::shapes {

MeshView Shape::view() const {
  return {positions, offsets.empty() ? FacesView::triangles(corners) : FacesView::polygons(offsets, corners)};
}

Shape Kind::make(std::size_t vertices) const {
  const auto shape = [&] { return std::string(name) + " with " + std::to_string(vertices) + " vertices: "; };
  if (vertices < minimum) raise(ErrorCode::InvalidOption, shape() + "expected at least " + std::to_string(minimum));
  if (vertices > kMaxVertices) {
    raise(ErrorCode::TooLarge, shape() + "expected at most " + std::to_string(kMaxVertices));
  }
  return generate(vertices);
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"book", "eight pages on one spine, close together: a ball contains several pages", 6, book},
      {"comb", "long flat teeth, half an edge apart: a ball contains neighboring teeth", 24, comb},
      {"folds", "an accordion with walls 1.5 edges apart: a ball contains several walls", 4, folds},
      {"grid", "a flat square grid of triangles: many vertices at equal distances", 3, grid},
      {"gyroid", "a smooth sheet that fills a box: a ball contains many parts, nearly all connected", 4, gyroid},
      {"isolated", "points without faces: every neighborhood is a single vertex", 1, isolated},
      {"knot", "a trefoil tube whose strands pass close: a ball contains several strands", 9, knot},
      {"ngons", "a honeycomb of hexagons: opposite corners are near, but three edges apart", 6, ngons},
      {"noise", "a height field of spikes: steep uneven triangles, for which bounding spheres are loose", 3, noise},
      {"path", "one long folded polyline: the depth of its graph is the number of vertices", 2, path},
      {"plates", "two parallel sheets 0.6 edges apart, connected at one side: a ball contains both", 4, plates},
      {"quads", "a flat grid of squares: opposite corners are not connected", 3, quads},
      {"scroll", "a rolled sheet with turns 2.5 edges apart: a ball contains several turns", 4, scroll},
      {"soup", "spheres of about forty vertices half an edge apart: each is a component", 5, soup},
      {"sphere", "a sphere: no difficulty, until the radius is close to its size", 5, sphere},
      {"star", "a hub and its spokes: one vertex has all neighbors, the others are near but not connected", 2, star},
      {"strip", "a flat spiral ribbon: neighboring turns are near, but far along the ribbon", 3, strip},
  };
  return all;
}

const Kind* find_kind(std::string_view name) {
  const auto& all = kinds();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Kind& kind) { return kind.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace meshhood::shapes
