#include "spatial/arrangement/plane_cells.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "spatial/arrangement/plane_lines.h"

namespace dymsum::spatial {
namespace {

// The half-edges of one plane, around the points that they leave and along the faces to their left.

/// Edge e has the half-edge 2 e from a to b, and 2 e + 1 back. Points have indices from 0 on, in the order of their
/// first half-edges.
class PlaneHalfEdges {
 public:
  explicit PlaneHalfEdges(const PlanePoints& points) : points_(points) {}

  /// Sorts the half-edges of these edges, which have to live as long as they are queried. Exact. O(n log n).
  void run(const std::vector<CellEdge>& edges);

  std::uint32_t count() const { return static_cast<std::uint32_t>(2 * edges_->size()); }
  const CellEdge& edge(std::uint32_t h) const { return (*edges_)[h / 2]; }
  PointId from(std::uint32_t h) const { return h & 1 ? edge(h).b : edge(h).a; }
  PointId to(std::uint32_t h) const { return from(h ^ 1); }
  /// 1 where half-edge h runs along n x n_cut.
  int direction(std::uint32_t h) const { return (edge(h).along ? 1 : -1) * (h & 1 ? -1 : 1); }
  /// The half-edge that follows h along the face to its left.
  std::uint32_t next(std::uint32_t h) const { return next_[h]; }

  /// The ends of edges, each once.
  const std::vector<PointId>& points() const { return point_; }
  /// The first half-edge out of a point.
  std::uint32_t first_out(std::uint32_t point) const { return out_[begin_[point]]; }
  /// The first half-edge out of the point that h leaves.
  std::uint32_t first_beside(std::uint32_t h) const { return first_out(vertex_[h]); }
  /// The last half-edge counter-clockwise at the lowest point of a component, where all leave into half a turn. To its
  /// left is the outside.
  std::uint32_t last_around(std::uint32_t point) const;

 private:
  struct Sector {
    int sector;
    std::uint32_t half_edge;
  };

  /// The sign of the turn from half-edge g to h, both out of one point.
  int turn(std::uint32_t g, std::uint32_t h) const;
  void index_points();
  void sort_around(std::uint32_t first, std::uint32_t last);

  const PlanePoints& points_;
  const std::vector<CellEdge>* edges_ = nullptr;
  std::vector<PointId> point_;
  std::vector<std::uint32_t> vertex_, next_;    // per half-edge: the point that it leaves; what follows it
  std::vector<std::uint32_t> begin_, out_;      // half-edges by points, counter-clockwise
  std::vector<std::uint32_t> slot_, position_;  // scratch of index_points() and run()
  std::vector<Sector> sectors_;                 // scratch of sort_around()
};

void PlaneHalfEdges::run(const std::vector<CellEdge>& edges) {
  edges_ = &edges;
  index_points();
  begin_.assign(point_.size() + 1, 0);
  for (const std::uint32_t v : vertex_) ++begin_[v + 1];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  out_.resize(count()), next_.resize(count());
  position_.assign(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t h = 0; h < count(); ++h) out_[position_[vertex_[h]]++] = h;
  for (std::size_t v = 0; v < point_.size(); ++v) {
    const std::uint32_t first = begin_[v], last = begin_[v + 1];
    if (last - first > 2) sort_around(first, last);
    // The next half-edge runs along the face to the left: clockwise around the end.
    for (std::uint32_t k = first; k < last; ++k) next_[out_[k] ^ 1] = out_[k == first ? last - 1 : k - 1];
  }
}

std::uint32_t PlaneHalfEdges::last_around(std::uint32_t point) const {
  const std::uint32_t first = begin_[point], last = begin_[point + 1];
  for (std::uint32_t k = first; k < last; ++k)
    if (last - first == 1 || turn(out_[k], out_[k + 1 < last ? k + 1 : first]) < 0) return out_[k];
  // Two half-edges leave in opposite directions at no lowest point.
  throw std::logic_error("plane_half_edges: no outer side at a lowest point");
}

int PlaneHalfEdges::turn(std::uint32_t g, std::uint32_t h) const {
  const PlaneId a = edge(g).cut, b = edge(h).cut;
  return a == b ? 0 : direction(g) * direction(h) * points_.space().det(points_.plane(), a, b);
}

void PlaneHalfEdges::index_points() {
  const std::size_t slots = std::bit_ceil(2 * std::size_t{count()} + 1);
  slot_.assign(slots, kNoId);
  point_.clear(), vertex_.resize(count());
  for (std::uint32_t h = 0; h < count(); ++h) {
    const PointId p = from(h);
    std::size_t at = (p * 0x9e3779b1u) & (slots - 1);
    while (slot_[at] != kNoId && point_[slot_[at]] != p) at = (at + 1) & (slots - 1);
    if (slot_[at] == kNoId) {
      slot_[at] = static_cast<std::uint32_t>(point_.size());
      point_.push_back(p);
    }
    vertex_[h] = slot_[at];
  }
}

void PlaneHalfEdges::sort_around(std::uint32_t first, std::uint32_t last) {
  const std::uint32_t reference = out_[first];
  // 0 along the reference, 1 less than half a turn from it, 2 opposite, 3 beyond.
  sectors_.clear();
  for (std::uint32_t k = first; k < last; ++k) {
    const int t = k == first ? 0 : turn(reference, out_[k]);
    sectors_.push_back({k == first ? 0 : t > 0 ? 1 : t < 0 ? 3 : 2, out_[k]});
  }
  std::sort(sectors_.begin(), sectors_.end(), [&](const Sector& g, const Sector& h) {
    if (g.sector != h.sector || g.sector == 0 || g.sector == 2) return g.sector < h.sector;
    return turn(g.half_edge, h.half_edge) > 0;
  });
  for (std::uint32_t k = first; k < last; ++k) out_[k] = sectors_[k - first].half_edge;
}

// The loops of half-edges in one plane, the connected components that they belong to, and the faces that these lie in.

/// Loops have indices from 0 on, in the order of their first half-edges, and components in that of their first loops.
class PlaneLoops {
 public:
  PlaneLoops(const PlanePoints& points, const PlaneHalfEdges& half_edges) : points_(points), half_edges_(half_edges) {}

