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
  const auto asked = [&] { return std::string(name) + " with " + std::to_string(vertices) + " vertices: "; };
  if (vertices < minimum) raise(ErrorCode::InvalidOption, asked() + "it takes at least " + std::to_string(minimum));
  if (vertices > kMaxVertices) {
    raise(ErrorCode::TooLarge, asked() + "at most " + std::to_string(kMaxVertices) + " are possible");
  }
  return generate(vertices);
}

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"book", "eight pages on one spine, close together: a ball turns the page", 6, book},
      {"comb", "long flat teeth, half an edge apart: a ball jumps from tooth to tooth", 24, comb},
      {"folds", "an accordion, its walls 1.5 edges apart: a ball goes through the walls", 4, folds},
      {"grid", "a flat square grid of triangles, many vertices at equal distances: none but ties", 3, grid},
      {"gyroid", "a smooth sheet that winds through a box: a ball meets it many times, nearly all joined", 4, gyroid},
      {"isolated", "points without faces: every neighborhood is the vertex alone", 1, isolated},
      {"knot", "a trefoil tube whose strands pass close: a ball leaves the strand", 9, knot},
      {"ngons", "a honeycomb of hexagons: corners across a hexagon are near, and three edges apart", 6, ngons},
      {"noise", "a height field of spikes: steep uneven triangles, around which spheres are loose", 3, noise},
      {"path", "one long polyline, to and fro: its graph is as deep as it has vertices", 2, path},
      {"plates", "two parallel sheets 0.6 edges apart, joined at one rim: a ball takes both", 4, plates},
      {"quads", "a flat grid of squares: corners across a square are not joined", 3, quads},
      {"scroll", "a rolled sheet, its turns 2.5 edges apart: a ball takes the turns above and below", 4, scroll},
      {"soup", "balls of about forty vertices half an edge apart: one component for each", 5, soup},
      {"sphere", "a round ball: the case without a trap, until the radius reaches round it", 5, sphere},
      {"star", "a hub and its spokes: one vertex has all the neighbours, the rim is near but not joined", 2, star},
      {"strip", "a ribbon rolled flat: neighbouring turns are near, and far apart along it", 3, strip},
  };
  return all;
}

const Kind* find_kind(std::string_view name) {
  const auto& all = kinds();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Kind& kind) { return kind.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace meshhood::shapes
