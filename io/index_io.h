// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/serialize.h"

/// Reading and writing index files. `meshhood/serialize.h` documents the content and its verification.
namespace meshhood::inline v0_1::io {
MESHHOOD_API_BEGIN

/// Writes `index` to a file atomically: to a temporary file beside the target, which is synced and renamed. Processes
/// that have the old file open or mapped keep the old content. If several save at once, the last wins.
///
/// Progress is reported as by the core, and once more when the data is on the disk, just before the rename.
/// Throws Error{IoFailure, Cancelled}, and as the core if the faces are refused; the old file is then unchanged, as it
/// is when memory runs out.
void save(const std::filesystem::path& path, const Index& index, const SaveOptions& options = {}, const Run& run = {});

/// Reads an index into memory and verifies it. The file may change or disappear afterwards.
///
/// A file that is not an index, or is truncated, is refused by its first bytes. Progress is reported while the file is
/// read, as in `ReadOptions`, and between the parts of the verification. O(bytes).
/// Throws Error{IoFailure, MalformedIndex, TooLarge, Cancelled}: one line that begins with the file.
[[nodiscard]] Index load(const std::filesystem::path& path, const Run& run = {});

/// The same for the paper's index.
void save(const std::filesystem::path& path, const paper::Index& index, const Run& run = {});
[[nodiscard]] paper::Index load_paper(const std::filesystem::path& path, const Run& run = {});

/// Maps an index file: the system reads pages when queries need them, and shares them between processes. The mapping
/// lives as long as the index. Replacing the file by renaming, as `save` does, is safe. Truncating or overwriting it in
/// place is not: the next query that needs a missing page ends the program.
///
/// Verifies everything unless `options.trusted`. Throws as `load`; a pipe cannot be mapped.
[[nodiscard]] Index map(const std::filesystem::path& path, const MapOptions& options = {}, const Run& run = {});

/// Whether the file begins like a saved index. False for a pipe, a device or standard input, which is not read.
/// Throws Error{IoFailure}.
[[nodiscard]] bool is_index(const std::filesystem::path& path);

/// The header of the index in a regular file. Throws as `load`. O(1).
[[nodiscard]] IndexHeader read_header(const std::filesystem::path& path);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1::io
