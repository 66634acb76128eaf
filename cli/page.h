// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "meshhood/mesh.h"

/// The page that shows neighborhoods in a browser: viewer/, built into one HTML file.
namespace meshhood::cli {

/// The initial state of a page.
struct PageSettings {
  std::string name;                             ///< of the mesh, as displayed
  std::optional<VertexId> vertex;               ///< otherwise one of the page's choice
  std::optional<double> radius;                 ///< in the unit of the positions
  std::optional<double> weld;                   ///< eps of --weld
  std::string precision;                        ///< of --precision; empty without
  std::optional<std::vector<VertexId>> answer;  ///< shown instead of the answers of the methods
  std::vector<float> values;                    ///< one for each vertex, shown as colors; or empty
  std::string values_name;                      ///< the legend of the values
};

/// The built page: the file that the environment variable MESHHOOD_VIEWER names, or share/meshhood/viewer.html of the
/// installation, or build/viewer/viewer.html of the build tree, or that of the Python package whose wheel contains this
/// program. Throws Error{IoFailure} if there is none.
[[nodiscard]] std::filesystem::path find_page();

/// Throws Error{IoFailure} if `mesh` is not a regular file, and Error{TooLarge} if it is larger than a browser takes in
/// a page.
void check_mesh_of_page(const std::filesystem::path& mesh);

/// Writes a copy of the page that holds `mesh`, a mesh or index file, or `ply` unless it is empty, the content of the
/// same mesh as PLY. The file appears whole or not at all.
///
/// Throws as `check_mesh_of_page`; Error{IoFailure, Cancelled}.
void write_page(const std::filesystem::path& output, const std::filesystem::path& mesh, const std::string& ply,
                const PageSettings& settings);

}  // namespace meshhood::cli
