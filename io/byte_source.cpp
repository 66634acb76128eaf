// SPDX-License-Identifier: MIT
#include "io/byte_source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <poll.h>
#include <sys/stat.h>

#include "io/messages.h"
#include "io/waiting.h"

namespace meshhood::io {
std::size_t MemorySource::read(std::span<char> out) {
  const std::size_t count = std::min(out.size(), left_.size());
  if (count != 0) std::memcpy(out.data(), left_.data(), count);
  left_ = left_.subspan(count);
  return count;
}

FileSource::FileSource(const std::filesystem::path& path) : path_(path), file_(open_to_read(path)) {
  const struct stat status = status_of(file_, path);
  const bool is_file = S_ISREG(status.st_mode);
  const bool is_standard_input = path == kStandardInput;
  is_regular_ = is_file && !is_standard_input;
  // A file of length 0 may still have content: /proc is full of them.
  if (is_file && status.st_size > 0) size_ = static_cast<std::uint64_t>(status.st_size);
  may_lack_a_writer_ = S_ISFIFO(status.st_mode) && !is_standard_input;
  if (!is_standard_input) return;
  // Opened by another process, without O_NONBLOCK, and perhaps read in part.
  may_block_ = !is_file;
  if (size_) *size_ -= std::min(*size_, static_cast<std::uint64_t>(::lseek(file_.number(), 0, SEEK_CUR)));
}

FileSource::FileSource(const std::filesystem::path& path, Descriptor file) : path_(path), file_(std::move(file)) {
  const struct stat status = status_of(file_, path);
  is_regular_ = S_ISREG(status.st_mode);
  size_ = static_cast<std::uint64_t>(status.st_size);
  if (::lseek(file_.number(), 0, SEEK_SET) < 0) raise_errno(path, errno);
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

std::size_t FileSource::read(std::span<char> out) {
  if (peeked_.empty()) return read_file(out);
  const std::size_t count = std::min(out.size(), peeked_.size());
  std::copy_n(peeked_.begin(), count, out.begin());
  peeked_.erase(0, count);
  return count;
}

std::size_t FileSource::read_file(std::span<char> out) {
  for (;;) {
    if (may_block_) wait_for(file_.number(), POLLIN, kNoTimeout);
    const ssize_t count = ::read(file_.number(), out.data(), out.size());
    if (count == 0 && std::exchange(may_lack_a_writer_, false)) {
      if (!wait_for(file_.number(), POLLIN, kPartnerTimeout))
        raise_io(path_, ETIMEDOUT, "no process writes to this pipe");
      continue;
    }
    if (count >= 0) {
      may_lack_a_writer_ = false;
      return static_cast<std::size_t>(count);
    }
    if (errno == EAGAIN) {
      wait_for(file_.number(), POLLIN, kNoTimeout);
    } else if (errno == EINTR) {
      report_wait();
    } else {
      raise_errno(path_, errno);
    }
  }
}

}  // namespace meshhood::io
