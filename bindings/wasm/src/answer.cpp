// SPDX-License-Identifier: MIT
#include "answer.h"

#include <cstddef>
#include <cstdint>

namespace meshhood::wasm {

extern "C" {

[[clang::export_name("answer_ids")]] const VertexId* answer_ids() { return answer.ids.data(); }

[[clang::export_name("answer_ids_size")]] std::size_t answer_ids_size() { return answer.ids.size(); }

[[clang::export_name("answer_reals")]] const double* answer_reals() { return answer.reals.data(); }

[[clang::export_name("answer_reals_size")]] std::size_t answer_reals_size() { return answer.reals.size(); }

[[clang::export_name("answer_counts")]] const std::uint32_t* answer_counts() { return answer.counts.data(); }

[[clang::export_name("answer_counts_size")]] std::size_t answer_counts_size() { return answer.counts.size(); }

/// Gives the memory of a large answer back.
[[clang::export_name("release_answer")]] void release_answer() { answer = {}; }

}  // extern "C"

}  // namespace meshhood::wasm
