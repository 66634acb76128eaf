// SPDX-License-Identifier: MIT
#include "input.h"

#include <filesystem>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "output.h"
#include "progress.h"

namespace meshhood::cli {
namespace {

void complain_about(const io::Mesh& mesh, const std::string& file) {
  for (const io::Warning& warning : mesh.warnings) {
    const std::string times = warning.count == 1 ? "" : fmt::format("{} times, first ", warning.count);
    const std::string place = warning.first_place.empty() ? "" : " (" + times + "at " + warning.first_place + ")";
    complain("warning: ", fmt::format("{}: {}{}", file, warning.what, place));
  }
}

}  // namespace

Input read_input(const std::string& file) {
  const Progress progress("reading " + file);
  Input input{file, io::read_mesh(file), {}};
  complain_about(input.mesh, file);
  input.adjacency = adjacency(input.view());
  return input;
}

void refuse_same_file(const std::string& input, const std::string& output) {
  std::error_code missing;
  if (std::filesystem::equivalent(input, output, missing)) {
    raise(ErrorCode::InvalidOption, output + ": " + input + " would be overwritten; name another file for the output");
  }
}

}  // namespace meshhood::cli
