// SPDX-License-Identifier: MIT
#include <algorithm>
#include <csignal>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "meshhood/error.h"

#include "arrays.h"
#include "bindings.h"
#include "cli/program.h"
#include "interpreter.h"

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

std::optional<cli::OtherFile> other_file(nb::handle reader, const std::string& file) {
  try {
    const nb::object read = reader(nb::bytes(file.data(), file.size()));
    if (read.is_none()) return std::nullopt;
    auto [ply, notes] = nb::cast<std::pair<nb::bytes, std::vector<std::string>>>(read);
    return cli::OtherFile{{ply.c_str(), ply.size()}, std::move(notes)};
  } catch (const nb::python_error& error) {
    raise(code_of(error), nb::str(error.value()).c_str());
  }
}

/// `reader` takes the bytes of a name. It returns the file as PLY and a list of notes, or None.
cli::OtherReader reader_by(nb::handle reader) {
  return [reader, state = PyThreadState_Get()](const std::string& name) {
    return with_lock(state, [&] { return other_file(reader, name); });
  };
}

int run_command(const std::vector<nb::bytes>& words, nb::handle read_other) {
  std::vector<std::string> arguments(words.size());
  std::ranges::transform(words, arguments.begin(), &nb::bytes::c_str);
  cli::read_others_by(reader_by(read_other));
  restore_interrupt();
  return without_lock([&] { return cli::run_program(std::move(arguments)); });
}

}  // namespace

void bind_command(nb::module_& module) { module.def("run_command", run_command, nb::arg(), nb::arg("read_other")); }

}  // namespace meshhood::python
