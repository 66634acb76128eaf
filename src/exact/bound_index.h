// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "exact/index_access.h"
#include "exact/layout.h"

namespace meshhood::inline v0_1 {

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

}  // namespace meshhood::inline v0_1
