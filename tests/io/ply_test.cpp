// SPDX-License-Identifier: MIT
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hostile.h"
#include "support/scale.h"

// PLY files: rows of the catalogue of mesh files.

namespace meshhood::test {
namespace {

using ::testing::ElementsAre;

const std::string kAxes = "property float x\nproperty float y\nproperty float z\n";

std::string vertex_lines(const std::string& count) { return "element vertex " + count + "\n" + kAxes; }

std::string face_lines(const std::string& count) {
  return "element face " + count + "\nproperty list uchar int vertex_indices\n";
}

std::string header(const std::string& encoding, const std::string& elements) {
  return "ply\nformat " + encoding + " 1.0\n" + elements + "end_header\n";
}

std::string text_with(const std::string& elements) { return header("ascii", elements); }
std::string binary_with(const std::string& elements) { return header("binary_little_endian", elements); }

std::string triangle(const std::string& rows) { return text_with(vertex_lines("3") + face_lines("1")) + rows; }

const std::string kVertices = "0 0 0\n1 0 0\n0 1 0\n";

std::string little_triangle(const std::string& face) {
  return binary_with(vertex_lines("3") + face_lines("1")) + little(0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F) + face;
}

// M1
TEST(Ply, HugeCountsAreRefusedBeforeTheyAllocate) {
  const std::string digits(33, '9');
  for (const std::string encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    expect_malformed("a.ply", header(encoding, vertex_lines("1099511627776")), "a.ply:3:16", "1099511627776",
                     "0 bytes are left");
    expect_malformed("a.ply", header(encoding, vertex_lines(digits)), digits);
    expect_malformed("a.ply", header(encoding, vertex_lines("18446744073709551615")), "18446744073709551615");
    expect_malformed("a.ply", header(encoding, vertex_lines("-1")), "-1");
    expect_malformed("a.ply", header(encoding, vertex_lines("0") + face_lines("1099511627776")), "'face'");
  }
}

// M2
TEST(Ply, ElementsWithoutPropertiesCostNothing) {
  for (const std::string encoding : {"ascii", "binary_little_endian"}) {
    const auto mesh = read("a.ply", header(encoding, "element nothing 18446744073709551615\nelement vertex 0\n" +
                                                         kAxes + "element face 999999999999999999\n"));
    EXPECT_EQ(vertex_count(mesh), 0U);
    EXPECT_EQ(face_count(mesh), 0U);
  }
}

// M3
TEST(Ply, TruncationAtAnyByteIsRefused) {
  const std::string whole = little_triangle(little(std::uint8_t{3}, 0, 1, 2));
  expect_truncations_refused("a.ply", whole, 1);
  expect_malformed("a.ply", whole.substr(0, whole.size() - 1), "a.ply@", "face 0 of 1", "vertex_indices");
}

// M3
TEST(Ply, TruncationOfTextNamesElementAndLocation) {
  expect_truncations_refused("a.ply", triangle(kVertices + "3 0 1 2"), 1);  // the last newline may be missing
  expect_malformed(
      "a.ply", triangle("0 0 0\n1 0 0\n0 1"), "a.ply:3:16",
      "3 elements 'vertex' take at least 6 bytes each, but 15 bytes are left: at least 1 elements are missing");
  expect_malformed("a.ply", triangle("0.00000 0 0\n1.00000 0 0\n0 1"), "a.ply:12:4",
                   "vertex 2 of 3, z: the file ends here, 1 of 3 rows are missing");
  expect_malformed("a.ply", triangle(kVertices + "3 0 1"), "face 0 of 1");
}

TEST(Ply, ATruncatedBinaryFileSaysHowManyElementsAreMissing) {
  std::string whole = binary_with(vertex_lines("10"));
  for (int i = 0; i < 10; ++i) whole += little(0.F, 0.F, 0.F);
  expect_malformed(
      "a.ply", whole.substr(0, whole.size() - 13),
      "10 elements 'vertex' take at least 12 bytes each, but 107 bytes are left: at least 2 elements are missing");
}

// It may be a misspelt line that changes the layout of the values, so it is not skipped.
TEST(Ply, AHeaderLineWithoutKeywordIsRefused) {
  expect_malformed("a.ply", "ply\nformat ascii 1.0\nmade by hand\nelement vertex 0\n" + kAxes + "end_header\n",
                   "a.ply:3:1", "'comment'", "found 'made'");
}

// M4
TEST(Ply, BytesAfterTheLastElementAreAWarning) {
  const std::string binary = little_triangle(little(std::uint8_t{3}, 0, 1, 2));
  for (const auto& file : {binary + "x", triangle(kVertices + "3 0 1 2\n7 8\n")}) {
    EXPECT_EQ(warned(read("a.ply", file), "after the last element"), 1U);
    EXPECT_TRUE(refusal("a.ply", file, {.strict = true}).refused);
  }
  EXPECT_TRUE(read("a.ply", triangle(kVertices + "3 0 1 2\n \n\n")).warnings.empty());
  EXPECT_EQ(read("a.ply", binary + "x").warnings.at(0).first_place, "byte " + std::to_string(binary.size()));
}

// M24
TEST(Ply, MoreNumbersInALineThanDeclaredAreSkippedWithAWarning) {
  const auto vertices = [](const std::string& more) {
    return "0 0 0" + more + "\n1 0 0" + more + "\n0 1 0" + more + "\n";
  };
  const std::string face = "3 0 1 2\n";
  const std::vector<std::pair<std::string, std::uint64_t>> files = {
      {vertices(" 1") + face, 3},
      {vertices(" 0 0 1 3 0 1 2") + face, 3},
      {vertices("") + "3 0 1 2 255 0 0 1\n", 1},
      {vertices(" 1") + "\n" + "3 0 1 2 3\n", 4},
      {"0 0 0\n1 0 0 7\n0 1 0\n" + face, 1},  // one line alone
  };
  for (const auto& [rows, lines] : files) {
    const auto mesh = read("a.ply", triangle(rows));
    EXPECT_THAT(floats(mesh), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0)) << rows;
    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2)) << rows;
    EXPECT_EQ(mesh.warnings.size(), 1U) << rows;
    EXPECT_EQ(warned(mesh, "more numbers than the header declares"), lines) << rows;
    EXPECT_TRUE(refusal("a.ply", triangle(rows), {.strict = true}).refused) << rows;
  }
  EXPECT_EQ(read("a.ply", triangle(files[0].first)).warnings.at(0).first_place, "line 10");
  EXPECT_EQ(warned(read("a.ply", triangle(files[0].first + "7\n")), "after the last element"), 1U);
}

