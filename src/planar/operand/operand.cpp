#include "planar/operand/operand.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "base/scratch.h"
#include "planar/operand/edges.h"
#include "planar/operand/lattice.h"
#include "planar/region/region.h"
#include "planar/region/region_validate.h"

namespace dymsum::planar {
namespace {

std::vector<Point> source_vertices(const RegionData& region, std::size_t n, bool reflected) {
  std::vector<Point> all;
  all.reserve(n);
  for_each_chain(region,
                 [&](const std::vector<Point>& points) { all.insert(all.end(), points.begin(), points.end()); });
  if (reflected)
    for (Point& p : all) p = {0 - p.x, 0 - p.y};  // leaves no negative zeros
  return all;
}

std::shared_ptr<const PlacedPoints> placed_vertices(const EngineRegion& region, std::size_t n, bool reflected) {
  if (region.fractions == nullptr) return place_points(source_vertices(region.data(), n, reflected));
  std::vector<exact::HomogeneousPoint> at = *region.fractions;
  if (reflected)
    for (exact::HomogeneousPoint& v : at) v.x.backend().negate(), v.y.backend().negate();
  return fractions_as_points(std::move(at));
}

struct Size {
  std::size_t vertices = 0, walk = 0, loops = 0, components = 0;  // `walk` before collinear vertices are dropped
};
Size size_of(const RegionData& region) {
  Size size;
  size.components = region.parts.size() + region.polylines.size() + region.points.size();
  size.loops = size.components;
  for (const Part& part : region.parts) {
    size.vertices += part.outer.size();
    size.loops += part.holes.size();
    for (const Ring& hole : part.holes) size.vertices += hole.size();
  }
  size.walk = size.vertices + region.points.size();
  for (const Polyline& line : region.polylines) {
    size.vertices += line.size();
    size.walk += 2 * (line.size() - 1);
  }
  size.vertices += region.points.size();
  return size;
}

// Roughly what the arrays of an operand take, so that one block holds them.
std::size_t bytes_for(const Size& size) {
  constexpr std::size_t kPerVertex = sizeof(EdgeBox) + sizeof(Operand::Indices) + 12 * sizeof(double);
  return kPerVertex * size.walk + (sizeof(Loop) + 2) * size.loops +
         (sizeof(Component) + 2 * sizeof(DirectionList) + 32) * size.components + 256;
}

// A rotation moves the first direction to another place of the list.
void restart(DirectionList& list, const Operand& o, const Lattice& lattice) {
  const std::size_t n = list.edges.size();
  std::size_t first = 0;
  for (std::size_t k = 1; k < n && first == 0; ++k)
    if (compare_directions(lattice, list.keys[k], o.edge(list.edges[k]), list.keys[k - 1], o.edge(list.edges[k - 1])) <
        0)
      first = k;
  std::rotate(list.edges.begin(), list.edges.begin() + static_cast<std::ptrdiff_t>(first), list.edges.end());
  std::rotate(list.keys.begin(), list.keys.begin() + static_cast<std::ptrdiff_t>(first), list.keys.end());
  number(list, o);
}

// The same by points that are no doubles.
template <class Points>
void find_exact_extremes(Loop& loop, const Operand& o, const Points& points) {
  loop.min_x = loop.max_x = loop.min_y = loop.max_y = o.source[loop.first];
  for (std::uint32_t i = loop.first; i < loop.last; ++i) {
    const std::uint32_t s = o.source[i];
    if (points.compare(s, loop.min_x, 0) < 0) loop.min_x = s;
    if (points.compare(s, loop.max_x, 0) > 0) loop.max_x = s;
    if (points.compare(s, loop.min_y, 1) < 0) loop.min_y = s;
    if (points.compare(s, loop.max_y, 1) > 0) loop.max_y = s;
  }
}

void find_largest_holes(Operand& o) {
  const PlacedPoints& at = *o.points;
  const auto width = [&](const Loop& l) { return at.x[l.max_x] - at.x[l.min_x]; };
  const auto height = [&](const Loop& l) { return at.y[l.max_y] - at.y[l.min_y]; };
  for (Component& c : o.components) {
    c.widest_hole = c.tallest_hole = c.first_loop + 1;
    for (std::uint32_t l = c.first_loop + 2; l < c.last_loop; ++l) {
      if (width(o.loops[l]) > width(o.loops[c.widest_hole])) c.widest_hole = l;
      if (height(o.loops[l]) > height(o.loops[c.tallest_hole])) c.tallest_hole = l;
    }
  }
}

// The walk beside its edge vectors.
void place_walk(Operand& o) {
  const std::size_t n = o.size();
  for (auto* list : {&o.x, &o.y}) list->resize(n);
  o.boxes.resize(n);
  const double *const x = o.points->x.data(), *const y = o.points->y.data();
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t from = o.source[i], to = o.source[o.next[i]];
    o.boxes[i] = {x[from], y[from], x[to], y[to], o.ex[i], o.ey[i]};
    o.x[i] = x[from];
    o.y[i] = y[from];
  }
}

// Everything that counts in the lattice's units.
void place(Operand& o, const Lattice& lattice) {
  o.points = lattice.points[o.op];
  for (std::uint32_t i = 0; i < o.size(); ++i) {
    const Point d = lattice.vector(o.edge(i));
    o.ex[i] = d.x;
    o.ey[i] = d.y;
  }
  place_walk(o);
  // A scale per axis keeps the order of the directions, but not their angles.
  for (DirectionList& list : o.directions)
    for (std::size_t k = 0; k < list.edges.size(); ++k) {
      const std::uint32_t i = list.edges[k];
      const Point d = lattice.wide ? lattice.direction(o.edge(i)) : Point{o.ex[i], o.ey[i]};
      list.keys[k] = pseudo_angle(d.x, d.y);
    }
  if (o.points->turned != nullptr) {
    for (DirectionList& list : o.directions) restart(list, o, lattice);
    for (Loop& loop : o.loops) find_exact_extremes(loop, o, *o.points->turned);
    find_largest_holes(o);
  }
}

constexpr std::uint32_t kUnnumbered = 0xffffffff;  // SumVertex::kNone

class Builder {
 public:
  Builder(std::uint32_t op, const EngineRegion& region, std::shared_ptr<const PlacedPoints> points, const Size& size)
      : region_(region), edges_(*points), made_(std::make_shared<Operand>(bytes_for(size))), out_(*made_) {
    out_.op = op;
    out_.points = std::move(points);
    for (auto* list : {&out_.source, &out_.next, &out_.prev, &out_.vertex_index, &out_.edge_index})
      list->resize(size.walk);
    out_.convex.resize(size.walk);
    for (auto* list : {&out_.ex, &out_.ey}) list->resize(size.walk);
    out_.loops.reserve(size.loops);
    out_.components.reserve(size.components);
    out_.directions.reserve(size.components + (size.loops > size.components ? size.components : 0));
    out_.component_directions.reserve(size.components);
  }

