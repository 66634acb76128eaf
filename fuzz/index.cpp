// SPDX-License-Identifier: MIT
// Any bytes as a saved index. Checksums reject nearly all; an index that is accepted is queried and saved again.
#include <algorithm>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/serialize.h"

#include "judge.h"
#include "query_untrusted.h"
#include "support/index_bytes.h"
#include "target.h"

namespace meshhood::fuzz {

void run(std::span<const std::byte> input) {
  try {
    const Index index = load(input);
    query_untrusted(index);
    if (!std::ranges::equal(test::saved(index, {.faces = index.faces()}), input))
      fail("saved again, not the same bytes");
  } catch (const Error& error) {
    if (error.code() != ErrorCode::MalformedIndex) fail(error.what());
  }
}

}  // namespace meshhood::fuzz