// M24
TEST(Ply, MoreNumbersBehindAListAreSkippedInTheirElement) {
  const std::string elements = vertex_lines("3") + "element strange 2\nproperty list uchar int a\nproperty float b\n" +
                               face_lines("2") + "property uchar red\n";
  const auto mesh = read("a.ply", text_with(elements) + kVertices + "1 7 2 9 9\n0 2 9 9\n3 0 1 2 255\n3 2 1 0 0\n");
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 2, 1, 0));
  EXPECT_EQ(warned(mesh, "more numbers"), 2U);
}

// M24
TEST(Ply, FewerNumbersInALineThanDeclaredAreRefusedByRow) {
  const std::string too_few = "has fewer numbers in its line than the header declares";
  expect_malformed("a.ply", triangle("0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), "a.ply:11:1: vertex 1 " + too_few);
  expect_malformed("a.ply", triangle("0 0 0 1\n1 0 0 1\n0 1\n3 0 1 2\n"), "a.ply:12:4",
                   "vertex 2 of 3, z: the line ends here");
  const std::string two_faces = text_with(vertex_lines("3") + face_lines("2")) + kVertices;
  expect_malformed("a.ply", two_faces + "3 0 1\n2 1 0\n", "a.ply:13:1: face 0 " + too_few);
  expect_malformed(
      "a.ply", two_faces + "3 0 1\n3 2 1 0\n",
      "a.ply:14:1: face 0, vertex_indices[2] = 3, but there are 3 vertices; the row runs on after line 13");
  // Half of the numbers: two lines are taken for a row until the file ends.
  const std::string six = vertex_lines("4") + "property float nx\nproperty float ny\nproperty float nz\n";
  expect_malformed("a.ply", text_with(six) + "0.00 0.0 0.0\n1.00 0.0 0.0\n0.00 1.0 0.0\n0.00 0.0 1.0\n",
                   "vertex 2 of 4, x: the file ends here, 2 of 4 rows are missing", "; vertex 0 runs on after line 11");
}

// M24
TEST(Ply, RowsMayRunOverLinesAndShareThem) {
  const std::vector<std::string> layouts = {"0 0 0 1 0 0 0 1 0\n3 0 1 2\n", "0 0 0 1\n0 0 0 1\n0 3 0 1\n2\n",
                                            "0\n0\n0\n1 0 0\n0 1\n0\n3\n0 1 2\n", "0 0 0 1 0 0 0 1 0 3 0 1 2",
                                            "0 0\n0 1 0 0 0 1 0\n3 0 1\n2"};
  for (const auto& rows : layouts) {
    const auto mesh = read("a.ply", triangle(rows));
    EXPECT_THAT(floats(mesh), ElementsAre(0, 0, 0, 1, 0, 0, 0, 1, 0)) << rows;
    EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2)) << rows;
    EXPECT_TRUE(mesh.warnings.empty()) << rows;
  }
  // A face of no corners and a number more would have a line of its own, too.
  const auto one = read("a.ply", text_with(vertex_lines("1") + face_lines("1")) + "0 0 0 2 0\n0\n");
  EXPECT_THAT(one.corners, ElementsAre(0, 0));
  expect_malformed("a.ply", triangle(layouts[2] + "7\n"),
                   "a.ply:18:1: data after the last element; vertex 0 runs on after line 10");
}

