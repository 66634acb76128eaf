// SPDX-License-Identifier: MIT
#include "exit_code.h"

#include <exception>
#include <new>
#include <stdexcept>
#include <system_error>

#include "meshhood/error.h"

namespace meshhood::cli {
namespace {

ExitCode exit_code(ErrorCode code) {
  switch (code) {
    case ErrorCode::VertexOutOfRange:
    case ErrorCode::InvalidRadius:
    case ErrorCode::InvalidOption: return ExitCode::Usage;
    case ErrorCode::InvalidMesh:
    case ErrorCode::MalformedFile:
    case ErrorCode::UnsupportedFormat: return ExitCode::MeshRefused;
    case ErrorCode::MalformedIndex: return ExitCode::IndexRefused;
    case ErrorCode::IoFailure: return ExitCode::InputOutput;
    case ErrorCode::TooLarge: return ExitCode::Limit;
    case ErrorCode::Cancelled: return ExitCode::Interrupted;
  }
  throw std::logic_error("an error code without an exit code");
}

bool is_lack_of_memory(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
         dynamic_cast<const std::length_error*>(&error) != nullptr;
}

}  // namespace

ExitCode exit_code(const std::exception& error) {
  if (const auto* ours = dynamic_cast<const Error*>(&error)) return exit_code(ours->code());
  if (is_lack_of_memory(error)) return ExitCode::Limit;
  if (dynamic_cast<const std::system_error*>(&error) != nullptr) return ExitCode::InputOutput;
  throw;
}

// Of the standard library's own words for it, none says what is meant.
const char* reason(const std::exception& error) {
  return is_lack_of_memory(error) ? "not enough memory" : error.what();
}

}  // namespace meshhood::cli
