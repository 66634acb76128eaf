// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "io/readers.h"
#include "io/text.h"
#include "shared/parallel.h"

namespace meshhood::io {

/// The place of the first row that begins at `place` or later: after a line end, or at the end of `text`.
[[nodiscard]] inline std::size_t next_line_of(std::string_view text, std::size_t place) {
  const auto end = text.find('\n', place);
  return end == std::string_view::npos ? text.size() : end + 1;
}

/// Takes rows in the form that nearly all files have from the front of a text, in blocks that threads parse together.
/// It stops at the first row that is not *plain*. The reader of the format reads that row; it decides what a file means
/// and what is wrong with it. A plain row must mean the same to both.
///
/// `Rows` are the rows of a block:
///
///     static constexpr std::uint64_t kLines;        // of a row
///     static std::size_t split(text, place);        // where a row begins, at `place` or later; may be wrong
///     const char* take(const char* row, const char* end);
///                                                   // the end of the row, or null, without a trace, if it is not
///                                                   plain
///     std::size_t size() const;
///     void clear();
template <class Rows>
class PlainRows {
 public:
  /// empty   what blocks begin with.
  PlainRows(Text& text, const ReaderOptions& options, Rows empty)
      : text_(text), empty_(std::move(empty)), block_bytes_(options.block_bytes), task_(options.threads, kSilent, 0) {}

  /// Passes plain rows to `append`, up to `most` of them. If it refuses rows by false, the reader reads the rest of
  /// their block.
  template <class Append>
  void take(std::uint64_t most, Append&& append) {
    while (most != 0 && text_.at_line_end()) {
      text_.finish_line();
      Block* const block = block_at(text_.input().offset(), most);
      if (block == nullptr || block->rows.size() == 0) return;
      if (!append(std::as_const(block->rows))) {
        block->is_refused = true;
        return;
      }
      most -= block->rows.size();
      block->begin += block->taken;
      text_.skip_lines(block->taken, Rows::kLines * block->rows.size());
      block->is_parsed = false;
      if (block->begin != block->end) return;
    }
  }

 private:
  /// Of the file, from one byte to another.
  struct Block {
    std::uint64_t begin;
    std::uint64_t end;
    Rows rows;
    std::size_t taken = 0;  // bytes of the rows
    bool is_parsed = false;
    bool is_refused = false;
  };

  static inline const Progress kSilent;  // the source of the text reports
  static constexpr std::size_t kBlocks = 32;

  /// The block at this place, with the rows that begin there; null if the reader must read on alone.
  Block* block_at(std::uint64_t place, std::uint64_t most) {
    while (front_ < used_ && blocks_[front_].end <= place) ++front_;
    if (front_ == used_ && !parse_window(most)) return nullptr;
    Block& block = blocks_[front_];
    if (block.is_refused) return nullptr;
    if (!block.is_parsed || block.begin != place || block.rows.size() > most) {
      block.begin = place;
      parse(block, text_.input().ahead(static_cast<std::size_t>(block.end - place)), most);
    }
    return &block;
  }

  bool parse_window(std::uint64_t most) {
    front_ = used_ = 0;
    const std::uint64_t offset = text_.input().offset();
    if (block_bytes_ == 0 || offset < searched_) return false;
    auto window = text_.input().ahead(kBlocks * block_bytes_);
    searched_ = offset + window.size();
    window = window.substr(0, window.rfind('\n') + 1);
    for (std::size_t begin = 0; begin != window.size();) {
      const std::size_t end = Rows::split(window, std::min(begin + block_bytes_, window.size()) - 1);
      if (used_ == blocks_.size()) blocks_.push_back({0, 0, empty_});
      Block& block = blocks_[used_++];
      block.begin = offset + begin;
      block.end = offset + end;
      block.is_refused = false;
      begin = end;
    }
    task_.parallel_for(used_, 1, [&](unsigned /*thread*/, std::size_t i, std::size_t /*end*/) {
      parse(blocks_[i], window.substr(static_cast<std::size_t>(blocks_[i].begin - offset)), most);
    });
    return used_ != 0;
  }

  static void parse(Block& block, std::string_view text, std::uint64_t most) {
    block.rows.clear();
    const char* at = text.data();
    const char* const end = at + static_cast<std::size_t>(block.end - block.begin);
    while (at != end && block.rows.size() < most) {
      const char* const next = block.rows.take(at, end);
      if (next == nullptr) break;
      at = next;
    }
    block.taken = static_cast<std::size_t>(at - text.data());
    block.is_parsed = true;
  }

  Text& text_;
  Rows empty_;
  std::size_t block_bytes_;
  TaskContext task_;
  std::vector<Block> blocks_;  // of the last window; the first `used_` of them, of which those before `front_` are over
  std::size_t used_ = 0;
  std::size_t front_ = 0;
  std::uint64_t searched_ = 0;  // blocks have all line ends before this byte; without it, CR as line end is quadratic
};

}  // namespace meshhood::io
