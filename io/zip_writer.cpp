// SPDX-License-Identifier: MIT
#include "io/zip_writer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <limits>
#include <utility>

#include "io/waiting.h"

namespace meshhood::inline v0_1::io {
namespace {

constexpr std::uint64_t kMost32 = std::numeric_limits<std::uint32_t>::max();  // says that the value is in Zip64 fields
constexpr std::uint16_t kStored = 0;
constexpr std::uint16_t kDeflated = 8;

using ChecksumTables = std::array<std::array<std::uint32_t, 256>, 8>;

/// Table k: what a byte contributes to the CRC-32 if k bytes follow it.
constexpr ChecksumTables checksum_tables() {
  ChecksumTables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t value = byte;
    for (int bit = 0; bit < 8; ++bit) value = value >> 1U ^ ((value & 1U) != 0 ? 0xedb88320U : 0U);
    tables[0][byte] = value;
  }
  for (std::size_t k = 1; k < tables.size(); ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = tables[k - 1][byte];
      tables[k][byte] = before >> 8U ^ tables[0][before & 0xffU];
    }
  }
  return tables;
}

/// The CRC-32 of what `checksum` is of, followed by `bytes`. Eight bytes at once, so that the disk is the slower part.
std::uint32_t extend_checksum(std::uint32_t checksum, std::string_view bytes) {
  static constexpr ChecksumTables kTables = checksum_tables();
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  std::uint32_t state = ~checksum;
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < 8; ++i) {
      const std::uint32_t mixed = i < 4 ? state >> (8U * i) & 0xffU : 0U;
      next ^= kTables[7 - i][byte(i) ^ mixed];
    }
    state = next;
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) state = state >> 8U ^ kTables[0][(state ^ byte(i)) & 0xffU];
  return ~state;
}

/// Appends values in the order of bytes of the format.
class Fields {
 public:
  Fields& u16(std::uint64_t value) { return put(value, 2); }
  Fields& u32(std::uint64_t value) { return put(value, 4); }
  Fields& u64(std::uint64_t value) { return put(value, 8); }
  /// A value of 32 bits, or the sign that it is in a field of Zip64.
  Fields& clipped(std::uint64_t value) { return u32(std::min(value, kMost32)); }
  Fields& text(std::string_view value) {
    bytes_ += value;
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  Fields& put(std::uint64_t value, unsigned size) {
    for (unsigned i = 0; i < size; ++i) bytes_ += static_cast<char>(value >> (8U * i) & 0xffU);
    return *this;
  }

  std::string bytes_;
};

/// Appends the codes of Deflate, which begin with their highest bit, to bytes, which are filled from the lowest bit.
class Codes {
 public:
  explicit Codes(FileWriter& file) : file_(file) {}

  void put(unsigned code, unsigned length) {
    while (length-- > 0) {
      byte_ |= (code >> length & 1U) << filled_;
      if (++filled_ == 8) flush();
    }
  }

  /// Fills the last byte with zeros.
  void flush() {
    if (filled_ == 0) return;
    const char byte = static_cast<char>(byte_);
    file_.write({&byte, 1});
    byte_ = filled_ = 0;
  }

