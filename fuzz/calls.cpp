// SPDX-License-Identifier: MIT
// Calls in any order: an input is a list of calls. Indexes of both kinds are built, cancelled, moved, saved, loaded,
// mapped, destroyed, rejected and queried; the answers are compared with the oracle.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "meshhood/meshhood.h"

#include "bytes.h"
#include "judge.h"
#include "support/families.h"
#include "support/index_bytes.h"
#include "support/oracle.h"
#include "support/paper_bounds.h"
#include "support/region_oracle.h"
#include "target.h"

namespace meshhood::fuzz {
namespace {

constexpr std::size_t kMostCalls = 60;

/// A mesh and its oracle, which refers to the mesh; so neither may move.
struct Subject {
  explicit Subject(test::TestMesh made) : mesh(std::move(made)), oracle(mesh) {}

  test::TestMesh mesh;
  test::Oracle oracle;
};

const std::deque<Subject>& subjects() {
  static const std::deque<Subject> all = [] {
    std::deque<Subject> made;
    for (const test::Family& family : test::families()) made.emplace_back(test::make_mesh(family, made.size(), 90));
    return made;
  }();
  return all;
}

/// Holds at most one index and a searcher on it.
template <class Index, class Searcher>
struct Place {
  const Subject* subject = nullptr;  // null if there is no index
  std::optional<Index> index;
  std::optional<Searcher> searcher;

  void put(const Subject& of, Index made) {
    clear();
    index = std::move(made);
    searcher.emplace(*index);
    subject = &of;
  }

  /// An index may be moved while a searcher uses it.
  void move_to(Place& other) {
    if (&other == this || subject == nullptr) return;
    other.clear();
    other.index = std::move(index);
    other.searcher = std::move(searcher);
    other.subject = subject;
    clear();
  }

  void clear() {
    searcher.reset();
    index.reset();
    subject = nullptr;
  }
};

/// A saved index.
struct File {
  const Subject* subject = nullptr;  // null if there is no file
  IndexKind kind = IndexKind::Exact;
  std::shared_ptr<test::Mappable> bytes;
};

template <class Call>
void expect_refused(ErrorCode code, Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    if (error.code() == code) return;
    fail(std::string("refused for another reason: ") + error.what());
  }
  fail("not refused");
}

class Session {
 public:
  explicit Session(std::span<const std::byte> input) : bytes_(input) {}

  void run() {
    for (std::size_t i = 0; i < kMostCalls && !bytes_.empty(); ++i) (this->*kCalls[below(kCalls.size())])();
  }

 private:
  using Exact = Place<Index, Searcher>;
  using Paper = Place<paper::Index, paper::Searcher>;

  std::size_t below(std::size_t bound) { return bytes_.take<std::uint8_t>() % bound; }
  const Subject& any_subject() { return subjects()[below(subjects().size())]; }
  Exact& any_exact() { return exact_[below(exact_.size())]; }
  Paper& any_paper() { return paper_[below(paper_.size())]; }
  File& any_file() { return files_[below(files_.size())]; }

  void build_exact() {
    Exact& place = any_exact();
    const Subject& subject = any_subject();
    place.put(subject, build(subject.mesh.view(), {.threads = static_cast<unsigned>(1 + below(3))}));
  }

  void build_paper() {
    Paper& place = any_paper();
    const Subject& subject = any_subject();
    place.put(subject, paper::build(subject.mesh.view(),
                                    {.levels = static_cast<int>(1 + below(8)), .discard = static_cast<int>(below(4))}));
  }

  void build_from_graph() {
    const Exact& source = any_exact();
    if (source.subject == nullptr) return;
    const GraphData data = extract_graph(*source.index);
    const Subject& subject = *source.subject;
    any_exact().put(subject, build(data.view()));
  }

  /// The index that was there before stays.
  void give_up_build() {
    const Subject& subject = any_subject();
    std::size_t left = below(32);
    const Progress stop = [&](std::size_t, std::size_t) { return left-- > 0; };
    try {
      static_cast<void>(build(subject.mesh.view(), {.threads = 2, .progress = stop}));
    } catch (const Error& error) {
      if (error.code() != ErrorCode::Cancelled) fail(error.what());
    }
  }

