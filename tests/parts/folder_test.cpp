// SPDX-License-Identifier: MIT
// A folder of parts under faults: runs that are cancelled, two runs at once, and files that have been changed.
#include "parts/folder.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "parts/partition.h"
#include "shared/checksum.h"
#include "support/families.h"
#include "support/parts_folder.h"
#include "support/refusal.h"

namespace meshhood::test {
namespace {

namespace fs = std::filesystem;
using parts::PartitionOptions;

void overwrite(const fs::path& file, const std::string& bytes) {
  fs::remove(file);  // a file that is mapped or linked keeps its content
  std::ofstream(file, std::ios::binary) << bytes;
}

class Folder : public PartsFolder {
 protected:
  /// Has a file of another written, which no run removes, with `resume` or without.
  void expect_kept(const std::string& file, const std::string& cause) const {
    fs::create_directories((folder / file).parent_path());
    overwrite(folder / file, "mine");
    const auto before = contents(folder);
    PartitionOptions options = kOptions;
    for (const bool resume : {true, false}) {
      options.resume = resume;
      expect_refused(ErrorCode::MalformedIndex, cause, [&] { partition(*chunked(mesh), folder, options); });
      EXPECT_EQ(contents(folder), before);
    }
  }
};

/// The text of a JSON file of a folder, whose first line is its checksum.
std::string sealed(const std::string& rest) {
  return fmt::format("{{\"checksum\": \"{:016x}\",\n{}", checksum({std::as_bytes(std::span(rest))}), rest);
}

TEST_F(Folder, IsUnchangedByASecondRun) {
  EXPECT_EQ(run(folder).kept, 0U);
  const auto before = contents(folder);
  EXPECT_EQ(run(folder).kept, 4U);
  EXPECT_EQ(contents(folder), before);
}

TEST_F(Folder, LosesNoFinishedPartWhenARunIsCancelled) {
  const auto expected = whole();
  std::size_t stops = 0;
  for (std::size_t stop = 1;; stop += 3) {
    fs::remove_all(folder);
    std::size_t calls = 0;
    try {
      run(folder, [&](std::size_t, std::size_t) { return ++calls < stop; });
      break;
    } catch (const Error& error) {
      ASSERT_EQ(error.code(), ErrorCode::Cancelled) << error.what();
    }
    EXPECT_FALSE(fs::exists(folder / parts::kManifestFile));
    std::size_t finished = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().filename() == parts::kMarkFile) continue;
      EXPECT_TRUE(entry.path().filename().string().starts_with("part-")) << entry.path() << " was left";
      ++finished;
    }
    EXPECT_EQ(run(folder).kept, finished);
    EXPECT_EQ(contents(folder), expected);
    ++stops;
  }
  std::printf("cancelled at %zu moments\n", stops);
  EXPECT_GT(stops, 20U);
}

