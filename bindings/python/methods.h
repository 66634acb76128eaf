// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <utility>
#include <variant>

#include "meshhood/batch.h"
#include "meshhood/index.h"
#include "meshhood/search.h"

#include "pool.h"

namespace meshhood::python {

/// A method of the core with what it borrows. Any number of threads may use it at the same time.
class Method {
 public:
  /// `owner` owns what `search` borrows.
  Method(const SearchMethod& search, std::shared_ptr<const void> owner) : owner_(std::move(owner)), search_(search) {}
  Method(const Method&) = delete;
  Method& operator=(const Method&) = delete;

  [[nodiscard]] const SearchMethod& search() const { return search_; }

  /// Calls `f` with a searcher that no other thread uses. Called with the interpreter lock, which is released
  /// meanwhile.
  template <class F>
  auto with_searcher(F&& f) {
    return with_any([&](AnySearcher& searcher) { return std::visit(f, searcher); });
  }

  /// The same of an exact method, by any metric.
  template <class F>
  auto with_exact_searcher(F&& f) {
    return with_any([&](AnySearcher& searcher) { return f(std::get<Searcher>(searcher)); });
  }

 private:
  template <class F>
  auto with_any(F&& f) {
    return searchers_.with([this] { return search_.make_searcher(); }, std::forward<F>(f));
  }

  std::shared_ptr<const void> owner_;
  SearchMethod search_;
  Pool<AnySearcher> searchers_;
};

/// The exact neighborhood by the index, and the calls that only the index has.
class ExactMethod : public Method {
 public:
  explicit ExactMethod(std::shared_ptr<const Index> index) : Method(*index, index), index_(std::move(index)) {}

  [[nodiscard]] const Index& index() const { return *index_; }

 private:
  std::shared_ptr<const Index> index_;
};

[[nodiscard]] inline std::shared_ptr<ExactMethod> exact_method(Index index) {
  return std::make_shared<ExactMethod>(std::make_shared<const Index>(std::move(index)));
}

}  // namespace meshhood::python