  void move_exact() {
    Exact& from = any_exact();
    from.move_to(any_exact());
  }

  void move_paper() {
    Paper& from = any_paper();
    from.move_to(any_paper());
  }

  void destroy_exact() { any_exact().clear(); }
  void destroy_paper() { any_paper().clear(); }

  template <class Indexed>
  void save_to_file(const Indexed& place, IndexKind kind) {
    File& file = any_file();
    if (place.subject == nullptr) return;
    file = {place.subject, kind, std::make_shared<test::Mappable>(test::saved(*place.index))};
  }

  void save_exact() { save_to_file(any_exact(), IndexKind::Exact); }
  void save_paper() { save_to_file(any_paper(), IndexKind::Paper); }

  void load_file() {
    const File& file = any_file();
    if (file.subject == nullptr) return;
    if (read_header(file.bytes->bytes()).kind != file.kind) fail("another kind than was saved");
    if (file.kind == IndexKind::Exact) {
      any_exact().put(*file.subject, load(file.bytes->bytes()));
    } else {
      any_paper().put(*file.subject, paper::load(file.bytes->bytes()));
    }
  }

  void load_other_kind() {
    const File& file = any_file();
    if (file.subject == nullptr) return;
    if (file.kind == IndexKind::Exact) {
      expect_refused(ErrorCode::MalformedIndex, [&] { static_cast<void>(paper::load(file.bytes->bytes())); });
    } else {
      expect_refused(ErrorCode::MalformedIndex, [&] { static_cast<void>(load(file.bytes->bytes())); });
    }
  }

  void load_part() {
    const File& file = any_file();
    if (file.subject == nullptr) return;
    const auto size = bytes_.take<std::uint32_t>() % file.bytes->bytes().size();
    expect_refused(ErrorCode::MalformedIndex, [&] { static_cast<void>(load(file.bytes->bytes().first(size))); });
  }

  /// The file may be removed; the index keeps its bytes alive.
  void map_file() {
    const File& file = any_file();
    if (file.subject == nullptr || file.kind != IndexKind::Exact) return;
    const bool trusted = below(2) == 1;
    any_exact().put(*file.subject, map(file.bytes->bytes(), file.bytes, {.trusted = trusted}));
  }

  void remove_file() { any_file() = {}; }

  void check() {
    const Exact& exact = any_exact();
    if (exact.subject != nullptr && !exact.index->check(exact.subject->mesh.view()).empty())
      fail("exact index: faults");
    const Paper& paper = any_paper();
    if (paper.subject != nullptr && !paper.index->check(paper.subject->mesh.view()).empty()) fail("paper's: faults");
  }

  struct Query {
    VertexId vertex;
    double radius;
  };

  Query any_query(const test::Oracle& oracle) {
    const auto vertex = static_cast<VertexId>(below(oracle.size()));
    const double radius = oracle.distance(vertex, below(oracle.size()));
    return {vertex, below(16) == 0 ? std::numeric_limits<double>::infinity() : radius};
  }

  void ask_exact() {
    Exact& place = any_exact();
    if (place.subject == nullptr || place.subject->oracle.size() == 0) return;
    const Query query = any_query(place.subject->oracle);
    const std::vector<std::uint32_t> expected = place.subject->oracle.exact(query.vertex, query.radius);
    place.searcher->neighborhood(query.vertex, query.radius, ids_, distances_);
    std::sort(ids_.begin(), ids_.end());
    if (ids_ != expected || distances_.size() != ids_.size()) fail("exact answer differs");
    if (place.searcher->count(query.vertex, query.radius) != expected.size()) fail("exact count differs");
  }

  void ask_paper() {
    Paper& place = any_paper();
    if (place.subject == nullptr || place.subject->oracle.size() == 0) return;
    const test::Oracle& oracle = place.subject->oracle;
    const Query query = any_query(oracle);
    place.searcher->neighborhood(query.vertex, query.radius, ids_);
    test::PaperBounds bounds(oracle.size());
    const auto inside = [&](VertexId w) {
      return oracle.distance(query.vertex, w) <= query.radius && oracle.component(query.vertex) == oracle.component(w);
    };
    if (!bounds.holds(oracle.exact(query.vertex, query.radius), ids_, inside)) fail("paper's answer differs");
  }

