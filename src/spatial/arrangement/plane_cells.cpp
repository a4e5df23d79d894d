#include "spatial/arrangement/plane_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <unordered_map>

#include "spatial/mesh/box_tree.h"

namespace dymsum::spatial {

namespace {

struct Box2 {
  double low_x = 1e300, low_y = 1e300, high_x = -1e300, high_y = -1e300;
  void add(double x, double y, double r) {
    low_x = std::min(low_x, x - r), low_y = std::min(low_y, y - r);
    high_x = std::max(high_x, x + r), high_y = std::max(high_y, y + r);
  }
};

class Arrangement {
 public:
  Arrangement(const SumSpace& space, const PointTable& points, PlaneId plane, std::span<const PlaneSegment> segments)
      : space_(space), points_(points), plane_(plane), segments_(segments), inner_(segments.size()) {
    const Vec3 n = space.plane(plane).n;
    const double size[3] = {std::abs(n.x), std::abs(n.y), std::abs(n.z)};
    axis_ = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
    facing_ = (axis_ == 0 ? n.x : axis_ == 1 ? n.y : n.z) > 0 ? 1 : -1;
    result_.known = static_cast<PointId>(points.size());
  }

  PlaneCells run() {
    cross_segments();
    name_crossings();
    cut_segments();
    sort_around_points();
    trace_loops();
    find_components();
    nest_components();
    cover_faces();
    collect_cells();
    collect_touches();
    return std::move(result_);
  }

 private:
  // -- points
  PointSource source(PointId id) const {
    return id < result_.known ? points_.source(id) : result_.found[id - result_.known];
  }
  const Approx& approx(PointId id) const {
    return id < result_.known ? points_.approx(id) : found_approx_[id - result_.known];
  }
  /// Coordinates in the plane, counter-clockwise seen against its normal.
  double x(const Approx& a) const { return axis_ == 0 ? a.at.y : axis_ == 1 ? a.at.z : a.at.x; }
  double y(const Approx& a) const { return facing_ * (axis_ == 0 ? a.at.z : axis_ == 1 ? a.at.x : a.at.y); }
  int axis_x() const { return (axis_ + 1) % 3; }
  int axis_y() const { return (axis_ + 2) % 3; }
  /// The sign of b's coordinate less a's: axis 0 is x, 1 is y.
  int order(PointId a, PointId b, int axis) const {
    if (a == b) return 0;
    const Approx &u = approx(a), &v = approx(b);
    const double gap = axis == 0 ? x(v) - x(u) : y(v) - y(u);
    if (std::abs(gap) > (u.radius + v.radius) * (1 + 0x1p-40) + space_.span() * 0x1p-51) return gap > 0 ? 1 : -1;
    return axis == 0 ? space_.exact_order(source(a), source(b), axis_x())
                     : facing_ * space_.exact_order(source(a), source(b), axis_y());
  }
  /// 1 where the point is to the left of the direction n x n_cut on the line of `cut`, -1 to the right.
  int left_of(PlaneId cut, PointId point) const { return -space_.side(cut, source(point), approx(point)); }

  // -- crossings
  void cross_segments() {
    std::vector<Box2> boxes(segments_.size());
    std::vector<std::uint32_t> order(segments_.size());
    for (std::size_t k = 0; k < segments_.size(); ++k) {
      for (const PointId p : {segments_[k].a, segments_[k].b})
        boxes[k].add(x(approx(p)), y(approx(p)), approx(p).radius);
      order[k] = static_cast<std::uint32_t>(k);
    }
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return boxes[a].low_x != boxes[b].low_x ? boxes[a].low_x < boxes[b].low_x : a < b;
    });
    std::vector<std::uint32_t> open;
    for (const std::uint32_t s : order) {
      std::erase_if(open, [&](std::uint32_t t) { return boxes[t].high_x < boxes[s].low_x; });
      for (const std::uint32_t t : open)
        if (boxes[t].low_y <= boxes[s].high_y && boxes[s].low_y <= boxes[t].high_y) cross(s, t);
      open.push_back(s);
    }
  }

  bool is_point(std::uint32_t s) const { return segments_[s].a == segments_[s].b; }

  int end_sign(PointId end, const PlaneSegment& t) const { return end == t.a || end == t.b ? 0 : left_of(t.cut, end); }

