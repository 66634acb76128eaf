// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "meshhood/adjacency.h"
#include "meshhood/export.h"
#include "meshhood/index.h"
#include "meshhood/mesh.h"
#include "meshhood/metric.h"
#include "meshhood/paper.h"
#include "meshhood/reference.h"
#include "meshhood/run.h"
#include "meshhood/search.h"

/// Finds many neighborhoods in one call, on all processors unless `Run` says otherwise.
///
///     const auto [offsets, ids, distances] = meshhood::neighborhoods(index, {.radius = 1.5}, {.distances = true});
namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

struct SearcherFactory;

/// The searcher of a `SearchMethod`; `std::visit` passes it to a callable.
using AnySearcher = std::variant<Searcher, paper::Searcher, ReferenceSearcher, BallSearcher>;

/// A way to find neighborhoods, chosen at run time. It makes searchers for single queries, and is the first argument of
/// a batch. It converts from either index. It borrows its arguments, which must outlive it and its searchers, and must
/// not be moved meanwhile. A copy is cheap. Any number of threads may use one.
class SearchMethod {
 public:
  /// Finds the exact neighborhoods (see `Searcher`).
  SearchMethod(const Index& index);
  SearchMethod(const Index&&) = delete;

  // A move copies, so that every method can be used.
  SearchMethod(const SearchMethod&) = default;
  SearchMethod& operator=(const SearchMethod&) = default;
  ~SearchMethod() = default;

  /// Finds the approximate neighborhoods of the paper (see `paper::Searcher`). Throws Error{InvalidOption}.
  SearchMethod(const paper::Index& index, const paper::QueryOptions& options = {});
  SearchMethod(const paper::Index&&, const paper::QueryOptions& = {}) = delete;

  /// Finds the exact neighborhoods without an index (see `ReferenceSearcher`). Each thread copies the positions and
  /// checks the graph, in O(#V + #E log(valence)). Throws Error{InvalidMesh, TooLarge} if the graph is invalid.
  [[nodiscard]] static SearchMethod breadth_first(const GraphView& graph);

  /// Returns the method of the same `Index` by a metric: `make_searcher` then makes a `Searcher` by it. In a batch, the
  /// metric of the query does this, unless it is `Straight`: then that of the method holds. Throws Error{InvalidOption}
  /// if the method is not the exact one of an `Index`, unless `metric` is `Straight`.
  [[nodiscard]] SearchMethod by(Metric metric) const;

  /// Finds the vertices in space without an index, by a scan of all vertices for each query (see `BallSearcher`). The
  /// coordinates must be valid.
  [[nodiscard]] static SearchMethod ball_scan(const PositionsView& positions);

  /// Returns #V.
  [[nodiscard]] std::size_t vertex_count() const;

  /// Makes a searcher of this method, of the type named above. Each thread needs its own. Throws as its constructor.
  [[nodiscard]] AnySearcher make_searcher() const;

  /// The batches use this.
  [[nodiscard]] const SearcherFactory& factory() const { return *factory_; }

 private:
  explicit SearchMethod(SearcherFactory&& factory);

  std::shared_ptr<const SearcherFactory> factory_;
};

/// The query vertices of a batch: all vertices of the mesh in order, or a borrowed list.
class BatchVertices {
 public:
  /// Takes all vertices, in order.
  BatchVertices() = default;

  /// Borrows `vertices` in [0, #V), in any order; repeats are allowed. The compiler rejects a temporary container.
  template <BorrowedArray<VertexId> Range>
  BatchVertices(Range&& vertices) : list_(std::span<const VertexId>(vertices)) {}

  /// Returns the list, or none if all vertices are meant.
  [[nodiscard]] const std::optional<std::span<const VertexId>>& list() const& { return list_; }
  [[nodiscard]] const std::optional<std::span<const VertexId>>& list() const&& = delete;

