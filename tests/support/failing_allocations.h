// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

/// Replaces every `operator new` of the program: counts the calls, and lets some fail. The operators call `malloc` and
/// `free`, so that sanitizers still see all allocations.
namespace meshhood::test {

enum class Shortage {
  Once,         ///< one allocation fails, later ones succeed
  FromThereOn,  ///< one fails, and all later ones
};

/// During its lifetime, allocation number `at` fails, counted from 0 over all threads. At most one object at a time.
class FailingAllocations {
 public:
  FailingAllocations(std::size_t at, Shortage shortage);
  ~FailingAllocations();
  FailingAllocations(const FailingAllocations&) = delete;
  FailingAllocations& operator=(const FailingAllocations&) = delete;

  /// Whether the allocation number was reached.
  [[nodiscard]] bool happened() const;

 private:
  std::size_t at_;
};

/// Blocks that were allocated and not yet freed.
[[nodiscard]] std::size_t blocks_in_use();

}  // namespace meshhood::test
