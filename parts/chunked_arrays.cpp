// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "meshhood/error.h"

#include "io/binary.h"
#include "io/messages.h"
#include "io/npy.h"
#include "parts/chunked_mesh.h"
#include "parts/random_file.h"

namespace meshhood::parts {
namespace {

/// A `.npy` file of numbers in rows.
class Rows {
 public:
  static constexpr std::size_t kBufferBytes = std::size_t{1} << 18;

  Rows(const std::filesystem::path& path, std::string_view kinds, std::string_view expected)
      : file_(path), name_(io::printable_name(path.string())), header_(read_header()) {
    const auto& [bytes, kind, item, order, fortran_order, shape] = header_;
    const bool is_number = kinds.find(kind) != std::string_view::npos && (item == 4 || item == 8);
    if (!is_number || fortran_order || shape.size() != 2) {
      raise(ErrorCode::UnsupportedFormat,
            fmt::format("{}: an array of shape ({}), type {}{}{}, expected {} in C order", name_,
                        fmt::join(shape, ", "), kind, item, fortran_order ? ", in Fortran order" : "", expected));
    }
    check_size();
  }

  [[nodiscard]] std::uint64_t rows() const { return header_.shape[0]; }
  [[nodiscard]] std::uint64_t columns() const { return header_.shape[1]; }
  [[nodiscard]] std::size_t item() const { return header_.item; }
  [[nodiscard]] const std::string& name() const { return name_; }

  /// Calls `f(value)` with `count` values from value `first` on. `F` takes Small or Large, as the file has 4 or 8
  /// bytes.
  template <class Small, class Large, class F>
  void read(std::uint64_t first, std::uint64_t count, F&& f) {
    while (count != 0) {
      const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(count, kBufferBytes / item()));
      buffer_.resize(now * item());
      file_.read(header_.bytes + first * item(), buffer_);
      for (std::size_t i = 0; i < now; ++i) {
        const char* const place = buffer_.data() + i * item();
        item() == 4 ? f(io::number_at<Small>(place, header_.order)) : f(io::number_at<Large>(place, header_.order));
      }
      first += now;
      count -= now;
    }
  }

  void check_unchanged() const { file_.check_unchanged(); }

 private:
  [[nodiscard]] io::NpyHeader read_header() const {
    std::string head(static_cast<std::size_t>(std::min<std::uint64_t>(io::kNpyHeadBytes, file_.size())), '\0');
    file_.read(0, head);
    return io::parse_npy_header(head, name_);
  }

  void check_size() const {
    if (columns() == 0 && rows() != 0) {
      raise(ErrorCode::MalformedFile,
            fmt::format("{}: an array of shape ({}, 0), expected values in its rows", name_, rows()));
    }
    const std::uint64_t row = columns() * item();
    const std::uint64_t left = file_.size() - header_.bytes;
    const bool overflows = columns() > std::numeric_limits<std::uint32_t>::max();
    if (!overflows && (row == 0 || rows() <= left / row)) return;
    raise(ErrorCode::MalformedFile,
          fmt::format("{}: {} rows of {} values of {} bytes, but {} bytes follow the header: the file is truncated",
                      name_, rows(), columns(), item(), left));
  }

  RandomFile file_;
  std::string name_;
  io::NpyHeader header_;
  std::vector<char> buffer_;
};

class Arrays final : public ChunkedMesh {
 public:
  Arrays(Rows positions, Rows faces)
      : ChunkedMesh(positions.name(), positions.rows(), positions.item() == 8),
        positions_(std::move(positions)),
        faces_(std::move(faces)) {
    if (positions_.columns() != 3) {
      raise(ErrorCode::InvalidMesh, fmt::format("{}: an array of shape ({}, {}), expected three coordinates a vertex",
                                                name(), positions_.rows(), positions_.columns()));
    }
  }

  [[nodiscard]] const std::string& name_of_faces() const override { return faces_.name(); }

 private:
  void load_positions(std::uint64_t first, std::span<Point> out) override {
    std::array<double, 3> xyz{};
    std::size_t scalar = 0;
    positions_.read<float, double>(3 * first, 3 * out.size(), [&](auto value) {
      xyz[scalar % 3] = static_cast<double>(value);
      if (++scalar % 3 == 0) out[scalar / 3 - 1] = {xyz[0], xyz[1], xyz[2]};
    });
  }

  void check_unchanged() const override {
    positions_.check_unchanged();
    faces_.check_unchanged();
  }

  void load_first_face() override { left_ = {}; }

  bool load_face(std::uint64_t face, std::vector<std::uint64_t>& corners) override {
    if (face == faces_.rows()) return false;
    check_degree(faces_.columns());
    if (left_.empty()) load_ahead(face);
    const auto next = left_.first(static_cast<std::size_t>(faces_.columns()));
    corners.insert(corners.end(), next.begin(), next.end());
    left_ = left_.subspan(next.size());
    return true;
  }

  void load_ahead(std::uint64_t face) {
    const std::uint64_t columns = faces_.columns();
    const std::uint64_t rows = std::max<std::uint64_t>(1, Rows::kBufferBytes / 8 / columns);
    ahead_.clear();
    faces_.read<std::int32_t, std::int64_t>(face * columns, std::min(rows, faces_.rows() - face) * columns,
                                            [&](auto id) { ahead_.push_back(static_cast<std::uint64_t>(id)); });
    left_ = ahead_;
  }

  Rows positions_;
  Rows faces_;
  std::vector<std::uint64_t> ahead_;     // corners of some faces
  std::span<const std::uint64_t> left_;  // of these
};

}  // namespace

std::unique_ptr<ChunkedMesh> open_arrays(const std::filesystem::path& positions, const std::filesystem::path& faces) {
  return std::make_unique<Arrays>(Rows(positions, "f", "(#V, 3) float32 or float64"),
                                  Rows(faces, "iu", "(#F, k) integers of 4 or 8 bytes"));
}

}  // namespace meshhood::parts
