// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "io/file_writer.h"
#include "support/hostile.h"
#include "support/refusal.h"
#include "support/scratch.h"

namespace meshhood::test {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

template <class Real>
std::vector<Real> random_positions(std::size_t vertices) {
  using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  std::mt19937_64 random(vertices);
  std::vector<Real> positions;
  while (positions.size() < 3 * vertices) {
    const auto number = std::bit_cast<Real>(static_cast<Bits>(random()));
    if (std::abs(number) < Real{1e30F}) positions.push_back(number);
  }
  return positions;
}

template <class Real>
bool same_bits(const std::vector<Real>& a, const std::vector<Real>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Real)) == 0);
}

class WritePly : public ::testing::Test {
 protected:
  Refusal refused(const std::filesystem::path& path, const MeshView& mesh, const io::PlyOptions& options = {}) {
    try {
      io::write_ply(path, mesh, options);
      return {};
    } catch (const Error& error) {
      return {true, error.code(), error.what()};
    }
  }

  template <class Real>
  void expect_same_after_writing(const std::vector<Real>& xyz, const FacesView& faces) {
    for (const bool ascii : {false, true}) {
      io::write_ply(file, {xyz, faces}, {.ascii = ascii});
      const auto mesh = io::read_mesh(file, {.strict = true});
      ASSERT_TRUE(std::holds_alternative<std::vector<Real>>(mesh.positions));
      EXPECT_TRUE(same_bits(std::get<std::vector<Real>>(mesh.positions), xyz));
      std::vector<std::vector<std::uint64_t>> expected;
      std::vector<std::vector<std::uint64_t>> found;
      faces.for_each(
          [&](std::size_t, std::span<const VertexId> face) { expected.emplace_back(face.begin(), face.end()); });
      mesh.view().faces.for_each(
          [&](std::size_t, std::span<const VertexId> face) { found.emplace_back(face.begin(), face.end()); });
      EXPECT_EQ(found, expected);
    }
  }

  Scratch scratch;
  const std::filesystem::path file = scratch.path() / "out.ply";
  const std::vector<float> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::vector<std::int32_t> corners = {0, 1, 2};
  const MeshView triangle = {positions, FacesView::triangles(corners)};
};

TEST_F(WritePly, ReadsBackBitForBit) {
  const std::vector<std::uint32_t> triangles = {0, 1, 2, 2, 3, 4, 999, 998, 997};
  const std::vector<std::uint64_t> offsets = {0, 4, 4, 5, 7, 10};
  const std::vector<std::int64_t> polygons = {0, 1, 2, 3, 9, 8, 7, 6, 5, 4};
  expect_same_after_writing(random_positions<float>(1000), FacesView::triangles(triangles));
  expect_same_after_writing(random_positions<double>(1000), FacesView::triangles(triangles));
  expect_same_after_writing(random_positions<float>(1000), FacesView::polygons(offsets, polygons));
  expect_same_after_writing(random_positions<double>(1000), FacesView::polygons(offsets, polygons));
  expect_same_after_writing(std::vector<float>{}, FacesView{});
  expect_same_after_writing(std::vector<float>{-0.F, 1e-45F, 3.4028234e38F}, FacesView{});
}

TEST_F(WritePly, FacesMayHaveMoreThan255Corners) {
  std::vector<std::uint32_t> ring(70000);
  for (std::size_t i = 0; i < ring.size(); ++i) ring[i] = static_cast<std::uint32_t>(i % 300);
  for (const std::uint64_t length : {255U, 256U, 70000U}) {
    const std::vector<std::uint64_t> offsets = {0, length};
    const std::vector<std::uint32_t> face(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(length));
    expect_same_after_writing(random_positions<float>(300), FacesView::polygons(offsets, face));
  }
}

