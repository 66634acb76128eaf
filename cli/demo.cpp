// SPDX-License-Identifier: MIT
// The commands that tools/demo runs. The program that `make demo` builds has no others, because a program with all
// commands takes twice as long to compile.
#include "commands.h"

namespace meshhood::cli {

void add_commands(CLI::App& program) {
  add_info(program);
  add_build(program);
  add_check(program);
  add_compare(program);
  add_generate(program);
}

}  // namespace meshhood::cli
