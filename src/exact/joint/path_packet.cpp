// SPDX-License-Identifier: MIT
#include "exact/joint/path_packet.h"

namespace meshhood::inline v0_1 {
namespace {

constexpr std::uint32_t kNoNumber = 0xFFFFFFFF;

constexpr PathLengths kReachedByNone = [] {
  PathLengths lengths{};
  lengths.fill(kInfinity);
  return lengths;
}();

// This replaces an infinite radius, so that no vertex without a path is within it.
constexpr double kLongest = std::numeric_limits<double>::max();

/// Sorts the vertices along the coordinate in which they differ most.
void sort_along_longest_axis(std::span<std::uint32_t> vertices, const PositionsInOrder& positions) {
  std::visit(
      [&](const auto& xyz) {
        const auto coordinate = [&](std::size_t axis) {
          return [&xyz, axis](std::uint32_t v) { return xyz[3 * std::size_t{v} + axis]; };
        };
        std::array<double, 3> extents{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto [least, most] = std::ranges::minmax_element(vertices, {}, coordinate(axis));
          extents[axis] = double{coordinate(axis)(*most)} - double{coordinate(axis)(*least)};
        }
        const auto longest = std::ranges::max_element(extents) - extents.begin();
        std::ranges::sort(vertices, {}, coordinate(static_cast<std::size_t>(longest)));
      },
      positions);
}

}  // namespace

PathPacket::PathPacket(const IndexView& index, KeptGraph& graph, Isa isa, const PathLimits& limits)
    : index_(&index),
      graph_(&graph.paths_of(index)),
      kernels_(&path_kernels(isa)),
      joint_kernels_(&joint_kernels(isa)),
      limits_(limits),
      search_(index, graph),
      numbers_(index.vertex_count(), kNoNumber),
      place_of_(index.leaf_count()),
      single_(kReachedByNone) {}

bool PathPacket::run(std::span<const PathQuery> queries) {
  begin(queries);
  is_single_ = false;
  std::array<std::uint32_t, kPacketCapacity> vertices{};
  double most = 0;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    vertices[i] = queries[i].vertex;
    most = std::max(most, queries[i].radius);
  }
  sort_along_longest_axis(std::span(vertices).first(queries.size()), index_->positions);
  std::array<Path, kPacketCapacity> starts{};
  std::ranges::transform(vertices, starts.begin(), [](std::uint32_t vertex) { return Path{0, vertex}; });
  const auto are_too_many = [this](std::span<const Path>) { return search_.found().size() > limits_.vertices; };
  search_.run(std::span<const Path>(starts).first(queries.size()), most, are_too_many);
  if (are_too_many({})) return false;
  list_edges();
  if (!pass_on_lengths()) return false;
  leave_out_ignored();
  return true;
}

void PathPacket::run_single(const PathQuery& query) {
  begin(std::span(&query, 1));
  is_single_ = true;
  search_.run(query.vertex, query.radius);
}

void PathPacket::begin(std::span<const PathQuery> queries) {
  assert(!queries.empty() && queries.size() <= kPacketCapacity);
  queries_.assign(queries.begin(), queries.end());
  leaves_.clear();
  steps_ = 0;
}

/// Returns the limits of the queries; no length is within that of a query that does not exist.
PathLengths PathPacket::limits() const {
  PathLengths limits{};
  limits.fill(-1);
  for (std::size_t i = 0; i < queries_.size(); ++i) limits[i] = std::min(queries_[i].radius, kLongest);
  return limits;
}

/// Numbers the vertices that were found, and lists the edges between them.
void PathPacket::list_edges() {
  const std::span<const Path> found = search_.found();
  const auto row = [&](std::uint32_t v) { return std::pair(graph_->edges->offsets[v], graph_->edges->offsets[v + 1]); };
  first_edge_.resize(found.size() + 1);
  std::size_t most = 1;
  for (const Path& path : found) most += row(path.end).second - row(path.end).first;
  if (edges_.size() < most) edges_.resize(most);
  // Nothing throws before the numbers are forgotten.
  for (std::size_t i = 0; i < found.size(); ++i) numbers_[found[i].end] = static_cast<std::uint32_t>(i);
  std::size_t count = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    first_edge_[i] = count;
    const auto [begin, end] = row(found[i].end);
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t number = numbers_[graph_->edges->neighbors[k]];
      edges_[count] = {graph_->lengths[k], number};
      count += number != kNoNumber ? 1 : 0;
    }
  }
  first_edge_[found.size()] = count;
  for (std::size_t i = 0; i < queries_.size(); ++i) starts_[i] = numbers_[queries_[i].vertex];
  for (const Path& path : found) numbers_[path.end] = kNoNumber;
}

