// SPDX-License-Identifier: MIT
#include "parts/survey.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "shared/checksum.h"

namespace meshhood::parts {
namespace {

/// The number of corners that are hashed at once. Fixed, because the content hash depends on it.
constexpr std::size_t kHashedCorners = std::size_t{1} << 18;

/// Spreads ids, so that a sample by this number does not follow a pattern of the numbering. The finalizer of
/// SplitMix64 (Steele, Lea and Flood, 2014).
std::uint64_t scattered(std::uint64_t id) {
  id += 0x9e3779b97f4a7c15U;
  id = (id ^ id >> 30U) * 0xbf58476d1ce4e5b9U;
  id = (id ^ id >> 27U) * 0x94d049bb133111ebU;
  return id ^ id >> 31U;
}

/// Every vertex with a number up to this is in the sample.
std::uint64_t sample_limit(std::uint64_t vertices, std::uint64_t sample) {
  constexpr auto kAll = std::numeric_limits<std::uint64_t>::max();
  return vertices <= sample ? kAll : kAll / vertices * sample;
}

}  // namespace

std::uint64_t sample_size(std::uint64_t parts) {
  constexpr std::uint64_t kOfEachPart = 2048;
  constexpr std::uint64_t kLeast = std::uint64_t{1} << 18;
  return std::max(kLeast, parts * kOfEachPart);
}

Survey survey(ChunkedMesh& mesh, std::uint64_t parts, Stages& stages) {
  Survey result;
  const auto hash = [&](std::span<const std::byte> bytes) {
    const Fingerprint before = result.content_hash;
    result.content_hash = wide_checksum({std::as_bytes(std::span(&before, 1)), bytes});
  };
  const std::array<std::uint64_t, 2> head{mesh.vertex_count(), mesh.is_double() ? 8U : 4U};
  hash(std::as_bytes(std::span(head)));
  const std::uint64_t limit = sample_limit(mesh.vertex_count(), sample_size(parts));
  for_each_vertex_chunk(mesh, stages, [&](std::uint64_t first, std::span<const Point> positions) {
    hash(std::as_bytes(positions));
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (scattered(first + i) <= limit) result.sample.push_back({positions[i], first + i});
    }
  });
  FaceChunk chunk;
  mesh.rewind_faces();
  while (mesh.read_faces(kHashedCorners, chunk)) {
    hash(std::as_bytes(std::span(chunk.corners)));
    hash(std::as_bytes(std::span(chunk.ends)));
    result.faces += chunk.size();
    result.corners += chunk.corners.size();
    stages.report(1.0);
  }
  return result;
}

}  // namespace meshhood::parts