  void ask_batch() {
    const Exact& place = any_exact();
    if (place.subject == nullptr || place.subject->oracle.size() == 0) return;
    const test::Oracle& oracle = place.subject->oracle;
    const double radius = any_query(oracle).radius;
    std::vector<VertexId> vertices(1 + below(100));
    for (VertexId& v : vertices) v = static_cast<VertexId>(below(oracle.size()));
    const Run run{.threads = static_cast<unsigned>(1 + below(3))};
    const Neighborhoods answer =
        neighborhoods(*place.index, {.vertices = vertices, .radius = radius}, {.sort = RowSort::Id}, run);
    for (std::size_t row = 0; row < vertices.size(); ++row) {
      const auto ids =
          std::span(answer.ids).subspan(answer.offsets[row], answer.offsets[row + 1] - answer.offsets[row]);
      if (!std::ranges::equal(ids, oracle.exact(vertices[row], radius))) fail("a row of the batch differs");
    }
    aggregate_ids(*place.index, vertices, radius, answer, run.threads);
    fit_rows(place, vertices, radius, run.threads);
    find_patches(place, vertices, radius, run.threads);
    find_nearest(*place.index, vertices, radius, run.threads);
    follow_refit(place, {.vertices = vertices, .radius = radius}, run.threads);
  }

  /// Aggregates the ids of the vertices, as doubles, whose sums are exact.
  static void aggregate_ids(const Index& index, const std::vector<VertexId>& vertices, double radius,
                            const Neighborhoods& rows, unsigned threads) {
    std::vector<double> values(index.vertex_count());
    std::iota(values.begin(), values.end(), 0.0);
    const auto of = [&](std::vector<Reduce> reduce, SmoothingKernel kernel = SmoothingKernel::Box) {
      const AggregateQuery query{.vertices = vertices, .radius = radius, .reduce = std::move(reduce), .kernel = kernel};
      return aggregate(index, {values}, query, {.threads = threads});
    };
    const std::vector<double> exact = of({Reduce::Sum, Reduce::Count, Reduce::Maximum, Reduce::Median});
    const std::vector<double> means = of({Reduce::Mean}, SmoothingKernel::Biweight);
    const std::vector<double> smooth = of({Reduce::Mean}, SmoothingKernel::Gaussian);
    for (std::size_t row = 0; row < vertices.size(); ++row) {
      const auto ids = std::span(rows.ids).subspan(rows.offsets[row], rows.offsets[row + 1] - rows.offsets[row]);
      const double sum = std::accumulate(ids.begin(), ids.end(), 0.0);
      const double maximum = *std::ranges::max_element(ids);
      const double median = (static_cast<double>(ids[(ids.size() - 1) / 2]) + ids[ids.size() / 2]) / 2;
      const std::array expected{sum, static_cast<double>(ids.size()), maximum, median};
      const bool right = std::ranges::equal(expected, std::span(exact).subspan(4 * row, 4));
      // The query vertex has the weight 1, so the mean is a number.
      const auto is_within = [&](double mean) { return mean >= -1e-9 && mean <= maximum + 1e-9; };
      if (!right || !is_within(means[row]) || !is_within(smooth[row])) fail("an aggregate differs");
    }
  }

  /// Curvatures have the same bits however many threads there are, and the state of each row is correct.
  static void fit_rows(const Exact& place, const std::vector<VertexId>& vertices, double radius, unsigned threads) {
    const test::TestMesh& mesh = place.subject->mesh;
    if (mesh.face_count() == 0) return;
    const Surface surface(*place.index, mesh.view().faces);
    const BatchQuery query{.vertices = vertices, .radius = radius};
    const Curvatures found = curvatures(surface, query, {}, {.threads = threads});
    if (found.k1 != curvatures(surface, query, {}, {.threads = 1}).k1) fail("curvatures depend on the threads");
    const test::Oracle& oracle = place.subject->oracle;
    for (std::size_t row = 0; row < vertices.size(); ++row) {
      const std::size_t most = oracle.exact(vertices[row], std::numeric_limits<double>::infinity()).size();
      const CurvatureState state = found.state[row];
      const bool without = state == CurvatureState::TooFew || state == CurvatureState::NoNormal;
      if (most < 6 && !without) fail("a fit to fewer than six vertices");
      if (most >= 6 && state == CurvatureState::TooFew) fail("too few vertices where there are enough");
      if (!(found.k1[row] >= found.k2[row])) fail("curvatures are not in order");
      if (without && found.k1[row] != 0) fail("a curvature without a fit");
    }
  }

