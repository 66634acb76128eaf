// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "meshhood/error.h"

namespace meshhood::python {

/// Calls `f`. If it throws, the message begins with the name of the argument. An error of a vertex or a radius becomes
/// one that the module does not name a second time.
template <class F>
auto about(const char* argument, F&& f) {
  try {
    return f();
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    const bool is_of_query = error.code() == ErrorCode::VertexOutOfRange || error.code() == ErrorCode::InvalidRadius;
    raise(is_of_query ? ErrorCode::InvalidOption : error.code(), std::string(argument) + ": " + error.what());
  }
}

/// A result beyond the limit of bytes: a MemoryError in Python.
class ResultTooLarge : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Calls `f`, whose result alone may be too large. `advice`: what to do then.
template <class F>
auto limited(const char* advice, F&& f) {
  try {
    return std::forward<F>(f)();
  } catch (const Error& error) {
    if (error.code() != ErrorCode::TooLarge) throw;
    throw ResultTooLarge(std::string(error.what()) + "; " + advice);
  }
}

}  // namespace meshhood::python
