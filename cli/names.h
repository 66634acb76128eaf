// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace meshhood::cli {

/// The values of an enumeration and their names on the command line.
template <class T, std::size_t Size>
using Names = std::array<std::pair<std::string_view, T>, Size>;

/// The names, in their order.
template <class T, std::size_t Size>
[[nodiscard]] std::vector<std::string> names_of(const Names<T, Size>& names) {
  std::vector<std::string> result;
  for (const auto& [name, value] : names) result.emplace_back(name);
  return result;
}

/// The name of a value, which is one of `names`.
template <class T, std::size_t Size>
[[nodiscard]] std::string_view name_of(const Names<T, Size>& names, T value) {
  for (const auto& [name, known] : names) {
    if (known == value) return name;
  }
  return names.front().first;
}

/// The value of a name, which is one of `names`.
template <class T, std::size_t Size>
[[nodiscard]] T value_of(const Names<T, Size>& names, std::string_view name) {
  for (const auto& [known, value] : names) {
    if (known == name) return value;
  }
  return names.front().second;
}

}  // namespace meshhood::cli