// M24
TEST(Ply, RowsAreToldFromLinesInAnyLayout) {
  std::mt19937 random(24);
  const auto number = [&random] { return fmt::format("{:.2f}", static_cast<double>(random() % 1000) / 100); };
  const std::size_t cases = scaled(3000, 200);
  for (std::size_t i = 0; i < cases; ++i) {
    const std::size_t vertices = 2 + random() % 5;
    std::vector<std::string> rows;
    while (rows.size() < vertices) rows.push_back(number() + ' ' + number() + ' ' + number());
    for (int face = 0; face < 4; ++face) rows.emplace_back(face % 2 == 0 ? "3 0 1 0" : "2 1 0");
    const std::string head = text_with(vertex_lines(std::to_string(vertices)) + face_lines("4"));
    std::string plain = head;
    std::string running = head;
    std::string longer = head;
    for (std::size_t row = 0; row < rows.size(); ++row) {
      plain += rows[row] + '\n';
      longer += rows[row] + (row < vertices ? " 1 2\n" : " 3\n");
      running += rows[row] + ' ';
    }
    for (std::size_t at = head.size(); at < running.size(); ++at) {
      if (running[at] == ' ' && random() % 3 == 0) running[at] = '\n';
    }
    const auto mesh = read("a.ply", plain);
    const auto same = [&mesh](const io::Mesh& other) {
      return other.positions == mesh.positions && other.corners == mesh.corners && other.offsets == mesh.offsets;
    };
    const auto run = read("a.ply", running);
    EXPECT_TRUE(same(run) && run.warnings.empty()) << running;
    EXPECT_TRUE(same(read("a.ply", longer))) << longer;
  }
  std::printf("%zu meshes in three layouts\n", cases);
}

// M24
TEST(Ply, ALongTextIsReadByLines) {
  constexpr std::size_t kCount = 400'000;
  std::string file = text_with(vertex_lines(std::to_string(kCount)));
  for (std::size_t i = 0; i < kCount; ++i) file += fmt::format("{} 0.123456789012345 0.123456789012345 1\n", i);
  EXPECT_GT(file.size(), std::size_t{16} << 20);
  const auto mesh = read("a.ply", file);
  EXPECT_EQ(warned(mesh, "more numbers"), kCount);
  EXPECT_EQ(floats(mesh)[3 * (kCount - 1)], static_cast<float>(kCount - 1));
}

template <class Count, class Index>
void expect_list_types(const std::string& count_type, const std::string& index_type) {
  const std::string elements =
      vertex_lines("3") + "element face 1\nproperty list " + count_type + " " + index_type + " vertex_index\n";
  for (const auto order : {std::endian::little, std::endian::big}) {
    const bool is_little = order == std::endian::little;
    std::string file = header(is_little ? "binary_little_endian" : "binary_big_endian", elements);
    for (const float number : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) file += bytes_of(number, order);
    file += bytes_of(Count{3}, order);
    for (const int index : {2, 0, 1}) file += bytes_of(static_cast<Index>(index), order);
    EXPECT_THAT(read("a.ply", file).corners, ElementsAre(2, 0, 1)) << count_type << " " << index_type;
  }
  const auto text = read("a.ply", text_with(elements) + kVertices + "3 2 0 1\n");
  EXPECT_THAT(text.corners, ElementsAre(2, 0, 1));
}

