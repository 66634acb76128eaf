// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "meshhood/index.h"
#include "meshhood/paper.h"
#include "meshhood/serialize.h"

#include "output.h"

/// The parts of an index, and the memory of each.
namespace meshhood::cli {

[[nodiscard]] std::string_view kind_name(IndexKind kind);
[[nodiscard]] std::string_view precision_name(const IndexHeader& header);

[[nodiscard]] Json json_of(const Index& index);
[[nodiscard]] Json json_of(const paper::Index& index);

[[nodiscard]] std::string text_of(const Index& index);
[[nodiscard]] std::string text_of(const paper::Index& index);

}  // namespace meshhood::cli