  void cross(std::uint32_t i, std::uint32_t j) {
    const PlaneSegment &s = segments_[i], &t = segments_[j];
    if (is_point(i) && is_point(j)) return;
    if (s.cut == t.cut) return overlap(i, j);
    const int sa = end_sign(s.a, t), sb = end_sign(s.b, t);
    if (sa * sb > 0) return;
    const int ta = end_sign(t.a, s), tb = end_sign(t.b, s);
    if (ta * tb > 0) return;
    if (sa == 0 && sb == 0) return overlap(i, j);
    if (ta == 0 && tb == 0) return overlap(i, j);
    if (sa != 0 && sb != 0 && ta != 0 && tb != 0) {
      PointSource at{PointSource::Kind::planes, plane_, s.cut, t.cut};
      sort_planes(at);
      crossings_.push_back({i, j, at});
      return;
    }
    // An end on the other segment.
    if (sa == 0 && ta * tb < 0) inner_[j].push_back(s.a);
    if (sb == 0 && ta * tb < 0) inner_[j].push_back(s.b);
    if (ta == 0 && sa * sb < 0) inner_[i].push_back(t.a);
    if (tb == 0 && sa * sb < 0) inner_[i].push_back(t.b);
  }

  static void sort_planes(PointSource& p) {
    if (p.a > p.b) std::swap(p.a, p.b);
    if (p.b > p.c) std::swap(p.b, p.c);
    if (p.a > p.b) std::swap(p.a, p.b);
  }

  /// Both on one line, or one of them a point on the other's line.
  void overlap(std::uint32_t i, std::uint32_t j) {
    for (const auto& [s, t] : {std::pair{i, j}, std::pair{j, i}}) {
      if (is_point(s)) continue;
      const int axis = long_axis(s);
      const int way = order(segments_[s].a, segments_[s].b, axis);
      for (const PointId p : {segments_[t].a, segments_[t].b}) {
        if (order(segments_[s].a, p, axis) * way > 0 && order(p, segments_[s].b, axis) * way > 0 && on_line(s, t, p))
          inner_[s].push_back(p);
      }
    }
  }
  /// With one of two segments a point, that may lie on the other's line or not; two stretches lie on one line here.
  bool on_line(std::uint32_t s, std::uint32_t t, PointId p) const {
    return segments_[s].cut == segments_[t].cut || !is_point(t) || left_of(segments_[s].cut, p) == 0;
  }
  int long_axis(std::uint32_t s) const {
    const Approx &a = approx(segments_[s].a), &b = approx(segments_[s].b);
    const double dx = std::abs(x(b) - x(a)), dy = std::abs(y(b) - y(a));
    const int axis = dx >= dy ? 0 : 1;
    return order(segments_[s].a, segments_[s].b, axis) != 0 ? axis : 1 - axis;
  }

  struct Crossing {
    std::uint32_t s, t;
    PointSource at;
  };

  void name_crossings() {
    if (crossings_.empty()) return;
    std::vector<PointSource> sources;
    for (const Crossing& c : crossings_) sources.push_back(c.at);
    const std::vector<exact::Residue> hashes = space_.point_hashes(sources);
    std::unordered_multimap<exact::Residue, PointId> named;
    const auto add_known = [&](PointId id) { named.emplace(points_.hash(id), id); };
    std::vector<PointId> ends;
    for (const PlaneSegment& s : segments_) ends.push_back(s.a), ends.push_back(s.b);
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (const PointId id : ends) add_known(id);
    for (std::size_t k = 0; k < crossings_.size(); ++k) {
      PointId id = kNoId;
      for (auto [at, end] = named.equal_range(hashes[k]); at != end && id == kNoId; ++at)
        if (space_.same_point(source(at->second), sources[k])) id = at->second;
      if (id == kNoId) {
        id = result_.known + static_cast<PointId>(result_.found.size());
        result_.found.push_back(sources[k]);
        found_approx_.push_back(space_.approximate(sources[k]));
        named.emplace(hashes[k], id);
      }
      inner_[crossings_[k].s].push_back(id);
      inner_[crossings_[k].t].push_back(id);
    }
  }