TEST_F(WritePly, ColorsAndPropertiesAreWritten) {
  const std::vector<std::uint8_t> colors = {255, 0, 0, 0, 128, 0, 1, 2, 3};
  const std::vector<float> distance = {0.5F, std::numeric_limits<float>::infinity(), 2};
  const std::vector<float> level = {1, 2, 3};
  const io::PlyOptions options = {.colors = colors, .properties = {{"distance", distance}, {"level", level}}};
  io::write_ply(file, triangle, options);
  EXPECT_EQ(io::read_mesh(file, {.strict = true}).corners, (std::vector<std::uint32_t>{0, 1, 2}));
  const auto binary = read_file(file);
  EXPECT_THAT(binary, HasSubstr("property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                "property float distance\nproperty float level\nelement face 1\n"));
  EXPECT_THAT(binary, HasSubstr(little(1.F, 0.F, 0.F, std::uint8_t{0}, std::uint8_t{128}, std::uint8_t{0},
                                       std::numeric_limits<float>::infinity(), 2.F)));
  auto text = options;
  text.ascii = true;
  io::write_ply(file, triangle, text);
  EXPECT_THAT(read_file(file), HasSubstr("\nend_header\n0 0 0 255 0 0 0.5 1\n1 0 0 0 128 0 inf 2\n0 1 0 1 2 3 2 3\n"
                                         "3 0 1 2\n"));
  EXPECT_EQ(io::read_mesh(file, {.strict = true}).corners, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST_F(WritePly, VectorsAreThreeProperties) {
  const std::vector<float> normal = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const std::vector<float> level = {10, 20, 30};
  io::write_ply(file, triangle, {.properties = {{"n", normal}, {"level", level}}, .ascii = true});
  EXPECT_THAT(read_file(file), HasSubstr("property float n_x\nproperty float n_y\nproperty float n_z\n"
                                         "property float level\n"));
  EXPECT_THAT(read_file(file), HasSubstr("\n0 0 0 1 2 3 10\n1 0 0 4 5 6 20\n0 1 0 7 8 9 30\n"));
}

TEST_F(WritePly, VtkHasTheMeshAndItsValues) {
  const std::vector<float> normal = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const std::vector<float> level = {10, 20, 30};
  io::write_vtk(file, triangle, {.properties = {{"level", level}, {"n", normal}}});
  EXPECT_EQ(read_file(file), "# vtk DataFile Version 4.2\nmeshhood\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n" +
                                 big(0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F) + "\nPOLYGONS 1 4\n" +
                                 big(3, 0, 1, 2) + "\nPOINT_DATA 3\nSCALARS level float 1\nLOOKUP_TABLE default\n" +
                                 big(10.F, 20.F, 30.F) + "\nFIELD FieldData 1\nn 3 3 float\n" +
                                 big(1.F, 2.F, 3.F, 4.F, 5.F, 6.F, 7.F, 8.F, 9.F) + "\n");
  io::write_vtk(file, triangle, {.properties = {{"n", normal}}});
  EXPECT_THAT(read_file(file), HasSubstr("\nPOINT_DATA 3\nFIELD FieldData 1\nn 3 3 float\n"));
  io::write_vtk(file, triangle, {.properties = {{"5%", level}, {"%41%", level}}});
  EXPECT_THAT(read_file(file), HasSubstr("\nSCALARS 5%25 float 1\n")) << "readers decode it";
  EXPECT_THAT(read_file(file), HasSubstr("\n%2541%25 1 3 float\n"));
  const std::vector<std::int32_t> records = {0, 1, 2, -1, 2, 1, 0, -1};
  io::write_vtk(file, {positions, FacesView::strided_triangles(records, 2, 4, 1)});
  EXPECT_THAT(read_file(file), HasSubstr("\nPOLYGONS 2 8\n" + big(3, 0, 1, 2, 3, 2, 1, 0) + "\nPOINT_DATA 3\n"));
  const std::vector<double> none;
  io::write_vtk(file, {none, FacesView{}});
  EXPECT_THAT(read_file(file), EndsWith("\nPOINTS 0 double\n\nPOINT_DATA 0\n"));
}

TEST_F(WritePly, VtkRefusesWhatDoesNotFit) {
  const std::vector<float> values = {1, 2, 3};
  const std::vector<float> two = {1, 2};
  for (const io::VtkOptions& options :
       {io::VtkOptions{.properties = {{"a", two}}}, io::VtkOptions{.properties = {{"a", values}, {"a", values}}},
        io::VtkOptions{.properties = {{"two words", values}}}}) {
    EXPECT_THROW(io::write_vtk(file, triangle, options), Error);
  }
  EXPECT_THROW(io::write_vtk(file, triangle, {.progress = [](std::size_t, std::size_t) { return false; }}), Error);
  EXPECT_EQ(files_in(scratch.path()), 0U);
}

TEST_F(WritePly, OptionsThatDoNotFitAreRefusedAndNothingIsWritten) {
  const std::vector<std::uint8_t> short_colors = {1, 2};
  const std::vector<float> values = {1, 2, 3};
  const std::vector<float> two = {1, 2};
  const std::vector<float> vectors = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  const std::vector<io::PlyOptions> bad = {
      {.colors = short_colors},
      {.properties = {{"a", two}}},
      {.properties = {{"a", values}, {"a", values}}},
      {.properties = {{"x", values}}},
      {.properties = {{"n", vectors}, {"n_y", values}}},
      {.properties = {{"two words", values}}},
      {.properties = {{"line\nend_header", values}}},
      {.properties = {{"", values}}},
  };
  for (const auto& options : bad) EXPECT_EQ(refused(file, triangle, options).code, ErrorCode::InvalidOption);
  const std::vector<std::int32_t> out_of_range = {0, 1, 3};
  EXPECT_EQ(refused(file, {positions, FacesView::triangles(out_of_range)}).code, ErrorCode::InvalidMesh);
  EXPECT_EQ(files_in(scratch.path()), 0U);
}

TEST_F(WritePly, AFullDeviceIsAnErrorAndStaysADevice) {
  if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const auto full = refused("/dev/full", triangle);
  EXPECT_EQ(full.code, ErrorCode::IoFailure);
  EXPECT_THAT(full.message, StartsWith("/dev/full: cannot write: No space left on device"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(WritePly, ReplacesTheTargetOfALinkAndKeepsItsMode) {
  ASSERT_EQ(scratch.write("out.ply", "old"), file);
  ASSERT_EQ(::chmod(file.c_str(), 0640), 0);
  const auto link = scratch.path() / "link.ply";
  std::filesystem::create_symlink(file, link);
  io::write_ply(link, triangle);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(face_count(io::read_mesh(file)), 1U);
  struct stat status = {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
  EXPECT_EQ(files_in(scratch.path()), 2U);
}

TEST_F(WritePly, ALinkWithoutTargetSurvives) {
  const auto link = scratch.path() / "link.ply";
  std::filesystem::create_symlink("out.ply", link);
  io::write_ply(link, triangle);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ(face_count(io::read_mesh(file)), 1U);
  std::filesystem::remove(file);
  const auto second = scratch.path() / "second.ply";
  std::filesystem::create_symlink("link.ply", second);
  io::write_ply(second, triangle);
  EXPECT_TRUE(std::filesystem::is_symlink(link)) << "a chain is followed to its end";
  EXPECT_EQ(face_count(io::read_mesh(file)), 1U);
  std::filesystem::remove(second);
  const auto loop = scratch.path() / "loop.ply";
  std::filesystem::create_symlink("loop.ply", loop);
  EXPECT_EQ(refused(loop, triangle).code, ErrorCode::IoFailure);
  EXPECT_EQ(files_in(scratch.path()), 3U);
}

// The permissions of a file in octal digits.
unsigned mode_of(const std::filesystem::path& path) {
  struct stat status = {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0) << path;
  return status.st_mode & 0777U;
}

TEST_F(WritePly, TheTemporaryFileOfAPrivateFileIsPrivate) {
  const auto before = ::umask(0022);
  ASSERT_EQ(scratch.write("out.ply", "old"), file);
  ASSERT_EQ(::chmod(file.c_str(), 0600), 0);
  {
    io::FileWriter writer(file);
    writer.write("new");
    std::size_t beside = 0;
    for (const auto& entry : std::filesystem::directory_iterator(scratch.path())) {
      EXPECT_EQ(mode_of(entry.path()), 0600U) << entry.path();
      ++beside;
    }
    EXPECT_EQ(beside, 2U);
    writer.commit();
  }
  EXPECT_EQ(mode_of(file), 0600U);
  std::filesystem::remove(file);
  io::write_ply(file, triangle);
  EXPECT_EQ(mode_of(file), 0644U) << "a new file is as the umask says";
  ::umask(before);
}

TEST_F(WritePly, RefusesAReadOnlyFile) {
  ASSERT_EQ(scratch.write("out.ply", "old"), file);
  ASSERT_EQ(::chmod(file.c_str(), 0444), 0);
  const auto error = refused(file, triangle);
  EXPECT_EQ(error.code, ErrorCode::IoFailure);
  EXPECT_THAT(error.message, HasSubstr("is read-only"));
  EXPECT_EQ(files_in(scratch.path()), 1U);
}

// Both wait for others about ten times a second in a function that may end them.
TEST_F(WritePly, ToAPipeWithoutAReaderEndsByItsProgressOrAfterAWhile) {
  const auto pipe = scratch.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(refused(pipe, triangle).message, HasSubstr("no process reads this pipe"));
  int calls = 0;
  expect_refused(ErrorCode::Cancelled, "", [&] {
    io::write_ply(pipe, triangle, {.progress = [&](std::size_t, std::size_t) { return ++calls < 3; }});
  });
  EXPECT_EQ(calls, 3);
}

TEST_F(WritePly, KeepsTheOwnerWherePermitted) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root may";
  constexpr uid_t kOtherUser = 1234;
  ASSERT_EQ(scratch.write("out.ply", "old"), file);
  ASSERT_EQ(::chown(file.c_str(), kOtherUser, kOtherUser), 0);
  io::write_ply(file, triangle);
  struct stat status = {};
  ASSERT_EQ(::stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, kOtherUser);
  EXPECT_EQ(status.st_gid, kOtherUser);
}

TEST_F(WritePly, CancelledAtAnyReportKeepsTheOldFile) {
  const auto xyz = random_positions<float>(10000);
  const std::vector<std::uint32_t> triangles(3 * 20000, 7);
  const MeshView mesh = {xyz, FacesView::triangles(triangles)};
  ASSERT_EQ(scratch.write("out.ply", "old"), file);
  std::size_t last = 0;
  for (bool is_ended = true; is_ended; ++last) {
    std::vector<std::size_t> reports;
    const auto ended = refused(file, mesh, {.progress = [&](std::size_t done, std::size_t total) {
                                 EXPECT_EQ(total, 30000U);
                                 reports.push_back(done);
                                 return reports.size() <= last;
                               }});
    is_ended = ended.refused;
    EXPECT_EQ(reports.front(), 0U);
    EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end()));
    EXPECT_EQ(files_in(scratch.path()), 1U);
    if (!is_ended) {
      EXPECT_EQ(reports.back(), 30000U);
      break;
    }
    EXPECT_EQ(ended.code, ErrorCode::Cancelled);
    EXPECT_EQ(ended.message, file.string() + ": cancelled");
    EXPECT_EQ(read_file(file), "old");
  }
  EXPECT_EQ(face_count(io::read_mesh(file)), 20000U);
  EXPECT_GE(last, 8U);
  std::printf("ended at %zu reports\n", last);
}

TEST_F(WritePly, NamesMayHaveTheMaximalLength) {
  const auto longest = scratch.path() / std::string(255, 'x');
  io::write_ply(longest, triangle);
  EXPECT_EQ(face_count(io::read_mesh(longest)), 1U);
}

}  // namespace
}  // namespace meshhood::test
