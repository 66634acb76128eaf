// SPDX-License-Identifier: MIT
// meshhood merge: joins the files of `meshhood batch --shard`.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "io/npz_reader.h"
#include "io/npz_writer.h"
#include "options.h"
#include "output.h"
#include "row_file.h"
#include "shard.h"
#include "task.h"

namespace meshhood::cli {
namespace {

struct MergeCommand {
  std::vector<std::string> files;
  std::string output;
  bool json = false;
};

/// A file of a batch and its description.
struct ShardFile {
  std::string name;
  Json about;  ///< without the number of the shard
  Shard shard;
};

[[noreturn]] void refuse(const std::string& file, std::string_view reason) {
  raise(ErrorCode::InvalidOption, fmt::format("{}: {}", printable_name(file), reason));
}

ShardFile open(const std::string& name) {
  io::NpzReader reader(name);
  if (!reader.has(kShardArray)) refuse(name, "is not a shard: it was not written by meshhood batch --shard");
  try {
    Json about = Json::parse(reader.text(kShardArray));
    const Shard shard{about.at("number").get<std::uint64_t>(), about.at("shards").get<std::uint64_t>()};
    if (shard.number == 0 || shard.number > shard.count) refuse(name, "has a number out of range");
    about.erase("number");
    for (const char* const key : {"rows", "columns"}) static_cast<void>(about.at(key).get<std::uint64_t>());
    for (const char* const key : {"count", "distances"}) static_cast<void>(about.at(key).get<bool>());
    if (!is_name_of(kRowOrders, about.at("order").get<std::string>())) refuse(name, "has rows in an unknown order");
    return {name, std::move(about), shard};
  } catch (const Json::exception& error) {
    refuse(name, fmt::format("has no valid description of its shard: {}", error.what()));
  }
}

/// The first property in which two shards differ.
std::string difference(const Json& about, const Json& first) {
  for (const auto& [key, value] : first.items()) {
    if (!about.contains(key)) return key;
    if (about[key] != value) return fmt::format("{} {}, expected {}", key, about[key].dump(), value.dump());
  }
  return "other properties";
}

/// In order; each shard of the batch once.
std::vector<ShardFile> open_all(const std::vector<std::string>& names) {
  std::vector<ShardFile> files;
  files.reserve(names.size());
  for (const std::string& name : names) files.push_back(open(name));
  for (const ShardFile& file : files) {
    if (file.about == files[0].about) continue;
    refuse(file.name, fmt::format("is a shard of another batch than {}: {}", printable_name(files[0].name),
                                  difference(file.about, files[0].about)));
  }
  std::sort(files.begin(), files.end(),
            [](const ShardFile& a, const ShardFile& b) { return a.shard.number < b.shard.number; });
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::uint64_t number = files[i].shard.number;
    if (number == i + 1) continue;
    if (number <= i) refuse(files[i].name, fmt::format("is shard {}, as is {}", number, files[i - 1].name));
    refuse(files[i].name,
           fmt::format("is shard {} of {}, but shard {} is missing", number, files[i].shard.count, i + 1));
  }
  if (files.size() < files[0].shard.count) {
    refuse(files.back().name, fmt::format("is shard {} of {}, but shard {} is missing", files.size(),
                                          files[0].shard.count, files.size() + 1));
  }
  return files;
}

/// Writes what the batch without shards would have written.
class Merger {
 public:
  Merger(std::vector<ShardFile> files, io::NpzWriter& npz, Task& task)
      : files_(std::move(files)), npz_(npz), task_(task), rows_(files_[0].about.at("rows").get<std::uint64_t>()) {}