  /// Finds the loops of the half-edges as they are now. Exact. O(n + c l) for c components with l loops around them.
  void run();

  std::uint32_t count() const { return static_cast<std::uint32_t>(start_.size()); }
  std::uint32_t start(std::uint32_t loop) const { return start_[loop]; }
  std::uint32_t of(std::uint32_t half_edge) const { return of_[half_edge]; }
  /// Whether the outside of a component is to the left of a loop.
  bool is_outer(std::uint32_t loop) const { return is_outer_[loop]; }

  std::uint32_t components() const { return static_cast<std::uint32_t>(lowest_.size()); }
  /// The loop around a component.
  std::uint32_t outer(std::uint32_t component) const { return outer_[component]; }
  /// The loop in whose face a component lies; kNoId where it is the plane's outside.
  std::uint32_t home(std::uint32_t component) const { return home_[component]; }
  /// The face of a loop: the loop itself, or for the outside of a component what it lies in; kNoId for the plane's
  /// outside.
  std::uint32_t face(std::uint32_t loop) const { return is_outer_[loop] ? home_[component_[loop]] : loop; }

 private:
  struct LoopBox {
    double low_x = 1e300, low_y = 1e300, high_x = -1e300, high_y = -1e300;
  };

  void trace();
  void find_components();
  void join();
  void nest();
  void find_boxes();
  bool before(PointId a, PointId b) const;
  bool near(std::uint32_t loop, PointId p) const;
  bool encloses(std::uint32_t loop, PointId p) const;
  PointId lowest_point(std::uint32_t component) const { return half_edges_.points()[lowest_[component]]; }

