// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Records the system calls that write files, and lets one of them fail. With the linker option `--wrap` for each call,
/// all statically linked code calls these wrappers.
namespace meshhood::test {

enum class Call { Open, Write, Seek, Look, ChangeOwner, ChangeMode, Sync, Close, Rename, Unlink };
inline constexpr std::size_t kCalls = 10;

[[nodiscard]] std::string_view name_of(Call call);

enum class FaultKind {
  None,
  Error,       ///< the call does nothing and fails; `close` fails, but has closed
  Short,       ///< a write takes half of its bytes; other calls succeed
  Kill,        ///< the process is killed before the call
  KillWithin,  ///< the process is killed in the middle of a write, or before any other call
};

/// The fault and its time.
struct Fault {
  FaultKind kind = FaultKind::None;
  std::size_t at = 0;  ///< number of the call, from 0
  int error = 0;       ///< `errno` of the failure
  bool stuck = false;  ///< removing files fails as well
};

/// A successful call that changed a file or will change it.
struct Effect {
  Call call = Call::Open;
  int file = -1;               ///< file descriptor; not for `Rename` and `Unlink`
  std::string path = {};       ///< for `Open`, `Rename` and `Unlink`
  std::string to = {};         ///< for `Rename`
  std::string bytes = {};      ///< for `Write`: the bytes that were written
  std::uint64_t position = 0;  ///< for `Seek`: the new position
};

/// During its lifetime, records calls and lets one fail. At most one object at a time, one thread.
class SystemCalls {
 public:
  explicit SystemCalls(const Fault& fault = {});
  ~SystemCalls();
  SystemCalls(const SystemCalls&) = delete;
  SystemCalls& operator=(const SystemCalls&) = delete;

  /// In the order of the calls.
  [[nodiscard]] const std::vector<Call>& made() const { return made_; }
  [[nodiscard]] const std::vector<Effect>& effects() const { return effects_; }

  /// Counts a call that is about to be made, and returns its fault.
  [[nodiscard]] FaultKind next(Call call);
  [[nodiscard]] int error() const { return fault_.error; }

  /// Records a call that succeeded.
  void add(Effect effect) { effects_.push_back(std::move(effect)); }

 private:
  Fault fault_;
  std::vector<Call> made_;
  std::vector<Effect> effects_;
};

}  // namespace meshhood::test
