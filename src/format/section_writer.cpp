// SPDX-License-Identifier: MIT
#include "format/section_writer.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "meshhood/error.h"

#include "shared/checksum.h"

namespace meshhood::inline v0_1::file {
namespace {

std::span<const std::byte> bytes_of(const Header& header) { return std::as_bytes(std::span(&header, 1)); }

/// Writes zeros up to the next multiple of the alignment.
void pad(std::uint64_t bytes, const Sink& sink) {
  static constexpr std::array<std::byte, kIndexAlignment> kZeros{};
  const auto missing = static_cast<std::size_t>(aligned(bytes) - bytes);
  if (missing != 0) sink(std::span(kZeros).first(missing));
}

/// Writes in chunks, so that progress and cancellation stay responsive.
void write_chunks(std::span<const std::byte> bytes, const Sink& sink, TaskContext& task) {
  constexpr std::size_t kChunk = std::size_t{4} << 20;
  while (!bytes.empty()) {
    const auto chunk = bytes.first(std::min(bytes.size(), kChunk));
    sink(chunk);
    bytes = bytes.subspan(chunk.size());
    task.step(chunk.size());
  }
}

}  // namespace

void SectionWriter::add_bytes(std::string_view name, std::span<const std::byte> bytes) {
  assert(name.size() <= Section{}.name.size());
  parts_.push_back({std::string(name), bytes});
}

std::size_t SectionWriter::parts() const {
  std::size_t bytes = 0;
  for (const Part& part : parts_) bytes += part.bytes.size();
  return 2 * bytes;  // one pass for the checksums, one to write
}

std::vector<Section> SectionWriter::make_table(TaskContext& task) const {
  std::vector<Section> table;
  std::uint64_t begin = head_bytes(parts_.size());
  for (const Part& part : parts_) {
    Section& section = table.emplace_back();
    std::copy(part.name.begin(), part.name.end(), section.name.begin());
    section.begin = begin;
    section.bytes = part.bytes.size();
    section.checksum = checksum({part.bytes});
    task.step(part.bytes.size());
    begin = aligned(begin + part.bytes.size());
  }
  return table;
}

void SectionWriter::write(Header header, const Sink& sink, TaskContext& task) const {
  if constexpr (std::endian::native != std::endian::little) {
    raise(ErrorCode::MalformedIndex, "saving an index requires a little-endian machine");
  }
  header.format = format_of(header.kind);
  std::vector<Section> table = make_table(task);
  header.sections = static_cast<std::uint32_t>(table.size());
  header.bytes = aligned(table.back().begin + table.back().bytes);
  // The section table and the zeros up to the first section, which the header's checksum covers.
  std::vector<std::byte> rest(static_cast<std::size_t>(head_bytes(table.size())) - sizeof(Header));
  std::ranges::copy(std::as_bytes(std::span(table)), rest.begin());
  header.checksum = checksum({bytes_of(header).first(offsetof(Header, checksum)), rest});
  sink(bytes_of(header));
  sink(rest);
  for (const Part& part : parts_) {
    write_chunks(part.bytes, sink, task);
    pad(part.bytes.size(), sink);
  }
  task.report_progress();
}

}  // namespace meshhood::inline v0_1::file
