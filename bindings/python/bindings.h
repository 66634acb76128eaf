// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>

#include "meshhood/surface.h"

/// The extension module of the Python package: conversions, and the interpreter lock. Arguments have been checked and
/// converted by meshhood/_mesh.py and meshhood/_convert.py.
namespace meshhood::python {

/// The methods that answer queries: neighborhoods, regions, connecting radii, rings and nearest vertices.
void bind_methods(nanobind::module_& module);

/// Sums and other properties of values over neighborhoods.
void bind_aggregates(nanobind::module_& module);

/// The functions that make an index, and the other methods from it.
void bind_makers(nanobind::module_& module);

/// Surfaces: closest points, regions as meshes, and areas, volumes and gaps of the surface in a ball.
nanobind::class_<Surface> bind_surface(nanobind::module_& module);

/// Curvature, of surfaces too.
void bind_curvature(nanobind::module_& module, nanobind::class_<Surface>& surface);

/// Mesh files, index files, an index as bytes, and welding.
void bind_files(nanobind::module_& module);

/// Meshes in parts.
void bind_parts(nanobind::module_& module);

/// The command line as a function. Only where it is built: MESHHOOD_BUILD_CLI.
void bind_command(nanobind::module_& module);

}  // namespace meshhood::python
