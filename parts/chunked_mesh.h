// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh_io.h"
#include "shared/distance.h"

namespace meshhood::parts {

/// Faces in the order of the mesh.
struct FaceChunk {
  std::vector<std::uint64_t> corners;  ///< of all faces, face after face
  std::vector<std::size_t> ends;       ///< of each face in `corners`

  [[nodiscard]] std::size_t size() const { return ends.size(); }

  [[nodiscard]] std::span<const std::uint64_t> face(std::size_t i) const {
    const std::size_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(corners).subspan(begin, ends[i] - begin);
  }
};

/// A mesh of any size, with 64-bit vertex ids, of which a piece at a time is in memory. It is read several times, so
/// every piece is checked every time: the file may change meanwhile.
///
/// Throws Error{InvalidMesh}, naming the vertex or the face and corner; Error{MalformedFile, IoFailure}.
class ChunkedMesh {
 public:
  ChunkedMesh(const ChunkedMesh&) = delete;
  ChunkedMesh& operator=(const ChunkedMesh&) = delete;
  virtual ~ChunkedMesh() = default;

  /// The file, printable: that of the positions.
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] virtual const std::string& name_of_faces() const { return name_; }

  [[nodiscard]] std::uint64_t vertex_count() const { return vertices_; }
  [[nodiscard]] bool is_double() const { return is_double_; }

  /// The warnings of the reader of a mesh in memory, which has also judged whether float is coarse for it; of a mesh
  /// that is read in chunks null.
  [[nodiscard]] virtual const std::vector<io::Warning>* warnings() const { return nullptr; }

  /// Reads the vertices from `first` on, as many as `out` has room for.
  void read_positions(std::uint64_t first, std::span<Point> out);

  /// Moves to the first face.
  void rewind_faces();

  /// Replaces `chunk` by the next faces: at least `corners` corners, unless there are as many faces before, or the mesh
  /// ends. False if there is no further face.
  bool read_faces(std::size_t corners, FaceChunk& chunk);

 protected:
  ChunkedMesh(std::string name, std::uint64_t vertices, bool is_double)
      : name_(std::move(name)), vertices_(vertices), is_double_(is_double) {}

  /// Throws Error{TooLarge} if a face has more than 2^20 corners.
  void check_degree(std::uint64_t corners) const;

 private:
  virtual void load_positions(std::uint64_t first, std::span<Point> out) = 0;

  /// Moves to the first face.
  virtual void load_first_face() {}

  /// Appends the corners of the next face, which is number `face`; false if there is none.
  virtual bool load_face(std::uint64_t face, std::vector<std::uint64_t>& corners) = 0;

  /// Refuses files that have been written to since they were opened. Called before the first face and after the last.
  virtual void check_unchanged() const {}

  void check_face(std::span<const std::uint64_t> corners) const;

  std::string name_;
  std::uint64_t vertices_;
  bool is_double_;
  std::uint64_t next_face_ = 0;
};

/// A mesh that is read into memory takes several times the bytes of its file.
inline constexpr std::uint64_t kMemoryPerByte = 4;

/// Opens a mesh file. A binary PLY file whose vertices have a fixed size is read in chunks, and may have any size. Any
/// other file is read into memory, if it has at most `max_bytes` bytes, with `progress`.
/// Throws as `io::read_mesh`; Error{TooLarge}, naming the formats that are read in chunks.
[[nodiscard]] std::unique_ptr<ChunkedMesh> open_mesh(const std::filesystem::path& path, std::uint64_t max_bytes,
                                                     const Progress& progress = {});

/// Opens `.npy` files of positions (#V by 3, float32 or float64) and faces (#F by k, integers of 4 or 8 bytes), both in
/// C order. Throws Error{IoFailure, MalformedFile, UnsupportedFormat}.
[[nodiscard]] std::unique_ptr<ChunkedMesh> open_arrays(const std::filesystem::path& positions,
                                                       const std::filesystem::path& faces);

/// A mesh in memory. `name` is for messages.
[[nodiscard]] std::unique_ptr<ChunkedMesh> chunked(io::Mesh mesh, const std::string& name);

/// Null if the file is not a PLY file that can be read in chunks.
[[nodiscard]] std::unique_ptr<ChunkedMesh> open_binary_ply(const std::filesystem::path& path);

}  // namespace meshhood::parts
