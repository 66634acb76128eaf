// SPDX-License-Identifier: MIT
#include "io/byte_source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <poll.h>
#include <sys/stat.h>

#include "meshhood/error.h"

#include "io/place.h"

namespace meshhood::io {
namespace {

using Clock = std::chrono::steady_clock;

// A named pipe that nobody opens for writing is given up after this long.
constexpr auto kWriterPatience = std::chrono::seconds(2);

// A source that has nothing to read yet may get it at any time.
constexpr auto kAnyTime = Clock::duration::max();

constexpr auto kMoment = std::chrono::milliseconds(100);

}  // namespace

std::size_t MemorySource::read(std::span<char> out) {
  const std::size_t count = std::min(out.size(), left_.size());
  if (count != 0) std::memcpy(out.data(), left_.data(), count);
  left_ = left_.subspan(count);
  return count;
}

FileSource::FileSource(const std::filesystem::path& path)
    : name_(printable_name(path.string())), file_(open_to_read(path)) {
  struct stat status = {};
  if (!file_.is_open() || ::fstat(file_.number(), &status) != 0) fail(std::generic_category().message(errno));
  if (S_ISDIR(status.st_mode)) fail("is a directory, expected a file");
  is_ordinary_ = S_ISREG(status.st_mode);
  // A file of length 0 may still have content: /proc is full of them.
  if (is_ordinary_ && status.st_size > 0) size_ = static_cast<std::uint64_t>(status.st_size);
  may_lack_a_writer_ = S_ISFIFO(status.st_mode);
}

std::size_t FileSource::read(std::span<char> out) {
  for (;;) {
    const ssize_t count = ::read(file_.number(), out.data(), out.size());
    if (count == 0 && std::exchange(may_lack_a_writer_, false)) {
      if (!wait_for_bytes(kWriterPatience)) fail("nobody writes to this pipe");
      continue;
    }
    if (count >= 0) {
      may_lack_a_writer_ = false;
      return static_cast<std::size_t>(count);
    }
    if (errno == EAGAIN && wait_for_bytes(kAnyTime)) continue;
    if (errno != EINTR) fail(std::generic_category().message(errno));
  }
}

bool FileSource::wait_for_bytes(Clock::duration patience) const {
  pollfd waiting = {file_.number(), POLLIN, 0};
  const auto start = Clock::now();
  while (::poll(&waiting, 1, static_cast<int>(kMoment.count())) <= 0) {
    if (while_waiting_) while_waiting_();
    if (Clock::now() - start >= patience) return false;
  }
  return true;
}

void FileSource::fail(const std::string& reason) const { raise(ErrorCode::IoFailure, name_ + ": " + reason); }

}  // namespace meshhood::io
