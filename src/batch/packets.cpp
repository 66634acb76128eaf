// SPDX-License-Identifier: MIT
// The neighborhoods of a batch as packets, each passed to the visitor of the thread that found it.
#include "batch/packets.h"

#include <vector>

#include "meshhood/error.h"

#include "batch/batch.h"

namespace meshhood {

void for_each_packet(const Index& index, const BatchQuery& query, const PacketVisitorFactory& make_visitor,
                     const PacketOptions& options, const Run& run) {
  if (!make_visitor) raise(ErrorCode::InvalidOption, "make_visitor is empty, expected a function");
  Batch batch(index, query, {}, run, 1);
  std::vector<PacketVisitor> visitors(batch.task().threads());
  batch.for_all_chunks([&](unsigned thread, const BatchChunk& chunk) {
    PacketVisitor& visitor = visitors[thread];
    if (!visitor) visitor = make_visitor(thread);
    if (!visitor) raise(ErrorCode::InvalidOption, "make_visitor returned an empty function");
    batch.worker(thread).visit(chunk.items, options.lengths, [&](const PacketAnswer& answer) {
      visitor(answer);
      batch.task().advance(thread, answer.rows.size());
      return batch.task().should_continue(thread);
    });
  });
  batch.task().finish();
}

}  // namespace meshhood
