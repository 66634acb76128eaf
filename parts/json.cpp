// SPDX-License-Identifier: MIT
#include "parts/json.h"

#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "meshhood/error.h"

#include "io/messages.h"

namespace meshhood::parts {
namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(std::string_view problem) { raise(ErrorCode::MalformedIndex, std::string(problem)); }

}  // namespace

/// Receives the values in the order of the text. The names of the functions are those of nlohmann_json.
class JsonValues::Reader {
 public:
  explicit Reader(std::map<std::string, Value>& values) : values_(values) {}

  bool null() { return keep(Nothing{}); }
  bool boolean(bool /*value*/) { return keep(Nothing{}); }
  bool number_integer(Json::number_integer_t /*negative*/) { return keep(Nothing{}); }
  bool number_unsigned(Json::number_unsigned_t number) { return keep(std::uint64_t{number}); }
  bool number_float(Json::number_float_t number, const std::string& /*text*/) { return keep(number); }
  bool string(std::string& text) { return keep(std::move(text)); }
  bool binary(Json::binary_t& /*value*/) { return keep(Nothing{}); }

  bool start_object(std::size_t /*size*/) { return open(false); }
  bool start_array(std::size_t /*size*/) { return open(true); }
  bool key(std::string& name) {
    levels_.back().name = std::move(name);
    return true;
  }
  bool end_object() {
    levels_.pop_back();
    return true;
  }
  bool end_array() {
    const Length length{levels_.back().elements};
    levels_.pop_back();
    return set(length);
  }

  bool parse_error(std::size_t byte, const std::string& last, const Json::exception& /*error*/) {
    fail(fmt::format("no JSON at byte {}: {}", byte, io::quote(last)));
  }

 private:
  struct Level {
    std::string path;  // that of the object or array
    bool is_array = false;
    std::string name = {};  // of the next value of an object
    std::size_t elements = 0;
  };

  bool open(bool is_array) {
    constexpr std::size_t kMostLevels = 8;
    if (levels_.size() == kMostLevels) fail(fmt::format("more than {} levels", kMostLevels));
    count_element();
    levels_.push_back({.path = path(), .is_array = is_array});
    return true;
  }

  template <class T>
  bool keep(T value) {
    count_element();
    return set(std::move(value));
  }

  template <class T>
  bool set(T value) {
    values_[path()].template emplace<T>(std::move(value));
    return true;
  }

  void count_element() {
    if (!levels_.empty()) ++levels_.back().elements;
  }

  /// The path of the value that was counted last.
  [[nodiscard]] std::string path() const {
    if (levels_.empty()) return {};
    const Level& level = levels_.back();
    const std::string last = level.is_array ? std::to_string(level.elements - 1) : level.name;
    return level.path.empty() ? last : fmt::format("{}/{}", level.path, last);
  }

  std::map<std::string, Value>& values_;
  std::vector<Level> levels_;
};

JsonValues::JsonValues(std::string_view text) {
  Reader reader(values_);
  static_cast<void>(Json::sax_parse(text, &reader));
}

template <class T>
const T& JsonValues::at(const std::string& path, std::string_view expected) const {
  const auto found = values_.find(path);
  if (found == values_.end()) fail(fmt::format("'{}' is missing", path));
  const T* const value = std::get_if<T>(&found->second);
  if (value == nullptr) fail(fmt::format("'{}' is not {}", path, expected));
  return *value;
}

std::uint64_t JsonValues::count(const std::string& path) const {
  return at<std::uint64_t>(path, "a whole number >= 0");
}

double JsonValues::number(const std::string& path) const { return at<double>(path, "a number with a point"); }

const std::string& JsonValues::text(const std::string& path) const { return at<std::string>(path, "a text"); }

std::size_t JsonValues::size(const std::string& path) const { return at<Length>(path, "an array").elements; }

void JsonText::begin(std::string_view name, char bracket) {
  add_literal(name, std::string(1, bracket));
  ++level_;
  is_first_ = true;
}

void JsonText::end(char bracket) {
  --level_;
  if (!is_first_) begin_line();
  text_ += bracket;
  is_first_ = false;
}

void JsonText::add(std::string_view name, double number) { add_literal(name, Json(number).dump()); }

void JsonText::add(std::string_view name, std::string_view text) { add_literal(name, fmt::format("\"{}\"", text)); }

std::string JsonText::take() {
  end('}');
  return std::move(text_);
}

void JsonText::add_literal(std::string_view name, std::string_view literal) {
  if (!is_first_) text_ += ',';
  if (!text_.empty()) begin_line();
  if (!name.empty()) text_ += fmt::format("\"{}\": ", name);
  text_ += literal;
  is_first_ = false;
}

void JsonText::begin_line() {
  text_ += '\n';
  text_.append(level_, ' ');
}

}  // namespace meshhood::parts
