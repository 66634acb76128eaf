// SPDX-License-Identifier: MIT
#include <exception>
#include <string>

#include <nanobind/nanobind.h>

#include "meshhood/error.h"
#include "meshhood/version.h"

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

/// The argument that an error of a query is about.
const char* argument_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::VertexOutOfRange: return "v: ";
    case ErrorCode::InvalidRadius: return "r: ";
    default: return "";
  }
}

void translate(const std::exception_ptr& exception, void*) {
  try {
    std::rethrow_exception(exception);
  } catch (const Error& error) {
    PyErr_SetString(python_type(error.code()), (std::string(argument_of(error.code())) + error.what()).c_str());
  }
}

}  // namespace
}  // namespace meshhood::python

NB_MODULE(_core, module) {
  // A daemon thread that sleeps while the process ends keeps its objects.
  nb::set_leak_warnings(false);
  nb::register_exception_translator(meshhood::python::translate);
  meshhood::python::bind_methods(module);
  meshhood::python::bind_makers(module);
  meshhood::python::bind_files(module);
  module.attr("__version__") = meshhood::kVersion.data();
}
