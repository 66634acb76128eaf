// SPDX-License-Identifier: MIT
// Steps that rearrange: small parts of nodes are dissolved in a build, and rows of a batch are sorted by position. The
// first byte of an input chooses. From the others, the nodes are drawn, or they are the positions.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "batch/position_sort.h"
#include "bytes.h"
#include "exact/build/node_parts.h"
#include "judge.h"
#include "support/divided_nodes.h"
#include "target.h"

namespace meshhood::fuzz {
namespace {

/// Draws from an input; zeros when it has ended.
class Draw {
 public:
  explicit Draw(Bytes& bytes) : bytes_(bytes) {}
  std::size_t below(std::size_t bound) { return bytes_.take<std::uint16_t>() % bound; }

 private:
  Bytes& bytes_;
};

void dissolve(Bytes& bytes) {
  Draw draw(bytes);
  const test::DividedNodes before = test::draw_divided_nodes(draw);
  NodeParts after = before.node_parts();
  dissolve_small_parts(after);
  const std::string fault = test::fault_of(before, after);
  if (!fault.empty()) fail(fault);
}

void sort_rows(Bytes& bytes) {
  const auto mask = bytes.take<std::uint32_t>();
  RawVector<std::uint64_t> rows;
  while (!bytes.empty()) rows.push_back((std::uint64_t{bytes.take<std::uint32_t>() & mask} << 32) + rows.size());
  RawVector<std::uint64_t> expected = rows;
  std::ranges::sort(expected);  // ties by the number of the row
  TaskContext alone;
  sort_by_position(rows, alone);
  if (rows != expected) fail("rows are not sorted");
}

}  // namespace

void run(std::span<const std::byte> input) {
  Bytes bytes(input);
  if (bytes.take<std::uint8_t>() % 4 == 0) {
    sort_rows(bytes);
  } else {
    dissolve(bytes);
  }
}

}  // namespace meshhood::fuzz
