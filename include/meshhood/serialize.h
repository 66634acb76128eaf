// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "meshhood/fingerprint.h"
#include "meshhood/index.h"
#include "meshhood/paper.h"
#include "meshhood/progress.h"

/// An index as bytes, to be kept. Files are `meshhood/io/index_io.h`'s business.
///
/// The bytes are the same on every machine, for any compiler and number of threads. They have a format number of their
/// own; docs/design.md says what stands where. Every byte is covered by a checksum or must be zero, so that a change is
/// noticed wherever it is.
namespace meshhood {

/// Takes the bytes of an index, piece after piece. What it throws, `save` passes on.
using Sink = std::function<void(std::span<const std::byte>)>;

/// Where bytes that are to be mapped must begin: at a multiple of this.
inline constexpr std::size_t kIndexAlignment = 64;

/// How an index is saved.
struct SaveOptions {
  /// Called now and then while the fingerprint of the mesh is found, then between parts: the checksum of each section,
  /// and pieces of the bytes. The longest takes O(bytes).
  Progress progress = {};
};

/// Gives the bytes of `index` to `sink`. They are not held as a whole; what is, for the fingerprint, is
/// `extract_graph(index)`. Throws Error{Cancelled}. O(bytes of the index).
void save(const Index& index, const Sink& sink, const SaveOptions& options = {});

/// How an index is loaded.
struct LoadOptions {
  /// Called between the parts of the verification: the checksum of each section, then passes over the arrays. The
  /// longest takes O(bytes).
  Progress progress = {};
};

/// The index that was saved as `bytes`, which are copied: what happens to them later does not matter.
///
/// Everything is verified: the checksums, and whatever a search relies on. An index that is accepted answers every
/// query within its arrays, even where somebody has forged it; the answers may then be wrong.
///
/// Throws Error{MalformedIndex}, naming the section, the byte, what stands there and what was expected;
/// Error{Cancelled}. O(bytes).
[[nodiscard]] Index load(std::span<const std::byte> bytes, const LoadOptions& options = {});

/// How an index is mapped.
struct MapOptions {
  /// Skip whatever needs a look at the data: the checksums of the sections, and the verification of what a search
  /// relies on. The header, and where the sections lie, are verified still. Then mapping takes no time, and bytes that
  /// have been changed lead to anything: wrong answers, a crash, a query that does not end. Only for files that nobody
  /// but oneself can write.
  bool trusted = false;

  /// As that of `LoadOptions`; of a trusted file there are no parts.
  Progress progress = {};
};

/// The same index in place: nothing is copied, and pages of a mapped file are read as queries need them.
///
/// bytes   at an address that is a multiple of `kIndexAlignment`; must not change as long as the index lives. A file
///         that is truncated or overwritten in place changes under its mapping (one that is replaced by renaming does
///         not): who cannot exclude that takes `load`.
/// owner   kept as long as the index lives; may be null where the caller keeps the bytes.
///
/// Throws as `load`, and Error{InvalidOption} where the address is wrong. O(bytes), or O(1) if trusted.
[[nodiscard]] Index map(std::span<const std::byte> bytes, std::shared_ptr<const void> owner,
                        const MapOptions& options = {});

/// Which of the two indexes.
enum class IndexKind : std::uint8_t {
  Exact = 1,  ///< `Index`
  Paper = 2,  ///< `paper::Index`
};

/// What the first bytes of a saved index say.
struct IndexHeader {
  std::uint32_t format = 0;  ///< the number of the format
  IndexKind kind = IndexKind::Exact;
  bool is_double = false;  ///< the precision of the positions
  std::uint64_t vertices = 0;
  std::uint64_t bytes = 0;  ///< of all
  Fingerprint mesh;         ///< which the index was built from
};

/// Whether bytes that begin so are meant to be an index. Eight are enough to tell it from any mesh file.
[[nodiscard]] bool is_index(std::span<const std::byte> first_bytes);

/// The first bytes of a saved index, so many of them, hold its header and the table of its sections.
inline constexpr std::size_t kIndexHeadBytes = std::size_t{1} << 14;

/// The header of a saved index of `size` bytes, verified by the checksum that it shares with the table. At what the
/// table says, or the sections, it does not look.
///
/// first_bytes   the first `kIndexHeadBytes` or more, or all.
/// Throws Error{MalformedIndex}. O(1).
[[nodiscard]] IndexHeader read_header(std::span<const std::byte> first_bytes, std::uint64_t size);

/// The same where all bytes are there.
[[nodiscard]] IndexHeader read_header(std::span<const std::byte> bytes);

/// Throws Error{MalformedIndex}, naming both fingerprints, unless `mesh` is that of the header.
void check_mesh(const IndexHeader& header, const Fingerprint& mesh);

/// The same for the paper's index. It is read into memory, and cannot be mapped.
namespace paper {

/// Throws as its namesake. O(bytes of the index).
void save(const Index& index, const Sink& sink, const SaveOptions& options = {});

/// Throws as its namesake. O(bytes).
[[nodiscard]] Index load(std::span<const std::byte> bytes, const LoadOptions& options = {});

}  // namespace paper
}  // namespace meshhood
