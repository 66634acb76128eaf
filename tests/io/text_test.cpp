// SPDX-License-Identifier: MIT
#include <clocale>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <locale>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/hostile.h"

// Text and the detection of the format: rows of the catalogue of mesh files.

namespace meshhood::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kOff = "OFF\n3 1 0\n0.5 0 0\n1.5 0 0\n0 2.5 0\n3 0 1 2\n";

struct DecimalComma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

// Restores the locale.
class LocaleGuard {
 public:
  LocaleGuard() = default;
  LocaleGuard(const LocaleGuard&) = delete;
  LocaleGuard& operator=(const LocaleGuard&) = delete;
  ~LocaleGuard() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, name_.c_str());
  }

 private:
  std::locale before_;
  std::string name_ = std::setlocale(LC_ALL, nullptr);
};

void expect_numbers_with_points() {
  EXPECT_THAT(floats(read("a.off", kOff)), ElementsAre(0.5F, 0, 0, 1.5F, 0, 0, 0, 2.5F, 0));
  for (const std::string name : {"a.obj", "a.ply", "a.off", "a.stl"}) {
    const std::string xyz = "1 1,5 2";
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
    const std::string file = name == "a.obj"   ? "v " + xyz + "\n"
                             : name == "a.ply" ? ply + xyz + "\n"
                             : name == "a.off" ? "OFF\n1 0 0\n" + xyz + "\n"
                                               : "solid\nfacet normal 0 0 1\nouter loop\nvertex " + xyz + "\n";
    const auto column = file.substr(file.rfind('\n', file.size() - 2) + 1).find("1,5") + 1;
    expect_malformed(name, file, ":" + std::to_string(column) + ": ", "'1,5' is not a number");
  }
}

// M16
TEST(Text, ParsingIgnoresTheLocaleOfStreams) {
  const LocaleGuard guard;
  std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  expect_numbers_with_points();
}

// M16
TEST(Text, ParsingIgnoresTheLocaleOfTheCLibrary) {
  const LocaleGuard guard;
  const char* found = nullptr;
  for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "fr_FR.utf8", "de_DE", "nl_NL.utf8"}) {
    if (found == nullptr) found = std::setlocale(LC_ALL, name);
  }
  if (found == nullptr) GTEST_SKIP() << "no locale with a decimal comma is installed";
  ASSERT_EQ(std::snprintf(nullptr, 0, "%.1f", 1.5), 3);
  expect_numbers_with_points();
}

float read_number(const std::string& token) { return floats(read("a.obj", "v " + token + " 0 0\n"))[0]; }

// M17
TEST(Text, NumbersThatAreRead) {
  EXPECT_EQ(read_number("+1.5"), 1.5F);
  EXPECT_EQ(read_number(".5"), 0.5F);
  EXPECT_EQ(read_number("5."), 5.F);
  EXPECT_EQ(read_number("-1E+02"), -100.F);
  EXPECT_EQ(read_number("1e-010"), 1e-10F);
  EXPECT_EQ(read_number("340282346638528859811704183484516925440"), std::numeric_limits<float>::max());
  EXPECT_TRUE(std::signbit(read_number("-0")));
  // Underflow is rounded to 0 or to a denormal number.
  EXPECT_EQ(read_number("1e-400"), 0.F);
  EXPECT_EQ(read_number("1e-45"), std::numeric_limits<float>::denorm_min());
  const auto fine = read("a.obj", "v 0.1 1e-320 1e150\n", {.precision = io::Precision::Double});
  EXPECT_THAT(std::get<std::vector<double>>(fine.positions), ElementsAre(0.1, 1e-320, 1e150));
  EXPECT_EQ(read_number("1" + std::string(100000, '0') + "e-100000"), 1.F);
}