  const PlanePoints& points_;
  const PlaneHalfEdges& half_edges_;
  std::vector<std::uint32_t> start_, of_, component_;  // per loop, per half-edge, per loop
  std::vector<std::uint32_t> lowest_, outer_, home_;   // per component; its lowest point by index
  std::vector<bool> is_outer_;
  std::vector<LoopBox> box_;
  std::vector<std::uint32_t> parent_, index_;  // scratch of join()
  std::vector<std::uint32_t> around_;          // scratch of nest()
};

void PlaneLoops::run() {
  trace();
  find_components();
  nest();
}

void PlaneLoops::trace() {
  of_.assign(half_edges_.count(), kNoId);
  start_.clear();
  for (std::uint32_t h = 0; h < half_edges_.count(); ++h) {
    if (of_[h] != kNoId) continue;
    const std::uint32_t loop = count();
    start_.push_back(h);
    for (std::uint32_t g = h; of_[g] == kNoId; g = half_edges_.next(g)) of_[g] = loop;
  }
}

void PlaneLoops::find_components() {
  const std::vector<PointId>& points = half_edges_.points();
  // Each component has two more points and loops than edges.
  const std::size_t components = (points.size() + count() - half_edges_.count() / 2) / 2;
  if (components == 1) component_.assign(count(), 0);
  else join();
  lowest_.assign(components, kNoId);
  for (std::uint32_t v = 0; v < points.size(); ++v) {
    std::uint32_t& lowest = lowest_[component_[of_[half_edges_.first_out(v)]]];
    if (lowest == kNoId || before(points[v], points[lowest])) lowest = v;
  }
  outer_.resize(components);
  is_outer_.assign(count(), false);
  for (std::uint32_t c = 0; c < components; ++c) {
    outer_[c] = of_[half_edges_.last_around(lowest_[c])];
    is_outer_[outer_[c]] = true;
  }
}

/// Joins loops with a point in common: the two sides of every edge, and all half-edges out of a point.
void PlaneLoops::join() {
  parent_.resize(count());
  std::iota(parent_.begin(), parent_.end(), 0u);
  const auto root = [&](std::uint32_t v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  };
  for (std::uint32_t h = 0; h < half_edges_.count(); ++h) {
    parent_[root(of_[h])] = root(of_[h ^ 1]);
    parent_[root(of_[h])] = root(of_[half_edges_.first_beside(h)]);
  }
  component_.resize(count());
  index_.assign(count(), kNoId);
  std::uint32_t components = 0;
  for (std::uint32_t l = 0; l < count(); ++l) {
    const std::uint32_t r = root(l);
    if (index_[r] == kNoId) index_[r] = components++;
    component_[l] = index_[r];
  }
}

/// Lexicographic order of points of the plane.
bool PlaneLoops::before(PointId a, PointId b) const {
  const int s = points_.order(a, b, 0);
  return s != 0 ? s > 0 : points_.order(a, b, 1) > 0;
}

void PlaneLoops::nest() {
  home_.assign(components(), kNoId);
  if (components() < 2) return;
  find_boxes();
  for (std::uint32_t c = 0; c < components(); ++c) {
    around_.clear();
    for (std::uint32_t l = 0; l < count(); ++l)
      if (!is_outer_[l] && component_[l] != c && encloses(l, lowest_point(c))) around_.push_back(l);
    // The innermost: the one whose component is enclosed by all the others.
    std::size_t most = 0;
    for (const std::uint32_t l : around_) {
      std::size_t depth = 1;
      for (const std::uint32_t m : around_)
        depth += m != l && component_[m] != component_[l] && encloses(m, lowest_point(component_[l]));
      if (depth > most) most = depth, home_[c] = l;
    }
  }
}

void PlaneLoops::find_boxes() {
  box_.assign(count(), {});
  for (std::uint32_t h = 0; h < half_edges_.count(); ++h) {
    const Approx& at = points_.approx(half_edges_.from(h));
    LoopBox& box = box_[of_[h]];
    const double x = points_.x(at), y = points_.y(at);
    box.low_x = std::min(box.low_x, x - at.radius), box.high_x = std::max(box.high_x, x + at.radius);
    box.low_y = std::min(box.low_y, y - at.radius), box.high_y = std::max(box.high_y, y + at.radius);
  }
}

/// Whether a point may lie in a loop, as far as their boxes show.
bool PlaneLoops::near(std::uint32_t loop, PointId p) const {
  const Approx& at = points_.approx(p);
  const LoopBox& box = box_[loop];
  const double x = points_.x(at), y = points_.y(at), r = at.radius;
  return x + r >= box.low_x && x - r <= box.high_x && y + r >= box.low_y && y - r <= box.high_y;
}

/// Whether a point that lies on no edge of a loop lies inside it: the edges to the left of it, at its height.
bool PlaneLoops::encloses(std::uint32_t loop, PointId p) const {
  if (!near(loop, p)) return false;
  bool inside = false;
  std::uint32_t h = start_[loop];
  do {
    const bool a_above = points_.order(p, half_edges_.from(h), 1) > 0;
    const bool b_above = points_.order(p, half_edges_.to(h), 1) > 0;
    if (a_above != b_above) {
      // Upward edges have the points to their right on their way's right.
      const int left = points_.left_of(half_edges_.edge(h).cut, p) * half_edges_.direction(h);
      if (b_above ? left < 0 : left > 0) inside = !inside;
    }
    h = half_edges_.next(h);
  } while (h != start_[loop]);
  return inside;
}

}  // namespace

class PlaneArranger::Cells {
 public:
  Cells(const SumSpace& space, const PointTable& points)
      : points_(space, points), lines_(points_), half_edges_(points_), loops_(points_, half_edges_) {}

