// SPDX-License-Identifier: MIT
// Errors without exceptions: JavaScript keeps the message, the module traps, and JavaScript throws in its place. No
// destructor runs between here and the call from JavaScript, so that memory which the failed call had allocated is lost
// to this instance.
#include <string>
#include <utility>

#include "meshhood/error.h"

#include "host.h"

namespace meshhood::inline v0_1 {

void raise(ErrorCode code, std::string message, std::string /*path*/, int /*error_number*/) {
  {
    const std::string text = std::exchange(wasm::subject, {}) + std::move(message);
    wasm::keep_error(static_cast<int>(code), text.data(), text.size());
  }
  __builtin_trap();
}

}  // namespace meshhood::inline v0_1