// M17
TEST(Text, TokensThatAreNotNumbers) {
  const std::vector<std::string> none = {"1.#QNAN", "0x1p3", "1.5f",  "1,5", "--1",      "+-1",
                                         "++1",     "1e",    "e5",    ".",   "-",        "+",
                                         "1.5.2",   "1e5e5", "1_000", "1d5", "\xc2\xa0", "1\xe2\x80\x83"};
  for (const auto& token : none) {
    expect_malformed("a.obj", "v 0 0 0\nv 0 " + token + " 0\n", "a.obj:2:5: vertex 2, y = ", "is not a number");
  }
  for (const std::string token : {"nan", "NaN", "-nan", "+nan", "nan(1)"}) {
    EXPECT_EQ(warned(read("a.obj", "v 0 0 " + token + "\n"), "without a position"), 1U) << token;
  }
  const std::vector<std::string> infinite = {"inf", "-Inf", "INFINITY"};
  for (const auto& token : infinite) {
    expect_malformed("a.obj", "v 0 0 " + token + "\n", "a.obj:1:7: vertex 1, z = ", "' is ");
  }
  for (const std::string token : {"1e999", "-1e151", "340282366920938463463374607431768211456"}) {
    const auto result = refusal("a.obj", "v " + token + " 0 0\n", {.precision = io::Precision::Float});
    EXPECT_THAT(result.message, HasSubstr("'" + token + "' is too large"));
    const bool is_double = token.starts_with('3');
    EXPECT_EQ(refusal("a.obj", "v " + token + " 0 0\n").refused, !is_double) << token;
  }
  std::printf("%zu tokens refused\n", none.size() + infinite.size() + 3);
}

// M17
TEST(Text, EveryFloatReadsBackFromItsShortestText) {
  std::mt19937 random(17);
  std::string file;
  std::vector<float> numbers;
  std::array<char, 32> text = {};
  while (numbers.size() < 300000) {
    const auto number = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (!std::isfinite(number)) continue;
    numbers.push_back(number);
    const int length = std::snprintf(text.data(), text.size(), "%.9g", static_cast<double>(number));
    file += numbers.size() % 3 == 1 ? "v " : " ";
    file.append(text.data(), static_cast<std::size_t>(length));
    if (numbers.size() % 3 == 0) file += "\n";
  }
  const auto back = floats(read("a.obj", file));
  ASSERT_EQ(back.size(), numbers.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < back.size(); ++i) {
    if (std::bit_cast<std::uint32_t>(back[i]) != std::bit_cast<std::uint32_t>(numbers[i])) ++different;
  }
  EXPECT_EQ(different, 0U);
  std::printf("%zu floats\n", numbers.size());
}

// M18
TEST(Text, LineEndsMarksAndNulBytes) {
  const std::string obj = "# first\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string stl =
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
  for (const auto& [name, lines] : {std::pair{"a.obj", obj}, std::pair{"a.off", kOff}, std::pair{"a.stl", stl}}) {
    std::size_t count = 0;
    for (const std::string end : {"\n", "\r\n", "\r", "mixed"}) {
      std::string file;
      for (const char c : lines) {
        file += c != '\n'          ? std::string(1, c)
                : end != "mixed"   ? end
                : ++count % 3 == 0 ? "\r"
                : count % 3 == 1   ? "\n"
                                   : "\r\n";
      }
      EXPECT_THAT(read(name, file).corners, ElementsAre(0, 1, 2)) << name << " " << end;
      EXPECT_THAT(read(name, "\xef\xbb\xbf" + file).corners, ElementsAre(0, 1, 2)) << name << " " << end;
    }
    auto with_nul = lines;
    with_nul[with_nul.size() - 3] = '\0';
    expect_malformed(name, with_nul, "NUL byte");
  }
}

// M18
TEST(Text, LinesAreCountedForEveryLineEnd) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    expect_malformed("a.obj", "v 0 0 0" + end + end + "# c" + end + "\tv 0 x 0" + end, "a.obj:4:6: ");
  }
}

// M18
TEST(Text, Utf16IsRefusedByName) {
  for (const bool big : {true, false}) {
    std::string file = big ? "\xfe\xff" : "\xff\xfe";
    for (const char c : kOff) {
      if (big) file += '\0';
      file += c;
      if (!big) file += '\0';
    }
    expect_refused("a.off", file, ErrorCode::UnsupportedFormat, "UTF-16");
  }
}

