// SPDX-License-Identifier: MIT
// meshhood batch: the neighborhoods of all vertices, or of a list, in CSR form.
#include "meshhood/batch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands.h"
#include "input.h"
#include "io/npz_writer.h"
#include "methods.h"
#include "options.h"
#include "output.h"
#include "row_table.h"
#include "system.h"
#include "table_file.h"
#include "task.h"

namespace meshhood::cli {
namespace {

/// An estimate from random rows.
struct BatchEstimate {
  AnswerSize mean;
  AnswerSize lower;  ///< three standard errors below the mean
};

/// Takes about half a second. Empty for few rows, which are counted as fast.
std::optional<BatchEstimate> estimate(const SearchMethod& method, const BatchQuery& query) {
  constexpr std::size_t kSamples = 256;
  constexpr std::size_t kSamplesPerStep = 4;
  // Vertices, about half a second. Counted rather than timed, so that every machine draws the same sample.
  constexpr double kMostWork = 0x1p26;
  const std::size_t rows = query.vertices.count(method.vertex_count());
  if (rows <= kSamples) return std::nullopt;
  std::mt19937_64 random(1);
  std::vector<VertexId> vertices(kSamplesPerStep);
  std::vector<double> radii(kSamplesPerStep);
  const BatchRadius radius = query.radius.list() ? BatchRadius(radii) : query.radius;
  double drawn = 0;  // rows, and the sums of their sizes and of the squares of these
  double sum = 0;
  double squares = 0;
  // A call of a scan, or of a search that copies the positions, also takes a time that grows with the mesh.
  const auto work_of_call = static_cast<double>(method.vertex_count());
  for (double work = 0; drawn < kSamples && work < kMostWork; work = sum + work_of_call * drawn / kSamplesPerStep) {
    for (std::size_t i = 0; i < kSamplesPerStep; ++i) {
      const std::size_t row = random() % rows;
      vertices[i] = query.vertices[row];
      if (query.radius.list()) radii[i] = (*query.radius.list())[row];
    }
    for (const std::uint64_t size : counts(method, {.vertices = vertices, .radius = radius, .metric = query.metric})) {
      drawn += 1;
      sum += static_cast<double>(size);
      squares += static_cast<double>(size) * static_cast<double>(size);
    }
  }
  const double mean = sum / drawn;
  const double standard_error = std::sqrt(std::max(0.0, squares / drawn - mean * mean) / drawn);
  const auto of_all_rows = [rows](double size) {
    return AnswerSize{rows, static_cast<std::uint64_t>(static_cast<double>(rows) * size)};
  };
  return BatchEstimate{of_all_rows(mean), of_all_rows(std::max(0.0, mean - 3 * standard_error))};
}

struct BatchCommand {
  Reading reading;
  RowOptions rows;
  std::string order;  ///< as typed, empty for the default; from `with_order` on index, vertex or list
  MethodOptions search;
  bool count = false;
  bool distances = false;
  bool json = false;
  std::optional<std::uint64_t> max_bytes;
  TableFile output;
};

/// Arrays of rows come in index order, which is the fastest. Sizes are found as fast in vertex order, where the number
/// of a row is that of its vertex, and text is read by people.
BatchCommand with_order(BatchCommand options) {
  const bool is_exact = options.search.method == "exact";
  if (options.order == "index" && !is_exact) wrong_option("--order index: expected --method exact");
  const bool is_fastest_by_index = is_exact && !options.count && !options.output.is_csv();
  if (options.order.empty()) options.order = is_fastest_by_index ? "index" : "vertex";
  if (!options.rows.vertices.empty()) options.order = "list";
  return options;
}

/// Whether the file says of which vertex a row is.
bool has_vertices(const BatchCommand& options) { return options.order != "vertex"; }

/// Rows in vertex order or in that of a list are a sparse matrix that `scipy.sparse.load_npz` reads: `format`, `shape`,
/// `indptr`, `indices`, `data`; `vertices` has the list. Rows in index order are not stored as a matrix, because SciPy
/// would ignore `vertices` and take row `i` for that of vertex `i`. They are `vertices`, `indptr`, `indices`,
/// `distances`, and SciPy refuses them.
bool is_matrix(const BatchCommand& options) { return options.order != "index"; }

/// SciPy uses 32-bit indices where they suffice, and would convert others. `count`: of the stored values.
bool fits_32_bits(std::uint64_t count, std::uint64_t columns) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::int32_t>::max();
  return count <= kMost && columns <= kMost;
}

/// Whether the command sorts the rows itself, and not the search: those of paths, in index order.
bool sorts_rows(const BatchCommand& options) {
  return options.search.sort == "index" && value_of(kMetrics, options.search.metric) == Metric::Path;
}

/// The approximate size of the file: the members without the zip headers. The ones of a matrix without distances
/// are compressed: 258 of them take 13 bits.
double file_bytes(const BatchCommand& options, const AnswerSize& total, std::size_t columns) {
  const auto rows = static_cast<double>(total.rows);
  const auto count = static_cast<double>(total.count);
  const double vertices = has_vertices(options) ? 8 * rows : 0;
  const double radii = options.rows.row_radii.empty() ? 0 : 8 * rows;
  if (options.count) return vertices + radii + 8 * rows * static_cast<double>(options.rows.scale_count());
  const double index_bytes = fits_32_bits(total.count, columns) ? 4 : 8;
  return vertices + index_bytes * (rows + count) + (options.distances ? 8 : 13.0 / 8 / 258) * count;
}

/// One for each array of the file whose length is that of the answer, and one to count.
std::size_t number_of_passes(const BatchCommand& options) {
  return options.output.is_csv() ? 1 : options.distances ? 3 : 2;
}

/// Text is refused while it is written.
void check_answer(const BatchCommand& options, const AnswerSize& size, std::size_t columns,
                  std::string_view about = "") {
  if (options.output.is_csv()) return;
  check_size(options.output.name, options.max_bytes, size, file_bytes(options, size, columns), about);
}

AnswerSize size_of(std::span<const std::uint64_t> sizes, std::size_t scales) {
  return {sizes.size() / scales, std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0})};
}

