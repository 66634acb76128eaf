// SPDX-License-Identifier: MIT
// Compiled with the headers and the renamed namespace of the other commit.
#include "before.h"

#include <utility>

#include "meshhood/meshhood.h"

namespace before {
namespace {

class ExactEngine : public Engine {
 public:
  explicit ExactEngine(meshhood::Index index) : index_(std::move(index)), searcher_(index_) {}

  void neighborhood(std::uint32_t v, double radius, std::vector<std::uint32_t>& out) override {
    searcher_.neighborhood(v, radius, out);
  }
  std::size_t count(std::uint32_t v, double radius) override { return searcher_.count(v, radius); }
  [[nodiscard]] std::size_t bytes() const override { return index_.bytes().total(); }

 private:
  meshhood::Index index_;
  meshhood::Searcher searcher_;
};

}  // namespace

std::unique_ptr<Engine> build(const Graph& graph) {
  const meshhood::PositionsView positions =
      graph.floats.empty() ? meshhood::PositionsView(graph.doubles) : meshhood::PositionsView(graph.floats);
  return std::make_unique<ExactEngine>(
      meshhood::build(meshhood::GraphView{positions, meshhood::AdjacencyView{graph.offsets, graph.neighbors}}));
}

}  // namespace before
