// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "meshhood/batch.h"
#include "meshhood/searcher.h"

namespace meshhood::wasm {

/// The numbers are part of the interface with JavaScript. `Path` is the exact search by the metric of the paths.
enum class MethodName : std::uint8_t { Exact, Paper, Bfs, Ball, Path };

inline constexpr std::size_t kMethodCount = 5;

/// A method of search: single queries, and batches. As for all searchers, a vertex at exactly the radius is inside.
class Method {
 public:
  /// `batches` is the method of the batches.
  explicit Method(SearchMethod batches) : batches_(std::move(batches)) {}
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;
  virtual ~Method() = default;

  /// Replaces `ids`, and `distances` unless it is null. Throws Error{VertexOutOfRange, InvalidRadius}.
  virtual void neighborhood(VertexId v, double radius, std::vector<VertexId>& ids, std::vector<double>* distances) = 0;

  /// The number of these ids.
  [[nodiscard]] virtual std::size_t count(VertexId v, double radius) = 0;

  [[nodiscard]] const SearchMethod& batches() const { return batches_; }

 private:
  SearchMethod batches_;
};

template <NeighborhoodSearcher S>
class MethodOf final : public Method {
 public:
  MethodOf(S searcher, SearchMethod batches) : Method(std::move(batches)), searcher_(std::move(searcher)) {}

  void neighborhood(VertexId v, double radius, std::vector<VertexId>& ids, std::vector<double>* distances) override {
    if (distances != nullptr) {
      searcher_.neighborhood(v, radius, ids, *distances);
    } else {
      searcher_.neighborhood(v, radius, ids);
    }
  }

  [[nodiscard]] std::size_t count(VertexId v, double radius) override { return searcher_.count(v, radius); }

 private:
  S searcher_;
};

/// A method whose single queries are those of `searcher`.
template <NeighborhoodSearcher S>
std::unique_ptr<Method> make_method(S searcher, SearchMethod batches) {
  return std::make_unique<MethodOf<S>>(std::move(searcher), std::move(batches));
}

}  // namespace meshhood::wasm
