// SPDX-License-Identifier: MIT
// meshhood batch: the neighborhoods of all vertices, or of a list, in CSR form.
#include "meshhood/batch.h"

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
#include "methods.h"
#include "options.h"
#include "output.h"
#include "quantity.h"
#include "row_file.h"
#include "row_query.h"
#include "size_limit.h"
#include "task.h"
#include "vertex_order.h"

namespace meshhood::cli {
namespace {

struct BatchCommand {
  std::string file;
  Reading reading;
  RowOptions rows;
  std::string order;  ///< as typed; empty for the default
  MethodOptions search;
  std::string sort = "id";
  bool count = false;
  bool distances = false;
  bool json = false;
  std::optional<std::uint64_t> max_bytes;
  std::string output;
};

/// Rows that are streamed come in index order, which is the fastest. Sizes are found as fast in vertex order, where
/// the number of a row is that of its vertex.
RowOrder row_order(const BatchCommand& options) {
  const bool is_exact = options.search.method == "exact";
  if (options.order == "index" && !is_exact) raise(ErrorCode::InvalidOption, "--order index: expected --method exact");
  if (!options.rows.vertices.empty()) return RowOrder::List;
  if (!options.order.empty()) return value_of(kRowOrders, options.order);
  return is_exact && !options.count ? RowOrder::Index : RowOrder::Vertex;
}

/// Rows as the methods write them are in the order of the ids, or of the index except along the edges.
bool sorts_rows(const BatchCommand& options) {
  return options.sort == "distance" || (options.sort == "index" && options.search.metric == "path");
}

/// The approximate size of the file: the members without the zip headers. The ones of a matrix without distances
/// are compressed: 258 of them take 13 bits.
double file_bytes(const BatchCommand& options, const BatchSize& total, std::size_t columns) {
  const auto rows = static_cast<double>(total.rows);
  const auto count = static_cast<double>(total.count);
  const double vertices = has_vertices(row_order(options)) ? 8 * rows : 0;
  if (options.count) return vertices + 8 * rows * static_cast<double>(options.rows.scale_count());
  const double index_bytes = fits_32_bits(total.count, columns) ? 4 : 8;
  return vertices + index_bytes * (rows + count) + (options.distances ? 8 : 13.0 / 8 / 258) * count;
}

/// One for each array of the file whose length is that of the answer, and one to count.
std::size_t number_of_passes(const BatchCommand& options) { return options.count ? 1 : options.distances ? 3 : 2; }

/// Writes the rows of a batch, of one radius unless they are only counted. The length of an array precedes its values,
/// so the rows are counted first. Then each array is computed and written in a pass of its own, so that memory holds
/// only a few numbers per row.
class Writer {
 public:
  Writer(const SearchMethod& method, const BatchQuery& query, const BatchCommand& options, VertexSorter& sorter,
         const SizeLimit& limit, Task& task, io::NpzWriter& npz)
      : method_(method),
        query_(query),
        options_(options),
        order_(row_order(options)),
        sorter_(sorter),
        limit_(limit),
        task_(task),
        npz_(npz) {}

  BatchSize write() {
    const std::vector<std::uint64_t> sizes = counts(method_, query_, next_run());
    const std::size_t scales = options_.rows.scale_count();
    const BatchSize total{sizes.size() / scales, std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0})};
    limit_.check(total, file_bytes(options_, total, method_.vertex_count()));
    if (options_.count) {
      npz_.begin<std::uint64_t>("count", std::array<std::uint64_t, 2>{scales, total.rows});
      npz_.append<std::uint64_t>(sizes);
    } else {
      write_rows(sizes, total);
    }
    return total;
  }

 private:
  void write_rows(std::span<const std::uint64_t> sizes, const BatchSize& total) {
    begin_rows(npz_, order_, total.rows, method_.vertex_count());
    if (fits_32_bits(total.count, method_.vertex_count())) {
      write_pattern<std::int32_t>(sizes, total);
    } else {
      write_pattern<std::int64_t>(sizes, total);
    }
    options_.distances ? write_distances(total) : end_rows(npz_, order_, total.count);
  }

  template <class Integer>
  void write_pattern(std::span<const std::uint64_t> sizes, const BatchSize& total) {
    std::vector<Integer> offsets(sizes.size() + 1);
    std::transform_inclusive_scan(sizes.begin(), sizes.end(), offsets.begin() + 1, std::plus<>(),
                                  [](std::uint64_t size) { return static_cast<Integer>(size); });
    npz_.add<Integer>("indptr", offsets);
    std::vector<Integer> converted;
    const auto write = [&](std::span<const VertexId> ids, std::span<const double> /*distances*/) {
      converted.assign(ids.begin(), ids.end());
      npz_.append<Integer>(converted);
    };
    npz_.begin<Integer>("indices", total.count);
    for_each_row(sorter_.needs_distances(), write);
  }

  void write_distances(const BatchSize& total) {
    npz_.begin<double>(distances_name(order_), total.count);
    for_each_row(true,
                 [&](std::span<const VertexId> /*ids*/, std::span<const double> distances) { npz_.append(distances); });
  }

