// SPDX-License-Identifier: MIT
#include "format/format.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>

#include "meshhood/error.h"
#include "meshhood/serialize.h"

#include "shared/checksum.h"
#include "shared/text.h"

namespace meshhood::inline v0_1::file {
namespace {

[[noreturn]] void refuse_at(const std::string& section, std::uint64_t byte, const std::string& message) {
  raise(ErrorCode::MalformedIndex, section + ", byte " + std::to_string(byte) + ": " + message);
}

[[noreturn]] void refuse_header(std::size_t byte, const std::string& message) { refuse_at("header", byte, message); }

std::string expected(std::uint64_t value, std::uint64_t wanted) {
  return std::to_string(value) + ", expected " + std::to_string(wanted);
}

std::string_view name_of(const Section& section) {
  const std::string_view all(section.name.data(), section.name.size());
  return all.substr(0, all.find('\0'));
}

/// A forged name may contain any bytes; only printable ones are shown.
std::string quoted(std::string_view name) {
  const bool is_plain = std::all_of(name.begin(), name.end(), [](char c) { return ' ' <= c && c <= '~'; });
  return is_plain ? "section " + std::string(name) : "a section without a readable name";
}

/// Verifies only the fields that all formats have in common, so that the error for another format states its number.
void verify_beginning(const Header& header) {
  if (header.magic != kMagic) refuse_header(0, "not a saved index");
  if (header.byte_order == kOtherByteOrder) {
    refuse_header(offsetof(Header, byte_order), "big-endian byte order, expected little-endian");
  }
  if (header.byte_order != kByteOrderMark)
    refuse_header(offsetof(Header, byte_order), "the byte order mark is not valid");
  const std::uint32_t format = format_of(header.kind);
  if (header.format != format) {
    const std::string advice = header.format < format ? "build the index again" : "install a newer meshhood";
    refuse_header(offsetof(Header, format), "format " + std::to_string(header.format) +
                                                ", but this version reads format " + std::to_string(format) + ": " +
                                                advice);
  }
}

void verify_header_checksum(const Header& header, std::span<const std::byte> first_bytes) {
  const std::uint64_t end = head_bytes(header.sections);
  if (end > first_bytes.size()) {
    refuse_header(offsetof(Header, sections), std::to_string(header.sections) + " sections do not fit into " +
                                                  std::to_string(first_bytes.size()) + " bytes");
  }
  const auto rest = first_bytes.first(static_cast<std::size_t>(end)).subspan(sizeof(Header));
  if (checksum({first_bytes.first(offsetof(Header, checksum)), rest}) != header.checksum) {
    refuse_header(offsetof(Header, checksum), "the checksum of the header and the section table does not match");
  }
}

/// A valid checksum does not make the input trusted: every field is validated.
void verify_fields(const Header& header) {
  if (header.kind != IndexKind::Exact && header.kind != IndexKind::Paper) {
    refuse_header(offsetof(Header, kind), "index kind " + std::to_string(static_cast<unsigned>(header.kind)) +
                                              ", expected 1 (exact) or 2 (paper)");
  }
  if (header.id_bytes != sizeof(VertexId)) {
    refuse_header(offsetof(Header, id_bytes), "vertex ids of " + std::to_string(8U * header.id_bytes) +
                                                  " bits, expected " + std::to_string(8 * sizeof(VertexId)));
  }
  if (header.scalar_bytes != sizeof(float) && header.scalar_bytes != sizeof(double)) {
    refuse_header(offsetof(Header, scalar_bytes),
                  "coordinates of " + std::to_string(header.scalar_bytes) + " bytes, expected 4 or 8");
  }
  if (header.unused != 0) refuse_header(offsetof(Header, unused), expected(header.unused, 0));
  if (header.vertices > kMaxVertices) {
    refuse_header(offsetof(Header, vertices),
                  std::to_string(header.vertices) + " vertices, but the limit is " + std::to_string(kMaxVertices));
  }
}

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

Header read_header(std::span<const std::byte> first_bytes, std::uint64_t size) {
  if constexpr (std::endian::native != std::endian::little) {
    raise(ErrorCode::MalformedIndex, "an index is saved and loaded on little-endian machines only");
  }
  if (first_bytes.size() < sizeof(Header)) {
    refuse_header(first_bytes.size(), "the end, expected " + std::to_string(sizeof(Header)) + " bytes or more");
  }
  Header header;
  std::memcpy(&header, first_bytes.data(), sizeof(Header));
  verify_beginning(header);
  if (header.bytes != size) {
    refuse_header(offsetof(Header, bytes),
                  "expected " + std::to_string(header.bytes) + " bytes in all, but there are " + std::to_string(size));
  }
  verify_header_checksum(header, first_bytes);
  verify_fields(header);
  return header;
}

void expect_kind(IndexKind kind, IndexKind expected) {
  if (kind == expected) return;
  refuse_header(offsetof(Header, kind), expected == IndexKind::Exact ? "a paper index, expected an exact index"
                                                                     : "an exact index, expected a paper index");
}

SectionReader::SectionReader(std::span<const std::byte> bytes)
    : bytes_(bytes),
      header_(read_header(bytes, bytes.size())),
      table_(reinterpret_cast<const Section*>(bytes.data() + sizeof(Header)), header_.sections) {
  verify_table();
}

void SectionReader::verify_table() const {
  std::uint64_t next = head_bytes(table_.size());
  for (const Section& section : table_) {
    const auto byte = static_cast<std::uint64_t>(reinterpret_cast<const std::byte*>(&section) - bytes_.data());
    const std::string where = "header, " + quoted(name_of(section));
    if (section.begin != next) refuse_at(where, byte, "begins at " + expected(section.begin, next));
    if (section.bytes > bytes_.size() - next) {
      refuse_at(where, byte,
                std::to_string(section.bytes) + " bytes from byte " + std::to_string(next) + ", but there are " +
                    std::to_string(bytes_.size()) + " bytes in all");
    }
    next = aligned(next + section.bytes);
  }
  if (next != bytes_.size()) refuse_header(offsetof(Header, bytes), "sections end at " + expected(next, bytes_.size()));
}

std::span<const std::byte> SectionReader::bytes_of(const Section& section) const {
  return bytes_.subspan(static_cast<std::size_t>(section.begin), static_cast<std::size_t>(section.bytes));
}

void SectionReader::verify_checksums(TaskContext& task) const {
  for (const Section& section : table_) {
    const std::string where = quoted(name_of(section));
    if (checksum({bytes_of(section)}) != section.checksum) {
      refuse_at(where, section.begin, "the checksum of its " + std::to_string(section.bytes) + " bytes does not match");
    }
    const std::uint64_t end = section.begin + section.bytes;
    for (std::uint64_t byte = end; byte < aligned(end); ++byte) {
      const auto value = std::to_integer<unsigned>(bytes_[static_cast<std::size_t>(byte)]);
      if (value != 0) refuse_at(where, byte, "padding byte " + expected(value, 0));
    }
    task.step();
  }
}

bool SectionReader::is_next(std::string_view name) const {
  return taken_ < table_.size() && name_of(table_[taken_]) == name;
}

std::span<const std::byte> SectionReader::take_bytes(std::string_view name, std::size_t of_each) {
  if (taken_ == table_.size())
    refuse_header(offsetof(Header, sections), "section " + std::string(name) + " is missing");
  const Section& section = table_[taken_++];
  std::array<char, 16> padded{};
  std::copy(name.begin(), name.end(), padded.begin());
  if (section.name != padded) {
    refuse(&section, quoted(name_of(section)) + ", expected section " + std::string(name));
  }
  if (section.bytes % of_each != 0) {
    refuse_at(quoted(name), section.begin,
              std::to_string(section.bytes) + " bytes, expected a multiple of " + std::to_string(of_each));
  }
  return bytes_of(section);
}

void SectionReader::expect_end() const {
  if (taken_ != table_.size()) refuse(&table_[taken_], quoted(name_of(table_[taken_])) + ", expected no more sections");
}

void SectionReader::refuse_count(std::uint64_t count, std::uint64_t wanted) const {
  refuse_last(expected(count, wanted) + " elements");
}

void SectionReader::refuse_last(const std::string& message) const {
  const Section& section = table_[taken_ - 1];
  refuse_at(quoted(name_of(section)), section.begin, message);
}

void SectionReader::refuse_in(std::string_view section, std::uint64_t byte, const std::string& message) const {
  refuse_at(quoted(section), std::ranges::find(table_, section, name_of)->begin + byte, message);
}

void SectionReader::refuse(const void* place, const std::string& message) const {
  const auto byte = static_cast<std::uint64_t>(static_cast<const std::byte*>(place) - bytes_.data());
  const auto after = std::find_if(table_.begin(), table_.end(), [&](const Section& s) { return s.begin > byte; });
  refuse_at(after == table_.begin() ? "header" : quoted(name_of(*(after - 1))), byte, message);
}

void SectionWriter::add_bytes(std::string_view name, std::span<const std::byte> bytes) {
  assert(name.size() <= Section{}.name.size());
  parts_.push_back({std::string(name), bytes});
}

std::size_t SectionWriter::parts() const {
  std::size_t bytes = 0;
  for (const Part& part : parts_) bytes += part.bytes.size();
  return 2 * bytes;  // one pass computes the checksums, one writes
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
  check_function(sink, "sink");
  if constexpr (std::endian::native != std::endian::little) {
    raise(ErrorCode::MalformedIndex, "saving an index requires a little-endian machine");
  }
  header.format = format_of(header.kind);
  std::vector<Section> table = make_table(task);
  header.sections = static_cast<std::uint32_t>(table.size());
  header.bytes = aligned(table.back().begin + table.back().bytes);
  // The checksum of the header also covers the section table and the zeros up to the first section.
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