  PlaneCells run(PlaneId plane, std::span<const PlaneSegment> segments) {
    if (is_lone_facet(segments)) return lone_facet(segments);
    points_.begin(plane);
    lines_.run(segments);
    result_ = {};
    result_.known = points_.known();
    result_.edges.reserve(lines_.pieces().size());
    for (const LinePiece& p : lines_.pieces())
      result_.edges.push_back({p.a, p.b, kNoId, kNoId, p.cut, p.along, p.facet_edge});
    half_edges_.run(result_.edges);
    loops_.run();
    cover_faces();
    collect_cells();
    collect_touches();
    result_.found = points_.found;
    return std::move(result_);
  }

 private:
  /// Whether segments are the edges of one facet, each beginning where another one ends, and nothing else.
  static bool is_lone_facet(std::span<const PlaneSegment> segments) {
    if (segments.size() < 3 || segments.size() > 4) return false;
    for (std::size_t k = 0; k < segments.size(); ++k) {
      const PlaneSegment &s = segments[k], &next = segments[(k + 1) % segments.size()];
      if (s.inside == 0 || s.side != segments[0].side || s.a == s.b || end_of(s) != start_of(next)) return false;
    }
    return segments.size() == 3 || start_of(segments[0]) != start_of(segments[2]);
  }
  /// The point at which the segment begins on a walk around its facet, counter-clockwise about its own normal.
  static PointId start_of(const PlaneSegment& s) { return s.inside * s.side > 0 ? s.a : s.b; }
  static PointId end_of(const PlaneSegment& s) { return s.inside * s.side > 0 ? s.b : s.a; }

  /// Facets are convex: one cell.
  PlaneCells lone_facet(std::span<const PlaneSegment> segments) const {
    PlaneCells result;
    const int side = segments[0].side;
    result.known = points_.known();
    result.cells.push_back({side > 0 ? 1U : 0U, side > 0 ? 0U : 1U, 0, 1});
    result.edges.reserve(segments.size()), result.half_edges.reserve(segments.size());
    for (const PlaneSegment& s : segments) {
      const bool along = s.a < s.b, left = (s.inside > 0) == along;
      result.half_edges.push_back(static_cast<std::uint32_t>(2 * result.edges.size() + (left ? 0 : 1)));
      result.edges.push_back(
          {std::min(s.a, s.b), std::max(s.a, s.b), left ? 0 : kNoId, left ? kNoId : 0, s.cut, along, s.facet_edge});
    }
    // Seen against the plane's normal the way around is clockwise where the facet's is the opposite one.
    if (side < 0) std::reverse(result.half_edges.begin(), result.half_edges.end());
    result.loops.push_back(static_cast<std::uint32_t>(segments.size()));
    return result;
  }

  void cover_faces() {
    covered_.assign(loops_.count(), {0, 0});
    seen_.assign(loops_.count(), 0);
    // Faces by components, those that lie in no other one first.
    done_.assign(loops_.components(), 0);
    for (bool more = true; more;) {
      more = false;
      for (std::uint32_t c = 0; c < loops_.components(); ++c) {
        if (done_[c] != 0 || (loops_.home(c) != kNoId && seen_[loops_.home(c)] == 0)) continue;
        done_[c] = more = true;
        if (loops_.home(c) != kNoId) covered_[loops_.outer(c)] = covered_[loops_.home(c)];
        seen_[loops_.outer(c)] = 1;
        todo_.push_back(loops_.outer(c));
        while (!todo_.empty()) spread();
      }
    }
  }
  void spread() {
    const std::uint32_t loop = todo_.back();
    todo_.pop_back();
    std::uint32_t h = loops_.start(loop);
    do {
      const std::uint32_t across = loops_.of(h ^ 1);
      if (seen_[across] == 0) {
        seen_[across] = 1;
        const std::array<int, 2>& change = lines_.pieces()[h / 2].change;
        for (std::size_t i = 0; i < 2; ++i) covered_[across][i] = covered_[loop][i] - (h & 1 ? -1 : 1) * change[i];
        todo_.push_back(across);
      }
      h = half_edges_.next(h);
    } while (h != loops_.start(loop));
  }

