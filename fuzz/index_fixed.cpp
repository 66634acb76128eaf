// SPDX-License-Identifier: MIT
// A forged index: the header, the table and the checksums of the input are corrected before it is loaded, so that only
// the content of the sections can be rejected.
#include <algorithm>
#include <cstring>
#include <vector>

#include "meshhood/error.h"
#include "meshhood/serialize.h"

#include "judge.h"
#include "query_untrusted.h"
#include "support/forged_index.h"
#include "target.h"

namespace meshhood::fuzz {
namespace {

/// Places the sections one after the other with zeros between them, and removes what follows the last.
void lay_out(std::vector<std::byte>& bytes) {
  std::vector<file::Section> table = test::table_of(bytes);
  std::uint64_t next = file::head_bytes(table.size());
  for (file::Section& section : table) {
    section.begin = next;
    section.bytes = std::min<std::uint64_t>(section.bytes, bytes.size() - std::min<std::uint64_t>(next, bytes.size()));
    next = file::aligned(next + section.bytes);
    if (next > bytes.size()) bytes.resize(static_cast<std::size_t>(next));
    std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(section.begin + section.bytes),
              bytes.begin() + static_cast<std::ptrdiff_t>(next), std::byte{0});
  }
  bytes.resize(static_cast<std::size_t>(next));
  if (table.empty()) return;
  std::memcpy(bytes.data() + sizeof(file::Header), table.data(), table.size() * sizeof(file::Section));
}

}  // namespace

void run(std::span<const std::byte> input) {
  std::vector<std::byte> bytes(input.begin(), input.end());
  if (bytes.size() < sizeof(file::Header)) return;
  file::Header header = test::header_of(bytes);
  const file::Header right;
  header.magic = right.magic;
  header.byte_order = right.byte_order;
  header.format = right.format;
  header.kind = right.kind;
  header.id_bytes = right.id_bytes;
  header.unused = right.unused;
  if (header.scalar_bytes != sizeof(double)) header.scalar_bytes = sizeof(float);
  if (file::head_bytes(header.sections) > bytes.size()) return;
  std::memcpy(bytes.data(), &header, sizeof(header));
  lay_out(bytes);
  header.bytes = bytes.size();
  std::memcpy(bytes.data(), &header, sizeof(header));
  test::seal(bytes);
  try {
    query_untrusted(load(bytes));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::MalformedIndex) fail(error.what());
  }
}

}  // namespace meshhood::fuzz
