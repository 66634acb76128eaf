// SPDX-License-Identifier: MIT
#include "meshhood/error.h"

#include "meshhood/owner.h"

namespace meshhood::inline v0_1 {

std::string_view describe(ErrorCode code) noexcept {
  switch (code) {
    case ErrorCode::VertexOutOfRange: return "the mesh has no such vertex";
    case ErrorCode::InvalidRadius: return "a radius is NaN or negative, or not one that the call takes";
    case ErrorCode::InvalidOption:
      return "an option is outside its range, or an object was moved from or did not follow a refit";
    case ErrorCode::InvalidMesh: return "the arrays do not describe a mesh";
    case ErrorCode::MalformedFile: return "the file contradicts its format or itself";
    case ErrorCode::UnsupportedFormat: return "the format, or this variant of it, is not read";
    case ErrorCode::MalformedIndex: return "the saved index was changed, is of another version or of another mesh";
    case ErrorCode::IoFailure: return "the operating system could not open, read, write or close";
    case ErrorCode::TooLarge: return "larger than the documented limits, or than there is memory for";
    case ErrorCode::Cancelled: return "the caller cancelled the call, or forked during it";
  }
  return "unknown error";
}

void detail::raise_moved_from() {
  raise(ErrorCode::InvalidOption, "the object has been moved from, expected one that was assigned since");
}

}  // namespace meshhood::inline v0_1
