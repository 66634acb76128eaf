// SPDX-License-Identifier: MIT
#include "contestants.h"

#include <sstream>

#include "meshhood/error.h"

#include "measure/timing.h"

#if defined(MESHHOOD_BEFORE)
#include <type_traits>

#include "before/before.h"
#endif

namespace meshhood::bench {
namespace {

struct PaperOptions {
  paper::BuildOptions build;
  paper::QueryOptions query;
};

/// Parses the part of "paper,f=3,levels=4" after the first comma.
PaperOptions paper_options(const std::string& name) {
  PaperOptions options;
  std::istringstream words(name);
  std::string word;
  std::getline(words, word, ',');
  while (std::getline(words, word, ',')) {
    const auto equals = word.find('=');
    const std::string key = word.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : word.substr(equals + 1);
    if (key == "f") {
      options.query.radius_ratio = std::stod(value);
    } else if (key == "levels") {
      options.build.levels = std::stoi(value);
    } else if (key == "discard") {
      options.build.discard = std::stoi(value);
    } else {
      raise(ErrorCode::InvalidOption,
            std::string(name).append(": ").append(word).append(" is not one of f, levels, discard"));
    }
  }
  return options;
}

template <class BuildIndex>
double seconds_of(BuildIndex&& build_index) {
  const double start = measure::processor_time();
  static_cast<void>(build_index());
  return measure::processor_time() - start;
}

}  // namespace

Contestant Contestants::method(const std::string& name) {
  if (name == "bfs") return contestant(name, SearchMethod::breadth_first(graph()));
  if (name == "bfs-reordered") return bfs_reordered();
  if (name == "ball") return ball();
  if (name == "ids") return ids_method();
  if (name == "count") return count_method();
  if (name == "ranges") return ranges_method();
  if (name.starts_with("paper")) return paper(name);
  if (name.starts_with("before")) return before_method(name);
  raise(ErrorCode::InvalidOption, name + ": unknown method");
}

std::vector<Build> Contestants::time_builds(int times) const {
  std::vector<Build> builds{{"exact", {}, build(mesh_).bytes().total()},
                            {"paper", {}, paper::build(mesh_).bytes().total()}};
  for (int i = 0; i < times; ++i) {
    builds[0].seconds.push_back(seconds_of([&] { return build(mesh_, {.threads = 1}); }));
    builds[1].seconds.push_back(seconds_of([&] { return paper::build(mesh_); }));
  }
  return builds;
}

const Index& Contestants::another_exact() {
  exacts_.push_back(std::make_unique<Index>(build(mesh_)));
  return *exacts_.back();
}

Contestant Contestants::ball() const {
  Contestant ball = contestant("ball", SearchMethod::ball_scan(mesh_.positions));
  ball.visits_all_vertices = true;
  return ball;
}

Contestant Contestants::ids_method() { return contestant("ids", another_exact()); }

Contestant Contestants::before_method(const std::string& name) {
#if defined(MESHHOOD_BEFORE)
  std::vector<float> floats;
  std::vector<double> doubles;
  mesh_.positions.visit([&]<class Real>(const StridedPositions<Real>& xyz) {
    for (std::size_t v = 0; v < xyz.size(); ++v) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if constexpr (std::is_same_v<Real, float>) {
          floats.push_back(xyz(v, axis));
        } else {
          doubles.push_back(xyz(v, axis));
        }
      }
    }
  });
  const std::vector<std::uint32_t> offsets(adjacency_.offsets.begin(), adjacency_.offsets.end());
  const std::shared_ptr<before::Engine> engine = before::build({floats, doubles, offsets, adjacency_.neighbors});
  if (name == "before-count") {
    return {.name = name,
            .neighborhood = [engine](VertexId v, double radius,
                                     std::vector<VertexId>&) { static_cast<void>(engine->count(v, radius)); },
            .lists_vertices = false};
  }
  return {.name = name, .neighborhood = [engine](VertexId v, double radius, std::vector<VertexId>& out) {
            engine->neighborhood(v, radius, out);
          }};
#else
  raise(ErrorCode::InvalidOption, name + ": there is no other commit; see bench/before/build");
#endif
}

Contestant Contestants::bfs_reordered() {
  if (!reordered_) reordered_ = std::make_unique<Reordered>(graph(), order());
  auto searcher = std::make_shared<ReferenceSearcher>(reordered_->view());
  return {.name = "bfs-reordered",
          .neighborhood =
              [searcher, this](VertexId v, double radius, std::vector<VertexId>& out) {
                searcher->neighborhood(reordered_->new_id[v], radius, out);
              },
          .lists_vertices = false};  // its answers have another numbering
}

template <class Query>
Contestant Contestants::unlisted(const std::string& name, Query query) {
  auto searcher = std::make_shared<Searcher>(another_exact());
  return {.name = name,
          .neighborhood = [searcher, query](VertexId v, double radius,
                                            std::vector<VertexId>&) { static_cast<void>(query(*searcher, v, radius)); },
          .lists_vertices = false};
}

Contestant Contestants::count_method() {
  return unlisted("count", [](Searcher& searcher, VertexId v, double radius) { return searcher.count(v, radius); });
}

Contestant Contestants::ranges_method() {
  return unlisted("ranges", [](Searcher& searcher, VertexId v, double radius) { return searcher.ranges(v, radius); });
}

Contestant Contestants::paper(const std::string& name) {
  const PaperOptions options = paper_options(name);
  papers_.push_back(std::make_unique<paper::Index>(paper::build(graph(), options.build)));
  return contestant(name, {*papers_.back(), options.query});
}

}  // namespace meshhood::bench
