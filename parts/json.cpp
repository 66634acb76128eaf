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
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool parse_error(std::size_t byte, const std::string& last, const Json::exception& /*error*/) {
    fail(fmt::format("no JSON at byte {}: {}", byte, io::quote(last)));
  }

 private:
  struct Level {
    std::string path;  // that of the object or array
    Length* array = nullptr;
    std::string name = {};  // of the next value of an object
  };

  bool open(bool is_array) {
    constexpr std::size_t kMostLevels = 8;
    if (levels_.size() == kMostLevels) fail(fmt::format("more than {} levels", kMostLevels));
    const std::string path = next_path();
    levels_.push_back({.path = path, .array = is_array ? &values_[path].emplace<Length>() : nullptr});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  template <class T>
  bool keep(T value) {
    values_[next_path()].template emplace<T>(std::move(value));
    return true;
  }

  /// The path of the next value, which counts as an element of its array.
  [[nodiscard]] std::string next_path() {
    if (levels_.empty()) return {};
    const Level& level = levels_.back();
    const std::string last = level.array != nullptr ? std::to_string(level.array->elements++) : level.name;
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

std::string json_text(double number) { return Json(number).dump(); }

}  // namespace meshhood::parts
