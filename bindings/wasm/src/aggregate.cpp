// SPDX-License-Identifier: MIT
// Values over neighborhoods.
#include <cstddef>
#include <span>

#include "meshhood/meshhood.h"

#include "answer.h"
#include "arguments.h"
#include "workspace.h"

namespace meshhood::wasm {

[[clang::export_name("aggregate")]] void aggregate(const double* values, std::size_t value_count, std::size_t channels,
                                                   const double* weights, std::size_t weight_count,
                                                   const Reduce* reductions, std::size_t reduction_count,
                                                   SmoothingKernel kernel, MissingValues missing, Nesting nesting,
                                                   std::size_t ddof, double quantile) {
  const SignalView signal{
      .values = std::span(values, value_count), .channels = channels, .weights = std::span(weights, weight_count)};
  answer.reals = meshhood::aggregate(workspace.searched(), signal,
                                     {.vertices = rows.vertices,
                                      .radius = rows.radius,
                                      .metric = rows.metric,
                                      .reduce = {reductions, reductions + reduction_count},
                                      .kernel = kernel,
                                      .missing = missing,
                                      .nesting = nesting,
                                      .ddof = ddof,
                                      .quantile = quantile},
                                     workspace.run());
}

[[clang::export_name("smoothing_radius")]] double smoothing_radius(double fwhm) {
  return meshhood::smoothing_radius(fwhm);
}

/// Of the mesh with the positions of the index.
[[clang::export_name("areas")]] void areas() {
  answer.reals = vertex_areas({workspace.graph().view().positions, given.faces});
}

}  // namespace meshhood::wasm