  /// Returns the number of rows for a mesh of `vertices` vertices.
  [[nodiscard]] std::size_t count(std::size_t vertices) const { return list_ ? list_->size() : vertices; }

  /// Returns the vertex of a row; `row` is less than `count`.
  [[nodiscard]] VertexId operator[](std::size_t row) const {
    return list_ ? (*list_)[row] : static_cast<VertexId>(row);
  }

 private:
  std::optional<std::span<const VertexId>> list_;
};

/// The radius of every row, or a borrowed list with one radius per row, or several radii for every row. Each is >= 0 or
/// infinite, in the unit of the positions.
class BatchRadius {
 public:
  /// Leaves the radius unset; every batch rejects that.
  BatchRadius() = default;

  /// Takes the same radius for every row.
  template <RadiusNumber Number>
  BatchRadius(Number radius) : common_(Radius(radius)) {}

  /// Borrows one radius per row. The compiler rejects a temporary container.
  template <BorrowedArray<double> Range>
  BatchRadius(Range&& radii) : list_(std::span<const double>(radii)) {}

  /// Takes one or more radii, in any order, each for all rows: the result then has a leading axis, radius after radius,
  /// and #rows stands for #radii by #rows. Calls that list neighborhoods throw Error{InvalidRadius}.
  [[nodiscard]] static BatchRadius scales(std::vector<double> radii) {
    BatchRadius result;
    result.scales_ = std::move(radii);
    return result;
  }

  /// Returns the radius of all rows, or NaN if there is a list or there are scales.
  [[nodiscard]] double common() const { return common_; }

  /// Returns the list, if there is one.
  [[nodiscard]] const std::optional<std::span<const double>>& list() const& { return list_; }
  [[nodiscard]] const std::optional<std::span<const double>>& list() const&& = delete;

  /// Returns the scales, if there are some.
  [[nodiscard]] const std::optional<std::vector<double>>& scales() const& { return scales_; }
  [[nodiscard]] const std::optional<std::vector<double>>& scales() const&& = delete;

 private:
  double common_ = std::numeric_limits<double>::quiet_NaN();
  std::optional<std::span<const double>> list_;
  std::optional<std::vector<double>> scales_;
};

/// The neighborhoods that a batch computes, one per row. The lists are copied when the call begins; later changes by
/// the caller, a callback or another thread have no effect.
struct BatchQuery {
  BatchVertices vertices = {};

  /// Required. A vertex at exactly the radius is inside.
  BatchRadius radius = {};

  /// An `Index` finds the neighborhoods by this metric, in which radii are measured. Other methods have their own, and
  /// take `Straight` alone.
  Metric metric = Metric::Straight;

  /// Returns the number of rows of a result for a mesh of `vertex_count` vertices: #radii by #rows if there are scales.
  /// Radii and ids are not checked. Throws Error{TooLarge} if an array cannot have `columns` doubles for each.
  [[nodiscard]] std::size_t result_rows(std::size_t vertex_count, std::size_t columns = 1) const;
};

/// The order of the vertices of a row, the same whatever the method, unless it is `None`.
enum class RowSort : std::uint8_t {
  None,      ///< as the method finds them (see `BatchOptions`)
  Id,        ///< ascending ids
  Distance,  ///< ascending distances, equal ones by id
};

/// What the rows of a batch have, and their order. A row depends on the index, its vertex and its radius alone, not on
/// the other rows. Unless they are sorted, the ids of an `Index` are in index order, ascending places of its
/// permutation, and by `Path` ascend by length; rows of other methods have the order of their searcher.
struct BatchOptions {
  bool distances = false;        ///< also compute the distance of each vertex (see `distance`)
  RowSort sort = RowSort::None;  ///< sorts each row; `Distance` needs `distances`, else Error{InvalidOption}

  /// `for_each_neighborhood` passes the rows in index order (see `Index::permutation`) instead of ascending. Near rows
  /// are then computed together whatever the order of the query, which is up to ten times as fast where the vertices of
  /// a mesh are numbered at random. Takes 12 bytes a row, and up to 50 while the rows are sorted. The other functions
  /// ignore it.
  bool in_index_order = false;

