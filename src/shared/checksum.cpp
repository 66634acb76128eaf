// SPDX-License-Identifier: MIT
#include "shared/checksum.h"

#define XXH_INLINE_ALL  // NOLINT(readability-identifier-naming): the library's own
#include <xxhash.h>

namespace meshhood::inline v0_1 {

std::uint64_t checksum(ByteSpans parts) {
  if (parts.size() == 1) return XXH3_64bits(parts.begin()->data(), parts.begin()->size());
  XXH3_state_t state;
  XXH3_64bits_reset(&state);
  for (const auto part : parts) XXH3_64bits_update(&state, part.data(), part.size());
  return XXH3_64bits_digest(&state);
}

Fingerprint wide_checksum(ByteSpans parts) {
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  for (const auto part : parts) XXH3_128bits_update(&state, part.data(), part.size());
  const XXH128_hash_t hash = XXH3_128bits_digest(&state);
  return {hash.high64, hash.low64};
}

}  // namespace meshhood::inline v0_1
