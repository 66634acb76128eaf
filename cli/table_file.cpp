// SPDX-License-Identifier: MIT
#include "table_file.h"

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/system.h"
#include "io/text.h"
#include "options.h"
#include "output.h"
#include "system.h"

namespace meshhood::cli {

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
