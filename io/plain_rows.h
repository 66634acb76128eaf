// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "io/mesh_builder.h"
#include "io/readers.h"
#include "io/text.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1::io {

/// Takes rows in the form that nearly all files have from the front of a text, in blocks that threads parse together.
/// It stops at the first row that is not *plain*. The reader of the format reads that row; it decides what a file means
/// and what is wrong with it. A plain row must mean the same to both.
///
/// `Row` is the form of a row:
///
///     static constexpr std::uint64_t kLines;           // of a row
///     static constexpr std::string_view kInLastLine;   // of the row: what is in no other
///     const char* take(const char* at, const char* end, PlainBlock<Real>& block) const;
///                                                      // appends a row; its end, or null if it is not plain,
///                                                      // without a face that has ended
template <class Real, class Row>
class PlainRows {
 public:
  /// is_open   whether to find out if float keeps the coordinates.
  PlainRows(Text& text, const ReaderOptions& options, const Row& row, bool is_open = false)
      : text_(text),
        row_(row),
        is_open_(is_open),
        block_bytes_(options.block_bytes),
        task_(options.threads, kSilent, 0) {}

  /// Passes plain rows to `append`, up to `most` of them. If it refuses rows by false, the reader reads the rest of
  /// their block.
  template <class Append>
  void take(std::uint64_t most, Append&& append) {
    while (most != 0 && text_.at_line_end()) {
      text_.finish_line();
      Block* const block = block_at(text_.input().offset(), most);
      if (block == nullptr || block->content.rows == 0) return;
      if (!append(std::as_const(block->content))) {
        block->is_refused = true;
        return;
      }
      most -= block->content.rows;
      block->begin += block->taken;
      text_.skip_lines(block->taken, Row::kLines * block->content.rows);
      block->is_parsed = false;
      if (block->begin != block->end) return;
    }
  }

 private:
  /// Of the file, from one byte to another.
  struct Block {
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
    PlainBlock<Real> content;
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
    if (!block.is_parsed || block.begin != place || block.content.rows > most) {
      block.begin = place;
      parse(block, text_.input().ahead(static_cast<std::size_t>(block.end - place)), most);
    }
    return &block;
  }

  /// What a row that is not plain may have changed.
  struct Extent {
    std::size_t scalars;
    std::size_t corners;
    bool float_keeps;
    std::size_t most_missing;
  };

  static Extent extent(PlainBlock<Real>& block) {
    return {block.positions.size(), block.faces.corners().size(), block.float_keeps, block.most_missing};
  }

  static void cut(PlainBlock<Real>& block, const Extent& extent) {
    block.positions.resize(extent.scalars);
    block.faces.corners().resize(extent.corners);
    block.float_keeps = extent.float_keeps;
    block.most_missing = extent.most_missing;
  }

  /// Where a row probably begins, at `place` or later.
  static std::size_t next_row(std::string_view text, std::size_t place) {
    const auto end = text.find('\n', text.find(Row::kInLastLine, place));
    return end == std::string_view::npos ? text.size() : end + 1;
  }

  bool parse_window(std::uint64_t most) {
    front_ = used_ = 0;
    const std::uint64_t offset = text_.input().offset();
    if (block_bytes_ == 0 || offset < searched_) return false;
    auto window = text_.input().ahead(kBlocks * block_bytes_);
    searched_ = offset + window.size();
    window = window.substr(0, window.rfind('\n') + 1);
    for (std::size_t begin = 0; begin != window.size();) {
      const std::size_t end = next_row(window, std::min(begin + block_bytes_, window.size()) - 1);
      if (used_ == blocks_.size()) blocks_.emplace_back();
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

  void parse(Block& block, std::string_view text, std::uint64_t most) const {
    PlainBlock<Real>& content = block.content;
    content.rows = 0;
    content.faces.clear();
    cut(content, {.scalars = 0, .corners = 0, .float_keeps = is_open_, .most_missing = 0});
    const char* at = text.data();
    const char* const end = at + static_cast<std::size_t>(block.end - block.begin);
    while (at != end && content.rows < most) {
      const Extent before = extent(content);
      const char* const next = row_.take(at, end, content);
      if (next == nullptr) {
        cut(content, before);
        break;
      }
      ++content.rows;
      at = next;
    }
    block.taken = static_cast<std::size_t>(at - text.data());
    block.is_parsed = true;
  }

  Text& text_;
  Row row_;
  bool is_open_;
  std::size_t block_bytes_;
  TaskContext task_;
  std::vector<Block> blocks_;  // of the last window; the first `used_` of them, of which those before `front_` are over
  std::size_t used_ = 0;
  std::size_t front_ = 0;
  std::uint64_t searched_ = 0;  // blocks have all line ends before this byte; without it, CR as line end is quadratic
};

}  // namespace meshhood::inline v0_1::io