/// Passes lengths on until none becomes shorter. Returns false if that takes too many steps.
bool PathPacket::pass_on_lengths() {
  constexpr std::size_t kAtOnce = 32;
  const std::span<const Path> found = search_.found();
  lengths_.assign(found.size(), kReachedByNone);
  waiting_.reset(found.size());
  for (std::size_t i = 0; i < queries_.size(); ++i) {
    if (starts_[i] == kNoNumber) continue;  // it is a wall
    lengths_[starts_[i]][i] = 0;
    waiting_.add(starts_[i]);
  }
  const std::size_t most = limits_.steps * found.size();
  waiting_.run([&](std::uint32_t number) {
    if (++steps_ > most) return;  // then the list becomes empty soon
    const std::size_t end = first_edge_[number + std::size_t{1}];
    for (std::size_t first = first_edge_[number]; first < end; first += kAtOnce) {
      const auto some = std::span<const PathEdge>(edges_).subspan(first, std::min(kAtOnce, end - first));
      const std::uint32_t shorter = kernels_->follow_edges(lengths_[number], some, lengths_.data());
      for_each_query(shorter, [&](std::size_t edge) { waiting_.add(some[edge].end); });
    }
  });
  return steps_ <= most;
}

/// Takes the ignored vertices out of what was found.
void PathPacket::leave_out_ignored() {
  if (index_->ignored.empty()) return;
  for (std::size_t number = 0; number < lengths_.size(); ++number) {
    if (index_->is_ignored_at(vertex(number))) lengths_[number] = kReachedByNone;
  }
}

PerLane<std::uint64_t> PathPacket::counts() {
  PerLane<std::uint64_t> counts{};
  if (is_single_) {
    for (const Path& path : search_.found()) counts[0] += index_->is_ignored_at(path.end) ? 0 : 1;
    return counts;
  }
  const PathLengths limits = this->limits();
  words_.resize(lengths_.size() / kLeafCapacity + 1);
  list_of_words_.clear();
  for (std::uint32_t i = 0; i < words_.size(); ++i) {
    joint_kernels_->clear_words(words_[i]);
    list_of_words_.push_back({i, 0});
  }
  for (std::size_t number = 0; number < lengths_.size(); ++number) {
    words_[number / kLeafCapacity].reached[number % kLeafCapacity] = kernels_->within_limits(lengths_[number], limits);
  }
  joint_kernels_->count_words(words_.data(), list_of_words_, counts);
  return counts;
}

std::span<const Path> PathPacket::paths_in_order(std::size_t query) {
  const auto [source, radius] = queries_[query];
  const std::span<const Path> found = search_.found();
  if (index_->is_wall_at(source)) return {};
  if (paths_.size() < found.size()) paths_.resize(found.size());
  std::size_t count = 0;
  // Whether a vertex is within the radius cannot be predicted, so there is no branch.
  for (std::size_t number = 0; number < found.size(); ++number) {
    const std::uint32_t end = vertex(number);
    const double length = is_single_ ? found[number].length : lengths_[number][query];
    const bool is_left_out = is_single_ && index_->is_ignored_at(end);
    paths_[count] = {length, end};
    count += static_cast<std::size_t>(length <= std::min(radius, kLongest)) & static_cast<std::size_t>(end != source) &
             static_cast<std::size_t>(!is_left_out);
  }
  const std::span<const Path> others = std::span(paths_).first(count);
  return index_->is_ignored_at(source) ? order_.sorted(others) : order_.sorted({0, source}, others);
}

std::span<const Piece> PathPacket::pieces() {
  list_leaves();
  pieces_.clear();
  reached_.resize(leaves_.size());
  const PathLengths limits = this->limits();
  for (const LeafPlaces& places : leaves_) {
    PerLane<QueryWord>& reached = reached_[pieces_.size()];
    reached = {};
    QueryWord any = 0;
    for_each_lane(places.lanes, [&](unsigned lane) {
      any |= reached[lane] = kernels_->within_limits(lengths_of(places.number[lane]), limits);
    });
    if (any != 0) pieces_.push_back({{places.leaf, places.leaf + 1}, 0, reached.data()});
  }
  return pieces_;
}

void PathPacket::select(LeafId leaf) {
  selected_ = &*std::ranges::lower_bound(leaves_, leaf, {}, &LeafPlaces::leaf);
  assert(selected_->leaf == leaf);
}

const PathLengths& PathPacket::at(unsigned lane) { return lengths_of(selected_->number[lane]); }

const PathLengths& PathPacket::lengths_of(std::uint32_t number) {
  if (!is_single_) return lengths_[number];
  single_[0] = search_.found()[number].length;
  return single_;
}

void PathPacket::list_leaves() {
  if (!leaves_.empty()) return;
  place_of_.forget();
  for (std::uint32_t number = 0; number < search_.found().size(); ++number) {
    const std::uint32_t slot = index_->slot_at(vertex(number));
    if (index_->is_ignored(slot)) continue;
    const LeafId leaf = leaf_of(slot);
    if (!place_of_.is_known(leaf)) {
      place_of_.set(leaf, static_cast<std::uint32_t>(leaves_.size()));
      leaves_.push_back({leaf, 0, {}});
    }
    LeafPlaces& places = leaves_[place_of_[leaf]];
    places.lanes |= LaneMask{1} << lane_of(slot);
    places.number[lane_of(slot)] = number;
  }
  std::ranges::sort(leaves_, {}, &LeafPlaces::leaf);
}

}  // namespace meshhood::inline v0_1