TEST(Text, QuotedTextIsCutAndEscaped) {
  const auto result = refusal("a.obj", "v 0 \x1b[31m\x07" + std::string(1000, 'x') + " 0\n");
  EXPECT_THAT(result.message, HasSubstr("\\x1b[31m\\x07xxx"));
  EXPECT_THAT(result.message, HasSubstr("xxx...'"));
  EXPECT_LT(result.message.size(), 200U);
  const auto name = refusal("a\nb.obj", "v x\n");
  EXPECT_THAT(name.message, HasSubstr("a\\x0ab.obj:1:3: "));
  // What is no character of UTF-8: too long, half of a pair, beyond the last.
  EXPECT_THAT(refusal("\xe0\x80\x80.obj", "v x\n").message, HasSubstr("\\xe0\\x80\\x80.obj"));
  EXPECT_THAT(refusal("\xed\xa0\x80.obj", "v x\n").message, HasSubstr("\\xed\\xa0\\x80.obj"));
  EXPECT_THAT(refusal("\xf4\x90\x80\x80.obj", "v x\n").message, HasSubstr("\\xf4\\x90\\x80\\x80.obj"));
}

TEST(Format, AGitLfsPointerIsRefusedWithAHint) {
  for (const std::string name : {"a.ply", "a.obj", "a.off", "a.stl", "a"}) {
    expect_refused(name, "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n",
                   ErrorCode::UnsupportedFormat, name + ": is a Git LFS pointer", "'git lfs pull'");
  }
}

TEST(Format, FilesForOtherLibrariesAreRefusedWithAWayOn) {
  const std::string xml = "<?xml version=\"1.0\"?>\n";
  for (const auto& [name, content, kind] :
       std::vector<std::array<std::string, 3>>{{"a.vtp", xml + "<VTKFile type=\"PolyData\">\n", "VTK's XML"},
                                               {"a.gii", xml + "<!DOCTYPE GIFTI>\n<GIFTI Version=\"1.0\">\n", "GIFTI"},
                                               {"a.stl", "glTF\x02{\"asset\"", "GLB"},
                                               {"a", "{\"asset\": {}}", "glTF"},
                                               {"a.3mf", "PK\x03\x04", "3MF"},
                                               {"a.msh", "$MeshFormat\n4.1 0 8\n", "MSH"},
                                               {"lh.white", "\xff\xff\xfd", "FreeSurfer's quads"}}) {
    expect_refused(name, content, ErrorCode::UnsupportedFormat, name + ": is " + kind,
                   "m.read_mesh(sys.argv[1]))' FILE converts it");
  }
}

TEST(Format, IsDetectedByContentThenByExtension) {
  EXPECT_EQ(read("wrong.obj", kOff).format, io::Format::Off);
  EXPECT_EQ(read("wrong.stl", "v 0 0 0\n").format, io::Format::Obj);
  EXPECT_EQ(read("wrong.ply", binary_stl({{0, 0, 0, 1, 0, 0, 0, 1, 0}})).format, io::Format::Stl);
  EXPECT_EQ(read("no_ending", "# only\n# comments\n\nv 0 0 0\n").format, io::Format::Obj);
  EXPECT_EQ(read("a.OBJ", "# only comments\n").format, io::Format::Obj);
  expect_refused("no_ending", "something else\n", ErrorCode::UnsupportedFormat,
                 "neither PLY, OBJ, OFF, STL, VTK nor FreeSurfer");
  expect_refused("no_ending", std::string(4096, '\0'), ErrorCode::UnsupportedFormat, "neither");
  expect_malformed("a.ply", "something else\n", "expected 'ply'");
  expect_refused("a.ply", "\x8bMHI\r\n\x1a\n", ErrorCode::UnsupportedFormat, "is an index, expected a mesh");
}

}  // namespace
}  // namespace meshhood::test
