// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

/// Every `operator new` of the program, counted, with some of them failing on purpose. The program that links this has
/// operators that call `malloc` and `free`, so that a sanitizer goes on seeing all of them.
namespace meshhood::test {

enum class Shortage {
  Once,         ///< one allocation fails, and those after it are well again
  FromThereOn,  ///< one fails, and every one after it
};

/// Has allocation number `at` fail, counted from 0 over all threads, while it lives. One object at a time.
class FailingAllocations {
 public:
  FailingAllocations(std::size_t at, Shortage shortage);
  ~FailingAllocations();
  FailingAllocations(const FailingAllocations&) = delete;
  FailingAllocations& operator=(const FailingAllocations&) = delete;

  /// Whether there were so many that one has failed.
  [[nodiscard]] bool happened() const;

 private:
  std::size_t at_;
};

/// Blocks that were taken and not yet given back.
[[nodiscard]] std::size_t blocks_in_use();

}  // namespace meshhood::test