  /// Patches have the same bits however many threads there are, and those of a search alone but for rounding. They
  /// have all faces at their neighborhoods, unless edges that are no sides of triangles join these.
  static void find_patches(const Exact& place, const std::vector<VertexId>& vertices, double radius, unsigned threads) {
    const test::TestMesh& mesh = place.subject->mesh;
    const std::size_t polygons = count_polygons(mesh);
    if (polygons == 0) return;
    const Surface surface(*place.index, mesh.view().faces);
    const BatchQuery query{.vertices = vertices, .radius = radius};
    const Invariants found = invariants(surface, query, {.threads = threads});
    const std::vector<SurfacePoint> nearest = gaps(surface, query, {.threads = threads});
    if (!same_bits(found.area, invariants(surface, query, {.threads = 1}).area)) fail("areas depend on the threads");
    PatchSearcher searcher(surface);
    for (std::size_t row = 0; row < vertices.size(); ++row) {
      const VertexId v = vertices[row];
      const auto [area, volume] = searcher.measure(v, radius);
      const double disc = std::numbers::pi * radius * radius;
      if (std::abs(found.area[row] - area) > 1e-12 * std::max(area, disc)) fail("an area differs");
      if (std::isnan(found.volume[row]) != std::isnan(volume)) fail("a volume differs");
      const double distance = searcher.gap(v, radius).distance;
      if (!(nearest[row].distance == distance)) fail("a gap differs");
      if (distance > radius && nearest[row].face != kNoFace) fail("a gap outside the ball");
      const std::vector<std::size_t> faces = searcher.patch(v, radius);
      if (polygons == mesh.face_count()) expect_faces(mesh, place.subject->oracle.exact(v, radius), faces);
      if (row == 0) clip_patch(searcher, v, radius, faces);
    }
    find_patches_of_points(surface, mesh, vertices, radius, threads);
  }

