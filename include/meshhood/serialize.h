// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "meshhood/export.h"
#include "meshhood/fingerprint.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/paper.h"
#include "meshhood/run.h"

/// Saves an index as bytes, and loads it. `meshhood/io/index_io.h` does this with files.
///
/// The bytes are the same on every machine, for any compiler and number of threads. docs/index_file.md describes the
/// format, which has a version number of its own. Every byte is covered by a checksum or must be zero, so that every
/// change is detected.
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// Receives the bytes of an index, piece by piece. Its exceptions are passed on.
using Sink = std::function<void(std::span<const std::byte>)>;

/// The alignment of bytes that are to be mapped.
inline constexpr std::size_t kIndexAlignment = 64;

/// How an index is saved.
struct SaveOptions {
  /// The faces of the mesh that the index was built from, borrowed for the call. They are saved with the index, for
  /// calls that need them (see `Index::faces`): 4 bytes for each corner and, unless all are triangles, for each face.
  /// The index does not know them: they are verified to be faces of #V vertices, not to be those of its graph. Without
  /// them, the file has none; `.faces = index.faces()` saves those of a loaded index again.
  std::optional<FacesView> faces = {};
};

/// Streams the bytes of `index` to `sink`. Progress is reported while the fingerprint is computed, then between parts:
/// the checksum of each section, and pieces of the bytes. The longest part takes O(bytes). Peak memory is one copy of
/// the graph, for the fingerprint, and one of the faces. Throws Error{InvalidMesh, TooLarge} if the faces are invalid,
/// or are not all triangles and have 2^32 corners or more; Error{InvalidOption} for an index with masks or of paths
/// along a surface; Error{Cancelled}. Takes O(bytes of the index), on one thread, as all that saves and loads.
void save(const Index& index, const Sink& sink, const SaveOptions& options = {}, const Run& run = {});

/// Returns the index that was saved as `bytes`, which are copied. Progress is reported between the parts of the
/// verification: the checksum of each section, then passes over the arrays. The longest part takes O(bytes).
///
/// Everything is verified: the checksums, and all that a search relies on for safety. An accepted index answers every
/// query within its arrays, even if it was forged; its answers may then be wrong.
///
/// Throws Error{MalformedIndex}, naming the section, the byte, what it contains and what was expected;
/// Error{Cancelled}. Takes O(bytes).
[[nodiscard]] Index load(std::span<const std::byte> bytes, const Run& run = {});

/// How an index is mapped.
struct MapOptions {
  /// Skips everything that reads the data: the checksums of the sections, and the verification of what a search relies
  /// on. The header and the table of sections are still verified. Mapping then takes no time, but damaged bytes lead to
  /// undefined behavior: wrong answers, a crash, or a query that does not end. Use it only for files that no other user
  /// can write.
  bool trusted = false;
};

/// Returns the index in place: nothing is copied, and pages of a mapped file are read when queries need them. Progress
/// is that of `load`; a trusted file has no parts.
///
/// bytes   at an address that is a multiple of `kIndexAlignment`; must not change as long as the index lives, or a
///         searcher, a surface or another index that was made from it. A file that is truncated or overwritten in
///         place changes under its mapping (a file replaced by renaming does not). If that can happen, use `load`.
/// owner   kept as long; null if the caller keeps the bytes.
///
/// Throws as `load`, and Error{InvalidOption} if the address is not aligned. Takes O(bytes), or O(1) if trusted.
[[nodiscard]] Index map(std::span<const std::byte> bytes, std::shared_ptr<const void> owner,
                        const MapOptions& options = {}, const Run& run = {});

/// The kind of a saved index.
enum class IndexKind : std::uint8_t {
  Exact = 1,  ///< `Index`
  Paper = 2,  ///< `paper::Index`
};

/// The header of a saved index.
struct IndexHeader {
  std::uint32_t format = 0;  ///< the version of the format
  IndexKind kind = IndexKind::Exact;
  bool is_double = false;  ///< the precision of the positions
  std::uint64_t vertices = 0;
  std::uint64_t bytes = 0;  ///< of the whole index
  Fingerprint mesh;         ///< of the mesh that the index was built from
};

/// Returns whether bytes that begin with `first_bytes` are meant to be an index. Eight bytes distinguish it from every
/// mesh file.
[[nodiscard]] bool is_index(std::span<const std::byte> first_bytes);

/// The number of bytes that always contain the header of a saved index and its table of sections.
inline constexpr std::size_t kIndexHeadBytes = std::size_t{1} << 14;

/// Returns the header of a saved index of `size` bytes, verified by the checksum that covers it and the table. The
/// contents of the table and the sections are not verified.
///
/// first_bytes   the first `kIndexHeadBytes` or more, or all.
/// Throws Error{MalformedIndex}. Takes O(1).
[[nodiscard]] IndexHeader read_header(std::span<const std::byte> first_bytes, std::uint64_t size);

/// Does the same for all bytes of an index.
[[nodiscard]] IndexHeader read_header(std::span<const std::byte> bytes);

/// Throws Error{MalformedIndex}, naming both fingerprints, unless `mesh` is that of the header.
void check_mesh(const IndexHeader& header, const Fingerprint& mesh);

/// The index of the paper can be loaded but not mapped: some of its arrays are computed when it is loaded.
namespace paper {

/// Saves as `meshhood::save`, without faces. The fingerprint was computed by `build`: nothing is copied.
void save(const Index& index, const Sink& sink, const Run& run = {});

/// Loads as `meshhood::load`.
[[nodiscard]] Index load(std::span<const std::byte> bytes, const Run& run = {});

}  // namespace paper
MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
