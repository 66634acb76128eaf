// SPDX-License-Identifier: MIT
#include <cstring>

#include "meshhood/error.h"
#include "meshhood/serialize.h"

#include "format/section_reader.h"

namespace meshhood::inline v0_1 {

bool is_index(std::span<const std::byte> first_bytes) {
  return first_bytes.size() >= file::kMagic.size() &&
         std::memcmp(first_bytes.data(), file::kMagic.data(), file::kMagic.size()) == 0;
}

IndexHeader read_header(std::span<const std::byte> bytes) { return read_header(bytes, bytes.size()); }

IndexHeader read_header(std::span<const std::byte> first_bytes, std::uint64_t size) {
  const file::Header header = file::read_header(first_bytes, size);
  return {.format = header.format,
          .kind = header.kind,
          .is_double = header.scalar_bytes == sizeof(double),
          .vertices = header.vertices,
          .bytes = header.bytes,
          .mesh = header.mesh};
}

void check_mesh(const IndexHeader& header, const Fingerprint& mesh) {
  if (header.mesh == mesh) return;
  raise(ErrorCode::MalformedIndex,
        "built from mesh " + to_text(header.mesh) + ", but the given mesh is " + to_text(mesh));
}

}  // namespace meshhood::inline v0_1
