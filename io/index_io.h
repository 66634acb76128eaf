// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "meshhood/index.h"
#include "meshhood/serialize.h"

/// Index files in and out. What stands in them, and what is verified, says `meshhood/serialize.h`.
namespace meshhood::io {

/// Writes `index` to a file that appears whole or not at all: it is written beside the target under another name,
/// brought to the disk and renamed. Who has mapped or opened the old file keeps it; of several who save at once, the
/// last wins.
///
/// Progress is told as by the core, and once more when all is on the disk, just before the file takes its name.
/// Throws Error{IoFailure, Cancelled}; the old file is then as it was, as it is where memory runs out.
void save(const std::filesystem::path& path, const Index& index, const SaveOptions& options = {});

/// The index in the file, read into memory and verified. What happens to the file later does not matter.
///
/// What is no index, or not all of one, is refused before it is read whole. Progress is told while the file is read, as
/// in `ReadOptions`, and between the parts of the verification. O(bytes).
/// Throws Error{IoFailure, MalformedIndex, TooLarge, Cancelled}: one line that begins with the file.
[[nodiscard]] Index load(const std::filesystem::path& path, const LoadOptions& options = {});

/// The same for the paper's index.
void save(const std::filesystem::path& path, const paper::Index& index, const SaveOptions& options = {});
[[nodiscard]] paper::Index load_paper(const std::filesystem::path& path, const LoadOptions& options = {});

/// The index in the file, in place: pages are read as queries need them, and shared with whoever maps the same file.
/// The file is unmapped with the index. Replacing it by renaming, as `save` does, is safe; to truncate or overwrite it
/// in place is not, and ends the program at the next query that needs what is gone.
///
/// Verifies everything, unless `options` say that the file is trusted. Throws as `load`; a pipe cannot be mapped.
[[nodiscard]] Index map(const std::filesystem::path& path, const MapOptions& options = {});

/// Whether the file begins as a saved index does. False for what is no ordinary file, which is not read.
/// Throws Error{IoFailure}.
[[nodiscard]] bool is_index(const std::filesystem::path& path);

/// The header of the index in an ordinary file. Throws as `load`. O(1).
[[nodiscard]] IndexHeader read_header(const std::filesystem::path& path);

}  // namespace meshhood::io