TEST_F(Folder, IsWrittenByOneRunAtATime) {
  fs::create_directory(folder);
  {
    const parts::FolderLock lock(folder);
    expect_refused(ErrorCode::IoFailure, "another run writes into this folder", [&] { run(folder); });
  }
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(Folder, IsLockedOnceAndOnlyIfItExists) {
  const fs::path missing = scratch.path() / "missing";
  expect_refused(ErrorCode::IoFailure, "missing: cannot open and lock: No such file or directory",
                 [&] { const parts::FolderLock lock(missing); });
  for (int run = 0; run < 2; ++run) {
    const parts::FolderLock lock(scratch.path());
    expect_refused(ErrorCode::IoFailure, "another run writes into this folder",
                   [&] { const parts::FolderLock second(scratch.path()); });
  }
  EXPECT_TRUE(fs::is_empty(scratch.path()));
}

TEST_F(Folder, IsWrittenByOneOfTwoRunsThatStartTogether) {
  std::size_t refused = 0;
  run(folder, [&](std::size_t done, std::size_t total) {
    if (done > 0 && done < total && refused == 0) {
      expect_refused(ErrorCode::IoFailure, "another run", [&] { run(folder); });
      ++refused;
    }
    return true;
  });
  EXPECT_EQ(refused, 1U);
  EXPECT_EQ(contents(folder), whole());
}

TEST_F(Folder, HasItsDamagedPartsWrittenAgain) {
  const auto expected = whole();
  std::size_t damaged = 0;
  for (const auto& [name, content] : expected) {
    if (name == parts::kManifestFile || content.empty()) continue;
    run(folder);
    const std::string shown = fs::path(name).make_preferred().string();
    std::string changed = content;
    changed[changed.size() / 2] = static_cast<char>(changed[changed.size() / 2] ^ 1);
    for (const std::string& bytes : {changed, content.substr(0, content.size() - 1), std::string()}) {
      overwrite(folder / name, bytes);
      if (name.ends_with(parts::kPartFile)) {
        expect_refused(ErrorCode::MalformedIndex, shown, [&] { run(folder); });
        overwrite(folder / name, content);
        continue;
      }
      const auto manifest = parts::read_manifest(folder);
      const auto number = static_cast<std::size_t>(name[9] - '0');
      const auto& files = manifest.parts[number].files;
      const auto listed = std::ranges::find(files, fs::path(name).filename().string(), &parts::PartFile::name);
      expect_refused(ErrorCode::MalformedIndex, shown,
                     [&] { parts::verify_file(folder / shown, std::as_bytes(std::span(bytes)), *listed); });
      const fs::path kept = folder / parts::part_name((number + 1) % 4) / "index.mhi";
      const auto written = fs::last_write_time(kept);
      EXPECT_EQ(run(folder).kept, 3U) << name;
      EXPECT_EQ(fs::last_write_time(kept), written) << "a part that is whole was written again";
      EXPECT_EQ(contents(folder), expected);
      ++damaged;
    }
  }
  fs::remove(folder / parts::part_name(2) / parts::kPartFile);
  EXPECT_EQ(run(folder).kept, 3U);
  fs::remove_all(folder / parts::part_name(3));
  fs::create_directory(folder / parts::part_name(3));
  EXPECT_EQ(run(folder).kept, 3U);
  EXPECT_EQ(contents(folder), expected);
  std::printf("%zu damaged files were found and written again\n", damaged);
  EXPECT_GE(damaged, 4U * 4 * 3);
}

TEST_F(Folder, OfOtherPartsHasAManifestOfAnotherChecksum) {
  run(folder);
  const std::uint64_t checksum = parts::read_manifest(folder).checksum;
  run(folder);
  EXPECT_EQ(parts::read_manifest(folder).checksum, checksum) << "of the same parts";
  PartitionOptions wider = kOptions;
  wider.halo *= 2;
  wider.resume = false;
  partition(*chunked(mesh), folder, wider);
  EXPECT_NE(parts::read_manifest(folder).checksum, checksum);
}

TEST_F(Folder, IsRefusedIfItsManifestHasBeenChanged) {
  run(folder);
  const fs::path file = folder / parts::kManifestFile;
  const std::string text = read_file(file);
  std::size_t changes = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string changed = text;
    changed[i] = changed[i] == '7' ? '8' : '7';
    for (const std::string& bytes : {changed, text.substr(0, i)}) {
      overwrite(file, bytes);
      expect_refused(ErrorCode::MalformedIndex, "manifest.json: ", [&] { return parts::read_manifest(folder); });
      ++changes;
    }
  }
  std::printf("%zu changes of the manifest were refused\n", changes);
}

TEST_F(Folder, IsRefusedIfItsManifestContradictsItself) {
  run(folder);
  const fs::path file = folder / parts::kManifestFile;
  const std::string text = read_file(file);
  // With the right checksum.
  const auto refuses = [&](const std::string& cause, const std::string& from, const std::string& to) {
    std::string rest = text.substr(text.find('\n') + 1);
    ASSERT_NE(rest.find(from), std::string::npos) << from;
    rest.replace(rest.find(from), from.size(), to);
    overwrite(file, sealed(rest));
    expect_refused(ErrorCode::MalformedIndex, "manifest.json: " + cause, [&] { return parts::read_manifest(folder); });
  };
  refuses("no JSON at byte", "{", "<\x9b\x7f");
  refuses("more than 8 levels", "{", "[[[[[[[[[");
  refuses("format 2, but this version reads format 1: install a newer meshhood", "\"format\": 1", "\"format\": 2");
  refuses("format 0, but this version reads format 1: partition the mesh again", "\"format\": 1", "\"format\": 0");
  refuses("'plan/vertices' is missing", "\"vertices\": 900", "\"vertexes\": 900");
  refuses("'plan/vertices' is not a whole number >= 0", "\"vertices\": 900", "\"vertices\": -900");
  refuses("'plan/vertices' is not a whole number >= 0", "\"vertices\": 900", "\"vertices\": 1e300");
  refuses("'plan/vertices' is not a whole number >= 0", "\"vertices\": 900", "\"vertices\": true");
  refuses("'plan/precision' is 'half'", "\"float\"", "\"half\"");
  refuses("'plan/halo' is -3", "\"halo\": 3.0", "\"halo\": -3.0");
  refuses("'plan/halo' is not a number", "\"halo\": 3.0", "\"halo\": null");
  refuses("'parts' is not an array", R"("parts": [)", R"("parts": 1, "others": [)");
  refuses("lists 4 parts of 5", "\"parts\": 4", "\"parts\": 5");
  refuses("the parts own 900 vertices of 901", "\"vertices\": 900", "\"vertices\": 901");
  refuses("a part that owns", "\"owned\": 2", "\"owned\": 9002");
}

