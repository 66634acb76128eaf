// SPDX-License-Identifier: MIT
#include "support/failing_allocations.h"

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>

namespace meshhood::test {
namespace {

constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

std::atomic<std::size_t> live_blocks{0};
std::atomic<std::size_t> requested{0};  // since the fault was set
std::atomic<std::size_t> first_to_fail{kNever};
std::atomic<std::size_t> last_to_fail{kNever};

bool is_to_fail() {
  const std::size_t number = requested.fetch_add(1, std::memory_order_relaxed);
  return number >= first_to_fail.load(std::memory_order_relaxed) &&
         number <= last_to_fail.load(std::memory_order_relaxed);
}

/// Null if there is no memory, or if this allocation shall fail.
void* take(std::size_t size, std::align_val_t alignment = std::align_val_t{__STDCPP_DEFAULT_NEW_ALIGNMENT__}) {
  if (is_to_fail()) return nullptr;
  const auto unit = static_cast<std::size_t>(alignment);
  // aligned_alloc needs a multiple of the alignment, and zero bytes must have an address of their own.
  void* const block = unit <= __STDCPP_DEFAULT_NEW_ALIGNMENT__
                          ? std::malloc(size == 0 ? 1 : size)
                          : std::aligned_alloc(unit, (size + unit - 1) / unit * unit);
  if (block != nullptr) live_blocks.fetch_add(1, std::memory_order_relaxed);
  return block;
}

template <class... Alignment>
void* take_or_throw(std::size_t size, Alignment... alignment) {
  void* const block = take(size, alignment...);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

void give_back(void* block) {
  if (block == nullptr) return;
  live_blocks.fetch_sub(1, std::memory_order_relaxed);
  std::free(block);
}

}  // namespace

FailingAllocations::FailingAllocations(std::size_t at, Shortage shortage) : at_(at) {
  requested = 0;
  last_to_fail = shortage == Shortage::Once ? at : kNever;
  first_to_fail = at;
}

FailingAllocations::~FailingAllocations() { first_to_fail = kNever; }

bool FailingAllocations::happened() const { return requested > at_; }

std::size_t blocks_in_use() { return live_blocks; }

}  // namespace meshhood::test

using meshhood::test::give_back;
using meshhood::test::take;
using meshhood::test::take_or_throw;

// All overloads: a library may bring its own of those that are missing.
void* operator new(std::size_t size) { return take_or_throw(size); }
void* operator new[](std::size_t size) { return take_or_throw(size); }
void* operator new(std::size_t size, std::align_val_t alignment) { return take_or_throw(size, alignment); }
void* operator new[](std::size_t size, std::align_val_t alignment) { return take_or_throw(size, alignment); }
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept { return take(size); }
void* operator new[](std::size_t size, const std::nothrow_t& /*tag*/) noexcept { return take(size); }
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t& /*tag*/) noexcept {
  return take(size, alignment);
}
void* operator new[](std::size_t size, std::align_val_t alignment, const std::nothrow_t& /*tag*/) noexcept {
  return take(size, alignment);
}

void operator delete(void* block) noexcept { give_back(block); }
void operator delete[](void* block) noexcept { give_back(block); }
void operator delete(void* block, std::size_t /*size*/) noexcept { give_back(block); }
void operator delete[](void* block, std::size_t /*size*/) noexcept { give_back(block); }
void operator delete(void* block, std::align_val_t /*alignment*/) noexcept { give_back(block); }
void operator delete[](void* block, std::align_val_t /*alignment*/) noexcept { give_back(block); }
void operator delete(void* block, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept { give_back(block); }
void operator delete[](void* block, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept { give_back(block); }
void operator delete(void* block, const std::nothrow_t& /*tag*/) noexcept { give_back(block); }
void operator delete[](void* block, const std::nothrow_t& /*tag*/) noexcept { give_back(block); }
void operator delete(void* block, std::align_val_t /*alignment*/, const std::nothrow_t& /*tag*/) noexcept {
  give_back(block);
}
void operator delete[](void* block, std::align_val_t /*alignment*/, const std::nothrow_t& /*tag*/) noexcept {
  give_back(block);
}
