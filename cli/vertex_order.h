// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "meshhood/mesh.h"

#include "input.h"
#include "names.h"

/// The order of the vertices of an answer.
namespace meshhood::cli {

/// Of equal distances, the smaller id comes first.
enum class VertexOrder { Id, Index, Distance };

inline constexpr Names<VertexOrder, 3> kVertexOrders{
    {{"id", VertexOrder::Id}, {"index", VertexOrder::Index}, {"distance", VertexOrder::Distance}}};

/// --sort.
void add_sort(CLI::App& command, std::string& sort);

/// Throws Error{InvalidOption} if `method` has no index order.
void check_sort(const std::string& sort, const std::string& method);

/// Puts answers into an order.
class VertexSorter {
 public:
  /// `sort` as typed. The input must have edges if it is "index".
  VertexSorter(const std::string& sort, Input& input);

  [[nodiscard]] bool needs_distances() const { return order_ == VertexOrder::Distance; }

  /// Sorts `ids`, and with them `distances`, which may be empty unless they are needed.
  void sort(std::span<VertexId> ids, std::span<double> distances);

 private:
  struct Item {
    double key;
    VertexId id;
    double distance;
  };

  VertexOrder order_;
  std::vector<std::uint32_t> places_;  // of each vertex, if it is the index order
  std::vector<Item> items_;            // of one call
};

}  // namespace meshhood::cli
