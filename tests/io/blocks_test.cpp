// SPDX-License-Identifier: MIT
// Files parsed in blocks, by any number of threads, are what the readers make of them row by row: the same mesh, the
// same warnings, the same error at the same place.
#include <array>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "meshhood/error.h"

#include "io/byte_source.h"
#include "io/input_buffer.h"
#include "io/readers.h"
#include "support/hostile.h"

namespace meshhood::test {
namespace {

using Reader = io::Mesh (*)(io::InputBuffer& input, const io::ReaderOptions& options);

/// A mesh or an error, in words.
std::string outcome(Reader reader, std::string_view content, const io::ReaderOptions& options) {
  const std::vector<char> exact(content.begin(), content.end());  // a sanitizer reports a read past the end
  io::MemorySource source(std::as_bytes(std::span(exact)));
  io::InputBuffer input(source, "file", content.size());
  try {
    const io::Mesh mesh = reader(input, options);
    EXPECT_NO_THROW(validate(mesh.view()));
    std::string words;
    const auto add = [&words](const auto& values) {
      for (const auto& value : values) words += std::to_string(value) + ' ';
      words += '\n';
    };
    words += mesh.positions.index() == 0 ? "float " : "double ";
    std::visit(add, mesh.positions);
    add(mesh.corners);
    add(mesh.offsets);
    add(mesh.walls);
    for (const io::Warning& warning : mesh.warnings) {
      words += warning.what + ", " + std::to_string(warning.count) + " times, " + warning.first_place + '\n';
    }
    return words;
  } catch (const Error& error) {
    EXPECT_EQ(std::string_view(error.what()).find_first_of("\n\r"), std::string_view::npos) << "one line";
    return error.what();
  }
}

struct File {
  const char* name;
  Reader reader;
  std::string content;
};

const std::string kPlyHeader =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty uchar c\nproperty float z\nproperty float y\n"
    "element face 3\nproperty uchar a\nproperty list uchar int vertex_indices\nproperty float b\nend_header\n";

std::string facet_with(const std::string& corner) {
  return "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex " + corner +
         "\n endloop\nendfacet\n";
}

/// `x`: of a vertex in no face.
std::string binary_ply(float x) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string vertices = little(0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F, x, 0.F, 0.F);
  const std::string triangle = little(std::uint8_t{3}, 0U, 1U, 2U);
  return header + vertices + triangle + little(std::uint8_t{2}, 2U, 1U) + little(std::uint8_t{0}) + triangle;
}

/// Small files with rows of all kinds, plain ones between others.
std::vector<File> files() {
  return {
      {"OBJ", io::read_obj,
       "# a comment\nv 0 0 0\nv 1 0 0.5\r\nv 1 1 0 0.5 0.5 0.5\nv 0 1 -1e-3\nvn 0 0 1\nvt 0.5 0.5\n\nf 1 2 3\ng part\n"
       "f 1//1 2/1/1 3/1 4\nf -1 -2 -3\nf 1 2 \\\n3\nv 2 2 2 0.5\nf 5 4 7\nv 3 3 3\n  v 4 4 4 \nf 2 5 7 # last"},
      {"faces before vertices", io::read_obj, "v 0 0 0\nf 1 2 3\nf 2 1 4\nv 1 0 0\nv 0 1 0\nf 3 2 1\nv 1 1 1\n"},
      {"OFF", io::read_off, "OFF # comment\n4 3 0\n0 0 0\n1 0 0\n 1 1 0\n0 1\n0\n3 0 1 2\n4 0 1 2 3 255 0 0\n2 3\n1\n"},
      {"PLY", io::read_ply,
       kPlyHeader + "0 9 0 0\n1 9 0 0\n1 9\n1 1\n0 9 0.5 1\n7 3 0 1 2 0\n7 4 0 1 2 3 nan\n7 2\n3 1 0\n"},
      {"PLY of rows alike", io::read_ply,
       "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty int q\n"
       "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
       "3 0 1 2\n3 0 1 2\n3 0 1 2\n3 0 1 2\n3 0 1 2\n"},
      {"PLY of long lines", io::read_ply,
       kPlyHeader + "0 9 0 0 1\n1 9 0 0 1\n1 9 1 1 1\n0 9 0.5 1 1\n7 3 0 1 2 0\n7 4 0 1 2 3 nan\n7 2 3 1 0\n"},
      {"PLY of rows that share lines", io::read_ply,
       kPlyHeader + "0 9 0 0 1 9\n0 0 1 9 1 1 0 9 0.5 1\n7 3 0 1 2 0\n7 4 0 1 2 3 nan\n7 2 3 1 0\n"},
      {"PLY in CR", io::read_ply,
       kPlyHeader + "0 9 0 0\n1 9 0 0\r1 9 1 1\r0 9 0.5 1\n7 3 0 1 2 0\r7 4 0 1 2 3 nan\r7 2 3 1 0\r"},
      {"OFF with holes", io::read_off, "OFF\n4 1 0\nnan nan nan\n1 0 0\n1 1 0\n0 nan 0\n2 2 1\n"},
      {"OBJ with holes", io::read_obj, "v nan nan nan\nf 2 3\nv 1 0 0\nv 1 1 0\nv 0 nan 0\nf 3 2\n"},
      {"OFF without edges", io::read_off, "NCOFF\n3 2\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n3 2 1 0\n"},
      {"STL", io::read_stl,
       "solid name\n" + facet_with("0 1 0") + facet_with("1 0 0") + facet_with("0 1 -0") +
           facet_with("2 2 2\n vertex 3 3 3") + "FACET NORMAL 0 0 1\n" + facet_with("5 5 5").substr(19) +
           facet_with("7 7 1e-5") + "endsolid\nsolid\n" + facet_with("8 8 8") + "endsolid\n"},
      {"OBJ of more digits", io::read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0 0.123456789\nv 0 5412345.2 0\nf 1 2 3 4\n"},
      {"OBJ of more digits in a long row", io::read_obj, "v 0 0 0\nv 1 0 0\nv 0 5412345.2 0 1\nf 1 2 3\n"},
      {"OFF of more digits", io::read_off, "OFF\n3 1 0\n0 0 0\n1 0 0.123456789012\n0 1 0\n3 0 1 2\n"},
      {"OFF of more digits in a face", io::read_off, "OFF\n2 2 0\n0 0 0\n1 0 0\n1 0 0.123456789012\n1 1 5412345.2\n"},
      {"STL of more digits", io::read_stl,
       "solid\n" + facet_with("0 1 0") + facet_with("0 1 5412345.2") + "endsolid\n"},
      {"binary PLY", io::read_ply, binary_ply(0.F)},
      {"binary PLY with holes", io::read_ply, binary_ply(std::numeric_limits<float>::quiet_NaN())},
  };
}

const std::array<unsigned, 2> kThreads = {1, 3};

TEST(Blocks, OfAnySizeGiveTheSameMesh) {
  std::size_t sizes = 0;
  for (const auto& [name, reader, content] : files()) {
    const std::string expected = outcome(reader, content, {{}, 0});
    EXPECT_EQ(expected.find("file:"), std::string::npos) << name << " should be a mesh: " << expected;
    for (std::size_t bytes = 1; bytes <= content.size() + 1; ++bytes, ++sizes) {
      for (const unsigned threads : kThreads) {
        ASSERT_EQ(outcome(reader, content, {{.threads = threads}, bytes}), expected) << name << ", blocks of " << bytes;
      }
    }
  }
  std::printf("%zu sizes\n", sizes);
}

TEST(Blocks, OfTruncatedFilesGiveTheSameError) {
  for (const auto& [name, reader, content] : files()) {
    for (std::size_t size = 0; size < content.size(); ++size) {
      const std::string_view part = std::string_view(content).substr(0, size);
      const std::string expected = outcome(reader, part, {{}, 0});
      for (const std::size_t bytes : {1U, 7U, 40U, 1U << 16U}) {
        ASSERT_EQ(outcome(reader, part, {{}, bytes}), expected)
            << name << ", " << size << " bytes in blocks of " << bytes;
      }
    }
  }
}

TEST(Blocks, OfFilesWithAChangedByteGiveTheSameMeshOrError) {
  const std::string bytes("\n\r\t \v#\\/-+.0179evfx\0\x80\xff", 22);
  std::size_t refused = 0;
  std::size_t accepted = 0;
  for (const auto& [name, reader, content] : files()) {
    for (std::size_t place = 0; place < content.size(); ++place) {
      for (const char byte : bytes) {
        std::string changed = content;
        changed[place] = byte;
        const std::string expected = outcome(reader, changed, {{}, 0});
        expected.starts_with("file") ? ++refused : ++accepted;
        for (const std::size_t block : {1U, 30U, 1U << 16U}) {
          ASSERT_EQ(outcome(reader, changed, {{}, block}), expected)
              << name << ", byte " << place << " is " << int{byte} << ", blocks of " << block;
        }
      }
    }
  }
  std::printf("%zu refused, %zu accepted\n", refused, accepted);
  EXPECT_GT(refused, 1000U);
  EXPECT_GT(accepted, 1000U);
}

TEST(Blocks, InStrictModeRefuseTheSameRow) {
  for (const auto& [name, reader, content] : files()) {
    const io::ReadOptions strict{.strict = true};
    const std::string expected = outcome(reader, content, {strict, 0});
    for (std::size_t bytes = 1; bytes < content.size(); bytes += 3) {
      ASSERT_EQ(outcome(reader, content, {strict, bytes}), expected) << name;
    }
  }
}

TEST(Blocks, OfDoubleCoordinatesAreReadInDouble) {
  for (const auto& [name, reader, content] : files()) {
    const io::ReadOptions in_double{.precision = io::Precision::Double};
    const std::string expected = outcome(reader, content, {in_double, 0});
    for (const std::size_t bytes : {1U, 25U, 1U << 16U}) {
      ASSERT_EQ(outcome(reader, content, {in_double, bytes}), expected) << name;
    }
  }
}

TEST(Blocks, TooManyThreadsAreRefused) {
  for (const char* const name : {"a.obj", "a.ply", "a.off", "a.stl"}) {
    const auto result = refusal(name, "v 0 0 0\n", {.threads = kMaxThreads + 1});
    EXPECT_EQ(result.code, ErrorCode::InvalidOption);
    EXPECT_NE(result.message.find("threads is 1025"), std::string::npos) << result.message;
  }
}

}  // namespace
}  // namespace meshhood::test
