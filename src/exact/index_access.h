// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "meshhood/adjacency.h"
#include "meshhood/index.h"

#include "exact/build/edge_source.h"
#include "exact/layout.h"
#include "exact/weighted_graph.h"
#include "shared/parallel.h"

namespace meshhood::inline v0_1 {

/// Access to the arrays of an index, for `build`, for index files and for tests.
struct IndexAccess {
  [[nodiscard]] static Index make(std::shared_ptr<IndexView> view) { return Index(std::move(view)); }
  /// With the graph of another index that has the same edges, or with other paths.
  [[nodiscard]] static Index make(std::shared_ptr<IndexView> view, std::shared_ptr<KeptGraph> graph) {
    Index result(std::move(view));
    result.graph_ = std::move(graph);
    return result;
  }
  /// The same index, which must not be refitted in place.
  [[nodiscard]] static Index alias(const Index& index) {
    static_cast<void>(index.view());
    return make(index.view_.share(), index.graph_);
  }
  [[nodiscard]] static Index make(IndexData arrays) { return make(make_view(std::move(arrays))); }

  [[nodiscard]] static const IndexView& view(const Index& index) { return index.view(); }
  [[nodiscard]] static IndexView& changeable(Index& index) { return index.view(); }

  /// The view of an index without masks. `done`: what cannot be done with one that has some. Throws
  /// Error{InvalidOption}.
  [[nodiscard]] static const IndexView& whole(const Index& index, const char* done);

  /// Keeps the view alive, for `BoundIndex`.
  [[nodiscard]] static std::shared_ptr<const IndexView> share(const Index& index) {
    static_cast<void>(index.view());
    return index.view_.share();
  }

  /// The graph vertex by vertex, for the same.
  [[nodiscard]] static std::shared_ptr<KeptGraph> share_graph(const Index& index) { return index.graph_; }

  /// The number of steps of a build, for progress: those of `make_leaves`, links between nodes, and those of
  /// `make_geometry`.
  static constexpr std::size_t kBuildSteps = 7;

  /// The arrays of the index of a mesh. The caller reports the last step. Throws as `build`.
  [[nodiscard]] static IndexData build_arrays(const MeshView& mesh, TaskContext& task);

  /// The same from positions and edges, which must be valid.
  [[nodiscard]] static IndexData build_arrays(const PositionsView& positions, const EdgeSource& edges,
                                              TaskContext& task);
};

/// An index in the state in which a searcher was bound to it. Keeps its memory alive.
class BoundIndex {
 public:
  explicit BoundIndex(const Index& index) : view_(IndexAccess::share(index)), version_(view_->version) {}

  [[nodiscard]] const IndexView& operator*() const { return *view_; }
  [[nodiscard]] const IndexView* operator->() const { return view_.get(); }

  /// Whether `index` has this memory, so that scratch memory made for this fits, too.
  [[nodiscard]] bool is_of(const Index& index) const { return view_ == IndexAccess::share(index); }

  /// Throws Error{InvalidOption} if `refit_in_place` has changed the index since.
  void check_current() const {
    if (version_ != *view_->newest) raise_outdated();
  }

  [[noreturn]] static void raise_outdated();

 private:
  std::shared_ptr<const IndexView> view_;
  std::uint64_t version_;
};

/// As without `task`, but polls `task` for cancellation. Reports no progress. Throws Error{Cancelled}.
[[nodiscard]] GraphData extract_graph(const IndexView& index, TaskContext& task);
[[nodiscard]] Fingerprint fingerprint(const Index& index, TaskContext& task);

}  // namespace meshhood::inline v0_1
