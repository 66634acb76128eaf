// SPDX-License-Identifier: MIT
#include "io/zip_writer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <minizip/zip.h>

#include "io/file_writer.h"
#include "io/messages.h"

namespace meshhood::io {
namespace {

/// The file that minizip writes to. Minizip is C, so no exception may pass through it: the first is kept for `check` to
/// throw, and nothing is written after it. Minizip itself gets no error, because it leaks memory if a write fails.
struct Target {
  FileWriter file;
  std::exception_ptr failure = nullptr;

  template <class F>
  void attempt(F&& f) noexcept {
    if (failure) return;
    try {
      std::forward<F>(f)(file);
    } catch (...) {
      failure = std::current_exception();
    }
  }
};

voidpf open_target(voidpf target, const void* /*path*/, int /*mode*/) { return target; }

uLong write_to(voidpf target, voidpf /*stream*/, const void* bytes, uLong size) {
  const std::string_view text(static_cast<const char*>(bytes), size);
  static_cast<Target*>(target)->attempt([&](FileWriter& file) { file.write(text); });
  return size;
}

ZPOS64_T position_in(voidpf target, voidpf /*stream*/) { return static_cast<Target*>(target)->file.position(); }

/// For a new file, minizip seeks only from the beginning.
long seek_in(voidpf target, voidpf /*stream*/, ZPOS64_T position, int /*origin*/) {
  static_cast<Target*>(target)->attempt([&](FileWriter& file) { file.seek(position); });
  return 0;
}

int close_target(voidpf /*target*/, voidpf /*stream*/) { return 0; }

int has_failed(voidpf /*target*/, voidpf /*stream*/) { return 0; }

zlib_filefunc64_def functions_of(Target& target) {
  return {.zopen64_file = open_target,
          .zread_file = nullptr,
          .zwrite_file = write_to,
          .ztell64_file = position_in,
          .zseek64_file = seek_in,
          .zclose_file = close_target,
          .zerror_file = has_failed,
          .opaque = &target};
}

}  // namespace

struct ZipWriter::State {
  explicit State(const std::filesystem::path& file)
      : path(file),
        target{FileWriter(file, FileWriter::Order::Any)} {  // the sizes in the headers are written after the values
    zlib_filefunc64_def functions = functions_of(target);
    zip = zipOpen2_64(path.c_str(), APPEND_STATUS_CREATE, nullptr, &functions);
    if (zip == nullptr) throw std::bad_alloc();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (zip != nullptr) zipClose(zip, nullptr);
  }

  void check(int status) const {
    if (target.failure) std::rethrow_exception(target.failure);
    if (status != ZIP_OK) {
      raise_io(path, 0, fmt::format("cannot write a zip file: minizip error {}", status));
    }
  }

  std::filesystem::path path;
  Target target;
  zipFile zip = nullptr;
  bool in_member = false;
};

ZipWriter::ZipWriter(const std::filesystem::path& path) : state_(std::make_unique<State>(path)) {}
ZipWriter::~ZipWriter() = default;

void ZipWriter::begin(const std::string& name, std::uint64_t bytes, Packing packing) {
  constexpr std::uint64_t kLargestWithoutZip64 = 0xff000000;  // 2^32 - 1, less what compression may add
  if (std::exchange(state_->in_member, true)) state_->check(zipCloseFileInZip(state_->zip));
  const zip_fileinfo info{
      .tmz_date = {.tm_sec = 0, .tm_min = 0, .tm_hour = 0, .tm_mday = 1, .tm_mon = 0, .tm_year = 1980},
      .dosDate = 0,
      .internal_fa = 0,
      .external_fa = 0};
  const int method = packing == Packing::Deflated ? Z_DEFLATED : 0;
  state_->check(zipOpenNewFileInZip64(state_->zip, name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr, method,
                                      Z_BEST_SPEED, bytes > kLargestWithoutZip64 ? 1 : 0));
}

void ZipWriter::write(std::string_view bytes) {
  constexpr std::size_t kMost = std::size_t{1} << 30;  // minizip counts in 32 bits
  while (!bytes.empty()) {
    const std::string_view part = bytes.substr(0, kMost);
    state_->check(zipWriteInFileInZip(state_->zip, part.data(), static_cast<unsigned>(part.size())));
    bytes.remove_prefix(part.size());
  }
}

void ZipWriter::commit() {
  state_->check(zipClose(std::exchange(state_->zip, nullptr), nullptr));
  state_->target.file.commit();
}

}  // namespace meshhood::io
