// SPDX-License-Identifier: MIT
#pragma once

namespace CLI {
class App;
}

/// The subcommands, one file each. Each function adds a subcommand with its options; the command runs inside `parse`.
namespace meshhood::cli {

/// All subcommands of the program, in the order of its help.
void add_commands(CLI::App& program);

void add_aggregate(CLI::App& program);
void add_batch(CLI::App& program);
void add_build(CLI::App& program);
void add_check(CLI::App& program);
void add_closest(CLI::App& program);
void add_compare(CLI::App& program);
void add_connect(CLI::App& program);
void add_curvature(CLI::App& program);
void add_features(CLI::App& program);
void add_gaps(CLI::App& program);
void add_generate(CLI::App& program);
void add_info(CLI::App& program);
void add_invariants(CLI::App& program);
void add_manual(CLI::App& program);
void add_partition(CLI::App& program);
void add_query(CLI::App& program);
void add_region(CLI::App& program);
void add_unconnected(CLI::App& program);
void add_view(CLI::App& program);

}  // namespace meshhood::cli
