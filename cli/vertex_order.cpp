// SPDX-License-Identifier: MIT
#include "vertex_order.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "meshhood/error.h"

#include "options.h"

namespace meshhood::cli {

void add_sort(CLI::App& command, std::string& sort) {
  add_choice(command, "--sort",
             "order of the vertices of an answer: id, index (that of the index, the fastest) or distance, then id",
             names_of(kVertexOrders), sort);
}

void check_sort(const std::string& sort, const std::string& method) {
  if (sort != "index" || method == "exact") return;
  raise(ErrorCode::InvalidOption, "--sort index: expected --method exact");
}

VertexSorter::VertexSorter(const std::string& sort, Input& input) : order_(value_of(kVertexOrders, sort)) {
  if (order_ != VertexOrder::Index) return;
  places_.resize(input.vertex_count());
  const std::span<const VertexId> permutation = input.exact_index().permutation();
  std::iota(places_.begin(), places_.end(), 0U);
  for (std::size_t i = 0; i < permutation.size(); ++i) places_[permutation[i]] = static_cast<std::uint32_t>(i);
}

void VertexSorter::sort(std::span<VertexId> ids, std::span<double> distances) {
  items_.clear();
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const double distance = distances.empty() ? 0 : distances[i];
    const double key = order_ == VertexOrder::Distance ? distance : order_ == VertexOrder::Index ? places_[ids[i]] : 0;
    items_.push_back({key, ids[i], distance});
  }
  std::sort(items_.begin(), items_.end(),
            [](const Item& a, const Item& b) { return std::tie(a.key, a.id) < std::tie(b.key, b.id); });
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = items_[i].id;
  for (std::size_t i = 0; i < distances.size(); ++i) distances[i] = items_[i].distance;
}

}  // namespace meshhood::cli
