// SPDX-License-Identifier: MIT
#include "vertex_list.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "meshhood/error.h"

#include "io/byte_source.h"
#include "io/input.h"
#include "io/mesh_io.h"
#include "io/number.h"
#include "io/place.h"
#include "io/text.h"

namespace meshhood::cli {
namespace {

VertexId parse_vertex(const io::Text& text, std::string_view token, std::size_t vertices) {
  const std::uint64_t vertex = io::parse_count(token).value_or(vertices);
  if (vertex < vertices) return static_cast<VertexId>(vertex);
  const std::string expected = vertices == 0 ? "no vertex was expected: the mesh has none"
                                             : fmt::format("one of the vertices 0 to {} was expected", vertices - 1);
  text.fail(ErrorCode::InvalidOption, io::quote(token) + " where " + expected);
}

std::vector<VertexId> read(io::Text& text, std::size_t vertices) {
  std::vector<VertexId> list;
  while (text.next_line()) {
    const std::string_view token = text.token_on_line();
    if (token.empty()) continue;
    list.push_back(parse_vertex(text, token, vertices));
    if (const std::string_view second = text.token_on_line(); !second.empty()) {
      text.fail(ErrorCode::InvalidOption, fmt::format("{} where the end of the line was expected", io::quote(second)));
    }
  }
  return list;
}

}  // namespace

std::vector<VertexId> read_vertex_list(const std::string& file, std::size_t vertices) {
  io::FileSource source(file);
  io::Input input(source, file, io::ReadOptions{}.max_bytes);
  io::Text text(input, {.hash_comments = true});
  try {
    return read(text, vertices);
  } catch (const Error& error) {
    // What is no text at all is no mesh that was refused.
    if (error.code() != ErrorCode::MalformedFile) throw;
    raise(ErrorCode::InvalidOption, error.what());
  }
}

}  // namespace meshhood::cli
