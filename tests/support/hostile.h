// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshhood/error.h"

#include "io/mesh_io.h"

/// Files that a test builds byte by byte, and the result of reading them.
namespace meshhood::test {

[[nodiscard]] inline io::Mesh read(const std::string& name, std::string_view content,
                                   const io::ReadOptions& options = {}) {
  // A copy that ends with the content, so that a sanitizer reports a read past the end.
  const std::vector<char> exact(content.begin(), content.end());
  return io::read_mesh(std::as_bytes(std::span(exact)), name, options);
}

struct Refusal {
  bool refused = false;
  ErrorCode code = ErrorCode::InvalidMesh;
  std::string message;
};

[[nodiscard]] inline Refusal refusal(const std::string& name, std::string_view content,
                                     const io::ReadOptions& options = {}) {
  try {
    static_cast<void>(read(name, content, options));
    return {};
  } catch (const Error& error) {
    return {true, error.code(), error.what()};
  }
}

[[nodiscard]] inline Refusal file_refusal(const std::filesystem::path& path, const io::ReadOptions& options = {}) {
  try {
    static_cast<void>(io::read_mesh(path, options));
    return {};
  } catch (const Error& error) {
    return {true, error.code(), error.what()};
  }
}

/// Expects that `call(path)` fails with this error of the system. Bindings need path and number, for OSError of Python.
template <class F>
void expect_errno(const std::filesystem::path& path, int error_number, F&& call) {
  try {
    call(path);
    ADD_FAILURE() << path << " was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::IoFailure) << error.what();
    EXPECT_EQ(error.path(), path.string()) << error.what();
    EXPECT_EQ(error.error_number(), error_number) << error.what();
  }
}

/// Expects an error whose message contains each of `parts`.
template <class... Parts>
void expect_refused(const std::string& name, std::string_view content, ErrorCode code, const Parts&... parts) {
  const auto result = refusal(name, content);
  ASSERT_TRUE(result.refused) << "accepted: " << content.substr(0, 400);
  EXPECT_EQ(result.code, code) << result.message;
  EXPECT_THAT(result.message, ::testing::AllOf(::testing::HasSubstr(parts)...));
  EXPECT_EQ(result.message.find_first_of("\n\r\x1b"), std::string::npos) << "one line, no control codes";
}

template <class... Parts>
void expect_malformed(const std::string& name, std::string_view content, const Parts&... parts) {
  expect_refused(name, content, ErrorCode::MalformedFile, parts...);
}

[[nodiscard]] inline std::vector<float> floats(const io::Mesh& mesh) {
  return std::get<std::vector<float>>(mesh.positions);
}

[[nodiscard]] inline std::size_t vertex_count(const io::Mesh& mesh) { return mesh.view().positions.size(); }
[[nodiscard]] inline std::size_t face_count(const io::Mesh& mesh) { return mesh.view().faces.size(); }

/// Expects that `whole` has so many faces, and is refused if it ends earlier: anywhere but before the last `optional`
/// bytes.
inline void expect_truncations_refused(const std::string& name, const std::string& whole, std::size_t faces,
                                       std::size_t optional = 0) {
  EXPECT_EQ(face_count(read(name, whole)), faces);
  for (std::size_t length = 0; length + optional < whole.size(); ++length) {
    EXPECT_TRUE(refusal(name, whole.substr(0, length)).refused) << length;
  }
  std::printf("%s: %zu truncations refused\n", name.c_str(), whole.size() - optional);
}

/// The number of warnings whose text contains `what`.
[[nodiscard]] inline std::uint64_t warned(const io::Mesh& mesh, std::string_view what) {
  std::uint64_t count = 0;
  for (const auto& warning : mesh.warnings) {
    if (warning.what.find(what) != std::string::npos) count += warning.count;
  }
  return count;
}

/// The bytes of a value in a file of the given byte order.
template <class T>
[[nodiscard]] std::string bytes_of(T value, std::endian order = std::endian::little) {
  std::array<char, sizeof(T)> bytes = {};
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return {bytes.begin(), bytes.end()};
}

template <class... T>
[[nodiscard]] std::string little(T... values) {
  return (bytes_of(values) + ... + std::string());
}

template <class... T>
[[nodiscard]] std::string big(T... values) {
  return (bytes_of(values, std::endian::big) + ... + std::string());
}

/// A binary STL file of the given triangles, nine numbers each.
[[nodiscard]] inline std::string binary_stl(const std::vector<std::array<float, 9>>& triangles,
                                            std::string_view header = "binary") {
  std::string file(header);
  file.resize(80, '\0');
  file += little(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    file.append(12, '\0');
    for (const float number : triangle) file += little(number);
    file.append(2, '\0');
  }
  return file;
}

}  // namespace meshhood::test