/// Those that the file names.
BatchVertices listed_rows(const BatchCommand& options, const BatchQuery& query) {
  return has_vertices(options) ? query.vertices : BatchVertices();
}

AnswerSize write_counts(const SearchMethod& method, const BatchQuery& query, const BatchCommand& options) {
  std::vector<std::uint64_t> sizes = [&] {
    Task task("computing", {"rows", 1});
    return counts(method, query, {.threads = options.rows.threads, .progress = task.progress()});
  }();
  const std::size_t scales = options.rows.scale_count();
  const AnswerSize total = size_of(sizes, scales);
  RowTable table{.rows = total.rows,
                 .scales = scales,
                 .scale_names = options.rows.radii.values,
                 .columns = {{"count", std::move(sizes), scales}}};
  table.add_properties({"count"});
  table.max_bytes = options.max_bytes;
  check_answer(options, total, method.vertex_count());
  write_rows(options.output, std::move(table), listed_rows(options, query), query.radius);
  return total;
}

/// Writes the rows of a batch, of one radius. The length of an array precedes its values, so the rows are counted
/// first. Then each array is computed and written in a pass of its own, so that memory holds only a few numbers per
/// row. Text is written in one pass.
class Writer {
 public:
  Writer(const SearchMethod& method, const BatchQuery& query, const BatchCommand& options, RowOrder& order, Task& task)
      : method_(method), query_(query), options_(options), order_(order), task_(task) {}

  AnswerSize write() {
    if (options_.output.is_csv()) return write_pairs();
    const std::vector<std::uint64_t> sizes = counts(method_, query_, next_run());
    const AnswerSize total = size_of(sizes, 1);
    check_answer(options_, total, method_.vertex_count());
    write_arrays(sizes, total);
    return total;
  }

