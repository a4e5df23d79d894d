#include "spatial/arrangement/plane_cells.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <stdexcept>

namespace dymsum::spatial {

class PlaneArranger::Cells {
 public:
  Cells(const SumSpace& space, const PointTable& points) : space_(space), points_(space, points), lines_(points_) {}

  PlaneCells run(PlaneId plane, std::span<const PlaneSegment> segments) {
    if (is_lone_facet(segments)) return lone_facet(segments);
    points_.begin(plane);
    lines_.run(segments);
    result_ = {};
    result_.known = points_.known();
    result_.edges.reserve(lines_.pieces().size());
    for (const LinePiece& p : lines_.pieces())
      result_.edges.push_back({p.a, p.b, kNoId, kNoId, p.cut, p.along, p.facet_edge});
    sort_around_points();
    trace_loops();
    find_components();
    nest_components();
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
  /// On the way around a facet counter-clockwise about its own normal.
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

  int order(PointId a, PointId b, int axis) const { return points_.order(a, b, axis); }
  int left_of(PlaneId cut, PointId point) const { return points_.left_of(cut, point); }

  std::size_t half_edge_count() const { return 2 * result_.edges.size(); }
  PointId from(std::uint32_t h) const { return h & 1 ? result_.edges[h / 2].b : result_.edges[h / 2].a; }
  PointId to(std::uint32_t h) const { return from(h ^ 1); }
  /// 1 where half-edge h runs along n x n_cut.
  int direction(std::uint32_t h) const { return (result_.edges[h / 2].along ? 1 : -1) * (h & 1 ? -1 : 1); }
  /// The sign of the turn from half-edge g to h, both out of one point.
  int turn(std::uint32_t g, std::uint32_t h) const {
    const PlaneId a = result_.edges[g / 2].cut, b = result_.edges[h / 2].cut;
    return a == b ? 0 : direction(g) * direction(h) * space_.det(points_.plane(), a, b);
  }

  /// Gives the ends of half-edges indices from 0 on, in the order of their first half-edges.
  void number_points() {
    const std::size_t slots = std::bit_ceil(2 * half_edge_count() + 1);
    slot_.assign(slots, kNoId);
    point_.clear(), vertex_.resize(half_edge_count());
    for (std::uint32_t h = 0; h < half_edge_count(); ++h) {
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
  /// Half-edges by the points that they leave, counter-clockwise around each; and which one follows which.
  void sort_around_points() {
    number_points();
    begin_.assign(point_.size() + 1, 0);
    for (const std::uint32_t v : vertex_) ++begin_[v + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    out_.resize(half_edge_count()), next_.resize(half_edge_count());
    position_.assign(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t h = 0; h < half_edge_count(); ++h) out_[position_[vertex_[h]]++] = h;
    for (std::size_t v = 0; v < point_.size(); ++v) {
      const std::uint32_t first = begin_[v], last = begin_[v + 1];
      if (last - first > 2) sort_around(first, last);
      // Along the face to the left: clockwise around the end.
      for (std::uint32_t k = first; k < last; ++k) next_[out_[k] ^ 1] = out_[k == first ? last - 1 : k - 1];
    }
  }
  void sort_around(std::uint32_t first, std::uint32_t last) {
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
  std::uint32_t next(std::uint32_t h) const { return next_[h]; }

  // -- loops and faces
  void trace_loops() {
    loop_of_.assign(half_edge_count(), kNoId);
    loop_start_.clear();
    for (std::uint32_t h = 0; h < half_edge_count(); ++h) {
      if (loop_of_[h] != kNoId) continue;
      const auto loop = static_cast<std::uint32_t>(loop_start_.size());
      loop_start_.push_back(h);
      for (std::uint32_t g = h; loop_of_[g] == kNoId; g = next(g)) loop_of_[g] = loop;
    }
  }

  void find_components() {
    // Each component has two more points and loops than edges.
    const std::size_t components = (point_.size() + loop_start_.size() - result_.edges.size()) / 2;
    if (components == 1) component_.assign(loop_start_.size(), 0);
    else join_loops();
    lowest_.assign(components, kNoId);
    for (std::uint32_t v = 0; v < point_.size(); ++v) {
      std::uint32_t& lowest = lowest_[component_[loop_of_[out_[begin_[v]]]]];
      if (lowest == kNoId || before(point_[v], point_[lowest])) lowest = v;
    }
    outer_.resize(lowest_.size());
    is_outer_.assign(loop_start_.size(), false);
    for (std::uint32_t c = 0; c < lowest_.size(); ++c) {
      outer_[c] = loop_of_[last_around(lowest_[c])];
      is_outer_[outer_[c]] = true;
    }
  }
  /// Loops with a point in common: the two sides of every edge, and all half-edges out of a point.
  void join_loops() {
    parent_.resize(loop_start_.size());
    std::iota(parent_.begin(), parent_.end(), 0u);
    const auto root = [&](std::uint32_t v) {
      while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
      return v;
    };
    for (std::uint32_t h = 0; h < half_edge_count(); ++h) {
      parent_[root(loop_of_[h])] = root(loop_of_[h ^ 1]);
      parent_[root(loop_of_[h])] = root(loop_of_[out_[begin_[vertex_[h]]]]);
    }
    component_.resize(loop_start_.size());
    index_.assign(loop_start_.size(), kNoId);
    std::uint32_t count = 0;
    for (std::uint32_t l = 0; l < component_.size(); ++l) {
      const std::uint32_t r = root(l);
      if (index_[r] == kNoId) index_[r] = count++;
      component_[l] = index_[r];
    }
  }
  /// Lexicographic order of points of the plane.
  bool before(PointId a, PointId b) const {
    const int s = order(a, b, 0);
    return s != 0 ? s > 0 : order(a, b, 1) > 0;
  }
  /// At the lowest point of a component all half-edges leave into half a turn: the last one counter-clockwise. To its
  /// left is the outside.
  std::uint32_t last_around(std::uint32_t vertex) const {
    const std::uint32_t first = begin_[vertex], last = begin_[vertex + 1];
    for (std::uint32_t k = first; k < last; ++k)
      if (last - first == 1 || turn(out_[k], out_[k + 1 < last ? k + 1 : first]) < 0) return out_[k];
    // Two half-edges leave in opposite directions at no lowest point.
    throw std::logic_error("plane_cells: no outer side at a lowest point");
  }
  PointId lowest_point(std::uint32_t component) const { return point_[lowest_[component]]; }

  /// Which loop's face every component lies in: kNoId for none.
  void nest_components() {
    home_.assign(lowest_.size(), kNoId);
    if (lowest_.size() < 2) return;
    find_boxes();
    for (std::uint32_t c = 0; c < lowest_.size(); ++c) {
      around_.clear();
      for (std::uint32_t l = 0; l < loop_start_.size(); ++l)
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
  struct LoopBox {
    double low_x = 1e300, low_y = 1e300, high_x = -1e300, high_y = -1e300;
  };
  void find_boxes() {
    box_.assign(loop_start_.size(), {});
    for (std::uint32_t h = 0; h < half_edge_count(); ++h) {
      const Approx& at = points_.approx(from(h));
      LoopBox& box = box_[loop_of_[h]];
      const double x = points_.x(at), y = points_.y(at);
      box.low_x = std::min(box.low_x, x - at.radius), box.high_x = std::max(box.high_x, x + at.radius);
      box.low_y = std::min(box.low_y, y - at.radius), box.high_y = std::max(box.high_y, y + at.radius);
    }
  }
  bool near(std::uint32_t loop, PointId p) const {
    const Approx& at = points_.approx(p);
    const LoopBox& box = box_[loop];
    const double x = points_.x(at), y = points_.y(at), r = at.radius;
    return x + r >= box.low_x && x - r <= box.high_x && y + r >= box.low_y && y - r <= box.high_y;
  }
  /// Whether a point that lies on no edge of a loop lies inside it: the edges to the left of it, at its height.
  bool encloses(std::uint32_t loop, PointId p) const {
    if (!near(loop, p)) return false;
    bool inside = false;
    std::uint32_t h = loop_start_[loop];
    do {
      const bool a_above = order(p, from(h), 1) > 0, b_above = order(p, to(h), 1) > 0;
      if (a_above != b_above) {
        // Upward edges have the points to their right on their way's right.
        const int left = left_of(result_.edges[h / 2].cut, p) * direction(h);
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
    seen_.assign(loop_start_.size(), 0);
    // Faces by components, those that lie in no other one first.
    done_.assign(lowest_.size(), 0);
    for (bool more = true; more;) {
      more = false;
      for (std::uint32_t c = 0; c < lowest_.size(); ++c) {
        if (done_[c] != 0 || (home_[c] != kNoId && seen_[home_[c]] == 0)) continue;
        done_[c] = more = true;
        if (home_[c] != kNoId) covered_[outer_[c]] = covered_[home_[c]];
        seen_[outer_[c]] = 1;
        todo_.push_back(outer_[c]);
        while (!todo_.empty()) spread();
      }
    }
  }
  void spread() {
    const std::uint32_t loop = todo_.back();
    todo_.pop_back();
    std::uint32_t h = loop_start_[loop];
    do {
      const std::uint32_t across = loop_of_[h ^ 1];
      if (seen_[across] == 0) {
        seen_[across] = 1;
        const std::array<int, 2>& change = lines_.pieces()[h / 2].change;
        for (std::size_t i = 0; i < 2; ++i) covered_[across][i] = covered_[loop][i] - (h & 1 ? -1 : 1) * change[i];
        todo_.push_back(across);
      }
      h = next(h);
    } while (h != loop_start_[loop]);
  }

  void collect_cells() {
    index_.assign(loop_start_.size(), kNoId);  // cells of loops
    inner_.clear();
    for (std::uint32_t c = 0; c < home_.size(); ++c)
      if (home_[c] != kNoId) inner_.push_back({home_[c], c});
    std::sort(inner_.begin(), inner_.end());
    result_.loops.assign(1, 0);
    std::size_t reserve = 0;
    for (std::uint32_t l = 0; l < loop_start_.size(); ++l) reserve += covered_[l][0] != 0 || covered_[l][1] != 0;
    result_.cells.reserve(reserve), result_.loops.reserve(reserve + inner_.size() + 1);
    result_.half_edges.reserve(half_edge_count());
    for (std::uint32_t l = 0; l < loop_start_.size(); ++l) {
      if (is_outer_[l] || (covered_[l][0] == 0 && covered_[l][1] == 0)) continue;
      index_[l] = static_cast<std::uint32_t>(result_.cells.size());
      Cell cell{static_cast<std::uint32_t>(covered_[l][0]), static_cast<std::uint32_t>(covered_[l][1]), 0, 0};
      cell.first_loop = static_cast<std::uint32_t>(result_.loops.size() - 1);
      add_loop(l);
      for (auto at = std::lower_bound(inner_.begin(), inner_.end(), std::array<std::uint32_t, 2>{l, 0});
           at != inner_.end() && (*at)[0] == l; ++at)
        add_loop(outer_[(*at)[1]]);
      cell.last_loop = static_cast<std::uint32_t>(result_.loops.size() - 1);
      result_.cells.push_back(cell);
    }
    const auto cell_at = [&](std::uint32_t h) {
      const std::uint32_t f = face(loop_of_[h]);
      return f == kNoId ? kNoId : index_[f];
    };
    for (std::uint32_t e = 0; e < result_.edges.size(); ++e) {
      result_.edges[e].left = cell_at(2 * e);
      result_.edges[e].right = cell_at(2 * e + 1);
    }
  }
  void collect_touches() {
    if (lines_.dots().empty()) return;
    std::vector<PointId> ends = point_;
    std::sort(ends.begin(), ends.end());
    for (const PlaneSegment& dot : lines_.dots())
      if (!std::binary_search(ends.begin(), ends.end(), dot.a)) result_.touches.push_back({dot.a, dot.cut});
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
  PlanePoints points_;
  PlaneLines lines_;

  std::vector<PointId> point_;                // the ends of edges, each once
  std::vector<std::uint32_t> vertex_, next_;  // per half-edge: where it begins, in point_; what follows it
  std::vector<std::uint32_t> begin_, out_;    // half-edges by points, counter-clockwise
  std::vector<std::uint32_t> loop_start_, loop_of_, component_;
  // Per component: its lowest point, loop around it, loop it lies in.
  std::vector<std::uint32_t> lowest_, outer_, home_;
  std::vector<bool> is_outer_;
  std::vector<std::array<int, 2>> covered_;  // per loop: by facets with the plane's normal, and with its opposite
  std::vector<LoopBox> box_;
  std::vector<std::array<std::uint32_t, 2>> inner_;  // loops with components in them
  // Scratch.
  struct Sector {
    int sector;
    std::uint32_t half_edge;
  };
  std::vector<Sector> sectors_;
  std::vector<std::uint32_t> slot_, position_;
  std::vector<std::uint32_t> parent_, index_, around_, todo_;
  std::vector<std::uint8_t> seen_, done_;
  PlaneCells result_;
};

PlaneArranger::PlaneArranger(const SumSpace& space, const PointTable& points)
    : cells_(std::make_unique<Cells>(space, points)) {}
PlaneArranger::~PlaneArranger() = default;

PlaneCells PlaneArranger::run(PlaneId plane, std::span<const PlaneSegment> segments) {
  return cells_->run(plane, segments);
}

}  // namespace dymsum::spatial