  /// Calls `write(ids, distances)` for each row, sorted as the options say.
  template <class Write>
  void for_each_row(bool with_distances, Write&& write) {
    const BatchOptions pass{
        .distances = with_distances, .sorted = options_.sort == "id", .in_index_order = order_ == RowOrder::Index};
    std::vector<VertexId> ids;
    std::vector<double> distances;
    const auto sort_and_write = [&](const BatchRow& row) {
      ids.assign(row.ids.begin(), row.ids.end());
      distances.assign(row.distances.begin(), row.distances.end());
      sorter_.sort(ids, distances);
      write(std::span<const VertexId>(ids), std::span<const double>(distances));
    };
    if (sorts_rows(options_)) return for_each_neighborhood(method_, query_, sort_and_write, pass, next_run());
    for_each_neighborhood(
        method_, query_, [&](const BatchRow& row) { write(row.ids, row.distances); }, pass, next_run());
  }

  Run next_run() {
    return {.threads = options_.rows.threads, .progress = task_.progress(passes_begun_++, number_of_passes(options_))};
  }

  const SearchMethod& method_;
  const BatchQuery& query_;
  const BatchCommand& options_;
  RowOrder order_;
  VertexSorter& sorter_;
  const SizeLimit& limit_;
  Task& task_;
  io::NpzWriter& npz_;
  std::size_t passes_begun_ = 0;
};

std::string task_name(const BatchCommand& options, const std::optional<BatchEstimate>& estimate, std::size_t columns) {
  if (!estimate) return "computing";
  return fmt::format("computing {} rows, about {}", estimate->mean.rows,
                     bytes_text(file_bytes(options, estimate->mean, columns)));
}

BatchSize write(const SearchMethod& method, const BatchQuery& query, const BatchCommand& options,
                VertexSorter& sorter) {
  const SizeLimit limit(options.output, options.max_bytes);
  const std::optional<BatchEstimate> expected = options.count ? std::nullopt : estimate(method, query);
  const std::size_t columns = method.vertex_count();
  if (expected) limit.check(expected->lower, file_bytes(options, expected->lower, columns), "at least ");
  Task task(task_name(options, expected, columns),
            {"rows", static_cast<double>(number_of_passes(options))});  // outlives the temporary file
  io::NpzWriter npz(options.output);
  if (has_vertices(row_order(options))) write_vertices(npz, query.vertices);
  if (options.count) write_radii(npz, query.radius);
  const BatchSize total = Writer(method, query, options, sorter, limit, task, npz).write();
  Task::check_cancelled();
  npz.commit();
  return total;
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
  check_weld(options.reading.weld, options.search.method);
  check_method(options.search, !options.rows.masks.empty(), options.rows.radii.unit);
  check_sort(options.sort, options.search.method);
  const std::size_t radii = options.rows.scale_count();
  if (radii > 1 && !options.count) {
    raise(ErrorCode::InvalidOption, fmt::format("--radius: {} radii, expected one{}", radii,
                                                options.distances ? " with --distances" : ", or --count"));
  }
}

void batch(const BatchCommand& options) {
  check_options(options);
  check_outputs();
  const RowOrder order = row_order(options);
  const unsigned threads = options.rows.threads;
  Input input(options.file, options.reading, threads);
  const RowQuery rows(options.rows, input);
  BatchQuery query = options.count ? rows.query() : rows.query_of_scale(0);
  query.metric = value_of(kMetrics, options.search.metric);
  if (query.metric == Metric::Space) input.ignore_welded();
  const SearchMethod method = method_of(options.search, input, {}, threads);
  VertexSorter sorter(options.sort, input);
  std::vector<VertexId> in_index_order;
  std::vector<double> radii_in_index_order;
  if (order == RowOrder::Index) {
    in_index_order = all_in_index_order(input.exact_index(threads), input.welding());
    query.vertices = in_index_order;
    if (query.radius.list()) {
      for (const VertexId v : in_index_order) radii_in_index_order.push_back(rows.radii()[v]);
      query.radius = radii_in_index_order;
    }
  }
  const BatchSize total = write(method, query, options, sorter);
  Json document{{"output", options.output}, {"method", options.search.method}};
  if (!options.search.is_straight()) document["metric"] = options.search.metric;
  document.update({{"order", name_of(kRowOrders, order)}, {"rows", total.rows}, {"count", total.count}});
  print_result(options.json, document,
               fmt::format("{}: {} rows{}, {} vertices in them\n", printable_name(options.output), total.rows,
                           order == RowOrder::Index ? " in index order" : "", total.count));
}

}  // namespace

void add_batch(CLI::App& program) {
  auto options = std::make_shared<BatchCommand>();
  CLI::App* command =
      program.add_subcommand("batch", "Write the neighborhoods of all vertices, or of a list, in CSR form");
  add_file(*command, options->file);
  add_reading(*command, options->reading);
  add_rows(*command, options->rows);
  add_choice(
      *command, "--order",
      "order of all rows; index: the fastest, with the array vertices; vertex: a matrix for scipy.sparse.load_npz "
      "(default: index; with --count or another method: vertex)",
      {"index", "vertex"}, options->order)
      ->excludes("--vertices");
  add_method(*command, options->search);
  add_sort(*command, options->sort);
  CLI::Option* count = command->add_flag("--count", options->count,
                                         "write only the number of vertices of each row, for one radius or several");
  command
      ->add_flag("--distances", options->distances,
                 "also write distances in the metric of the radius: the array distances, or the values of the matrix")
      ->excludes(count);
  add_max_bytes(*command, options->max_bytes);
  add_output(*command, ".npz", "file to write", options->output)->required();
  add_json(*command, options->json);
  command->callback([options] { batch(*options); });
}

}  // namespace meshhood::cli