  /// Rows of points nearest to the middles of pairs of vertices are searches alone, bit for bit. Some have another
  /// face.
  static void find_patches_of_points(const Surface& surface, const test::TestMesh& mesh,
                                     const std::vector<VertexId>& vertices, double radius, unsigned threads) {
    const std::size_t rows = vertices.size();
    const std::vector<double> scales{radius, 0, radius / 2};
    std::vector<std::size_t> faces;
    std::vector<SpacePoint> points;
    std::vector<double> radii;
    for (std::size_t row = 0; row < rows; ++row) {
      const double* const a = &mesh.positions[3 * std::size_t{vertices[row]}];
      const double* const b = &mesh.positions[3 * std::size_t{vertices[(row + 1) % rows]}];
      const SurfacePoint on = surface.closest_point({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
      faces.push_back((on.face + row % 8 / 7) % mesh.face_count());
      points.push_back(on.point);
      radii.push_back(scales[row % scales.size()]);
    }
    PatchSearcher searcher(surface);
    for (const BatchRadius& given : {BatchRadius(radius), BatchRadius(radii), BatchRadius::scales(scales)}) {
      const Invariants found = invariants(surface, faces, points, given, {.threads = threads});
      const std::vector<SurfacePoint> nearest = gaps(surface, faces, points, given, {.threads = threads});
      if (found.area.size() != (given.scales() ? scales.size() : 1) * rows) fail("another number of rows of points");
      for (std::size_t i = 0; i < found.area.size(); ++i) {
        const PatchStart start(faces[i % rows], points[i % rows]);
        const double one = given.scales() ? scales[i / rows] : given.list() ? radii[i] : radius;
        const auto [area, volume] = searcher.measure(start, one);
        const auto numbers = [](double a, double v, const SurfacePoint& gap) {
          return std::vector{a, v, gap.distance, gap.point[0], gap.point[1], gap.point[2]};
        };
        const SurfacePoint gap = searcher.gap(start, one);
        if (gap.face != nearest[i].face ||
            !same_bits(numbers(area, volume, gap), numbers(found.area[i], found.volume[i], nearest[i]))) {
          fail("a row of a point differs");
        }
      }
    }
  }

  /// Rows of nearest vertices, which are searched together, are those of single searches.
  static void find_nearest(const Index& index, const std::vector<VertexId>& vertices, double radius, unsigned threads) {
    const std::size_t k = 1 + vertices.size() / 2;
    const KNearest found = k_nearest(index, vertices, k, {.radius = radius}, {.threads = threads});
    Searcher searcher(index);
    std::vector<VertexId> ids;
    std::vector<double> distances;
    for (std::size_t row = 0; row < vertices.size(); ++row) {
      searcher.nearest_connected(vertices[row], k, ids, distances);
      ids.resize(static_cast<std::size_t>(std::ranges::upper_bound(distances, radius) - distances.begin()));
      distances.resize(ids.size());
      ids.resize(k, kNoVertex);
      distances.resize(k, std::numeric_limits<double>::infinity());
      if (!std::ranges::equal(ids, std::span(found.ids).subspan(row * k, k)) ||
          !std::ranges::equal(distances, std::span(found.distances).subspan(row * k, k))) {
        fail("a row of nearest vertices differs");
      }
    }
  }

  /// Counts the faces of three corners and more.
  static std::size_t count_polygons(const test::TestMesh& mesh) {
    std::size_t polygons = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      polygons += static_cast<std::size_t>(mesh.face(f).size() > 2);
    }
    return polygons;
  }

  /// Invariants, gaps, and walls at vertices and at the points of faces nearest to the origin.
  static std::vector<double> surface_numbers(const Surface& surface, const BatchQuery& query, unsigned threads) {
    Invariants found = invariants(surface, query, {.threads = threads});
    std::vector<double> all = std::move(found.area);
    all.insert(all.end(), found.volume.begin(), found.volume.end());
    for (const SurfacePoint& gap : gaps(surface, query, {.threads = threads})) all.push_back(gap.distance);
    std::vector<std::size_t> faces(surface.face_count());
    std::iota(faces.begin(), faces.end(), std::size_t{0});
    const std::vector<SpacePoint> points(faces.size());
    for (const ThicknessMethod method : {ThicknessMethod::Ray, ThicknessMethod::Sphere}) {
      for (const std::vector<double>& walls : {thickness(surface, query.vertices, method, {.threads = threads}),
                                               thickness(surface, faces, points, method, {.threads = threads})}) {
        if (std::ranges::any_of(walls, [](double wall) { return wall < 0; })) fail("a wall is negative");
        all.insert(all.end(), walls.begin(), walls.end());
      }
    }
    return all;
  }

  /// A surface that follows a refit is one that is made anew.
  void follow_refit(const Exact& place, const BatchQuery& query, unsigned threads) {
    if (count_polygons(place.subject->mesh) == 0) return;
    Surface surface(*place.index, place.subject->mesh.view().faces);
    const std::vector<double> before = surface_numbers(surface, query, threads);
    if (!same_bits(before, surface_numbers(surface, query, 1))) fail("the surface depends on the threads");
    test::TestMesh mesh = place.subject->mesh;
    std::vector<VertexId> changed;
    for (std::size_t i = below(4); i > 0; --i) {
      changed.push_back(static_cast<VertexId>(below(mesh.size())));
      std::copy_n(&mesh.positions[3 * below(mesh.size())], 3, &mesh.positions[3 * std::size_t{changed.back()}]);
    }
    mesh.finish(mesh.single_precision);
    const Index moved = refit(*place.index, mesh.positions_view(), changed);
    surface.refit_in_place(moved, changed);
    const Surface anew(moved, mesh.view().faces);
    if (!same_bits(surface_numbers(surface, query, threads), surface_numbers(anew, query, threads))) {
      fail("a surface does not follow a refit");
    }
  }

  static bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
    return std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)));
  }

  /// All faces at `vertices`, ascending, are among `faces`, ascending.
  static void expect_faces(const test::TestMesh& mesh, const std::vector<VertexId>& vertices,
                           const std::vector<std::size_t>& faces) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
      const bool is_met =
          std::ranges::any_of(mesh.face(f), [&](VertexId v) { return std::ranges::binary_search(vertices, v); });
      if (is_met && !std::ranges::binary_search(faces, f)) fail("a patch lacks a face");
    }
  }

  /// The patch of these faces as a mesh.
  static void clip_patch(PatchSearcher& searcher, VertexId v, double radius, const std::vector<std::size_t>& faces) {
    const ClippedMesh part = searcher.clip(v, radius, 1e-2);
    const bool is_valid =
        std::ranges::is_sorted(part.faces) &&
        std::ranges::all_of(part.faces, [&](std::size_t f) { return std::ranges::binary_search(faces, f); }) &&
        part.faces.size() == part.triangles.size() && part.points.size() == part.weights.size();
    if (!is_valid) fail("a clipped patch is not valid");
    for (const std::array<VertexId, 3>& triangle : part.triangles) {
      if (*std::ranges::max_element(triangle) >= part.points.size()) fail("a clipped triangle has no such point");
    }
  }

  /// Any center among the positions, up to three seeds, and walls.
  void ask_region() {
    const Exact& place = any_exact();
    if (place.subject == nullptr || place.subject->oracle.size() == 0) return;
    const test::RegionOracle oracle(place.subject->mesh);
    const std::size_t vertices = oracle.graph().size();
    test::PlainStart start;
    for (double& coordinate : start.center) coordinate = place.subject->mesh.positions[below(3 * vertices)];
    for (std::size_t i = below(4); i > 0; --i) start.seeds.push_back(static_cast<VertexId>(below(vertices)));
    start.walls.assign(vertices, 0);
    start.ignored.assign(vertices, 0);
    for (std::size_t i = below(8); i > 0; --i) start.walls[below(vertices)] = 1;
    const double radius = oracle.distance(start, below(vertices));
    const auto w = static_cast<VertexId>(below(vertices));
    const Index searched = masked(*place.index, {.walls = start.walls});
    Searcher searcher(searched);
    searcher.neighborhood({start.center, start.seeds}, radius, ids_);
    std::sort(ids_.begin(), ids_.end());
    if (ids_ != oracle.region(start, radius)) fail("the region differs");
    const double connecting = searcher.connecting_radius({start.center, start.seeds}, w);
    if (connecting != oracle.connecting_radii(start)[w]) fail("the connecting radius differs");
    std::vector<VertexId> all(vertices);
    std::iota(all.begin(), all.end(), VertexId{0});
    find_nearest(searched, all, radius, 2);
    const test::TestMesh& mesh = place.subject->mesh;
    const Surface surface(searched, mesh.view().faces);
    if (count_polygons(mesh) != 0) return find_patches_of_points(surface, mesh, all, radius, 2);
    const std::vector<std::size_t> none;
    expect_refused(ErrorCode::InvalidMesh, [&] { static_cast<void>(gaps(surface, none, {}, radius)); });
  }

  void ask_wrongly() {
    Exact& place = any_exact();
    if (place.subject == nullptr) return;
    const auto behind = static_cast<VertexId>(place.subject->oracle.size());
    expect_refused(ErrorCode::VertexOutOfRange, [&] { static_cast<void>(place.searcher->count(behind, 1)); });
    if (behind == 0) return;
    expect_refused(ErrorCode::InvalidRadius, [&] { static_cast<void>(place.searcher->count(0, -1)); });
  }

  using Call = void (Session::*)();
  static constexpr std::array<Call, 21> kCalls{
      &Session::build_exact, &Session::build_paper, &Session::build_from_graph, &Session::give_up_build,
      &Session::move_exact,  &Session::move_paper,  &Session::destroy_exact,    &Session::destroy_paper,
      &Session::save_exact,  &Session::save_paper,  &Session::load_file,        &Session::load_other_kind,
      &Session::load_part,   &Session::map_file,    &Session::remove_file,      &Session::check,
      &Session::ask_exact,   &Session::ask_paper,   &Session::ask_batch,        &Session::ask_wrongly,
      &Session::ask_region};

  Bytes bytes_;
  std::array<Exact, 3> exact_;
  std::array<Paper, 2> paper_;
  std::array<File, 3> files_;
  std::vector<VertexId> ids_;
  std::vector<double> distances_;
};

}  // namespace

void run(std::span<const std::byte> input) { Session(input).run(); }

}  // namespace meshhood::fuzz
