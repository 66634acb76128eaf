// SPDX-License-Identifier: MIT
// The neighborhoods of a batch as packets, each passed to the visitor of the thread that found it.
#include "batch/packets.h"

#include <memory>
#include <vector>

#include "meshhood/error.h"

#include "batch/batch.h"
#include "batch/joint_worker.h"
#include "exact/query/filtered.h"

namespace meshhood {
namespace {

/// The state of a thread.
struct PacketThread {
  JointWorker worker;
  PacketVisitor visitor;

  PacketThread(const Index& index, PacketVisitor visit) : worker(index), visitor(std::move(visit)) {
    if (!visitor) raise(ErrorCode::InvalidOption, "make_visitor returned an empty function");
  }
};

}  // namespace

void for_each_packet(const Index& index, const BatchQuery& query, const PacketVisitorFactory& make_visitor,
                     const PacketOptions& options) {
  if (!make_visitor) raise(ErrorCode::InvalidOption, "make_visitor is empty, expected a function");
  const BatchOptions batch_options{.threads = options.threads, .progress = options.progress};
  const Index searched = filtered(index, query.filter, options.threads);
  Batch batch(searched, {.vertices = query.vertices, .radius = query.radius}, batch_options, 1);
  std::vector<std::unique_ptr<PacketThread>> threads(batch.task().threads());
  batch.for_all_chunks([&](unsigned thread, const BatchChunk& chunk) {
    if (!threads[thread]) threads[thread] = std::make_unique<PacketThread>(searched, make_visitor(thread));
    threads[thread]->worker.visit(chunk.items, [&](const PacketAnswer& answer) {
      threads[thread]->visitor(answer);
      batch.task().advance(thread, answer.rows.size());
      return batch.task().should_continue(thread);
    });
  });
  batch.task().finish();
}

}  // namespace meshhood