  void begin_component(int dimension) {
    Component c;
    c.dimension = dimension;
    c.first_loop = static_cast<std::uint32_t>(out_.loops.size());
    c.first = size_;
    out_.components.push_back(c);
  }
  void end_component() {
    Component& c = out_.components.back();
    c.last_loop = static_cast<std::uint32_t>(out_.loops.size());
    c.last = size_;
    const auto outer = out_.convex.begin() + c.first;
    c.convex = c.dimension == 2 &&
               std::all_of(outer, outer + out_.loops[c.first_loop].last - c.first, [](auto f) { return f != 0; });
  }

  // A closed walk through source vertices; numbers[i] is the number of the edge from walk[i] to walk[i + 1].
  void add_loop(LoopKind kind, std::span<const std::uint32_t> walk, std::span<const std::uint32_t> indices) {
    const std::size_t n = walk.size();
    const auto edge = [&](std::size_t i) { return Edge{out_.op, walk[i], walk[i + 1 == n ? 0 : i + 1]}; };
    const std::uint32_t first = size_;
    std::uint32_t at = first;
    // Stores of bytes may change anything, as far as the compiler knows: even where the lists lie.
    std::uint32_t *const source = out_.source.data(), *const edge_index = out_.edge_index.data(),
                         *const vertex_index = out_.vertex_index.data();
    std::uint8_t* const convex = out_.convex.data();
    double *const ex = out_.ex.data(), *const ey = out_.ey.data();
    const bool touching = region_.touching;
    Point d = edges_.vector(walk[n - 1], walk[0]);
    for (std::size_t i = 0, before = n - 1; i < n; before = i++) {
      const Edge out = edge(i);
      const Point e = edges_.vector(out.from, out.to);
      const double value = d.x * e.y - d.y * e.x;
      const double bound = kEdgeCross * (std::abs(d.x * e.y) + std::abs(d.y * e.x)) + exact::kUnderflow;
      d = e;
      source[at] = walk[i];
      // The straight run that starts here; backward runs of a polyline carry the number of their forward run.
      edge_index[at] = region_.edge_index(indices[i]);
      vertex_index[at] = region_.vertex_index(walk[i]);
      ex[at] = e.x;
      ey[at] = e.y;
      convex[at] = value > 0;
      if (std::abs(value) > bound) [[likely]] {
        ++at;
        continue;
      }
      const Turn t = exact_turn(edge(before), out);
      convex[at] = t == Turn::convex;
      // Where a walk goes straight from one ring's edge to another's, the vertex stays: a contact names an edge of one
      // ring.
      const bool same_run = !touching || region_.edge_index(indices[i]) == region_.edge_index(indices[before]);
      if (t != Turn::straight || !same_run) ++at;
    }
    link(first, at);
    if (at - first < n) measure(first, at);
    add(kind, first, at);
  }

