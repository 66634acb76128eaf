// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

/// The functions that JavaScript provides to the module (bindings/wasm/instance.js).
namespace meshhood::wasm {

/// Keeps an error, which JavaScript throws once the module has trapped. `code` is an `ErrorCode`; the message is
/// copied.
[[clang::import_module("meshhood"), clang::import_name("keep_error")]]
void keep_error(int code, const char* message, std::size_t size);

/// What the next error is about, in front of its message, where the library has another name for an argument.
inline std::string subject;

/// Whether to continue (see `Progress`).
[[clang::import_module("meshhood"), clang::import_name("report_progress")]]
bool report_progress(std::size_t done, std::size_t total);

}  // namespace meshhood::wasm
