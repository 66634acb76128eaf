// SPDX-License-Identifier: MIT
#include "io/byte_source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "io/messages.h"
#include "io/waiting.h"

namespace meshhood::inline v0_1::io {

std::size_t ByteSource::read(std::span<char> out) {
  constexpr std::size_t kMostAtOnce = std::size_t{4} << 20;
  report();
  const std::size_t count = take(out.first(std::min(out.size(), kMostAtOnce)));
  done_ += count;
  return count;
}

std::size_t ByteSource::fill(std::span<char> out) {
  std::size_t size = 0;
  while (size < out.size()) {
    const std::size_t count = read(out.subspan(size));
    if (count == 0) break;
    size += count;
  }
  return size;
}

void ByteSource::watch(const Progress& progress, std::string name) {
  progress_ = &progress;
  watched_name_ = std::move(name);
}

void ByteSource::report() const {
  if (progress_ == nullptr) return;
  const auto total = static_cast<std::size_t>(size().value_or(0));
  // The file may grow while it is read.
  const auto done = static_cast<std::size_t>(total == 0 ? done_ : std::min<std::uint64_t>(done_, total));
  io::report(*progress_, done, total, watched_name_);
}

void ByteSource::finish() {
  done_ = std::max(done_, size().value_or(0));
  report();
}

std::size_t MemorySource::take(std::span<char> out) {
  const std::size_t count = std::min(out.size(), left_.size());
  if (count != 0) std::memcpy(out.data(), left_.data(), count);
  left_ = left_.subspan(count);
  return count;
}

FileSource::FileSource(const std::filesystem::path& path) : path_(path), file_(open_to_read(path)) {
  const FileStatus status = status_of(file_, path);
  const bool is_file = status.kind == FileStatus::Kind::Regular;
  const bool is_standard_input = path == kStandardInput;
  is_regular_ = is_file && !is_standard_input;
  // A file of length 0 may still have content: /proc is full of them.
  if (is_file && status.size > 0) size_ = status.size;
  may_lack_a_writer_ = status.kind == FileStatus::Kind::Pipe && !is_standard_input;
  if (!is_standard_input) return;
  // Opened by another process, so that reading may wait, and perhaps read in part.
  may_block_ = !is_file;
  if (size_) *size_ -= std::min(*size_, static_cast<std::uint64_t>(position_of(file_)));
}

FileSource::FileSource(const std::filesystem::path& path, Descriptor file) : path_(path), file_(std::move(file)) {
  const FileStatus status = status_of(file_, path);
  is_regular_ = status.kind == FileStatus::Kind::Regular;
  size_ = status.size;
  if (!move_to(file_, 0)) raise_errno(path, errno);
}

std::string_view FileSource::peek(std::size_t count) {
  std::size_t size = peeked_.size();
  peeked_.resize(std::max(size, count));
  while (size < count) {
    const std::size_t more = read_file(std::span(peeked_).subspan(size));
    if (more == 0) break;
    size += more;
  }
  peeked_.resize(size);
  return std::string_view(peeked_).substr(0, count);
}

std::size_t FileSource::take(std::span<char> out) {
  if (peeked_.empty()) return read_file(out);
  const std::size_t count = std::min(out.size(), peeked_.size());
  std::copy_n(peeked_.begin(), count, out.begin());
  peeked_.erase(0, count);
  return count;
}

std::size_t FileSource::read_file(std::span<char> out) {
  for (;;) {
    if (may_block_) wait_for(file_, Ready::ToRead, kNoTimeout);
    const std::ptrdiff_t count = read_some(file_, out);
    if (count == 0 && std::exchange(may_lack_a_writer_, false)) {
      if (!wait_for(file_, Ready::ToRead, kPartnerTimeout))
        raise_io(path_, ETIMEDOUT, "no process writes to this pipe");
      continue;
    }
    if (count >= 0) {
      may_lack_a_writer_ = false;
      return static_cast<std::size_t>(count);
    }
    if (errno == EAGAIN) {
      wait_for(file_, Ready::ToRead, kNoTimeout);
    } else if (errno == EINTR) {
      report_wait();
    } else {
      raise_errno(path_, errno);
    }
  }
}

}  // namespace meshhood::inline v0_1::io