  void collect_cells() {
    index_.assign(loops_.count(), kNoId);  // cells of loops
    inner_.clear();
    for (std::uint32_t c = 0; c < loops_.components(); ++c)
      if (loops_.home(c) != kNoId) inner_.push_back({loops_.home(c), c});
    std::sort(inner_.begin(), inner_.end());
    result_.loops.assign(1, 0);
    std::size_t reserve = 0;
    for (std::uint32_t l = 0; l < loops_.count(); ++l) reserve += covered_[l][0] != 0 || covered_[l][1] != 0;
    result_.cells.reserve(reserve), result_.loops.reserve(reserve + inner_.size() + 1);
    result_.half_edges.reserve(half_edges_.count());
    for (std::uint32_t l = 0; l < loops_.count(); ++l) {
      if (loops_.is_outer(l) || (covered_[l][0] == 0 && covered_[l][1] == 0)) continue;
      index_[l] = static_cast<std::uint32_t>(result_.cells.size());
      Cell cell{static_cast<std::uint32_t>(covered_[l][0]), static_cast<std::uint32_t>(covered_[l][1]), 0, 0};
      cell.first_loop = static_cast<std::uint32_t>(result_.loops.size() - 1);
      add_loop(l);
      for (auto at = std::lower_bound(inner_.begin(), inner_.end(), std::array<std::uint32_t, 2>{l, 0});
           at != inner_.end() && (*at)[0] == l; ++at)
        add_loop(loops_.outer((*at)[1]));
      cell.last_loop = static_cast<std::uint32_t>(result_.loops.size() - 1);
      result_.cells.push_back(cell);
    }
    const auto cell_at = [&](std::uint32_t h) {
      const std::uint32_t f = loops_.face(loops_.of(h));
      return f == kNoId ? kNoId : index_[f];
    };
    for (std::uint32_t e = 0; e < result_.edges.size(); ++e) {
      result_.edges[e].left = cell_at(2 * e);
      result_.edges[e].right = cell_at(2 * e + 1);
    }
  }
  void collect_touches() {
    if (lines_.dots().empty()) return;
    std::vector<PointId> ends = half_edges_.points();
    std::sort(ends.begin(), ends.end());
    for (const PlaneSegment& dot : lines_.dots())
      if (!std::binary_search(ends.begin(), ends.end(), dot.a)) result_.touches.push_back({dot.a, dot.cut});
  }
  void add_loop(std::uint32_t loop) {
    std::uint32_t h = loops_.start(loop);
    do {
      result_.half_edges.push_back(h);
      h = half_edges_.next(h);
    } while (h != loops_.start(loop));
    result_.loops.push_back(static_cast<std::uint32_t>(result_.half_edges.size()));
  }

  PlanePoints points_;
  PlaneLines lines_;
  PlaneHalfEdges half_edges_;
  PlaneLoops loops_;
  std::vector<std::array<int, 2>> covered_;  // per loop: by facets with the plane's normal, and with its opposite
  std::vector<std::uint32_t> todo_;          // scratch of cover_faces(), with the next two: per loop, per component
  std::vector<std::uint8_t> seen_, done_;
  std::vector<std::uint32_t> index_;                 // scratch of collect_cells(): cells of loops
  std::vector<std::array<std::uint32_t, 2>> inner_;  // and loops with components in them
  PlaneCells result_;
};

PlaneArranger::PlaneArranger(const SumSpace& space, const PointTable& points)
    : cells_(std::make_unique<Cells>(space, points)) {}
PlaneArranger::~PlaneArranger() = default;

PlaneCells PlaneArranger::run(PlaneId plane, std::span<const PlaneSegment> segments) {
  return cells_->run(plane, segments);
}

}  // namespace dymsum::spatial
