// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "meshhood/error.h"
#include "meshhood/progress.h"

#include "io/place.h"

namespace meshhood::io {

/// Tells who watches, unless nobody does. Throws Error{Cancelled}, naming the file, if they have seen enough.
inline void report(const Progress& progress, std::size_t done, std::size_t total, const std::string& file) {
  if (progress && !progress(done, total)) raise(ErrorCode::Cancelled, printable_name(file) + ": cancelled");
}

}  // namespace meshhood::io