template <class Count>
void expect_all_index_types(const std::string& count_type) {
  expect_list_types<Count, std::int8_t>(count_type, "char");
  expect_list_types<Count, std::uint8_t>(count_type, "uint8");
  expect_list_types<Count, std::int16_t>(count_type, "short");
  expect_list_types<Count, std::uint16_t>(count_type, "ushort");
  expect_list_types<Count, std::int32_t>(count_type, "int32");
  expect_list_types<Count, std::uint32_t>(count_type, "uint");
}

// M5
TEST(Ply, EveryIntegerCountAndIndexTypeIsRead) {
  expect_all_index_types<std::int8_t>("int8");
  expect_all_index_types<std::uint8_t>("uchar");
  expect_all_index_types<std::int16_t>("int16");
  expect_all_index_types<std::uint16_t>("uint16");
  expect_all_index_types<std::int32_t>("int");
  expect_all_index_types<std::uint32_t>("uint32");
  std::printf("36 pairs of types, each in text and in both byte orders\n");
}

// M5
TEST(Ply, WrongListCountsAreRefused) {
  const auto with_count_type = [](const std::string& type) {
    return header("binary_little_endian",
                  vertex_lines("0") + "element face 1\nproperty list " + type + " int vertex_indices\n");
  };
  expect_malformed("a.ply", with_count_type("char") + little(std::int8_t{-1}),
                   "face 0 of 1, vertex_indices: a list of -1 values");
  expect_malformed("a.ply", with_count_type("uint") + little(0xffffffffU, 0),
                   "a list of 4294967295 values, but 4 bytes are left");
  expect_malformed("a.ply", with_count_type("float") + little(3.F, 0, 1, 2), "a.ply:8:", "integer type");
  expect_malformed("a.ply", triangle(kVertices + "-3 0 1 2\n"), "a.ply:13:1", "'-3'");
  expect_malformed("a.ply", triangle(kVertices + "256 0 1 2\n"), "'256'");
  expect_malformed("a.ply", triangle(kVertices + "3.0 0 1 2\n"), "'3.0'");
}

// M6
TEST(Ply, IndicesOutOfRangeAreRefusedByFaceAndCorner) {
  for (const std::int32_t index : {3, -1, std::numeric_limits<std::int32_t>::min(), 999999}) {
    expect_malformed("a.ply", little_triangle(little(std::uint8_t{3}, 0, 1, index)),
                     "face 0, vertex_indices[2] = " + std::to_string(index) + ", but there are 3 vertices");
    expect_malformed("a.ply", triangle(kVertices + "3 0 1 " + std::to_string(index)),
                     "a.ply:13:7: face 0, vertex_indices[2] = " + std::to_string(index));
  }
  const std::string unsigned_face =
      binary_with(vertex_lines("1") + "element face 1\nproperty list uchar uint vertex_indices\n") +
      little(0.F, 0.F, 0.F, std::uint8_t{1});
  expect_malformed("a.ply", unsigned_face + little(0xffffffffU), "4294967295");
  expect_malformed("a.ply", unsigned_face + little(0x80000000U), "2147483648");
}

// M11
TEST(Ply, ExactlyOneLineEndFollowsTheHeader) {
  // The first byte of the body is 0x0A and does not belong to the line end of the header.
  const std::string body = little(std::bit_cast<float>(0x3f80000aU), 2.F, 3.F);
  const std::string lines = "ply\nformat binary_little_endian 1.0\nelement vertex 1\n" + kAxes + "end_header\n";
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string file;
    for (const char c : lines) file += c == '\n' ? end : std::string(1, c);
    const auto mesh = read("a.ply", file + body);
    EXPECT_THAT(floats(mesh), ElementsAre(std::bit_cast<float>(0x3f80000aU), 2.F, 3.F));
    EXPECT_TRUE(mesh.warnings.empty());
  }
  const auto mixed = read("a.ply", lines.substr(0, lines.size() - 1) + "\r\n" + body);
  EXPECT_EQ(floats(mixed).at(1), 2.F);
}

