// SPDX-License-Identifier: MIT
// The memory of the module: what JavaScript writes its arguments to, and the answers that it reads.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "meshhood/serialize.h"

#include "answer.h"

namespace meshhood::wasm {
namespace {

/// Traps without an error, by which JavaScript tells this from what is refused before it begins.
[[noreturn]] void refuse_memory() { __builtin_trap(); }

}  // namespace

/// To be called once, before all others.
[[clang::export_name("start")]] void start() { std::set_new_handler(refuse_memory); }

/// Its name tells JavaScript, before an instance is made, that this is the module of the same version.
[[clang::export_name("meshhood " MESHHOOD_VERSION_TEXT)]] void bear_version() {}

[[clang::export_name("allocate")]] void* allocate(std::size_t bytes) {
  void* const memory = std::aligned_alloc(kIndexAlignment, (bytes / kIndexAlignment + 1) * kIndexAlignment);
  if (memory == nullptr) refuse_memory();
  return memory;
}

[[clang::export_name("release")]] void release(void* memory) { std::free(memory); }

[[clang::export_name("answer_ids")]] const VertexId* answer_ids() { return answer.ids.data(); }

[[clang::export_name("answer_ids_size")]] std::size_t answer_ids_size() { return answer.ids.size(); }

[[clang::export_name("answer_reals")]] const double* answer_reals() { return answer.reals.data(); }

[[clang::export_name("answer_reals_size")]] std::size_t answer_reals_size() { return answer.reals.size(); }

[[clang::export_name("answer_counts")]] const std::uint32_t* answer_counts() { return answer.counts.data(); }

[[clang::export_name("answer_counts_size")]] std::size_t answer_counts_size() { return answer.counts.size(); }

/// Gives the memory of a large answer back.
[[clang::export_name("release_answer")]] void release_answer() { answer = {}; }

}  // namespace meshhood::wasm
