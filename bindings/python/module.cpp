// SPDX-License-Identifier: MIT
#include <exception>
#include <string>

#include "meshhood/error.h"
#include "meshhood/kernel_target.h"
#include "meshhood/version.h"

#include "about.h"
#include "arrays.h"
#include "bindings.h"

namespace nb = nanobind;

namespace meshhood::python {
namespace {

PyObject* python_type(ErrorCode code) {
  switch (code) {
    case ErrorCode::IoFailure: return PyExc_OSError;
    case ErrorCode::Cancelled: return PyExc_KeyboardInterrupt;
    default: return PyExc_ValueError;
  }
}

/// The argument that caused an error of a query.
const char* argument_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::VertexOutOfRange: return "vertices: ";
    case ErrorCode::InvalidRadius: return "r: ";
    default: return "";
  }
}

/// The message without the path at its beginning, which OSError shows itself.
std::string without_path(const Error& error) {
  const std::string message = error.what();
  const std::string prefix = error.path() + ": ";
  return message.starts_with(prefix) ? message.substr(prefix.size()) : message;
}

/// Sets OSError(errno, message, filename), which Python turns into FileNotFoundError and the like. Before Python 3.11,
/// an `except` of these catches an error that is set as an object, not one that is set as the arguments of OSError.
void set_os_error(const Error& error) {
  const nb::object filename =
      nb::steal(PyUnicode_DecodeFSDefaultAndSize(error.path().data(), static_cast<Py_ssize_t>(error.path().size())));
  const nb::object made = nb::handle(PyExc_OSError)(error.error_number(), without_path(error), filename);
  PyErr_SetObject(made.type().ptr(), made.ptr());
}

void translate(const std::exception_ptr& exception, void*) {
  try {
    std::rethrow_exception(exception);
  } catch (const ResultTooLarge& error) {
    PyErr_SetString(PyExc_MemoryError, error.what());
  } catch (const Error& error) {
    if (error.code() == ErrorCode::IoFailure && error.error_number() != 0) {
      set_os_error(error);
    } else {
      PyErr_SetString(python_type(error.code()), (std::string(argument_of(error.code())) + error.what()).c_str());
    }
  }
}

}  // namespace
}  // namespace meshhood::python

NB_MODULE(_core, module) {
  // A daemon thread that sleeps while the process ends keeps its objects.
  nb::set_leak_warnings(false);
  nb::register_exception_translator(meshhood::python::translate);
  meshhood::python::bind_methods(module);
  meshhood::python::bind_aggregates(module);
  meshhood::python::bind_makers(module);
  auto surface = meshhood::python::bind_surface(module);
  meshhood::python::bind_curvature(module, surface);
  meshhood::python::bind_files(module);
  meshhood::python::bind_parts(module);
#if defined(MESHHOOD_COMMANDS)
  meshhood::python::bind_command(module);
#endif
  module.attr("__version__") = meshhood::kVersion.data();
  module.def("kernel_target", [] { return std::string(meshhood::kernel_target()); });
}
