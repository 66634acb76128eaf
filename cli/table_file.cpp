// SPDX-License-Identifier: MIT
#include "table_file.h"

#include <cmath>
#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/system.h"
#include "io/text.h"
#include "options.h"
#include "output.h"
#include "system.h"

namespace meshhood::cli {
namespace {

std::optional<double> free_space(const std::filesystem::path& output) {
  if (output == io::kStandardOutput) return std::nullopt;
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(output, ignored);
  const bool is_special = std::filesystem::exists(status) && !std::filesystem::is_regular_file(status);
  const std::filesystem::path folder = output.has_parent_path() ? output.parent_path() : ".";
  std::error_code unknown;
  const std::filesystem::space_info space = std::filesystem::space(folder, unknown);
  if (is_special || unknown || space.capacity == 0) return std::nullopt;
  return static_cast<double>(space.available);
}

}  // namespace

bool TableFile::is_csv() const {
  return is_printed || io::lower_case(std::filesystem::path(name).extension().string()) == ".csv";
}

void add_table_output(CLI::App& command, const std::string& extension, const std::string& description,
                      TableFile& file) {
  CLI::Option* const output = add_output(command, extension + " or .csv", description, file.name);
  const auto print = [&file] {
    file = {std::string(io::kStandardOutput), true};
    name_output("--csv", file.name);
  };
  command.add_flag_callback("--csv", print, "print the table that --output FILE.csv would have")->excludes(output);
}

void check_size(const std::string& output, std::optional<std::uint64_t> max_bytes, const AnswerSize& size, double bytes,
                std::string_view about) {
  const std::optional<double> limit =
      max_bytes ? std::optional(static_cast<double>(*max_bytes)) : free_space(path_of(output));
  if (!limit || bytes <= *limit) return;
  constexpr int kDigits = 4;  // of two numbers that may be close
  const std::string number = bytes_text(*limit, kDigits);
  const std::string limit_text = max_bytes ? "the limit is " + number : fmt::format("the disk has {} free", number);
  raise(
      ErrorCode::TooLarge,
      fmt::format("{}: {} rows with {}{} vertices take {}{}, but {}; --max-bytes sets another limit",
                  printable_name(output), size.rows, about, size.count, about, bytes_text(bytes, kDigits), limit_text));
}

std::vector<std::string> pair_names(bool distances) {
  std::vector<std::string> names{"vertex", "neighbor"};
  if (distances) names.emplace_back("distance");
  return names;
}

CsvWriter::CsvWriter(const std::string& file, const std::vector<std::string>& names,
                     std::optional<std::uint64_t> max_bytes)
    : writer_(path_of(file)), file_(file), max_bytes_(max_bytes) {
  for (const std::string& name : names) add_text(name);
  end_row();
}

void CsvWriter::add(double number) {
  if (std::isfinite(number)) return add_text(fmt::format("{}", number));
  add_text(std::isnan(number) ? "NaN" : number > 0 ? "Inf" : "-Inf");
}

void CsvWriter::add_text(const std::string& text) {
  if (!line_.empty()) line_ += ',';
  line_ += text;
}

void CsvWriter::end_row() {
  line_ += '\n';
  writer_.write(line_);
  line_.clear();
  if (!max_bytes_ || writer_.position() <= *max_bytes_) return;
  raise(ErrorCode::TooLarge, fmt::format("{}: the table is larger than {}; --max-bytes sets another limit",
                                         printable_name(file_), bytes_text(static_cast<double>(*max_bytes_), 4)));
}

}  // namespace meshhood::cli
