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

/// Gives access to the arrays of an index to `build`, to index files and to tests.
struct IndexAccess {
  [[nodiscard]] static Index make(std::shared_ptr<IndexView> view) { return Index(std::move(view)); }
  /// Makes an index with the graph of another that has the same edges, or with other paths.
  [[nodiscard]] static Index make(std::shared_ptr<IndexView> view, std::shared_ptr<KeptGraph> graph) {
    Index result(std::move(view));
    result.graph_ = std::move(graph);
    return result;
  }
  /// Returns the same index, which must not be refitted in place.
  [[nodiscard]] static Index alias(const Index& index) {
    static_cast<void>(index.view());
    return make(index.view_.share(), index.graph_);
  }
  [[nodiscard]] static Index make(IndexData arrays) { return make(make_view(std::move(arrays))); }

  [[nodiscard]] static const IndexView& view(const Index& index) { return index.view(); }
  [[nodiscard]] static IndexView& changeable(Index& index) { return index.view(); }

  /// Returns the view of an index without masks. Throws Error{InvalidOption} if it has some; `done` says what cannot be
  /// done then.
  [[nodiscard]] static const IndexView& whole(const Index& index, const char* done);

  /// Keeps the view alive, for `BoundIndex`.
  [[nodiscard]] static std::shared_ptr<const IndexView> share(const Index& index) {
    static_cast<void>(index.view());
    return index.view_.share();
  }

  /// Returns the graph vertex by vertex.
  [[nodiscard]] static std::shared_ptr<KeptGraph> share_graph(const Index& index) { return index.graph_; }

  /// The number of steps that a build reports: those of `make_leaves`, links between nodes, and those of
  /// `make_geometry`.
  static constexpr std::size_t kBuildSteps = 7;

  /// Makes the arrays of the index of a mesh. The caller reports the last step. Throws as `build`.
  [[nodiscard]] static IndexData build_arrays(const MeshView& mesh, TaskContext& task);

  /// Makes them from positions and edges, which must be valid.
  [[nodiscard]] static IndexData build_arrays(const PositionsView& positions, const EdgeSource& edges,
                                              TaskContext& task);
};

/// An index in the state in which a searcher was bound to it. Keeps its memory alive.
class BoundIndex {
 public:
  explicit BoundIndex(const Index& index) : view_(IndexAccess::share(index)), version_(view_->version) {}

  [[nodiscard]] const IndexView& operator*() const { return *view_; }
  [[nodiscard]] const IndexView* operator->() const { return view_.get(); }

  /// Returns whether `index` has this memory, so that scratch memory made for this fits, too.
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

/// Do the same as without `task`, but poll it for cancellation. They report no progress, and throw Error{Cancelled}.
[[nodiscard]] GraphData extract_graph(const IndexView& index, TaskContext& task);
[[nodiscard]] Fingerprint fingerprint(const Index& index, TaskContext& task);

}  // namespace meshhood::inline v0_1
