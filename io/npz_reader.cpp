// SPDX-License-Identifier: MIT
#include "io/npz_reader.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <limits>
#include <type_traits>

#include <fmt/format.h>
#include <minizip/unzip.h>

#include "meshhood/error.h"

#include "io/messages.h"

namespace meshhood::io {

struct NpzReader::Archive {
  unzFile file;

  explicit Archive(unzFile opened) : file(opened) {}
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;
  ~Archive() {
    if (file != nullptr) unzClose(file);
  }

  [[nodiscard]] bool locate(std::string_view name) const {
    constexpr int kCaseSensitive = 1;
    return unzLocateFile(file, fmt::format("{}.npy", name).c_str(), kCaseSensitive) == UNZ_OK;
  }
};

NpzReader::NpzReader(const std::filesystem::path& path) : path_(path) {
  errno = 0;
  archive_ = std::make_unique<Archive>(unzOpen64(path.c_str()));
  if (archive_->file != nullptr) return;
  if (errno != 0) raise_errno(path, errno);
  raise_io(path, 0, "is not a whole .npz file");
}

NpzReader::NpzReader(NpzReader&&) noexcept = default;
NpzReader::~NpzReader() = default;

bool NpzReader::has(std::string_view name) const { return archive_->locate(name); }

NpyHeader NpzReader::begin(std::string_view name) {
  name_ = name;
  if (!archive_->locate(name)) fail("is missing");
  if (unzOpenCurrentFile(archive_->file) != UNZ_OK) fail("is damaged");
  // Nothing beyond the dictionary may be read yet. Its length is known from the first bytes, of version 1 as we write
  // it.
  constexpr std::size_t kBeforeDictionary = 10;
  std::string head(kBeforeDictionary, '\0');
  take(head);
  const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(head[i])}; };
  head.resize(kBeforeDictionary + (byte(8) | byte(9) << 8U));
  take(std::span(head).subspan(kBeforeDictionary));
  header_ = parse_npy_header(head, printable_name(path_.string()) + ": " + name_);
  left_ = 1;
  for (const std::uint64_t length : header_.shape) {
    if (length != 0 && left_ > std::numeric_limits<std::uint64_t>::max() / length) fail("is too large");
    left_ *= length;
  }
  if (header_.big_endian != (std::endian::native == std::endian::big) && header_.item > 1)
    fail("has another byte order");
  return header_;
}

template <class T>
bool NpzReader::read(std::vector<T>& values) {
  constexpr std::uint64_t kMost = 1'000'000;
  values.resize(static_cast<std::size_t>(std::min(left_, kMost)));
  left_ -= values.size();
  if (values.empty()) {
    end();
    return false;
  }
  const bool fits = std::is_floating_point_v<T> ? header_.kind == 'f' : header_.kind == 'i' || header_.kind == 'u';
  if (fits && header_.item == sizeof(T)) {
    take({reinterpret_cast<char*>(values.data()), values.size() * sizeof(T)});
  } else if (fits && header_.item == 4) {
    std::vector<std::int32_t> small(values.size());
    take({reinterpret_cast<char*>(small.data()), small.size() * sizeof(std::int32_t)});
    std::copy(small.begin(), small.end(), values.begin());
  } else {
    fail(fmt::format("has values of type {}{}", header_.kind, header_.item));
  }
  return true;
}

std::vector<std::int64_t> NpzReader::integers(std::string_view name) {
  begin(name);
  std::vector<std::int64_t> all;
  std::vector<std::int64_t> piece;
  while (read(piece)) all.insert(all.end(), piece.begin(), piece.end());
  return all;
}

std::string NpzReader::text(std::string_view name) {
  constexpr std::size_t kMost = std::size_t{1} << 16;
  begin(name);
  if (header_.kind != 'S' || header_.item > kMost) fail("is not a text");
  std::string value(header_.item, '\0');
  take(value);
  end();
  return value;
}

void NpzReader::take(std::span<char> out) {
  while (!out.empty()) {
    constexpr std::size_t kMost = std::size_t{1} << 30;
    const auto size = static_cast<unsigned>(std::min(out.size(), kMost));
    const int count = unzReadCurrentFile(archive_->file, out.data(), size);
    if (count <= 0) fail("is damaged or truncated");
    out = out.subspan(static_cast<std::size_t>(count));
  }
}

void NpzReader::end() {
  char more = 0;
  if (unzReadCurrentFile(archive_->file, &more, 1) != 0) fail("is longer than its header says");
  if (unzCloseCurrentFile(archive_->file) != UNZ_OK) fail("has a wrong checksum");
}

void NpzReader::fail(std::string_view problem) const {
  raise_io(path_, 0, fmt::format("the array '{}' {}", escape(name_), problem));
}

template bool NpzReader::read<std::int64_t>(std::vector<std::int64_t>&);
template bool NpzReader::read<double>(std::vector<double>&);

}  // namespace meshhood::io