TEST_F(Folder, IsRefusedIfItHasPartsOfAnotherMesh) {
  run(folder);
  const auto before = contents(folder);
  const auto refuses = [&](const std::string& cause, const TestMesh& other, const PartitionOptions& options) {
    expect_refused(ErrorCode::MalformedIndex, cause, [&] { partition(*chunked(other), folder, options); });
    EXPECT_EQ(contents(folder), before);
  };
  TestMesh moved = mesh;
  moved.positions[7] += 1e-3;
  moved.finish(mesh.single_precision);
  refuses("holds 4 parts of another mesh with halo 3 already", moved, kOptions);
  refuses("holds 4 parts of this mesh with halo 3 already", mesh, {.parts = 5, .halo = 3});
  refuses("holds 4 parts of this mesh with halo 3 already", mesh, {.parts = 4, .halo = 2});
  fs::remove(folder / parts::kManifestFile);
  expect_refused(ErrorCode::MalformedIndex, "is a part of another mesh",
                 [&] { partition(*chunked(moved), folder, kOptions); });
  for (const std::size_t part : {0U, 1U}) fs::remove_all(folder / parts::part_name(part));
  expect_refused(ErrorCode::MalformedIndex, "part.json: is a part of another mesh, or of another number",
                 [&] { partition(*chunked(mesh), folder, {.parts = 2, .halo = 3}); });

  // Without `resume`, the old parts are removed.
  PartitionOptions again = kOptions;
  again.resume = false;
  EXPECT_EQ(partition(*chunked(moved), folder, again).kept, 0U);
  EXPECT_EQ(partition(*chunked(moved), folder, kOptions).kept, 4U);
}

TEST_F(Folder, IsRefusedIfItHasFilesOfOthers) {
  for (const std::string file : {"thesis.txt", "part-00000/vertices.npy", "part-00003", "manifest.json",
                                 ".partition.tmp/index.mhi", "part-00000/part.json"}) {
    fs::remove_all(folder);
    expect_kept(file, "parts: has files, but not .partition, the mark of a partition; expected a new");
  }
}

TEST_F(Folder, KeepsFilesOfOthersInItsParts) {
  for (const std::string file : {"part-00001/owned.txt", "part-00001/thesis/part.json", "part-00001/index.mhi/x",
                                 "part-00004/owned.npy/x", "part-00004"}) {
    fs::remove_all(folder);
    run(folder);
    fs::remove(folder / parts::part_name(1) / parts::kIndexFile);
    expect_kept(file, "was not written by a partition, which would remove it");
  }
}

TEST_F(Folder, KeepsAPartThatIsWholeWithFilesOfOthers) {
  run(folder);
  overwrite(folder / parts::part_name(1) / ".DS_Store", "mine");
  const auto before = contents(folder);
  EXPECT_EQ(run(folder).kept, 4U);
  EXPECT_EQ(contents(folder), before);
}

TEST_F(Folder, KeepsWhatIsBesideItsParts) {
  auto expected = whole();
  run(folder);
  for (const std::string file : {"thesis.txt", "mywork/part.json", "part-mine/part.json", "part-2024-05-01/x.py",
                                 "part-2024-05-01/vertices.npy", "part-0001/owned.npy", "part-000001/part.json"}) {
    expected[file] = "mine";
    fs::create_directories((folder / file).parent_path());
    overwrite(folder / file, "mine");
  }
  fs::create_directory(folder / "part-7-8");
  PartitionOptions options = kOptions;
  for (const bool resume : {true, false, true}) {
    options.resume = resume;
    partition(*chunked(mesh), folder, options);
    EXPECT_EQ(contents(folder), expected);
    EXPECT_TRUE(fs::exists(folder / "part-7-8"));
  }
}

