// SPDX-License-Identifier: MIT
#include "parts/spill.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <utility>

#include <fmt/format.h>

#include "io/messages.h"
#include "io/system.h"

namespace meshhood::parts {

Spill::Spill(std::filesystem::path folder, std::string name, std::size_t lists, std::size_t buffer_bytes)
    : folder_(std::move(folder)),
      name_(std::move(name)),
      buffer_words_(std::max<std::size_t>(8, buffer_bytes / sizeof(std::uint64_t) / std::max<std::size_t>(1, lists))),
      buffers_(lists),
      sizes_(lists) {}

std::filesystem::path Spill::file(std::size_t list) const { return folder_ / fmt::format("{}-{}", name_, list); }

void Spill::append(std::size_t list, std::span<const std::uint64_t> words) {
  std::vector<std::uint64_t>& buffer = buffers_[list];
  if (buffer.size() + words.size() > buffer_words_) write(list);
  buffer.insert(buffer.end(), words.begin(), words.end());
  sizes_[list] += words.size();
}

void Spill::flush() {
  for (std::size_t list = 0; list < buffers_.size(); ++list) {
    write(list);
    std::vector<std::uint64_t>().swap(buffers_[list]);
  }
}

void Spill::write(std::size_t list) {
  std::vector<std::uint64_t>& buffer = buffers_[list];
  if (buffer.empty()) return;
  const std::filesystem::path path = file(list);
  io::Descriptor target = io::open_to_append(path);
  if (!target.is_open()) io::raise_errno(path, errno, "create");
  const auto bytes = std::as_bytes(std::span(buffer));
  if (!io::write_all(target, {reinterpret_cast<const char*>(bytes.data()), bytes.size()})) {
    io::raise_errno(path, errno, "write");
  }
  if (!target.close()) io::raise_errno(path, errno, "close");
  buffer.clear();
}

std::span<const std::uint64_t> SpillReader::next(std::size_t count) {
  if (buffer_.size() - taken_ < count) fill();
  if (buffer_.size() == taken_) return {};
  assert(buffer_.size() - taken_ >= count);
  const auto words = std::span(buffer_).subspan(taken_, count);
  taken_ += count;
  return words;
}

void SpillReader::fill() {
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(taken_));
  taken_ = 0;
  const std::size_t kept = buffer_.size();
  const auto more = static_cast<std::size_t>(std::min<std::uint64_t>(left_, buffer_words_ - kept));
  if (more == 0) return;
  buffer_.resize(kept + more);
  const auto room = std::span(buffer_).subspan(kept);
  RandomFile(path_).read(offset_ * sizeof(std::uint64_t), {reinterpret_cast<char*>(room.data()), room.size_bytes()});
  offset_ += more;
  left_ -= more;
}

}  // namespace meshhood::parts
