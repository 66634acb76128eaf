// SPDX-License-Identifier: MIT
// meshhood batch: the neighborhoods of all vertices, or of those listed, as a sparse matrix.
#include "meshhood/batch.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "meshhood/error.h"

#include "commands.h"
#include "input.h"
#include "interrupt.h"
#include "npz_writer.h"
#include "output.h"
#include "progress.h"
#include "query_arguments.h"
#include "vertex_list.h"

namespace meshhood::cli {
namespace {

struct Options {
  std::string file;
  Radius radius;
  std::string vertices;  ///< a file that lists them; empty for all
  std::string method = "exact";
  unsigned threads = kAllThreads;
  bool count = false;
  bool distances = false;
  bool json = false;
  std::string output;
};

/// What a batch came to.
struct Total {
  std::size_t rows = 0;
  std::uint64_t count = 0;  ///< of vertices, over all rows
};

/// Writes the answers of one index. How long an array is stands before its values, so the rows are counted first; and
/// they are asked for once an array, always the same, for then no array need be kept while another is written: memory
/// is that of a few numbers a row, and nothing but the target is written to.
template <class Index>
class Writer {
 public:
  Writer(const Index& index, const BatchQuery& query, const Options& options, const Interrupt& interrupt,
         NpzWriter& npz)
      : index_(index), query_(query), options_(options), interrupt_(interrupt), npz_(npz) {}

  Total write() {
    const std::vector<std::uint64_t> sizes = neighborhood_sizes(index_, query_, next_pass());
    const Total total{sizes.size(), std::accumulate(sizes.begin(), sizes.end(), std::uint64_t{0})};
    if (options_.count) {
      npz_.add<std::uint64_t>("count", sizes);
    } else {
      write_matrix(sizes, total);
    }
    return total;
  }

 private:
  /// As `scipy.sparse.load_npz` reads it.
  void write_matrix(std::span<const std::uint64_t> sizes, const Total& total) {
    const std::array<std::int64_t, 2> shape{static_cast<std::int64_t>(total.rows),
                                            static_cast<std::int64_t>(index_.vertex_count())};
    npz_.add_text("format", "csr");
    npz_.add<std::int64_t>("shape", shape);
    // SciPy's own choice: it would convert what comes in other integers.
    constexpr std::uint64_t kNarrow = std::numeric_limits<std::int32_t>::max();
    if (total.count <= kNarrow && index_.vertex_count() <= kNarrow) {
      write_pattern<std::int32_t>(sizes, total);
    } else {
      write_pattern<std::int64_t>(sizes, total);
    }
    options_.distances ? write_distances(total) : write_ones(total);
  }

  template <class Integer>
  void write_pattern(std::span<const std::uint64_t> sizes, const Total& total) {
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
    for_each_neighborhood(index_, query_, write, next_pass());
  }

  void write_distances(const Total& total) {
    npz_.begin<double>("data", total.count);
    BatchOptions pass = next_pass();
    pass.distances = true;
    for_each_neighborhood(index_, query_, [&](const BatchRow& row) { npz_.append(row.distances); }, pass);
  }

  void write_ones(const Total& total) {
    constexpr auto kOnes = [] {
      std::array<bool, std::size_t{1} << 16> ones{};
      ones.fill(true);
      return ones;
    }();
    npz_.begin<bool>("data", total.count);
    for (std::uint64_t left = total.count; left > 0;) {
      const auto ones = std::span(kOnes).first(std::min<std::uint64_t>(left, kOnes.size()));
      npz_.append<bool>(ones);
      left -= ones.size();
    }
  }

  BatchOptions next_pass() {
    const double passes = options_.count ? 1 : options_.distances ? 3 : 2;
    const double before = passes_begun_++;
    const auto report = [this, passes, before](std::size_t done, std::size_t total) {
      const double part = static_cast<double>(done) / static_cast<double>(std::max<std::size_t>(total, 1));
      progress_.report((before + part) / passes);
      return !interrupt_.requested();
    };
    return {.threads = options_.threads, .sorted = true, .progress = report};
  }

  const Index& index_;
  const BatchQuery& query_;
  const Options& options_;
  const Interrupt& interrupt_;
  NpzWriter& npz_;
  Progress progress_{"asking"};
  int passes_begun_ = 0;
};

template <class Index>
Total write(const Index& index, const BatchQuery& query, const Options& options) {
  const Interrupt interrupt;  // outlives the file that it is to leave no trace of
  NpzWriter npz(options.output);
  if (query.vertices) {
    const std::vector<std::int64_t> listed(query.vertices->begin(), query.vertices->end());
    npz.add<std::int64_t>("vertices", listed);
  }
  const Total total = Writer(index, query, options, interrupt, npz).write();
  if (interrupt.requested()) raise(ErrorCode::Cancelled, "cancelled");
  npz.commit();
  return total;
}

void batch(const Options& options) {
  for (const std::string& read : {options.file, options.vertices}) refuse_same_file(read, options.output);
  Input input(options.file);
  if (options.method == "exact") input.need_edges("--method exact");
  BatchQuery query{.vertices = {}, .radius = resolve(options.radius, input)};
  std::vector<VertexId> listed;
  if (!options.vertices.empty()) {
    listed = read_vertex_list(options.vertices, input.vertex_count());
    query.vertices = listed;
  }
  const Total total = options.method == "exact" ? write(input.exact_index(options.threads), query, options)
                                                : write(input.paper_index(), query, options);
  if (options.json) {
    print_json(
        Json{{"output", options.output}, {"method", options.method}, {"rows", total.rows}, {"count", total.count}});
  } else {
    print_text(fmt::format("{}: {} rows, {} vertices in them\n", printable(options.output), total.rows, total.count));
  }
}

}  // namespace

void add_batch(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand("batch", "The neighborhoods of all vertices, as a sparse matrix of SciPy");
  add_file(*command, options->file);
  add_radius(*command, options->radius);
  command->add_option("--vertices", options->vertices, "a text that lists the vertices to ask for, one a line")
      ->check(file_name())
      ->type_name("FILE");
  command->add_option("--method", options->method, "exact; paper, with a few extra vertices")
      ->check(CLI::IsMember({"exact", "paper"}))
      ->type_name("")
      ->capture_default_str();
  add_threads(*command, options->threads);
  CLI::Option* count = command->add_flag("--count", options->count, "only how many vertices each row has");
  command->add_flag("--distances", options->distances, "distances in space as the values of the matrix, not ones")
      ->excludes(count);
  add_output(*command, options->output, "the NPZ file to write")->required();
  command->add_flag("--json", options->json, "one JSON document");
  command->callback([options] { batch(*options); });
}

}  // namespace meshhood::cli