  std::uint64_t merge() {
    const Json& about = files_[0].about;
    const RowOrder order = value_of(kRowOrders, about.at("order").get<std::string>());
    if (has_vertices(order)) copy<std::int64_t>("vertices", rows_);
    if (about.at("count").get<bool>()) {
      copy_radius();
      npz_.begin<std::uint64_t>("count", std::array<std::uint64_t, 2>{1, rows_});
      copy_values<std::int64_t, std::uint64_t>("count", rows_);
      return rows_;
    }
    const auto columns = about.at("columns").get<std::uint64_t>();
    const std::vector<std::int64_t> offsets = joined_offsets();
    const auto total = static_cast<std::uint64_t>(offsets.back());
    begin_rows(npz_, order, rows_, columns);
    if (fits_32_bits(total, columns)) {
      npz_.add<std::int32_t>("indptr", std::vector<std::int32_t>(offsets.begin(), offsets.end()));
      copy<std::int64_t, std::int32_t>("indices", total);
    } else {
      npz_.add<std::int64_t>("indptr", offsets);
      copy<std::int64_t>("indices", total);
    }
    about.at("distances").get<bool>() ? copy<double>(distances_name(order), total) : end_rows(npz_, order, total);
    return rows_;
  }

 private:
  /// Which all files have.
  void copy_radius() {
    io::NpzReader reader(files_[0].name);
    reader.begin("radii");
    std::vector<double> radii;
    if (reader.left() != 1 || !reader.read(radii)) refuse(files_[0].name, "has not the one radius of a shard");
    npz_.add<double>("radii", radii);
  }

  [[nodiscard]] std::vector<std::int64_t> joined_offsets() const {
    std::vector<std::int64_t> all{0};
    for (const ShardFile& file : files_) {
      const std::vector<std::int64_t> offsets = io::NpzReader(file.name).integers("indptr");
      if (offsets.size() != file.shard.end_row(rows_) - file.shard.first_row(rows_) + 1) {
        refuse(file.name, fmt::format("has {} rows, which is not the number of its shard", offsets.size()));
      }
      const std::int64_t before = all.back();
      for (std::size_t i = 1; i < offsets.size(); ++i) all.push_back(before + offsets[i]);
    }
    return all;
  }

  /// Writes an array of all files, `total` values of type `In`, as one of type `Out`.
  template <class In, class Out = In>
  void copy(std::string_view name, std::uint64_t total) {
    npz_.begin<Out>(name, total);
    copy_values<In, Out>(name, total);
  }

  template <class In, class Out>
  void copy_values(std::string_view name, std::uint64_t total) {
    std::uint64_t done = 0;
    std::vector<In> values;
    for (const ShardFile& file : files_) {
      io::NpzReader reader(file.name);
      reader.begin(name);
      if (reader.left() > total - done) refuse(file.name, fmt::format("has too many values in '{}'", name));
      while (reader.read(values)) {
        const std::vector<Out> converted(values.begin(), values.end());
        npz_.append<Out>(converted);
        task_.report(done += values.size(), total);
        Task::check_cancelled();
      }
    }
    if (done != total) refuse(files_.back().name, fmt::format("'{}' has {} values too few", name, total - done));
  }

  std::vector<ShardFile> files_;
  io::NpzWriter& npz_;
  Task& task_;
  std::uint64_t rows_;
};

std::uint64_t merge_files(const MergeCommand& options) {
  std::vector<ShardFile> files = open_all(options.files);
  Task task("merging");
  io::NpzWriter npz(options.output);
  const std::uint64_t rows = Merger(std::move(files), npz, task).merge();
  npz.commit();
  return rows;
}

void merge(const MergeCommand& options) {
  check_outputs();
  const std::uint64_t rows = merge_files(options);
  print_result(options.json, {{"output", options.output}, {"shards", options.files.size()}, {"rows", rows}},
               fmt::format("{}: {} rows of {} shards\n", printable_name(options.output), rows, options.files.size()));
}

}  // namespace

void add_merge(CLI::App& program) {
  auto options = std::make_shared<MergeCommand>();
  CLI::App* command = program.add_subcommand("merge", "Join the files that batch --shard has written");
  command->add_option("SHARD", options->files, "all shards of a batch, in any order")
      ->required()
      ->check(stored_name("SHARD"))
      ->type_name("");
  add_output(*command, ".npz", "file to write", options->output)->required();
  add_json(*command, options->json);
  command->callback([options] { merge(*options); });
}

}  // namespace meshhood::cli