 private:
  /// A line for each vertex of each row.
  AnswerSize write_pairs() {
    CsvWriter csv(options_.output.name, pair_names(options_.distances), options_.max_bytes);
    const BatchVertices listed = listed_rows(options_, query_);
    AnswerSize total;
    for_each_row(options_.distances, [&](std::span<const VertexId> ids, std::span<const double> distances) {
      const VertexId v = listed[total.rows++];
      total.count += ids.size();
      for (std::size_t i = 0; i < ids.size(); ++i) {
        csv.add(v);
        csv.add(ids[i]);
        if (options_.distances) csv.add(distances[i]);
        csv.end_row();
      }
    });
    Task::check_cancelled();
    csv.commit();
    return total;
  }

  void write_arrays(std::span<const std::uint64_t> sizes, const AnswerSize& total) {
    io::NpzWriter npz(path_of(options_.output.name));
    write_vertices(npz, listed_rows(options_, query_));
    const std::uint64_t columns = method_.vertex_count();
    if (is_matrix(options_)) {
      const std::array<std::int64_t, 2> shape{static_cast<std::int64_t>(total.rows),
                                              static_cast<std::int64_t>(columns)};
      npz.add_text("format", "csr");
      npz.add<std::int64_t>("shape", shape);
    }
    if (fits_32_bits(total.count, columns)) {
      write_pattern<std::int32_t>(npz, sizes, total);
    } else {
      write_pattern<std::int64_t>(npz, sizes, total);
    }
    if (options_.distances) {
      npz.begin<double>(is_matrix(options_) ? "data" : "distances", total.count);
      for_each_row(
          true, [&](std::span<const VertexId> /*ids*/, std::span<const double> distances) { npz.append(distances); });
    } else if (is_matrix(options_)) {
      npz.add_ones("data", total.count);
    }
    Task::check_cancelled();
    npz.commit();
  }

  template <class Integer>
  void write_pattern(io::NpzWriter& npz, std::span<const std::uint64_t> sizes, const AnswerSize& total) {
    std::vector<Integer> offsets(sizes.size() + 1);
    std::transform_inclusive_scan(sizes.begin(), sizes.end(), offsets.begin() + 1, std::plus<>(),
                                  [](std::uint64_t size) { return static_cast<Integer>(size); });
    npz.add<Integer>("indptr", offsets);
    std::vector<Integer> converted;
    const auto write = [&](std::span<const VertexId> ids, std::span<const double> /*distances*/) {
      converted.assign(ids.begin(), ids.end());
      npz.append<Integer>(converted);
    };
    npz.begin<Integer>("indices", total.count);
    for_each_row(false, write);
  }

  /// Calls `write(ids, distances)` for each row, sorted as the options say.
  template <class Write>
  void for_each_row(bool with_distances, Write&& write) {
    const RowSort sort = value_of(kSorts, options_.search.sort);
    const BatchOptions pass{.distances = with_distances || sort == RowSort::Distance,
                            .sort = sort,
                            .in_index_order = options_.order == "index"};
    const bool sorts = sorts_rows(options_);
    std::vector<VertexId> ids;
    std::vector<double> distances;
    const auto pass_on = [&](const BatchRow& row) {
      if (!sorts) return write(row.ids, row.distances);
      ids.assign(row.ids.begin(), row.ids.end());
      distances.assign(row.distances.begin(), row.distances.end());
      order_.sort(ids, distances);
      write(std::span<const VertexId>(ids), std::span<const double>(distances));
    };
    for_each_neighborhood(method_, query_, pass_on, pass, next_run());
  }

  Run next_run() {
    return {.threads = options_.rows.threads, .progress = task_.progress(passes_begun_++, number_of_passes(options_))};
  }

  const SearchMethod& method_;
  const BatchQuery& query_;
  const BatchCommand& options_;
  RowOrder& order_;
  Task& task_;
  std::size_t passes_begun_ = 0;
};

std::string task_name(const BatchCommand& options, const std::optional<BatchEstimate>& estimate, std::size_t columns) {
  if (!estimate) return "computing";
  return fmt::format("computing {} rows, about {}", estimate->mean.rows,
                     bytes_text(file_bytes(options, estimate->mean, columns)));
}

