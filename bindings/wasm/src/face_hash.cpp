// SPDX-License-Identifier: MIT
#include "face_hash.h"

#define XXH_INLINE_ALL  // NOLINT(readability-identifier-naming): the library's own
#include <xxhash.h>

namespace meshhood::wasm {

Fingerprint hash_faces(const void* corners, std::size_t corner_count, const void* offsets, std::size_t offset_count) {
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  XXH3_128bits_update(&state, &corner_count, sizeof corner_count);
  XXH3_128bits_update(&state, corners, 4 * corner_count);
  XXH3_128bits_update(&state, offsets, 4 * offset_count);
  const XXH128_hash_t hash = XXH3_128bits_digest(&state);
  return {.high = hash.high64, .low = hash.low64};
}

}  // namespace meshhood::wasm
