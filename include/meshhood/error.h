// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <utility>

#include "meshhood/export.h"

namespace meshhood::inline v0_1 {
MESHHOOD_API_BEGIN

/// The reason why a call failed. The list is closed: a program may switch over it.
enum class ErrorCode {
  VertexOutOfRange,  ///< an id that the mesh does not have; or `nearest` of a mesh without a vertex to find
  InvalidRadius,     ///< a radius that is NaN or negative, or that the call does not take; or a wrong list of radii
  InvalidOption,     ///< an option outside its range; an object that was moved from, or did not follow a refit
  InvalidMesh,    ///< arrays that do not describe a mesh: an index out of range, a coordinate that is not finite, ...
  MalformedFile,  ///< a file whose content contradicts its format or itself
  UnsupportedFormat,  ///< a file in a format, or a variant of one, that is not read
  MalformedIndex,     ///< a saved index that has been changed, is of another version, or belongs to another mesh
  IoFailure,          ///< the operating system could not open, read, write or close
  TooLarge,           ///< more vertices, edges or bytes than the documented limits, or a file than there is memory for
  Cancelled,          ///< the caller's `Progress` returned false; or a callback forked, and this is the child
};

/// Returns one sentence about `code`, the same in every language binding.
[[nodiscard]] std::string_view describe(ErrorCode code) noexcept;

/// The one exception that meshhood throws. `what()` is one line that names the cause (file and place, face, corner,
/// value) and what was expected. A failed call leaves its arguments and the object it was called on as they were;
/// memory of the caller for results (`aggregate`, `curvatures`, `BatchMemory`) may have been written to.
///
/// If memory runs out, `std::bad_alloc` is passed on, with the same promise. Functions that read files throw
/// `TooLarge` instead if they still can.
///
/// A core compiled without exceptions (WebAssembly) traps instead.
class Error : public std::exception {
 public:
  Error(ErrorCode code, std::string message, std::string path = {}, int error_number = 0)
      : code_(code), message_(std::move(message)), path_(std::move(path)), error_number_(error_number) {}

  [[nodiscard]] ErrorCode code() const noexcept { return code_; }
  [[nodiscard]] const char* what() const noexcept override { return message_.c_str(); }

  /// Returns the file of an `IoFailure`, as it was given; otherwise an empty string.
  [[nodiscard]] const std::string& path() const noexcept { return path_; }

  /// Returns the `errno` value of the failed system call of an `IoFailure`; 0 where there is none.
  [[nodiscard]] int error_number() const noexcept { return error_number_; }

 private:
  ErrorCode code_;
  std::string message_;
  std::string path_;
  int error_number_;
};

/// Throws `Error{code, message, path, error_number}`, or traps where exceptions are off. All errors of the library pass
/// through here.
[[noreturn]] void raise(ErrorCode code, std::string message, std::string path = {}, int error_number = 0);

MESHHOOD_API_END
}  // namespace meshhood::inline v0_1
