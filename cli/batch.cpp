// SPDX-License-Identifier: MIT
// meshhood batch: the neighborhoods of all vertices, or of a list, as a sparse matrix.
#include "meshhood/batch.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "input.h"
#include "io/npz_writer.h"
#include "matrix_file.h"
#include "methods.h"
#include "options.h"
#include "output.h"
#include "shard.h"
#include "size_limit.h"
#include "task.h"
#include "vertex_files.h"

namespace meshhood::cli {
namespace {

struct BatchCommand {
  std::string file;
  Radius radius;
  std::string vertices;  ///< a file with a list; empty for all
  bool index_order = false;
  std::string method = "exact";
  unsigned threads = kAllThreads;
  bool count = false;
  bool distances = false;
  bool json = false;
  std::string shard;  ///< as typed; empty for all rows
  std::optional<std::uint64_t> max_bytes;
  std::string output;
};

/// The approximate size of the file: the members without the zip headers. The ones of a matrix without distances
/// compress to a thousandth.
double file_bytes(const BatchCommand& options, const BatchSize& total, std::size_t columns) {
  const auto rows = static_cast<double>(total.rows);
  const auto count = static_cast<double>(total.count);
  if (options.count) return 8 * rows;
  const double index_bytes = fits_32_bits(total.count, columns) ? 4 : 8;
  return index_bytes * (rows + count) + (options.distances ? 8 : 1e-3) * count;
}

/// One for each array of the file whose length is that of the answer, and one to count.
std::size_t number_of_passes(const BatchCommand& options) { return options.count ? 1 : options.distances ? 3 : 2; }

/// Writes the rows of a batch. The length of an array precedes its values, so the rows are counted first. Then
/// each array is computed and written in a pass of its own, so that memory holds only a few numbers per row.
class Writer {
 public:
  Writer(const SearchMethod& method, const BatchQuery& query, const BatchCommand& options, const SizeLimit& limit,
         Task& task, io::NpzWriter& npz)
      : method_(method), query_(query), options_(options), limit_(limit), task_(task), npz_(npz) {}

  BatchSize write() {
    const std::vector<std::uint64_t> sizes = neighborhood_sizes(method_, query_, next_pass());
    const BatchSize total{sizes.size(), std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0})};
    limit_.check(total, file_bytes(options_, total, method_.vertex_count()));
    if (options_.count) {
      npz_.add<std::uint64_t>("count", sizes);
    } else {
      write_matrix(sizes, total);
    }
    return total;
  }

 private:
  void write_matrix(std::span<const std::uint64_t> sizes, const BatchSize& total) {
    begin_matrix(npz_, total.rows, method_.vertex_count());
    if (fits_32_bits(total.count, method_.vertex_count())) {
      write_pattern<std::int32_t>(sizes, total);
    } else {
      write_pattern<std::int64_t>(sizes, total);
    }
    options_.distances ? write_distances(total) : write_ones(npz_, total.count);
  }

  template <class Integer>
  void write_pattern(std::span<const std::uint64_t> sizes, const BatchSize& total) {
    std::vector<Integer> offsets(sizes.size() + 1);
    std::transform_inclusive_scan(sizes.begin(), sizes.end(), offsets.begin() + 1, std::plus<>(),
                                  [](std::uint64_t size) { return static_cast<Integer>(size); });
    npz_.add<Integer>("indptr", offsets);
    std::vector<Integer> ids;
    const auto write = [&](const BatchRow& row) {
      ids.assign(row.ids.begin(), row.ids.end());
      npz_.append<Integer>(ids);
    };
    npz_.begin<Integer>("indices", total.count);
    for_each_neighborhood(method_, query_, write, next_pass());
  }

  void write_distances(const BatchSize& total) {
    npz_.begin<double>("data", total.count);
    BatchOptions pass = next_pass();
    pass.distances = true;
    for_each_neighborhood(method_, query_, [&](const BatchRow& row) { npz_.append(row.distances); }, pass);
  }

  BatchOptions next_pass() {
    return {.threads = options_.threads,
            .sorted = true,
            .progress = task_.progress(passes_begun_++, number_of_passes(options_))};
  }

  const SearchMethod& method_;
  const BatchQuery& query_;
  const BatchCommand& options_;
  const SizeLimit& limit_;
  Task& task_;
  io::NpzWriter& npz_;
  std::size_t passes_begun_ = 0;
};

std::string task_name(const BatchCommand& options, const std::optional<BatchEstimate>& estimate, std::size_t columns) {
  if (!estimate) return "computing";
  return fmt::format("computing {} rows, about {:.3g} MB", estimate->mean.rows,
                     file_bytes(options, estimate->mean, columns) / 1e6);
}

