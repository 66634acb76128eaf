// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>

/// JSON documents without a tree of values. The tree of nlohmann_json allocates memory in its destructor, so the
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

/// Writes a document, with a line for each value and an indentation of one blank for each level.
class JsonText {
 public:
  JsonText() { begin({}, '{'); }

  /// Begins an object or an array: '{' or '['. In an array, names are empty. Names and texts must need no escapes.
  void begin(std::string_view name, char bracket);
  void end(char bracket);

  void add(std::string_view name, std::uint64_t number) { add_literal(name, std::to_string(number)); }
  void add(std::string_view name, double number);
  void add(std::string_view name, std::string_view text);

  /// Ends the document and returns it.
  [[nodiscard]] std::string take();

 private:
  void add_literal(std::string_view name, std::string_view literal);
  void begin_line();

  std::string text_;
  std::size_t level_ = 0;
  bool is_first_ = true;  // of its object or array
};

}  // namespace meshhood::parts