  /// About this many bytes of results may wait until earlier rows are done (`for_each_neighborhood`). A larger buffer
  /// lets more rows run in index order and keeps threads busy; a smaller one stays in the processor's cache.
  std::size_t buffer_bytes = std::size_t{8} << 20;
};

/// One neighborhood of a batch, valid during the call of the sink.
struct BatchRow {
  std::size_t row;                    ///< ascends from 0, unless `BatchOptions::in_index_order`
  std::span<const VertexId> ids;      ///< without duplicates; the query vertex included unless it is masked
  std::span<const double> distances;  ///< in the order of `ids`; empty unless `BatchOptions::distances`
};

using RowSink = std::function<void(const BatchRow&)>;

/// All rows in CSR form: row `i` has the ids `ids[offsets[i]] .. ids[offsets[i + 1] - 1]`, and the distances likewise.
struct Neighborhoods {
  std::vector<std::uint64_t> offsets;  ///< #rows + 1
  std::vector<VertexId> ids;
  std::vector<double> distances;  ///< empty unless `BatchOptions::distances`; always there from `discs`
};

/// Memory for the ids of all rows, and for as many distances if they are computed.
struct BatchMemory {
  std::span<VertexId> ids;
  std::span<double> distances = {};
};

/// Returns memory for `count` ids.
using BatchAllocator = std::function<BatchMemory(std::size_t count)>;

/// Passes each row to `sink`, in order, on the calling thread; the other threads wait meanwhile. Needs `buffer_bytes`
/// of memory, a copy of the query, and per thread a searcher and two rows.
///
/// All arguments are checked before the first row is computed. An exception from `sink` or `run.progress`, or a lack
/// of memory, ends the batch; it is passed on once all threads have stopped, and the method can be used again.
/// Throws Error{VertexOutOfRange, InvalidRadius, InvalidOption, Cancelled}, naming the row.
void for_each_neighborhood(const SearchMethod& method, const BatchQuery& query, const RowSink& sink,
                           const BatchOptions& options = {}, const Run& run = {});

/// Returns all rows. With an index they are counted first, so that memory is allocated once and exactly. What is found
/// of straight neighborhoods, in space and of rings is kept meanwhile, so that these rows are searched once. It takes
/// about as much memory as the ids at most, and is dropped if `max_bytes` is less than it and the result together. Rows
/// of paths and of `paper::Index` are searched twice. Without an index each row is searched once, and the result is
/// held twice. Throws as `for_each_neighborhood`, and Error{TooLarge} if ids and distances exceed `run.max_bytes`: at
/// once if a sample of the rows shows that they will not fit (with an index), else soon after the rows exceed it.
[[nodiscard]] Neighborhoods neighborhoods(const SearchMethod& method, const BatchQuery& query,
                                          const BatchOptions& options = {}, const Run& run = {});

/// Writes all rows into memory of the caller, and returns their offsets. `allocate` is called once, on the calling
/// thread, after the rows are counted. All of the memory is written unless the call throws. Exceptions of `allocate`
/// are passed on.
/// Throws as the overload above, and Error{InvalidOption} if the memory does not have the requested size.
[[nodiscard]] std::vector<std::uint64_t> neighborhoods(const SearchMethod& method, const BatchQuery& query,
                                                       const BatchAllocator& allocate, const BatchOptions& options = {},
                                                       const Run& run = {});

/// Returns the number of vertices of each row; #radii by #rows if there are scales. Throws as `for_each_neighborhood`.
/// Needs memory for the result, a copy of the query, 8 bytes a row of up to 2^22, and a search for each thread
/// (docs/joint.md).
[[nodiscard]] std::vector<std::uint64_t> counts(const SearchMethod& method, const BatchQuery& query,
                                                const Run& run = {});

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
