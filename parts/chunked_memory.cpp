// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>
#include <variant>

#include "parts/chunked_mesh.h"

namespace meshhood::parts {
namespace {

class MeshInMemory final : public ChunkedMesh {
 public:
  MeshInMemory(io::Mesh mesh, const std::string& name)
      : ChunkedMesh(name, mesh.view().positions.size(), std::holds_alternative<std::vector<double>>(mesh.positions)),
        mesh_(std::move(mesh)) {}

 private:
  void load_positions(std::uint64_t first, std::span<Point> out) override {
    std::visit(
        [&](const auto& xyz) {
          for (std::size_t i = 0; i < out.size(); ++i) out[i] = point(std::span(xyz), first + i);
        },
        mesh_.positions);
  }

  void load_first_face() override {
    face_ = 0;
    corner_ = 0;
  }

  bool load_face(std::vector<std::uint64_t>& corners) override {
    const std::size_t faces = mesh_.offsets.empty() ? mesh_.corners.size() / 3 : mesh_.offsets.size() - 1;
    if (face_ == faces) return false;
    const std::size_t degree =
        mesh_.offsets.empty() ? 3 : static_cast<std::size_t>(mesh_.offsets[face_ + 1] - mesh_.offsets[face_]);
    check_degree(degree);
    const auto begin = mesh_.corners.begin() + static_cast<std::ptrdiff_t>(corner_);
    corners.insert(corners.end(), begin, begin + static_cast<std::ptrdiff_t>(degree));
    corner_ += degree;
    ++face_;
    return true;
  }

  io::Mesh mesh_;
  std::size_t face_ = 0;
  std::size_t corner_ = 0;
};

}  // namespace

std::unique_ptr<ChunkedMesh> chunked(io::Mesh mesh, const std::string& name) {
  io::refuse_walls(mesh, name);
  return std::make_unique<MeshInMemory>(std::move(mesh), name);
}

}  // namespace meshhood::parts