  void add_point(std::uint32_t source) {
    begin_component(0);
    out_.source[size_] = source;
    out_.edge_index[size_] = region_.edge_index(source);
    out_.vertex_index[size_] = region_.vertex_index(source);
    out_.convex[size_] = 1;
    out_.ex[size_] = out_.ey[size_] = 0;
    link(size_, size_ + 1);
    add(LoopKind::point, size_, size_ + 1);
    end_component();
  }

  std::shared_ptr<Operand> finish() && {
    for (auto* list : {&out_.source, &out_.next, &out_.prev, &out_.vertex_index, &out_.edge_index}) list->resize(size_);
    out_.convex.resize(size_);
    for (auto* list : {&out_.ex, &out_.ey}) list->resize(size_);
    place_walk(out_);
    out_.component_of.resize(size_);
    for (std::uint32_t c = 0; c < out_.components.size(); ++c) {
      const Component& component = out_.components[c];
      std::fill(out_.component_of.begin() + component.first, out_.component_of.begin() + component.last, c);
      const std::uint32_t all = static_cast<std::uint32_t>(out_.directions.size());
      out_.directions.push_back(sort_by_direction(edges_, out_, component));
      out_.component_directions.push_back({all, all});
      if (component.last_loop - component.first_loop == 1) continue;
      std::vector<std::uint8_t> keep(out_.loops.size(), 0);
      keep[component.first_loop] = 1;
      out_.directions.push_back(sublist(out_.directions[all], out_, component, keep, DirectionList(out_.memory)));
      out_.component_directions.back()[1] = all + 1;
    }
    for (Loop& loop : out_.loops) find_extremes(loop);
    find_largest_holes(out_);
    invert_numbers();
    return std::move(made_);
  }

 private:
  enum class Turn { straight, right, convex };

