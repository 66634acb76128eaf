// SPDX-License-Identifier: MIT
#include <algorithm>
#include <csignal>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "meshhood/error.h"

#include "bindings.h"
#include "cli/program.h"
#include "interpreter.h"
#include "io/mesh_io.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

/// As the program would find it: Python raises an exception at Ctrl-C, unless the signal was ignored at the start.
void restore_interrupt() {
  if (std::signal(SIGINT, SIG_DFL) == SIG_IGN) std::signal(SIGINT, SIG_IGN);
}

ErrorCode code_of(const nb::python_error& error) {
  if (error.matches(PyExc_MemoryError)) return ErrorCode::TooLarge;
  return error.matches(PyExc_OSError) ? ErrorCode::IoFailure : ErrorCode::UnsupportedFormat;
}

/// A mesh file of another library.
struct OtherFile {
  std::string ply;                 ///< its content as PLY
  std::vector<std::string> notes;  ///< what there is to say of it
};

std::optional<OtherFile> other_file(nb::handle reader, const std::string& file) {
  try {
    const nb::object read = reader(nb::bytes(file.data(), file.size()));
    if (read.is_none()) return std::nullopt;
    auto [ply, notes] = nb::cast<std::pair<nb::bytes, std::vector<std::string>>>(read);
    return OtherFile{{ply.c_str(), ply.size()}, std::move(notes)};
  } catch (const nb::python_error& error) {
    raise(code_of(error), nb::str(error.value()).c_str());
  }
}

/// `reader` takes the bytes of a name. It returns the file as PLY and a list of notes, or None.
cli::OtherReader reader_by(nb::handle reader) {
  return [reader, state = PyThreadState_Get()](const std::string& name, const io::ReadOptions& options) {
    std::optional<io::Mesh> mesh;
    const std::optional<OtherFile> file = with_lock(state, [&] { return other_file(reader, name); });
    if (!file) return mesh;
    mesh = io::read_mesh(std::as_bytes(std::span(file->ply)), name, options);
    mesh->format = io::Format::Other;
    // Those with a place in the PLY file are among the notes.
    std::erase_if(mesh->warnings, [](const io::Warning& warning) { return !warning.first_place.empty(); });
    std::ranges::transform(file->notes, std::back_inserter(mesh->warnings),
                           [](const std::string& note) { return io::Warning{.what = note}; });
    return mesh;
  };
}

int run_command(const std::vector<nb::bytes>& words, nb::handle read_other) {
  std::vector<const char*> arguments;
  for (const nb::bytes& word : words) arguments.push_back(word.c_str());
  cli::read_others_by(reader_by(read_other));
  restore_interrupt();
  return without_lock([&] { return cli::run_program(arguments); });
}

}  // namespace

void bind_command(nb::module_& module) { module.def("run_command", run_command, nb::arg(), nb::arg("read_other")); }

}  // namespace meshhood::python
