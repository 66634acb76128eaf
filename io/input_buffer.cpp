// SPDX-License-Identifier: MIT
#include "io/input_buffer.h"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/messages.h"

namespace meshhood::inline v0_1::io {
namespace {

constexpr std::size_t kWindow = std::size_t{1} << 20;

[[noreturn]] void refuse_size(const std::string& name, std::uint64_t max_bytes) {
  raise(ErrorCode::TooLarge, fmt::format("{}: larger than the limit of {} bytes", name, max_bytes));
}

}  // namespace

InputBuffer::InputBuffer(ByteSource& source, const std::string& name, std::uint64_t max_bytes)
    : source_(source), name_(printable_name(name)), max_bytes_(max_bytes) {
  if (source.size().value_or(0) > max_bytes) refuse_size(name_, max_bytes);
}

std::optional<std::uint64_t> InputBuffer::left() const {
  const auto size = source_.size();
  if (!size) return std::nullopt;
  return *size - offset_;
}

void InputBuffer::fill(std::size_t count) {
  make_room(count);
  while (end_ - begin_ < count && !exhausted_) read_more();
}

void InputBuffer::make_room(std::size_t count) {
  if (capacity_ - begin_ >= count) return;
  if (count <= capacity_) {
    std::memmove(buffer_.get(), buffer_.get() + begin_, end_ - begin_);
  } else {
    const std::size_t capacity = std::max({kWindow, 2 * capacity_, count});
    // Not initialized, so that unused pages take no memory. NOLINTNEXTLINE(modernize-avoid-c-arrays)
    auto wider = std::make_unique_for_overwrite<char[]>(capacity);
    if (end_ != begin_) std::memcpy(wider.get(), buffer_.get() + begin_, end_ - begin_);
    buffer_ = std::move(wider);
    capacity_ = capacity;
  }
  end_ -= begin_;
  begin_ = 0;
}

void InputBuffer::read_more() {
  // Of a file that grows while it is read, only the bytes that were there at the opening are read.
  const auto size = source_.size();
  const std::uint64_t expected = size ? *size - offset_ - (end_ - begin_) : capacity_;
  const auto room = static_cast<std::size_t>(std::min<std::uint64_t>(capacity_ - end_, expected));
  const std::size_t count = room == 0 ? 0 : source_.read(std::span(buffer_.get() + end_, room));
  end_ += count;
  exhausted_ = count == 0;
  const std::uint64_t reached = offset_ + (end_ - begin_);
  if (reached > max_bytes_) refuse_size(name_, max_bytes_);
  if (size && exhausted_ && reached < *size) {
    raise(ErrorCode::IoFailure,
          fmt::format("{}@{}: the file ends here, but had {} bytes when opened", name_, reached, *size));
  }
}

}  // namespace meshhood::inline v0_1::io
