// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>

/// Reads JSON without a tree of values. The tree of nlohmann_json allocates memory in its destructor, so the
/// process would end if memory ran out there.
namespace meshhood::parts {

/// The values of a document by their path: "plan/vertices", "parts/0/owned".
///
/// All functions throw Error{MalformedIndex}, which names the path, if there is no value of the type.
class JsonValues {
 public:
  /// Throws Error{MalformedIndex} if `text` is no JSON, or has more than eight levels.
  explicit JsonValues(std::string_view text);

  /// A whole number >= 0.
  [[nodiscard]] std::uint64_t count(const std::string& path) const;

  [[nodiscard]] double number(const std::string& path) const;
  [[nodiscard]] const std::string& text(const std::string& path) const;

  /// The number of elements of an array.
  [[nodiscard]] std::size_t size(const std::string& path) const;

 private:
  struct Length {
    std::size_t elements = 0;
  };
  struct Nothing {};  // null, and types that no function returns
  using Value = std::variant<Nothing, std::uint64_t, double, std::string, Length>;
  class Reader;

  template <class T>
  [[nodiscard]] const T& at(const std::string& path, std::string_view expected) const;

  std::map<std::string, Value> values_;
};

/// A number with a point or an exponent, as `JsonValues::number` reads it.
[[nodiscard]] std::string json_text(double number);

}  // namespace meshhood::parts