  void add(LoopKind kind, std::uint32_t first, std::uint32_t last) {
    Loop loop;
    loop.kind = kind;
    loop.component = static_cast<std::uint32_t>(out_.components.size() - 1);
    loop.first = first;
    loop.last = last;
    out_.loops.push_back(loop);
    size_ = last;
  }
  void link(std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t i = first; i < last; ++i) {
      out_.next[i] = i + 1;
      out_.prev[i] = i - 1;
    }
    out_.next[last - 1] = first;
    out_.prev[first] = last - 1;
  }
  // Edges anew where collinear vertices were dropped.
  void measure(std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t i = first; i < last; ++i) {
      const Point e = edges_.vector(out_.source[i], out_.source[out_.next[i]]);
      out_.ex[i] = e.x;
      out_.ey[i] = e.y;
    }
  }

  // Vertices and edges of an erosion's frame have no numbers.
  void invert_numbers() {
    const bool renumbered = !region_.vertex_indices.empty();
    std::uint32_t size = renumbered ? 0 : static_cast<std::uint32_t>(out_.points->input.size());
    if (renumbered)
      for (const auto* indices : {&out_.vertex_index, &out_.edge_index})
        for (const std::uint32_t v : *indices) size = v == kUnnumbered ? size : std::max(size, v + 1);
    out_.indices.resize(size_);
    for (std::uint32_t i = 0; i < size_; ++i)
      out_.indices[i] = {out_.vertex_index[i], out_.edge_index[i], out_.vertex_index[out_.next[i]]};
    out_.vertex_of_index.assign(size, 0);
    out_.edge_of_index.assign(size, {kUnnumbered, kUnnumbered});
    // Edges of rings that are not cut have one piece each.
    const bool whole = !renumbered && region_.data().polylines.empty();
    for (std::uint32_t i = 0; i < size_; ++i) {
      const std::uint32_t vertex = out_.vertex_index[i], edge = out_.edge_index[i];
      const std::uint32_t from = out_.source[i], to = out_.source[out_.next[i]];
      if (vertex != kUnnumbered) out_.vertex_of_index[vertex] = from;
      if (whole) out_.edge_of_index[edge] = {from, to};
      else if (edge != kUnnumbered) extend(out_.edge_of_index[edge], from, to);
    }
  }
  // Extends an edge that is cut by its piece from a to b: positions on one line are in the order of either coordinate
  // that changes.
  void extend(std::array<std::uint32_t, 2>& edge, std::uint32_t a, std::uint32_t b) const {
    if (edge[0] == kUnnumbered) {
      edge = {a, b};
      return;
    }
    const int forward = compare(a, b);
    const auto before = [&](std::uint32_t i, std::uint32_t j) { return compare(i, j) == forward; };
    if (before(a, edge[0])) edge[0] = a;
    if (before(edge[1], b)) edge[1] = b;
  }
  // Lexicographic order of two source vertices: -1, 0, 1.
  int compare(std::uint32_t i, std::uint32_t j) const {
    if (const FractionPoints* fractions = out_.points->fractions.get(); fractions != nullptr) {
      const int order = fractions->compare(i, j, 0);
      return order != 0 ? order : fractions->compare(i, j, 1);
    }
    const Point a = out_.points->input[i], b = out_.points->input[j];
    if (a == b) return 0;
    return (a.x != b.x ? a.x < b.x : a.y < b.y) ? -1 : 1;
  }
  void find_extremes(Loop& loop) const {
    if (out_.points->fractions != nullptr) {
      find_exact_extremes(loop, out_, *out_.points->fractions);
      return;
    }
    const std::vector<Point>& v = out_.points->input;
    std::uint32_t min_x = out_.source[loop.first], max_x = min_x, min_y = min_x, max_y = min_x;
    Point low = v[min_x], high = low;
    for (std::uint32_t i = loop.first + 1; i < loop.last; ++i) {
      const std::uint32_t s = out_.source[i];
      const Point p = v[s];
      if (p.x < low.x) low.x = p.x, min_x = s;
      if (p.x > high.x) high.x = p.x, max_x = s;
      if (p.y < low.y) low.y = p.y, min_y = s;
      if (p.y > high.y) high.y = p.y, max_y = s;
    }
    loop.min_x = min_x;
    loop.max_x = max_x;
    loop.min_y = min_y;
    loop.max_y = max_y;
  }

  Turn exact_turn(const Edge& in, const Edge& out) const {
    const int s = edges_.cross(in, out);
    if (s != 0) return s > 0 ? Turn::convex : Turn::right;
    return edges_.dot(in, out) > 0 ? Turn::straight : Turn::convex;  // folding back: the tip of a spike
  }

  const EngineRegion& region_;
  OwnEdges edges_;
  std::shared_ptr<Operand> made_;
  Operand& out_;
  std::uint32_t size_ = 0;  // walk vertices so far
};

}  // namespace

