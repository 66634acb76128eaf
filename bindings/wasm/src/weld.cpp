// SPDX-License-Identifier: MIT
// Welding: JavaScript copies the answer, and drops the instance.
#include "io/weld.h"

#include "answer.h"
#include "arguments.h"

namespace meshhood::wasm {

extern "C" {

/// The ids of the answer are those that the vertices get, the counts the new corners. The faces keep their offsets.
[[clang::export_name("weld")]] void weld(double eps) {
  const io::WeldedMesh welded = io::weld(given, eps);
  answer.ids.assign(welded.ids.begin(), welded.ids.end());
  answer.counts.assign(welded.corners.begin(), welded.corners.end());
}

}  // extern "C"

}  // namespace meshhood::wasm
