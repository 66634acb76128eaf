// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "meshhood/serialize.h"

#include "io/messages.h"
#include "io/readers.h"
#include "io/text.h"

namespace meshhood::inline v0_1::io {
namespace {

constexpr std::size_t kHead = std::size_t{1} << 16;
constexpr std::size_t kIndexMark = 8;
constexpr std::string_view kLfsMark = "version https://git-lfs.github.com/spec/";

/// A compressed file: its first bytes and the command that unpacks it.
struct Compression {
  std::string_view mark;
  std::string_view name;
  std::string_view command;
};

constexpr std::array kCompressions{
    Compression{"\x1f\x8b", "gzip", "gunzip"}, Compression{"\x28\xb5\x2f\xfd", "Zstandard", "unzstd"},
    Compression{{"\xfd\x37zXZ\0", 6}, "xz", "unxz"}, Compression{"BZh", "bzip2", "bunzip2"}};

/// A file that the Python package reads by another library: what it begins with, or what is in its first bytes.
struct Foreign {
  std::string_view mark;
  bool is_first;
  std::string_view name;
};

constexpr std::array kForeign{Foreign{"<VTKFile", false, "VTK's XML"},
                              Foreign{"<GIFTI", false, "GIFTI"},
                              Foreign{"glTF", true, "GLB"},
                              Foreign{"\"asset\"", false, "glTF"},
                              Foreign{"PK\x3\x4", true, "3MF or another ZIP"},
                              Foreign{"$MeshFormat", true, "MSH"},
                              Foreign{"\xff\xff\xff", true, "FreeSurfer's quads"},
                              Foreign{"\xff\xff\xfd", true, "FreeSurfer's quads"}};

bool is_index_start(InputBuffer& input) {
  return meshhood::is_index(std::as_bytes(std::span(input.ahead(kIndexMark))));
}

std::optional<Format> format_of_extension(const std::string& name) {
  const auto extension = lower_case(std::filesystem::path(name).extension().string());
  if (extension == ".ply") return Format::Ply;
  if (extension == ".obj") return Format::Obj;
  if (extension == ".off") return Format::Off;
  if (extension == ".stl") return Format::Stl;
  if (extension == ".vtk") return Format::Vtk;
  return std::nullopt;
}

void refuse_compressed(InputBuffer& input) {
  for (const auto& [mark, name, command] : kCompressions) {
    if (!input.ahead(mark.size()).starts_with(mark)) continue;
    raise(ErrorCode::UnsupportedFormat,
          fmt::format("{0}: is compressed by {1}, expected a mesh; '{2}' unpacks it, also into a pipe: "
                      "{2} -c {0} | meshhood info -",
                      input.name(), name, command));
  }
}

void refuse_foreign(InputBuffer& input) {
  const auto head = input.ahead(kHead).substr(0, kHead);
  for (const auto& [mark, is_first, name] : kForeign) {
    if (is_first ? !head.starts_with(mark) : head.find(mark) == std::string_view::npos) continue;
    constexpr std::string_view kConvert =
        "; python3 -c 'import sys, meshhood as m; m.write_mesh(\"mesh.ply\", m.read_mesh(sys.argv[1]))' FILE converts "
        "it";
    raise(ErrorCode::UnsupportedFormat,
          fmt::format("{}: is {}, which only the Python package reads{}", input.name(), name,
                      input.size() ? kConvert : ", from a file: write it to one first"));
  }
}

// The first word outside comments; empty if there is none.
std::string_view first_word(std::string_view head) {
  for (;;) {
    head.remove_prefix(std::min(head.find_first_not_of(kBlanks), head.size()));
    if (!head.starts_with('#')) return head.substr(0, head.find_first_of(kBlanks));
    head.remove_prefix(std::min(head.find_first_of("\r\n"), head.size()));
  }
}

// A keyword followed by a blank: a letter alone could begin any text.
bool begins_obj(std::string_view head, std::string_view word) {
  const auto behind = static_cast<std::size_t>(word.data() - head.data()) + word.size();
  return is_obj_statement(word) && behind < head.size() && (head[behind] == ' ' || head[behind] == '\t');
}

std::optional<Format> format_of_content(InputBuffer& input) {
  const auto head = input.ahead(kHead);
  if (head.starts_with(kVtkMark)) return Format::Vtk;
  if (head.starts_with(kFreeSurferMark)) return Format::FreeSurfer;
  if (has_binary_stl_size(input)) return Format::Stl;
  const auto word = first_word(head);
  if (word == "ply") return Format::Ply;
  if (lower_case(std::string(word)) == "solid") return Format::Stl;
  if (is_off_keyword(word)) return Format::Off;
  if (begins_obj(head, word)) return Format::Obj;
  return std::nullopt;
}

}  // namespace

Format detect_format(InputBuffer& input, const std::string& name) {
  take_byte_order_mark(input);
  const auto extension = format_of_extension(name);
  if (is_index_start(input)) {
    raise(ErrorCode::UnsupportedFormat, input.name() + ": is an index, expected a mesh");
  }
  if (input.ahead(kLfsMark.size()).starts_with(kLfsMark)) {
    raise(ErrorCode::UnsupportedFormat,
          input.name() + ": is a Git LFS pointer, not the mesh; 'git lfs pull' downloads the mesh");
  }
  if (input.ahead(1).empty()) {
    // Of all formats, only OBJ allows an empty file: a mesh without vertices.
    if (extension == Format::Obj) return Format::Obj;
    raise(ErrorCode::MalformedFile, input.name() + ": the file is empty");
  }
  const auto format = format_of_content(input);
  if (format) return *format;
  refuse_compressed(input);
  refuse_foreign(input);
  if (extension) return *extension;
  if (!input.left() && is_binary_stl(input)) return Format::Stl;  // a pipe
  raise(ErrorCode::UnsupportedFormat,
        input.name() + ": is neither PLY, OBJ, OFF, STL, VTK nor FreeSurfer, by its first bytes or its extension");
}

}  // namespace meshhood::inline v0_1::io