// M12
TEST(Ply, EveryScalarTypeIsAPosition) {
  const std::vector<std::pair<std::string, std::string>> types = {{"char", bytes_of(std::int8_t{-7})},
                                                                  {"uchar", bytes_of(std::uint8_t{200})},
                                                                  {"short", bytes_of(std::int16_t{-700})},
                                                                  {"ushort", bytes_of(std::uint16_t{60000})},
                                                                  {"int", bytes_of(-16777217)},
                                                                  {"uint", bytes_of(4294967295U)},
                                                                  {"float", bytes_of(0.1F)},
                                                                  {"double", bytes_of(0.1)}};
  const std::vector<double> values = {-7, 200, -700, 60000, -16777217, 4294967295.0, double{0.1F}, 0.1};
  for (std::size_t i = 0; i < types.size(); ++i) {
    const auto& [type, bytes] = types[i];
    const std::string file =
        binary_with("element vertex 1\nproperty " + type + " x\nproperty " + type + " y\nproperty " + type + " z\n") +
        bytes + bytes + bytes;
    const auto mesh = read("a.ply", file, {.precision = io::Precision::Double});
    EXPECT_THAT(std::get<std::vector<double>>(mesh.positions), ElementsAre(values[i], values[i], values[i])) << type;
    const bool is_double = std::holds_alternative<std::vector<double>>(read("a.ply", file).positions);
    EXPECT_EQ(is_double, type == "double" || type == "int" || type == "uint") << type;
  }
}

// M12
TEST(Ply, FacesMayComeFirstAndElementsMayBeUnknown) {
  const std::string elements =
      "element face 1\nproperty uchar flags\nproperty list uchar int vertex_indices\nproperty list ushort double w\n"
      "element strange 2\nproperty list int short a\nproperty float b\n"
      "element vertex 3\nproperty double z\nproperty list uchar float extra\nproperty double x\nproperty char c\n"
      "property double y\n";
  const auto text = read("a.ply", text_with(elements) +
                                      "9 3 0 1 2 2 0.5 0.5\n"
                                      "0 1.5\n2 1 2 2.5\n"
                                      "3 0 1 7 2\n6 2 1 1 4 7 5\n9 0 7 7 8\n");
  EXPECT_THAT(text.corners, ElementsAre(0, 1, 2));
  EXPECT_THAT(std::get<std::vector<double>>(text.positions), ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9));
  EXPECT_TRUE(text.warnings.empty());

  std::string file = header("binary_big_endian", elements);
  const auto add = [&file](auto... values) { ((file += bytes_of(values, std::endian::big)), ...); };
  add(std::uint8_t{9}, std::uint8_t{3}, 0, 1, 2, std::uint16_t{2}, 0.5, 0.5);
  add(0, 1.5F, 2, std::int16_t{1}, std::int16_t{2}, 2.5F);
  add(3.0, std::uint8_t{0}, 1.0, std::int8_t{7}, 2.0);
  add(6.0, std::uint8_t{2}, 1.F, 1.F, 4.0, std::int8_t{7}, 5.0);
  add(9.0, std::uint8_t{0}, 7.0, std::int8_t{7}, 8.0);
  const auto binary = read("a.ply", file);
  EXPECT_EQ(binary.corners, text.corners);
  EXPECT_EQ(binary.positions, text.positions);
}

// M12
TEST(Ply, XMissingOrTwiceIsRefused) {
  const std::string yz = "property float y\nproperty float z\n";
  expect_malformed("a.ply", text_with("element vertex 0\n" + yz), "a.ply:3:", "x");
  expect_malformed("a.ply", text_with("element vertex 0\nproperty float x\nproperty float x\n" + yz), "x twice");
  expect_malformed("a.ply", text_with("element vertex 0\nproperty list uchar float x\n" + yz), "scalar property x");
  expect_malformed("a.ply", text_with(vertex_lines("0") + vertex_lines("0")), "a second element 'vertex'");
  expect_malformed("a.ply", text_with(face_lines("0")), "no element vertex");
  expect_malformed("a.ply", text_with(vertex_lines("0") + face_lines("0") + "property list uchar int vertex_index\n"),
                   "twice");
}

// M12
TEST(Ply, WithoutFacesThereAreVerticesOnly) {
  const auto mesh = read("a.ply", text_with(vertex_lines("2")) + "1 2 3\n4 5 6\n");
  EXPECT_EQ(vertex_count(mesh), 2U);
  EXPECT_EQ(face_count(mesh), 0U);
  validate(mesh.view());
}

// M12
TEST(Ply, StripsAreTriangles) {
  const std::string elements = vertex_lines("5") + "element tristrips 1\nproperty list int int vertex_indices\n";
  const std::string vertices = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n";
  // The second strip turns back to 4 through a repeated corner.
  const auto mesh = read("a.ply", text_with(elements) + vertices + "11 0 1 2 3 -1 2 3 4 -1 0 0 1\n");
  EXPECT_THAT(mesh.corners, ElementsAre(0, 1, 2, 2, 1, 3, 2, 3, 4));
  expect_malformed("a.ply", text_with(elements) + vertices + "3 0 1 5\n", "tristrips 0, vertex_indices[2] = 5");
  expect_malformed("a.ply", text_with(elements) + vertices + "3 0 1 -2\n", "= -2");
}