 private:
  FileWriter& file_;
  unsigned byte_ = 0;
  unsigned filled_ = 0;
};

/// A last block with the fixed codes: the byte, copies of 258 bytes from one byte before, the rest of the bytes.
void write_run_block(FileWriter& file, unsigned char byte, std::uint64_t count) {
  constexpr std::uint64_t kLongest = 258;
  Codes codes(file);
  codes.put(0b110, 3);  // the last block; fixed codes, whose number 01 begins with the lower bit
  const auto put_bytes = [&](std::uint64_t bytes) {
    while (bytes-- > 0) codes.put(0x30U + byte, 8);
  };
  const std::uint64_t copies = count == 0 ? 0 : (count - 1) / kLongest;
  put_bytes(std::min<std::uint64_t>(count, 1));
  for (std::uint64_t i = 0; i < copies; ++i) {
    codes.put(0b11000101'00000, 13);  // length 258; distance 1
    if (i % 0x10000 == 0) report_wait();
  }
  put_bytes(count == 0 ? 0 : count - 1 - copies * kLongest);
  codes.put(0, 7);  // the end
  codes.flush();
}

}  // namespace

ZipWriter::ZipWriter(const std::filesystem::path& path)
    : file_(path, FileWriter::Order::Any) {}  // a header has the checksum of what follows it

void ZipWriter::begin(const std::string& name, std::uint64_t bytes) {
  begin({.name = name, .bytes = bytes, .method = kStored});
}

void ZipWriter::begin(Member member) {
  end_member();
  member.offset = file_.position();
  file_.write(header(member, false));
  members_.push_back(std::move(member));
}

void ZipWriter::write(std::string_view bytes) {
  members_.back().checksum = extend_checksum(members_.back().checksum, bytes);
  file_.write(bytes);
}

void ZipWriter::add_run(const std::string& name, std::string_view head, char byte, std::uint64_t count) {
  assert(head.size() < 0x10000 && static_cast<unsigned char>(byte) < 144);
  begin({.name = name, .bytes = head.size() + count, .method = kDeflated});
  file_.write(Fields().text({"\0", 1}).u16(head.size()).u16(~head.size()).bytes());  // a block that is not compressed
  write(head);
  write_run_block(file_, static_cast<unsigned char>(byte), count);
  const std::string run(std::size_t{1} << 16, byte);
  std::uint32_t& checksum = members_.back().checksum;
  for (std::uint64_t left = count; left > 0;) {
    const std::string_view part = std::string_view(run).substr(0, std::min<std::uint64_t>(left, run.size()));
    checksum = extend_checksum(checksum, part);
    left -= part.size();
    report_wait();  // 10^10 bytes take seconds
  }
}

/// The header is written again, now with the checksum.
void ZipWriter::end_member() {
  if (members_.empty()) return;
  Member& member = members_.back();
  const std::uint64_t end = file_.position();
  member.packed = end - member.offset - header(member, false).size();
  assert(member.method != kStored || member.packed == member.bytes);
  file_.seek(member.offset);
  file_.write(header(member, false));
  file_.seek(end);
}

/// Of a member, in front of it or in the directory at the end of the file. Its length depends only on what `begin`
/// knows.
std::string ZipWriter::header(const Member& member, bool is_central) {
  const bool is_large = member.bytes >= kMost32;
  const bool is_far = is_central && member.offset >= kMost32;
  Fields large;
  if (is_large) large.u64(member.bytes).u64(member.packed);
  if (is_far) large.u64(member.offset);
  Fields extra;
  if (is_large || is_far) extra.u16(1).u16(large.bytes().size()).text(large.bytes());
  const unsigned version = is_large || is_far ? 45 : 20;
  constexpr unsigned kDate = 1U << 5U | 1U;  // 1980-01-01
  Fields fields;
  is_central ? fields.u32(0x02014b50).u16(version) : fields.u32(0x04034b50);
  fields.u16(version).u16(0).u16(member.method).u16(0).u16(kDate).u32(member.checksum);
  fields.u32(is_large ? kMost32 : member.packed).u32(is_large ? kMost32 : member.bytes);
  fields.u16(member.name.size()).u16(extra.bytes().size());
  if (is_central) fields.u16(0).u16(0).u16(0).u32(0).clipped(member.offset);
  return fields.text(member.name).text(extra.bytes()).bytes();
}

/// Of the file, behind a directory of `bytes` bytes at `offset`.
std::string ZipWriter::end(std::uint64_t members, std::uint64_t offset, std::uint64_t bytes) {
  constexpr unsigned kVersion = 45;
  constexpr unsigned kSizeOfRest = 44;
  Fields fields;
  if (offset >= kMost32) {
    fields.u32(0x06064b50).u64(kSizeOfRest).u16(kVersion).u16(kVersion).u32(0).u32(0);
    fields.u64(members).u64(members).u64(bytes).u64(offset);
    fields.u32(0x07064b50).u32(0).u64(offset + bytes).u32(1);
  }
  return fields.u32(0x06054b50).u16(0).u16(0).u16(members).u16(members).u32(bytes).clipped(offset).u16(0).bytes();
}

void ZipWriter::commit() {
  end_member();
  const std::uint64_t offset = file_.position();
  for (const Member& member : members_) file_.write(header(member, true));
  file_.write(end(members_.size(), offset, file_.position() - offset));
  file_.commit();
}

}  // namespace meshhood::inline v0_1::io
