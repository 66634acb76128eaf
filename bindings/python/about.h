// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "meshhood/error.h"

namespace meshhood::python {

/// Calls `f`. If it throws, the message begins with the name of the argument.
template <class F>
auto about(const char* argument, F&& f) {
  try {
    return f();
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    raise(error.code(), std::string(argument) + ": " + error.what());
  }
}

}  // namespace meshhood::python
