// SPDX-License-Identifier: MIT
#include "parts/spill.h"

#include <algorithm>
#include <cerrno>
#include <utility>

#include <fmt/format.h>

#include "io/messages.h"
#include "io/system.h"

namespace meshhood::parts {

Spill::Spill(std::filesystem::path folder, std::string name, std::size_t lists, std::size_t buffer_bytes)
    : folder_(std::move(folder)),
      name_(std::move(name)),
      buffer_bytes_(std::max<std::size_t>(64, buffer_bytes / std::max<std::size_t>(1, lists))),
      buffers_(lists),
      sizes_(lists) {}

std::filesystem::path Spill::file(std::size_t list) const { return folder_ / fmt::format("{}-{}", name_, list); }

void Spill::append_bytes(std::size_t list, std::string_view bytes) {
  if (buffers_[list].size() + bytes.size() > buffer_bytes_) write(list);
  buffers_[list] += bytes;
  sizes_[list] += bytes.size();
}

void Spill::flush() {
  for (std::size_t list = 0; list < buffers_.size(); ++list) {
    write(list);
    std::string().swap(buffers_[list]);
  }
}

void Spill::write(std::size_t list) {
  if (buffers_[list].empty()) return;
  const std::filesystem::path path = file(list);
  io::Descriptor target = io::open_to_append(path);
  if (!target.is_open()) io::raise_errno(path, errno, "create");
  if (!io::write_all(target, buffers_[list])) io::raise_errno(path, errno, "write");
  if (!target.close()) io::raise_errno(path, errno, "close");
  buffers_[list].clear();
}

void SpillReader::fill() {
  buffer_.erase(0, taken_);
  taken_ = 0;
  const std::size_t kept = buffer_.size();
  const auto more = static_cast<std::size_t>(std::min<std::uint64_t>(left_, buffer_bytes_ - kept));
  if (more == 0) return;
  buffer_.resize(kept + more);
  RandomFile(path_).read(offset_, std::span(buffer_).subspan(kept));
  offset_ += more;
  left_ -= more;
}

}  // namespace meshhood::parts