TEST_F(Folder, IsWrittenAgainWithoutItsDamagedManifest) {
  run(folder);
  const auto expected = contents(folder);
  PartitionOptions options = kOptions;
  options.resume = false;
  for (const std::string& text : {std::string(), "X" + expected.at("manifest.json").substr(1), std::string("X")}) {
    overwrite(folder / parts::kManifestFile, text);
    expect_refused(ErrorCode::MalformedIndex, "manifest.json: has been changed or truncated", [&] { run(folder); });
    EXPECT_EQ(partition(*chunked(mesh), folder, options).kept, 0U);
    EXPECT_EQ(contents(folder), expected);
  }
}

TEST_F(Folder, KeepsThePlaceToWhichAPartIsALink) {
#ifdef _WIN32
  GTEST_SKIP() << "MinGW makes no links";
#endif
  run(folder);
  const auto expected = contents(folder);
  const fs::path place = scratch.path() / "place";
  fs::rename(folder / parts::part_name(0), place);
  fs::create_directory_symlink(place, folder / parts::part_name(0));
  EXPECT_EQ(run(folder).kept, 4U);
  overwrite(place / parts::kIndexFile, "damaged");
  EXPECT_EQ(run(folder).kept, 3U);
  EXPECT_EQ(contents(folder), expected);
  EXPECT_EQ(read_file(place / parts::kIndexFile), "damaged");
}

// Whatever a run has in its temporary folder at any time, and a part of which it has removed some files.
TEST_F(Folder, HasWhatAStoppedRunHasLeftRemoved) {
#ifdef _WIN32
  GTEST_SKIP() << "MinGW takes two files for one where a folder is copied";
#endif
  const fs::path left = scratch.path() / "left";
  run(folder, [&](std::size_t, std::size_t) {
    const fs::path now = folder / parts::kTemporaryFolder;
    constexpr auto kAll = fs::copy_options::recursive | fs::copy_options::overwrite_existing;
    if (fs::exists(now)) fs::copy(now, left, kAll);
    return true;
  });
  fs::copy(folder / parts::part_name(1), left / parts::part_name(1));
  EXPECT_GT(contents(left).size(), 15U);
  const auto expected = contents(folder);
  fs::remove(folder / parts::kManifestFile);
  fs::remove(folder / parts::part_name(1) / parts::kIndexFile);
  fs::rename(left, folder / parts::kTemporaryFolder);
  EXPECT_EQ(run(folder).kept, 3U);
  EXPECT_EQ(contents(folder), expected);
}

TEST_F(Folder, IsRefusedIfItsPartsHaveOtherNumbers) {
  run(folder);
  fs::rename(folder / parts::part_name(0), folder / "kept");
  fs::rename(folder / parts::part_name(1), folder / parts::part_name(0));
  fs::rename(folder / "kept", folder / parts::part_name(1));
  expect_refused(ErrorCode::MalformedIndex, "part.json: is a part of another mesh", [&] { run(folder); });
}

TEST_F(Folder, IsNotMadeForAMeshWithAFault) {
  TestMesh wrong = mesh;
  wrong.corners.back() = 900;
  expect_refused(ErrorCode::InvalidMesh, "face 1681: corner 2 is vertex 900, but the mesh has 900 vertices",
                 [&] { partition(*chunked(wrong), folder, kOptions); });
  wrong = mesh;
  wrong.positions[4] = kInfinity;
  wrong.finish(wrong.single_precision);
  expect_refused(ErrorCode::InvalidMesh, "vertex 1: y is inf", [&] { partition(*chunked(wrong), folder, kOptions); });
  EXPECT_TRUE(fs::is_empty(folder));
  expect_refused(ErrorCode::IoFailure, "No such file or directory", [&] { run(scratch.path() / "no" / "parts"); });
  expect_refused(ErrorCode::IoFailure, "Not a directory", [&] { run(scratch.write("file", "text")); });
}

}  // namespace
}  // namespace meshhood::test