  // -- edges
  void cut_segments() {
    struct Piece {
      PointId a, b;
      PlaneId cut;
      bool along;
      int front, back;  // more facets to the left than to the right
    };
    std::vector<Piece> pieces;
    for (std::uint32_t s = 0; s < segments_.size(); ++s) {
      if (is_point(s)) continue;
      const PlaneSegment& segment = segments_[s];
      std::vector<PointId>& inner = inner_[s];
      if (inner.size() > 1) {
        std::sort(inner.begin(), inner.end());
        inner.erase(std::unique(inner.begin(), inner.end()), inner.end());
        const int axis = long_axis(s), way = order(segment.a, segment.b, axis);
        std::sort(inner.begin(), inner.end(), [&](PointId a, PointId b) { return order(a, b, axis) * way > 0; });
      }
      inner.push_back(segment.b);
      PointId from = segment.a;
      for (const PointId to : inner) {
        const bool along = from < to;
        const int left = along ? segment.inside : -segment.inside;
        pieces.push_back({std::min(from, to), std::max(from, to), segment.cut, along, segment.side > 0 ? left : 0,
                          segment.side > 0 ? 0 : left});
        from = to;
      }
    }
    std::sort(pieces.begin(), pieces.end(),
              [](const Piece& a, const Piece& b) { return std::tie(a.a, a.b, a.cut) < std::tie(b.a, b.b, b.cut); });
    for (const Piece& piece : pieces) {
      if (result_.edges.empty() || result_.edges.back().a != piece.a || result_.edges.back().b != piece.b) {
        result_.edges.push_back({piece.a, piece.b, kNoId, kNoId, piece.cut, piece.along});
        change_.push_back({0, 0});
      }
      change_.back()[0] += piece.front;
      change_.back()[1] += piece.back;
    }
  }

  std::size_t half_edge_count() const { return 2 * result_.edges.size(); }
  PointId from(std::uint32_t h) const { return h & 1 ? result_.edges[h / 2].b : result_.edges[h / 2].a; }
  PointId to(std::uint32_t h) const { return from(h ^ 1); }
  /// 1 where half-edge h runs along n x n_cut.
  int way(std::uint32_t h) const { return (result_.edges[h / 2].along ? 1 : -1) * (h & 1 ? -1 : 1); }
  /// The sign of the turn from half-edge g to h, both out of one point.
  int turn(std::uint32_t g, std::uint32_t h) const {
    const PlaneId a = result_.edges[g / 2].cut, b = result_.edges[h / 2].cut;
    return a == b ? 0 : way(g) * way(h) * space_.det(plane_, a, b);
  }

