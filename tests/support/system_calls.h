// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The calls of the operating system that write files, listed, with one of them going wrong on purpose. The calls come
/// here from all that a program links statically, if it is linked with the option `--wrap` for each.
namespace meshhood::test {

enum class Call { Open, Write, Seek, Look, ChangeOwner, ChangeMode, Sync, Close, Rename, Unlink };
inline constexpr std::size_t kCalls = 10;

[[nodiscard]] std::string_view name_of(Call call);

enum class Mishap {
  None,
  Error,       ///< the call does nothing and fails; `close` fails, but has closed
  Short,       ///< a write takes half of its bytes; any other call goes well
  Kill,        ///< the process is killed before the call
  KillWithin,  ///< the process is killed when half of the bytes of a write are written, and before any other call
};

/// What goes wrong, and when.
struct Fault {
  Mishap mishap = Mishap::None;
  std::size_t at = 0;  ///< which call, counted from 0
  int error = 0;       ///< what `errno` then is
  bool stuck = false;  ///< no file can be removed either
};

/// A call that went well and has changed what a disk holds, or will hold.
struct Effect {
  Call call = Call::Open;
  int file = -1;               ///< the number of the file; not of `Rename` and `Unlink`
  std::string path = {};       ///< of `Open`, `Rename` and `Unlink`
  std::string to = {};         ///< of `Rename`
  std::string bytes = {};      ///< of `Write`: those that were taken
  std::uint64_t position = 0;  ///< of `Seek`: where it led
};

/// Lists calls, and has one go wrong, while it lives. One object at a time, one thread.
class SystemCalls {
 public:
  explicit SystemCalls(const Fault& fault = {});
  ~SystemCalls();
  SystemCalls(const SystemCalls&) = delete;
  SystemCalls& operator=(const SystemCalls&) = delete;

  /// In the order in which they were made.
  [[nodiscard]] const std::vector<Call>& made() const { return made_; }
  [[nodiscard]] const std::vector<Effect>& effects() const { return effects_; }

  /// Takes note of a call that is about to be made, and returns what shall become of it.
  [[nodiscard]] Mishap next(Call call);
  [[nodiscard]] int error() const { return fault_.error; }

  /// Takes note of what has come of it.
  void add(Effect effect) { effects_.push_back(std::move(effect)); }

 private:
  Fault fault_;
  std::vector<Call> made_;
  std::vector<Effect> effects_;
};

}  // namespace meshhood::test
