// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "aggregate/reducers.h"
#include "base/number_set.h"
#include "shared/distance.h"

namespace meshhood::inline v0_1 {
namespace {

/// Ranks each vertex by its value, so that the vertices of a packet are read in order without sorting them, once for
/// all of its rows.
struct Ranks {
  struct Channel {
    std::vector<std::uint32_t> ranks;  // by place; those of NaN are the last
    std::vector<double> values;        // by rank; no NaN
  };

  const NodeTree* tree;
  double quantile;
  bool propagates;  // NaN
  std::vector<Channel> channels;
};

std::vector<Ranks::Channel> rank(const std::vector<Column>& block) {
  std::vector<Ranks::Channel> channels;
  for (const Column& values : block) {
    std::vector<std::uint32_t> places(values.size() - kLeafCapacity);
    std::iota(places.begin(), places.end(), 0U);
    const auto numbers =
        std::partition(places.begin(), places.end(), [&](std::uint32_t place) { return !std::isnan(values[place]); });
    // Equal values are ordered by place, so that the sign of a zero depends on the row alone.
    std::sort(places.begin(), numbers,
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(values[a], a) < std::pair(values[b], b); });
    Ranks::Channel channel{std::vector<std::uint32_t>(places.size()), {}};
    for (std::uint32_t rank = 0; rank < places.size(); ++rank) channel.ranks[places[rank]] = rank;
    for (auto place = places.begin(); place != numbers; ++place) channel.values.push_back(values[*place]);
    channels.push_back(std::move(channel));
  }
  return channels;
}

/// The vertices of a packet in the order of their values, each with the word of its rows.
class OrderedRows {
 public:
  void clear() {
    ranks_.clear();
    words_.clear();
  }

  void add(std::size_t rank, QueryWord word) {
    ranks_.push_back(static_cast<std::uint32_t>(rank));
    words_.push_back(word);
  }

  /// Returns the number of vertices of a row. To be called before `place_of`.
  std::size_t count(std::size_t row) {
    words_.resize((ranks_.size() + kBlock - 1) / kBlock * kBlock);
    counts_.clear();
    std::size_t count = 0;
    for (std::size_t first = 0; first < words_.size(); first += kBlock) {
      std::uint32_t of_block = 0;
      for (std::size_t i = 0; i < kBlock; ++i) of_block += words_[first + i] >> row & 1U;
      counts_.push_back(of_block);
      count += of_block;
    }
    return count;
  }

  /// Returns the place of vertex number `n` of the row that was counted.
  [[nodiscard]] std::size_t place_of(std::size_t row, std::size_t n) const {
    std::size_t block = 0;
    for (; n >= counts_[block]; ++block) n -= counts_[block];
    return next(row, block * kBlock, n);
  }

  /// Returns the place of the row's vertex that has `n` others before it from `place` on.
  [[nodiscard]] std::size_t next(std::size_t row, std::size_t place, std::size_t n) const {
    for (;; ++place) {
      if ((words_[place] >> row & 1U) != 0 && n-- == 0) return place;
    }
  }

  [[nodiscard]] std::uint32_t rank(std::size_t place) const { return ranks_[place]; }

 private:
  static constexpr std::size_t kBlock = 64;  // blocks are counted without branches

  std::vector<std::uint32_t> ranks_;
  std::vector<QueryWord> words_;  // those after the last are 0
  std::vector<std::uint32_t> counts_;
};

class QuantileReducer final : public PacketReducer {
 public:
  explicit QuantileReducer(const Ranks& ranks)
      : of_all_(&ranks),
        results_(ranks.channels.size()),
        words_of_rank_(ranks.channels.front().ranks.size()),
        ranks_(words_of_rank_.size()) {}

  void begin(const PacketAnswer& packet) override {
    rows_ = packet.rows.size();
    parts_.clear();
    words_.clear();
    are_found_ = false;
  }

  void add_nodes(const NodeTree::Children& nodes, const QueryWord* queries) override {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (queries[k] == 0) continue;
      parts_.push_back({of_all_->tree->vertices(nodes.begin + static_cast<NodeTree::Node>(k)), queries[k], 0});
    }
  }

  void add_leaf(const VertexRange& vertices, const QueryWord* queries) override {
    parts_.push_back({vertices, 0, words_.size()});
    words_.insert(words_.end(), queries, queries + vertices.size());
  }

  void write(std::size_t row, std::span<double> channels) override {
    if (!are_found_) {
      for (std::size_t i = 0; i < channels.size(); ++i) find(of_all_->channels[i], results_[i]);
      are_found_ = true;
    }
    for (std::size_t i = 0; i < channels.size(); ++i) channels[i] = results_[i][row];
  }

 private:
  /// Vertices that belong to the rows of `word`, or, if that is 0, each to those of its own word.
  struct Part {
    VertexRange vertices;
    QueryWord word;
    std::size_t first;  // of `words_`
  };

  void find(const Ranks::Channel& channel, PerLane<double>& results) {
    for (const Part& part : parts_) {
      for (std::size_t k = 0; k < part.vertices.size(); ++k) {
        const QueryWord word = part.word != 0 ? part.word : words_[part.first + k];
        if (word == 0) continue;
        const std::uint32_t rank = channel.ranks[part.vertices.begin + k];
        words_of_rank_[rank] |= word;
        ranks_.insert(rank);
      }
    }
    QueryWord with_nan = 0;
    ordered_.clear();
    ranks_.take_all([&](std::size_t rank) {
      const QueryWord word = std::exchange(words_of_rank_[rank], 0);
      if (rank < channel.values.size()) return ordered_.add(rank, word);
      with_nan |= word;
    });
    for (std::size_t row = 0; row < rows_; ++row) {
      const bool is_nan = of_all_->propagates && (with_nan >> row & 1U) != 0;
      results[row] = is_nan ? kNan : result(channel, row);
    }
  }

  /// Interpolates linearly between two values, as NumPy does.
  double result(const Ranks::Channel& channel, std::size_t row) {
    const std::size_t count = ordered_.count(row);
    if (count == 0) return kNan;
    const double place = of_all_->quantile * static_cast<double>(count - 1);
    const double share = place - std::floor(place);
    const std::size_t at = ordered_.place_of(row, static_cast<std::size_t>(place));
    const double lower = channel.values[ordered_.rank(at)];
    if (share == 0) return lower;
    const double upper = channel.values[ordered_.rank(ordered_.next(row, at, 1))];
    return lower == upper ? lower : (1 - share) * lower + share * upper;
  }

  const Ranks* of_all_;
  std::size_t rows_ = 0;
  std::vector<Part> parts_;
  std::vector<QueryWord> words_;
  bool are_found_ = false;
  std::vector<PerLane<double>> results_;  // by channel
  std::vector<QueryWord> words_of_rank_;
  NumberSet ranks_;  // those of the packet
  OrderedRows ordered_;
};

}  // namespace

ReducerFactory quantile_reducers(const NodeTree& tree, SignalBlock block, double quantile, MissingValues missing) {
  return factory_of<QuantileReducer>(Ranks{&tree, quantile, missing == MissingValues::Propagate, rank(block.values())});
}

}  // namespace meshhood::inline v0_1
