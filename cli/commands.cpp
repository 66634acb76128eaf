// SPDX-License-Identifier: MIT
#include "commands.h"

namespace meshhood::cli {

void add_commands(CLI::App& program) {
  add_info(program);
  add_build(program);
  add_check(program);
#ifndef MESHHOOD_DEMO  // tools/demo runs only the others, and a program with all takes twice as long to compile
  add_query(program);
  add_connect(program);
  add_region(program);
  add_closest(program);
  add_batch(program);
  add_aggregate(program);
  add_curvature(program);
  add_features(program);
  add_invariants(program);
  add_unconnected(program);
  add_gaps(program);
  add_partition(program);
#endif
  add_compare(program);
  add_generate(program);
#ifndef MESHHOOD_DEMO
  add_view(program);
  add_manual(program);
#endif
}

}  // namespace meshhood::cli