// M17
TEST(Ply, OnlyPositionsMustBeFinite) {
  const std::string normals = "property float nx\n";
  for (const std::string word : {"inf", "-inf", "1e999", "1e39"}) {
    const auto good = read("a.ply", text_with(vertex_lines("1") + normals) + "1 2 3 " + word + "\n");
    EXPECT_EQ(vertex_count(good), 1U);
    expect_malformed("a.ply", text_with(vertex_lines("1") + normals) + "1 " + word + " 3 0\n", "a.ply:9:3",
                     "vertex 0 of 1, y: '" + word + "' is ");
  }
  const std::string doubles = "property double x\nproperty double y\nproperty double z\n";
  const std::string binary = binary_with("element vertex 1\n" + doubles);
  expect_malformed("a.ply", binary + little(1.0, std::numeric_limits<double>::infinity(), 0.0),
                   "vertex 0 of 1, y: is not finite");
  EXPECT_EQ(vertex_count(read("a.ply", binary + little(1.0, 1e39, 0.0))), 1U);
  const auto rounded = refusal("a.ply", binary + little(1.0, 1e39, 0.0), {.precision = io::Precision::Float});
  EXPECT_THAT(rounded.message, ::testing::HasSubstr("y: is too large"));
}

// M18
TEST(Ply, LineEndsAndBlanksOfAllKinds) {
  const std::string whole = triangle(kVertices + "3 0 1 2\n");
  for (const std::string end : {"\n", "\r\n", "\r", "\n\n"}) {
    std::string file;
    for (const char c : whole) file += c == '\n' ? end : c == ' ' ? "\t " : std::string(1, c);
    EXPECT_THAT(read("a.ply", file).corners, ElementsAre(0, 1, 2));
    EXPECT_THAT(read("a.ply", "\xef\xbb\xbf" + file).corners, ElementsAre(0, 1, 2));
  }
  expect_malformed("a.ply", triangle(kVertices + std::string("3 0 1 2\0\n", 9)), "a.ply:13:8", "NUL");
}

// M19
TEST(Ply, SizesNeverWrap) {
  // 2^60 rows of 16 bytes are 2^64 bytes, which wraps to 0.
  const std::string row = kAxes + "property float w\n";
  expect_malformed("a.ply", binary_with("element vertex 1152921504606846976\n" + row), "1152921504606846976");
  expect_malformed("a.ply",
                   header("binary_little_endian",
                          vertex_lines("0") + "element e 1152921504606846976\nproperty double a\nproperty double b\n"),
                   "'e'");
  // A list of 2^30 + 1 values of 4 bytes wraps to 4 in 32 bits.
  expect_malformed(
      "a.ply", binary_with(vertex_lines("0") + "element e 1\nproperty list uint float a\n") + little(0x40000001U, 0.F),
      "1073741825");
}

TEST(Ply, InvalidHeadersAreRefused) {
  expect_refused("a.ply", "ply\nformat ascii 2.0\nend_header\n", ErrorCode::UnsupportedFormat, "'2.0'");
  expect_refused("a.ply", "ply\nformat binary 1.0\nend_header\n", ErrorCode::UnsupportedFormat, "'binary'");
  expect_malformed("a.ply", "ply\nend_header\n", "'format'");
  expect_malformed("a.ply", "ply\nformat ascii 1.0\nproperty float x\nend_header\n", "before the first element");
  expect_malformed("a.ply", text_with("element vertex 0 7\n"), "'7'");
  expect_refused("a.ply", text_with("element vertex 0\nproperty int64 x\n"), ErrorCode::UnsupportedFormat, "'int64'");
  expect_malformed("a.ply", text_with("element vertex 0\nproperty float\n"), "name");
  expect_malformed("a.ply", text_with("nonsense \x1b[31m\n"), "'nonsense'");
  expect_malformed("a.ply", text_with(vertex_lines("0") + "element face 0\nproperty int vertex_index\n"),
                   "no list of integers");
  expect_malformed("a.ply", "ply\nformat ascii 1.0\n" + std::string(100, 'x') + "\n", std::string(64, 'x') + "...'");
}

}  // namespace
}  // namespace meshhood::test
