// SPDX-License-Identifier: MIT
#include "io/float_keeps.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <random>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/number.h"
#include "support/hostile.h"
#include "support/scale.h"

// Text keeps its digits: it becomes float only where float keeps what is written.

namespace meshhood::test {
namespace {

using ::testing::HasSubstr;

bool kept(const std::string& number) { return io::float_keeps(number, io::parse_real<double>(number).value()); }

std::string printed(double value, const char* form) {
  std::array<char, 64> text = {};
  return {text.data(), static_cast<std::size_t>(std::snprintf(text.data(), text.size(), form, value))};
}

std::string shortest(float value) {
  std::array<char, 64> text = {};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// What the plain reader makes of a number is what the whole token says.
void expect_same_at_a_glance(const std::string& number) {
  io::Decimal decimal;
  const std::string line = number + '\n';
  const char* const after = io::take_decimal(line.data(), decimal);
  if (after == nullptr) return;
  ASSERT_EQ(after, line.data() + number.size()) << number;
  const double value = io::parse_real<double>(number).value();
  ASSERT_EQ(std::bit_cast<std::uint64_t>(decimal.value()), std::bit_cast<std::uint64_t>(value)) << number;
  if (io::surely_keeps(decimal, value)) {
    ASSERT_TRUE(io::float_keeps(number, value)) << number;
  }
}

TEST(FloatKeeps, EveryNumberThatWasPrintedFromAFloat) {
  std::mt19937 random(31);
  const std::size_t floats = scaled(100'000);
  for (std::size_t i = 0; i < floats; ++i) {
    const auto number = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (!std::isfinite(number)) continue;
    for (const char* const form : {"%.9g", "%.9e", "%.8e", "%.17g", "%.16e"}) {
      const std::string text = printed(double{number}, form);
      ASSERT_TRUE(kept(text)) << text;
      ASSERT_EQ(static_cast<float>(io::parse_real<double>(text).value()), number) << text;
      expect_same_at_a_glance(text);
    }
    ASSERT_TRUE(kept(shortest(number))) << shortest(number);
    ASSERT_EQ(static_cast<float>(io::parse_real<double>(shortest(number)).value()), number);
    expect_same_at_a_glance(shortest(number));
  }
  std::printf("%zu floats in six forms\n", floats);
}

// The neighbors of a power of two are at two distances, so that its shortest text may be far from it.
TEST(FloatKeeps, EveryPowerOfTwo) {
  for (int exponent = -149; exponent < 128; ++exponent) {
    const float number = std::ldexp(1.0F, exponent);
    EXPECT_TRUE(kept(shortest(number))) << shortest(number);
    EXPECT_TRUE(kept(printed(double{number}, "%.9g")));
  }
}

TEST(FloatKeeps, NumbersOfSixDigitsButNotOfEight) {
  std::mt19937 random(7);
  std::size_t lost = 0;
  const std::size_t numbers = scaled(100'000);
  for (std::size_t i = 0; i < numbers; ++i) {
    const double value = std::ldexp(static_cast<double>(random()), -static_cast<int>(random() % 60));
    for (const char* const form : {"%.6g", "%.5e"}) ASSERT_TRUE(kept(printed(value, form))) << printed(value, form);
    const std::string eight = printed(value, "%.8g");
    for (const std::string& number : {printed(value, "%.7g"), eight}) expect_same_at_a_glance(number);
    if (!kept(eight)) ++lost;
  }
  EXPECT_GT(lost, numbers / 4);
  std::printf("%zu of %zu numbers of eight digits lost\n", lost, numbers);
}

TEST(FloatKeeps, WhatItSaysAtTheBoundary) {
  for (const char* const number : {"0",
                                   "-0.000",
                                   "0.1",
                                   "0.100000",
                                   "+0.1",
                                   ".5",
                                   "5.",
                                   "451234.5",
                                   "451234.500",
                                   "16777216",
                                   "1234567.12",  // the float is 1234567.125, which prints so because 2 is even
                                   "0.100000001",
                                   "0.10000000149",
                                   "0.100000001490116119384765625",
                                   "3.40282347e+38",
                                   "1.4e-45",
                                   "1e-400",
                                   "00000000000000000000000.1",
                                   "1e30",
                                   "1000000e-30"}) {
    EXPECT_TRUE(kept(number)) << number;
    expect_same_at_a_glance(number);
  }
  for (const char* const number :
       {"5412345.2", "5412345.2000", "1234567.13", "123.456000", "0.1000000000", "0.30000000000000004", "16777217",
        "16777217e0", "1e39", "3.5e38", "1.5e-45", "1e-50", "0.123456789012345", "123456789012345678901"}) {
    EXPECT_FALSE(kept(number)) << number;
    expect_same_at_a_glance(number);
  }
}

/// A square grid of 60 by 60 points in UTM, 0.1 m apart.
struct Terrain {
  static constexpr std::size_t kSide = 60;

  static std::string number(std::size_t tenths, std::size_t from) {
    return std::to_string((from + tenths) / 10) + '.' + std::to_string((from + tenths) % 10);
  }

  static std::string point(std::size_t v) {
    return number(v % kSide, 4'512'345) + ' ' + number(v / kSide, 54'123'452) + " 100";
  }

  static std::string points(const std::string& before) {
    std::string text;
    for (std::size_t v = 0; v < kSide * kSide; ++v) text += before + point(v) + '\n';
    return text;
  }

  template <class F>
  static std::string each_face(F&& face) {
    std::string text;
    for (std::size_t v = 0; v + kSide < kSide * kSide; ++v) {
      if (v % kSide + 1 == kSide) continue;
      text += face(v, v + 1, v + kSide + 1) + face(v, v + kSide + 1, v + kSide);
    }
    return text;
  }

  static std::string rows_of_three(const std::string& before, std::size_t base) {
    return each_face([&](std::size_t a, std::size_t b, std::size_t c) {
      return before + std::to_string(a + base) + ' ' + std::to_string(b + base) + ' ' + std::to_string(c + base) + '\n';
    });
  }

  static std::string counts(const std::string& between) {
    return std::to_string(kSide * kSide) + between + std::to_string(2 * (kSide - 1) * (kSide - 1));
  }

  static std::string obj() { return points("v ") + rows_of_three("f ", 1); }
  static std::string off() { return "OFF\n" + counts(" ") + " 0\n" + points("") + rows_of_three("3 ", 0); }

  static std::string stl() {
    return "solid\n" + each_face([](std::size_t a, std::size_t b, std::size_t c) {
             return "facet normal 0 0 1\nouter loop\nvertex " + point(a) + "\nvertex " + point(b) + "\nvertex " +
                    point(c) + "\nendloop\nendfacet\n";
           }) +
           "endsolid\n";
  }

  static std::string ply() {
    return "ply\nformat ascii 1.0\nelement vertex " +
           counts("\nproperty float x\nproperty float y\nproperty float z\nelement face ") +
           "\nproperty list uchar int vertex_indices\nend_header\n" + points("") + rows_of_three("3 ", 0);
  }
};

std::size_t distinct(const io::Mesh& mesh) {
  return std::visit(
      [](const auto& xyz) {
        std::set<std::array<double, 3>> points;
        for (std::size_t i = 0; i < xyz.size(); i += 3) points.insert({xyz[i], xyz[i + 1], xyz[i + 2]});
        return points.size();
      },
      mesh.positions);
}

bool is_double(const io::Mesh& mesh) { return mesh.positions.index() == 1; }

TEST(TextPrecision, ATerrainInUtmKeepsItsPositions) {
  for (const auto& [name, file] :
       {std::pair{"a.obj", Terrain::obj()}, std::pair{"a.off", Terrain::off()}, std::pair{"a.stl", Terrain::stl()}}) {
    const auto mesh = read(name, file, {.strict = true});
    ASSERT_TRUE(is_double(mesh)) << name;
    EXPECT_EQ(vertex_count(mesh), 3600U) << name;
    EXPECT_EQ(distinct(mesh), 3600U) << name;
    EXPECT_TRUE(mesh.warnings.empty()) << name;
    const auto& xyz = std::get<std::vector<double>>(mesh.positions);
    EXPECT_EQ(xyz[0], 451234.5);
    EXPECT_EQ(xyz[1], 5412345.2);
    // What the files were read as before.
    const auto rounded = read(name, file, {.precision = io::Precision::Float});
    EXPECT_FALSE(is_double(rounded)) << name;
    EXPECT_EQ(distinct(rounded), 780U) << name;
    EXPECT_EQ(warned(rounded, "read the file in double precision"), 1U) << name;
    EXPECT_EQ(rounded.warnings.back().first_place, "");
  }
}

TEST(TextPrecision, DeclaredFloatsAreReadAsSuchWithAWarning) {
  const auto text = read("a.ply", Terrain::ply());
  EXPECT_FALSE(is_double(text));
  EXPECT_EQ(distinct(text), 780U);
  EXPECT_EQ(warned(text, "floats are 0.5 apart at 5.41e+06; read the file in double precision if"), 1U);
  const auto wide = read("a.ply", Terrain::ply(), {.precision = io::Precision::Double});
  EXPECT_EQ(distinct(wide), 3600U);
  EXPECT_TRUE(wide.warnings.empty());
  const auto binary = read("a.stl", binary_stl({{5e6F, 0, 0, 5e6F, 1, 0, 5e6F, 0, 1}}), {.strict = true});
  EXPECT_EQ(warned(binary, "move the mesh to the origin"), 1U);
  const auto near = read("a.stl", binary_stl({{5, 0, 0, 5, 1, 0, 5, 0, 1}}));
  EXPECT_TRUE(near.warnings.empty());
}

// An edge of 64 steps between neighboring floats suffices, although all numbers are floats.
TEST(TextPrecision, CoarseFloatsBecomeDouble) {
  const auto edge = [](const std::string& end) { return read("a.obj", "v 1048576 0 0\nv " + end + " 0 0\nf 1 2\n"); };
  EXPECT_FALSE(is_double(edge("1048584")));
  EXPECT_TRUE(is_double(edge("1048583.875")));
  EXPECT_TRUE(edge("1048583.875").warnings.empty());
}

TEST(TextPrecision, AFileOfFloatsKeepsTheirBits) {
  const auto mesh = read("a.obj", "v 0.1 0.333333343 1.17549435e-38\nv 1e-3 123456.789 -0\nv 7 8 9\nf 1 2 3\n");
  EXPECT_THAT(floats(mesh),
              ::testing::ElementsAre(0.1F, 1.0F / 3, 1.17549435e-38F, 1e-3F, 123456.789F, -0.0F, 7, 8, 9));
}

// Two texts of one float are two positions, which must not become one.
TEST(TextPrecision, VerticesOfAnStlRemainDifferent) {
  const auto soup = [](const std::string& x) {
    const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0.1 0 0\nvertex 1 0 0\nvertex ";
    return read("a.stl", "solid\n" + facet + x + " 0 0\nendloop\nendfacet\nendsolid\n");
  };
  EXPECT_FALSE(is_double(soup("0.2")));
  EXPECT_TRUE(is_double(soup("0.10000000149")));
  EXPECT_EQ(vertex_count(soup("0.10000000149")), 3U);
}

}  // namespace
}  // namespace meshhood::test
