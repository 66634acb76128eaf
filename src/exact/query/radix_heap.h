// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace meshhood {

/// A priority queue for lengths that are never less than the one taken last: the radix heap of Ahuja, Mehlhorn, Orlin
/// and Tarjan (1990). `Item` has a member `length`, which is +0 or positive: the bits of such doubles ascend as their
/// values do.
///
/// The base is a length that no item is below. An item is in the bucket of the highest bit in which its length differs
/// from the base. So the items of a bucket are less than those of the next. When the lowest bucket has many items, the
/// least of them becomes the base, and all go to lower buckets: an item moves at most 63 times. If the bucket has few
/// items, the least is found without moving them: items pushed later are not less, so they belong to this bucket or a
/// higher one.
template <class Item>
class RadixHeap {
 public:
  void clear() {
    for (std::vector<Item>& bucket : buckets_) bucket.clear();
    occupied_ = 0;
    base_ = 0;
  }

  [[nodiscard]] bool empty() const { return occupied_ == 0; }

  void push(const Item& item) {
    const auto bucket = static_cast<unsigned>(std::bit_width(bits(item) ^ base_));
    buckets_[bucket].push_back(item);
    occupied_ |= std::uint64_t{1} << bucket;
  }

  /// Removes an item of the least length. The queue must not be empty.
  Item pop() {
    if (lowest() != 0 && buckets_[lowest()].size() > kFew) spread(buckets_[lowest()]);
    std::vector<Item>& bucket = buckets_[lowest()];
    const auto least = lowest() == 0 ? bucket.end() - 1 : least_of(bucket);  // those of bucket 0 are equal
    const Item item = *least;
    *least = bucket.back();
    bucket.pop_back();
    if (bucket.empty()) occupied_ &= occupied_ - 1;
    return item;
  }

 private:
  static constexpr std::size_t kFew = 16;

  static std::uint64_t bits(const Item& item) { return std::bit_cast<std::uint64_t>(item.length); }

  static auto least_of(std::vector<Item>& items) {
    return std::min_element(items.begin(), items.end(),
                            [](const Item& a, const Item& b) { return a.length < b.length; });
  }

  [[nodiscard]] std::size_t lowest() const { return static_cast<std::size_t>(std::countr_zero(occupied_)); }

  /// Moves the items of the lowest bucket to lower ones.
  void spread(std::vector<Item>& items) {
    base_ = bits(*least_of(items));
    occupied_ &= occupied_ - 1;
    for (const Item& item : items) push(item);
    items.clear();
  }

  std::array<std::vector<Item>, 64> buckets_;  // the sign, bit 63, is never set
  std::uint64_t occupied_ = 0;                 // bit i: bucket i has items
  std::uint64_t base_ = 0;
};

}  // namespace meshhood