/// The description of a shard and of its batch.
std::string describe(const BatchCommand& options, const Shard& shard, double radius, std::size_t rows,
                     const Fingerprint& mesh, std::size_t columns) {
  return Json{{"number", shard.number},
              {"shards", shard.count},
              {"rows", rows},
              {"listed", !options.vertices.empty() || options.index_order},
              {"columns", columns},
              {"mesh", to_text(mesh)},
              {"method", options.method},
              {"radius", radius},
              {"count", options.count},
              {"distances", options.distances}}
      .dump();
}

/// `shard`: the text of its own array; empty if all rows are written.
BatchSize write(const SearchMethod& method, const BatchQuery& query, const BatchCommand& options,
                const std::string& shard) {
  const SizeLimit limit(options.output, options.max_bytes);
  const std::optional<BatchEstimate> expected = estimate(method, query);
  const std::size_t columns = method.vertex_count();
  if (expected) limit.check(expected->lower, file_bytes(options, expected->lower, columns), "at least ");
  Task task(task_name(options, expected, columns),
            {"rows", static_cast<double>(number_of_passes(options))});  // outlives the temporary file
  io::NpzWriter npz(options.output);
  write_vertices(npz, query.vertices);
  if (!shard.empty()) npz.add_text(kShardArray, shard);
  const BatchSize total = Writer(method, query, options, limit, task, npz).write();
  Task::check_cancelled();
  npz.commit();
  return total;
}

/// The query vertices of a shard of `rows`.
std::vector<VertexId> vertices_of(const Shard& shard, const BatchVertices& rows, std::size_t vertices) {
  const std::size_t count = row_count(rows, vertices);
  const std::size_t first = shard.first_row(count);
  std::vector<VertexId> result(shard.end_row(count) - first);
  if (const auto& list = rows.list()) {
    std::copy_n(list->begin() + static_cast<std::ptrdiff_t>(first), result.size(), result.begin());
  } else {
    std::iota(result.begin(), result.end(), static_cast<VertexId>(first));
  }
  return result;
}

std::vector<VertexId> all_in_index_order(const BatchCommand& options, Input& input) {
  if (options.method != "exact") raise(ErrorCode::InvalidOption, "--index-order: expected --method exact");
  const Index& index = input.exact_index(options.threads);
  std::vector<VertexId> result(index.permutation().begin(), index.permutation().end());
  if (result.empty()) {  // the orders are equal
    result.resize(index.vertex_count());
    std::iota(result.begin(), result.end(), VertexId{0});
  }
  return result;
}

void batch(const BatchCommand& options) {
  check_output(options.output, {options.file, options.vertices});
  Input input(options.file);
  const QueryVertices vertices(options.vertices, input.vertex_count());
  BatchQuery query{.vertices = vertices.view(), .radius = resolve(options.radius, input)};
  const SearchMethod method = batch_method(options.method, input, options.threads);
  std::vector<VertexId> in_index_order;
  if (options.index_order) {
    in_index_order = all_in_index_order(options, input);
    query.vertices = in_index_order;
  }
  std::string about;
  std::vector<VertexId> of_shard;
  if (!options.shard.empty()) {
    const Shard shard = parse_shard(options.shard);
    about = describe(options, shard, query.radius.common(), row_count(query.vertices, input.vertex_count()),
                     input.fingerprint(), input.vertex_count());
    of_shard = vertices_of(shard, query.vertices, input.vertex_count());
    query.vertices = of_shard;
  }
  const BatchSize total = write(method, query, options, about);
  print_result(
      options.json,
      {{"output", options.output}, {"method", options.method}, {"rows", total.rows}, {"count", total.count}},
      fmt::format("{}: {} rows, {} vertices in them\n", printable_name(options.output), total.rows, total.count));
}

}  // namespace

void add_batch(CLI::App& program) {
  auto options = std::make_shared<BatchCommand>();
  CLI::App* command =
      program.add_subcommand("batch", "Write the neighborhoods of all vertices as a sparse matrix for SciPy");
  add_file(*command, options->file);
  add_radius(*command, options->radius);
  add_vertices(*command, options->vertices);
  command
      ->add_flag("--index-order", options->index_order,
                 "write the rows in the order of the index, which the array vertices contains; faster "
                 "for a mesh in random order")
      ->excludes("--vertices");
  add_method(*command, options->method);
  add_threads(*command, options->threads);
  CLI::Option* count = command->add_flag("--count", options->count, "write only the number of vertices of each row");
  command
      ->add_flag("--distances", options->distances,
                 "write straight-line distances as the values of the matrix, not ones")
      ->excludes(count);
  add_max_bytes(*command, options->max_bytes);
  command
      ->add_option("--shard", options->shard,
                   "compute piece i of N of the rows, for meshhood merge; slurm/N: i from SLURM_ARRAY_TASK_ID")
      ->type_name("i/N");
  add_output(*command, ".npz", "file to write", options->output)->required();
  add_json(*command, options->json);
  command->callback([options] { batch(*options); });
}

}  // namespace meshhood::cli
