// SPDX-License-Identifier: MIT
// A mesh of CGAL: the neighborhood of a vertex becomes a property of its vertices.
#include <cstdio>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <meshhood/cgal.h>
#include <meshhood/meshhood.h>

namespace {

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

// [readme]
/// Marks the neighborhood of `v` in the property "v:near".
void mark(Mesh& surface, CGAL::SM_Vertex_index v, double radius) {
  const meshhood::MeshData copy = meshhood::copy_mesh(surface);
  const auto index = meshhood::build(copy.view());
  meshhood::Searcher searcher(index);
  auto near = surface.add_property_map<CGAL::SM_Vertex_index, bool>("v:near", false).first;
  for (const meshhood::VertexId w : searcher.neighborhood(v, radius)) near[CGAL::SM_Vertex_index(w)] = true;
}
// [readme]

}  // namespace

int main() {
  Mesh surface;
  const auto a = surface.add_vertex({0, 0, 0});
  const auto b = surface.add_vertex({1, 0, 0});
  const auto c = surface.add_vertex({0, 2, 0});
  surface.add_face(a, b, c);
  mark(surface, a, 1.0);
  const auto near = surface.property_map<CGAL::SM_Vertex_index, bool>("v:near").first;
  std::printf("within 1 of a: a %d, b %d, c %d\n", int{near[a]}, int{near[b]}, int{near[c]});
  return near[a] && near[b] && !near[c] ? 0 : 1;
}