std::shared_ptr<Operand> make_operand(const EngineRegion& engine_region, std::uint32_t op, bool reflected) {
  const RegionData& region = engine_region.data();
  const Size size = size_of(region);
  Builder builder(op, engine_region, placed_vertices(engine_region, size.vertices, reflected), size);
  std::uint32_t at = 0;
  Scratch memory;
  Array<std::uint32_t> walk(&memory), indices(&memory);
  walk.reserve(size.walk);
  const auto ring = [&](const Ring& r, LoopKind kind) {
    walk.resize(r.size());
    std::iota(walk.begin(), walk.end(), at);
    at += static_cast<std::uint32_t>(r.size());
    builder.add_loop(kind, walk, walk);
  };
  for (const Part& part : region.parts) {
    builder.begin_component(2);
    ring(part.outer, LoopKind::outer);
    for (const Ring& hole : part.holes) ring(hole, LoopKind::hole);
    builder.end_component();
  }
  for (const Polyline& line : region.polylines) {
    const std::uint32_t n = static_cast<std::uint32_t>(line.size());
    builder.begin_component(1);
    walk.clear();
    indices.clear();
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
      walk.push_back(at + i);
      indices.push_back(at + i);
    }
    for (std::uint32_t i = n - 1; i > 0; --i) {
      walk.push_back(at + i);
      indices.push_back(at + i - 1);
    }
    builder.add_loop(LoopKind::curve, walk, indices);
    builder.end_component();
    at += n;
  }
  for (std::size_t i = 0; i < region.points.size(); ++i) builder.add_point(at++);
  std::shared_ptr<Operand> made = std::move(builder).finish();
  made->reflected = reflected;
  return made;
}

std::shared_ptr<const Operand> placed_on(const Lattice& lattice, std::shared_ptr<const Operand> operand) {
  if (lattice.points[operand->op] == operand->points) return operand;
  auto moved = std::make_shared<Operand>(*operand);
  place(*moved, lattice);
  return moved;
}

std::optional<Error> too_large(const PlacedPoints& points) {
  constexpr double kLimit = 0x1p1000;
  if (points.extent + std::abs(points.offset.x) + std::abs(points.offset.y) <= kLimit) return std::nullopt;
  for (const Point& v : points.input) {
    if (std::abs(v.x) <= kLimit && std::abs(v.y) <= kLimit) continue;
    Error error{ErrorCode::unsupported_operand, "a coordinate is larger than 2^1000", {}};
    error.evidence.x = v.x;
    error.evidence.y = v.y;
    return error;
  }
  return std::nullopt;
}

std::optional<Error> too_large(const Operand& operand) {
  std::optional<Error> error = too_large(*operand.points);
  if (!error || !operand.reflected) return error;
  error->evidence.x = 0 - *error->evidence.x;
  error->evidence.y = 0 - *error->evidence.y;
  return error;
}

bool has_component_without_area(const Operand& operand) {
  return std::any_of(operand.components.begin(), operand.components.end(),
                     [](const Component& c) { return c.dimension < 2; });
}

std::shared_ptr<PreparedRegion> not_yet_prepared() { return std::make_shared<PreparedRegion>(); }

std::shared_ptr<const Operand> PreparedRegion::operand(const Region& region, std::uint32_t op, bool reflected) {
  Slot& slot = slots_[2 * op + (reflected ? 1 : 0)];
  if (!slot.made.load(std::memory_order_acquire)) {
    const std::lock_guard lock(making_);
    if (!slot.made.load(std::memory_order_relaxed)) {
      slot.operand = make_operand(separate_touching(region.data(), region.touching_points()), op, reflected);
      slot.made.store(true, std::memory_order_release);
    }
  }
  return slot.operand;
}

std::shared_ptr<const Operand> prepared_operand(const Region& region, std::uint32_t op, bool reflected) {
  PreparedRegion* kept = RegionInternals::prepared(region);
  if (kept != nullptr) return kept->operand(region, op, reflected);
  return make_operand(separate_touching(region.data(), {}), op);  // the empty region
}

}  // namespace dymsum::planar