AnswerSize write(const SearchMethod& method, const BatchQuery& query, const BatchCommand& options, RowOrder& order) {
  if (options.count) return write_counts(method, query, options);
  const std::optional<BatchEstimate> expected = options.output.is_csv() ? std::nullopt : estimate(method, query);
  const std::size_t columns = method.vertex_count();
  if (expected) check_answer(options, expected->lower, columns, "at least ");
  Task task(task_name(options, expected, columns),
            {"rows", static_cast<double>(number_of_passes(options))});  // outlives the temporary file
  return Writer(method, query, options, order, task).write();
}

/// Without the vertices that have become others.
std::vector<VertexId> all_in_index_order(const Index& index, const Welding& welding) {
  std::vector<VertexId> result(index.permutation().begin(), index.permutation().end());
  if (result.empty()) {  // the orders are equal
    result.resize(index.vertex_count());
    std::iota(result.begin(), result.end(), VertexId{0});
  }
  std::erase_if(result, [&](VertexId v) { return welding.kept(v) != v; });
  return result;
}

void check_options(const BatchCommand& options) {
  need_radii(options.rows);
  if (options.output.name.empty()) wrong_option("expected --output or --csv");
  check_method(options.search, options.reading, !options.rows.masks.empty(), options.rows.radii.unit);
  const std::size_t radii = options.rows.scale_count();
  if (radii > 1 && !options.count) {
    wrong_option("--radius: {} radii, expected one{}", radii, options.distances ? " with --distances" : ", or --count");
  }
}

void batch(const BatchCommand& typed) {
  check_options(typed);
  check_outputs();
  const BatchCommand options = with_order(typed);
  const unsigned threads = options.rows.threads;
  Input input(options.reading, threads);
  const RowQuery rows(options.rows, input);
  BatchQuery query = options.count ? rows.query() : rows.query_of_first();
  query.metric = choose_metric(options.search.metric, input);
  if (query.metric == Metric::Space) input.ignore_welded();
  const SearchMethod method = method_of(options.search, input, {}, threads);
  RowOrder order = row_order(options.search.sort, input);
  std::vector<VertexId> in_index_order;
  std::vector<double> radii_in_index_order;
  if (options.order == "index") {
    in_index_order = all_in_index_order(input.exact_index(threads), input.welding());
    query.vertices = in_index_order;
    if (query.radius.list()) {
      for (const VertexId v : in_index_order) radii_in_index_order.push_back(rows.radii()[v]);
      query.radius = radii_in_index_order;
    }
  }
  const AnswerSize total = write(method, query, options, order);
  print_result(options.json,
               {{"output", options.output.name},
                {"method", options.search.method},
                {"metric", options.search.metric},
                {"order", options.order},
                {"rows", total.rows},
                {"count", total.count}},
               fmt::format("{}: {} rows{}, {} vertices in them\n", printable_name(options.output.name), total.rows,
                           options.order == "index" ? " in index order" : "", total.count));
}

}  // namespace

void add_batch(CLI::App& program) {
  const auto [command, options] =
      add_command(program, "batch", "Write the neighborhoods of all vertices, or of a list, in CSR form", batch);
  add_file(command, options.reading);
  add_rows(command, options.rows);
  add_choice(
      command, "--order",
      "order of all rows; index: the fastest, with the array vertices; vertex: a matrix for scipy.sparse.load_npz "
      "(default: index; with --count, a table or another method: vertex)",
      {"index", "vertex"}, options.order)
      ->excludes("--vertices");
  add_method(command, options.search);
  CLI::Option* count = command.add_flag("--count", options.count,
                                        "write only the number of vertices of each row, for one radius or several");
  command
      .add_flag("--distances", options.distances,
                "also write distances in the metric of the radius: the array distances, or the values of the matrix")
      ->excludes(count);
  add_max_bytes(command, options.max_bytes);
  add_table_output(command, ".npz", "file to write: arrays, or a table with a line for each vertex of each row",
                   options.output);
  add_json(command, options.json);
}

}  // namespace meshhood::cli