  void sort_around_points() {
    out_.resize(half_edge_count());
    std::iota(out_.begin(), out_.end(), 0u);
    std::sort(out_.begin(), out_.end(),
              [&](std::uint32_t g, std::uint32_t h) { return from(g) != from(h) ? from(g) < from(h) : g < h; });
    place_.resize(out_.size());
    for (std::size_t first = 0, last = 0; first < out_.size(); first = last) {
      while (last < out_.size() && from(out_[last]) == from(out_[first])) ++last;
      const std::uint32_t reference = out_[first];
      // 0 along the reference, 1 less than half a turn from it, 2 opposite, 3 beyond.
      const auto sector = [&](std::uint32_t h) {
        if (h == reference) return 0;
        const int t = turn(reference, h);
        return t > 0 ? 1 : t < 0 ? 3 : 2;
      };
      if (last - first > 2) {
        std::sort(out_.begin() + static_cast<std::ptrdiff_t>(first), out_.begin() + static_cast<std::ptrdiff_t>(last),
                  [&](std::uint32_t g, std::uint32_t h) {
                    const int a = sector(g), b = sector(h);
                    if (a != b || a == 0 || a == 2) return a < b;
                    return turn(g, h) > 0;
                  });
      }
      for (std::size_t k = first; k < last; ++k) place_[out_[k]] = static_cast<std::uint32_t>(k);
      spans_.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last)});
      for (std::size_t k = first; k < last; ++k) span_of_.push_back(static_cast<std::uint32_t>(spans_.size() - 1));
    }
  }
  /// Of half-edge h's span, the next one counter-clockwise, or clockwise.
  std::uint32_t around(std::uint32_t h, int step) const {
    const auto [first, last] = spans_[span_of_[place_[h]]];
    const std::uint32_t n = last - first;
    return out_[first + (place_[h] - first + (step > 0 ? 1 : n - 1)) % n];
  }
  /// Along the face to the left.
  std::uint32_t next(std::uint32_t h) const { return around(h ^ 1, -1); }

  // -- loops and faces
  void trace_loops() {
    loop_of_.assign(half_edge_count(), kNoId);
    for (std::uint32_t h = 0; h < half_edge_count(); ++h) {
      if (loop_of_[h] != kNoId) continue;
      const auto loop = static_cast<std::uint32_t>(loop_start_.size());
      loop_start_.push_back(h);
      for (std::uint32_t g = h; loop_of_[g] == kNoId; g = next(g)) loop_of_[g] = loop;
    }
  }

  void find_components() {
    std::vector<std::uint32_t> parent(loop_start_.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t v) {
      while (parent[v] != v) v = parent[v] = parent[parent[v]];
      return v;
    };
    // Loops with a point in common: the two sides of every edge, and all half-edges out of a point.
    for (const auto& [first, last] : spans_)
      for (std::uint32_t k = first; k < last; ++k) {
        parent[root(loop_of_[out_[k]])] = root(loop_of_[out_[first]]);
        parent[root(loop_of_[out_[k] ^ 1])] = root(loop_of_[out_[first]]);
      }
    component_.resize(loop_start_.size());
    std::vector<std::uint32_t> index(loop_start_.size(), kNoId);
    for (std::uint32_t l = 0; l < component_.size(); ++l) {
      const std::uint32_t r = root(l);
      if (index[r] == kNoId) {
        index[r] = static_cast<std::uint32_t>(lowest_.size());
        lowest_.push_back(kNoId);
      }
      component_[l] = index[r];
    }
    for (std::uint32_t s = 0; s < spans_.size(); ++s) {
      std::uint32_t& lowest = lowest_[component_[loop_of_[out_[spans_[s].first]]]];
      if (lowest == kNoId || before(point_of(s), point_of(lowest))) lowest = s;
    }
    outer_.resize(lowest_.size());
    is_outer_.assign(loop_start_.size(), false);
    for (std::uint32_t c = 0; c < lowest_.size(); ++c) {
      outer_[c] = loop_of_[last_around(lowest_[c])];
      is_outer_[outer_[c]] = true;
    }
  }
  PointId point_of(std::uint32_t span) const { return from(out_[spans_[span].first]); }
  /// Lexicographic order of points of the plane.
  bool before(PointId a, PointId b) const {
    const int s = order(a, b, 0);
    return s != 0 ? s > 0 : order(a, b, 1) > 0;
  }
  /// At the lowest point of a component all half-edges leave into half a turn: the last one counter-clockwise. To its
  /// left is the outside.
  std::uint32_t last_around(std::uint32_t span) const {
    const auto [first, last] = spans_[span];
    for (std::uint32_t k = first; k < last; ++k)
      if (last - first == 1 || turn(out_[k], around(out_[k], 1)) < 0) return out_[k];
    // Two half-edges leave in opposite directions at no lowest point.
    throw std::logic_error("plane_cells: no outer side at a lowest point");
  }

  /// Which loop's face every component lies in: kNoId for none.
  void nest_components() {
    home_.assign(lowest_.size(), kNoId);
    if (lowest_.size() < 2) return;
    for (std::uint32_t c = 0; c < lowest_.size(); ++c) {
      std::vector<std::uint32_t> around_it;
      for (std::uint32_t l = 0; l < loop_start_.size(); ++l)
        if (!is_outer_[l] && component_[l] != c && encloses(l, point_of(lowest_[c]))) around_it.push_back(l);
      // The innermost: the one whose component is enclosed by all the others.
      std::size_t most = 0;
      for (const std::uint32_t l : around_it) {
        std::size_t depth = 1;
        for (const std::uint32_t m : around_it)
          depth += m != l && component_[m] != component_[l] && encloses(m, point_of(lowest_[component_[l]]));
        if (depth > most) most = depth, home_[c] = l;
      }
    }
  }
  /// Whether a point that lies on no edge of a loop lies inside it: the edges to the left of it, at its height.
  bool encloses(std::uint32_t loop, PointId p) const {
    bool inside = false;
    std::uint32_t h = loop_start_[loop];
    do {
      const bool a_above = order(p, from(h), 1) > 0, b_above = order(p, to(h), 1) > 0;
      if (a_above != b_above) {
        // Upward edges have the points to their right on their way's right.
        const int left = left_of(result_.edges[h / 2].cut, p) * way(h);
        if (b_above ? left < 0 : left > 0) inside = !inside;
      }
      h = next(h);
    } while (h != loop_start_[loop]);
    return inside;
  }

  /// The face of a loop: the loop itself, or for the outside of a component what it lies in; kNoId for the plane's
  /// outside.
  std::uint32_t face(std::uint32_t loop) const { return is_outer_[loop] ? home_[component_[loop]] : loop; }

  void cover_faces() {
    covered_.assign(loop_start_.size(), {0, 0});
    std::vector<bool> seen(loop_start_.size());
    std::vector<std::uint32_t> todo;
    // Faces by components, those that lie in no other one first.
    std::vector<bool> done(lowest_.size());
    for (bool more = true; more;) {
      more = false;
      for (std::uint32_t c = 0; c < lowest_.size(); ++c) {
        if (done[c] || (home_[c] != kNoId && !seen[home_[c]])) continue;
        done[c] = more = true;
        if (home_[c] != kNoId) covered_[outer_[c]] = covered_[home_[c]];
        seen[outer_[c]] = true;
        todo.push_back(outer_[c]);
        while (!todo.empty()) spread(todo, seen);
      }
    }
  }
  void spread(std::vector<std::uint32_t>& todo, std::vector<bool>& seen) {
    const std::uint32_t loop = todo.back();
    todo.pop_back();
    std::uint32_t h = loop_start_[loop];
    do {
      const std::uint32_t across = loop_of_[h ^ 1];
      if (!seen[across]) {
        seen[across] = true;
        for (int i = 0; i < 2; ++i) covered_[across][i] = covered_[loop][i] - (h & 1 ? -1 : 1) * change_[h / 2][i];
        todo.push_back(across);
      }
      h = next(h);
    } while (h != loop_start_[loop]);
  }

  void collect_cells() {
    std::vector<std::uint32_t> cell_of(loop_start_.size(), kNoId);
    for (std::uint32_t l = 0; l < loop_start_.size(); ++l) {
      if (is_outer_[l] || (covered_[l][0] == 0 && covered_[l][1] == 0)) continue;
      cell_of[l] = static_cast<std::uint32_t>(result_.cells.size());
      Cell cell{static_cast<std::uint32_t>(covered_[l][0]), static_cast<std::uint32_t>(covered_[l][1]), 0, 0};
      cell.first_loop = static_cast<std::uint32_t>(result_.loops.size() - 1);
      add_loop(l);
      for (std::uint32_t c = 0; c < home_.size(); ++c)
        if (home_[c] == l) add_loop(outer_[c]);
      cell.last_loop = static_cast<std::uint32_t>(result_.loops.size() - 1);
      result_.cells.push_back(cell);
    }
    const auto cell_at = [&](std::uint32_t h) {
      const std::uint32_t f = face(loop_of_[h]);
      return f == kNoId ? kNoId : cell_of[f];
    };
    for (std::uint32_t e = 0; e < result_.edges.size(); ++e) {
      result_.edges[e].left = cell_at(2 * e);
      result_.edges[e].right = cell_at(2 * e + 1);
    }
  }
  void collect_touches() {
    for (std::uint32_t s = 0; s < segments_.size(); ++s) {
      if (!is_point(s)) continue;
      const PointId at = segments_[s].a;
      const auto on = [&](const CellEdge& e) { return e.a == at || e.b == at; };
      if (std::none_of(result_.edges.begin(), result_.edges.end(), on))
        result_.touches.push_back({at, segments_[s].cut});
    }
  }
  void add_loop(std::uint32_t loop) {
    std::uint32_t h = loop_start_[loop];
    do {
      result_.half_edges.push_back(h);
      h = next(h);
    } while (h != loop_start_[loop]);
    result_.loops.push_back(static_cast<std::uint32_t>(result_.half_edges.size()));
  }

  const SumSpace& space_;
  const PointTable& points_;
  PlaneId plane_;
  std::span<const PlaneSegment> segments_;
  int axis_ = 2, facing_ = 1;

  std::vector<std::vector<PointId>> inner_;  // points on each segment between its ends
  std::vector<Crossing> crossings_;
  std::vector<Approx> found_approx_;
  std::vector<std::array<int, 2>> change_;  // per edge: front and back facets to the left less those to the right
  std::vector<std::uint32_t> out_, place_;  // half-edges by points, counter-clockwise; where each is
  struct Span {
    std::uint32_t first, last;
  };
  std::vector<Span> spans_;             // per point
  std::vector<std::uint32_t> span_of_;  // per place
  std::vector<std::uint32_t> loop_start_, loop_of_, component_;
  std::vector<std::uint32_t> lowest_, outer_,
      home_;  // per component: span of its lowest point, loop around it, loop it lies in
  std::vector<bool> is_outer_;
  std::vector<std::array<int, 2>> covered_;
  PlaneCells result_;
};

}  // namespace

PlaneCells plane_cells(const SumSpace& space, const PointTable& points, PlaneId plane,
                       std::span<const PlaneSegment> segments) {
  return Arrangement(space, points, plane, segments).run();
}

}  // namespace dymsum::spatial
