// SPDX-License-Identifier: MIT
// This file is separate because the package for JavaScript has another one (bindings/wasm/src/raise.cpp).
#include <cstdlib>
#include <string>
#include <utility>

#include "meshhood/error.h"

namespace meshhood::inline v0_1 {

void raise(ErrorCode code, std::string message, std::string path, int error_number) {
#if defined(__cpp_exceptions)
  throw Error(code, std::move(message), std::move(path), error_number);
#else
  static_cast<void>(code);
  static_cast<void>(message);
  static_cast<void>(path);
  static_cast<void>(error_number);
  std::abort();
#endif
}

}  // namespace meshhood::inline v0_1
