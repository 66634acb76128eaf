// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdlib>
#include <new>

#include "meshhood/error.h"
#include "meshhood/serialize.h"

namespace meshhood::wasm {
namespace {

[[noreturn]] void refuse_memory() { raise(ErrorCode::TooLarge, "not enough memory"); }

}  // namespace

extern "C" {

/// To be called once, before all others.
[[clang::export_name("start")]] void start() { std::set_new_handler(refuse_memory); }

[[clang::export_name("allocate")]] void* allocate(std::size_t bytes) {
  void* const memory = std::aligned_alloc(kIndexAlignment, (bytes / kIndexAlignment + 1) * kIndexAlignment);
  if (memory == nullptr) refuse_memory();
  return memory;
}

[[clang::export_name("release")]] void release(void* memory) { std::free(memory); }

}  // extern "C"

}  // namespace meshhood::wasm
