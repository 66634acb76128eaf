// SPDX-License-Identifier: MIT
#include "io/watched_source.h"

#include <algorithm>
#include <utility>

#include "io/messages.h"

namespace meshhood::inline v0_1::io {
namespace {

constexpr std::size_t kMostAtOnce = std::size_t{4} << 20;

}  // namespace

WatchedSource::WatchedSource(ByteSource& source, const Progress& progress, std::string name)
    : source_(source), progress_(progress), file_(std::move(name)) {}

std::size_t WatchedSource::read(std::span<char> out) {
  report();
  const std::size_t count = source_.read(out.first(std::min(out.size(), kMostAtOnce)));
  done_ += count;
  return count;
}

void WatchedSource::report() const {
  const auto total = static_cast<std::size_t>(size().value_or(0));
  // The file may grow while it is read.
  const auto done = static_cast<std::size_t>(total == 0 ? done_ : std::min<std::uint64_t>(done_, total));
  io::report(progress_, done, total, file_);
}

void WatchedSource::finish() {
  done_ = std::max(done_, size().value_or(0));
  report();
}

}  // namespace meshhood::inline v0_1::io
