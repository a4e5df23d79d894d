#include "spatial/arrangement/plane_cells.h"

#include <algorithm>
#include <array>

#include "spatial/arrangement/plane_loops.h"

namespace dymsum::spatial {

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
