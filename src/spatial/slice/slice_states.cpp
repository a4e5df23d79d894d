#include "spatial/slice/slice_states.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <vector>

namespace dymsum::spatial {

namespace {

/// What is known of all segments with one cut.
struct CutLine {
  /// 1 or -1: they belong to facets through the plane whose normals are all the cut's, or all opposite to it; 0 for
  /// others.
  std::int8_t side = 0;
  /// No segment with another cut lies on the same line.
  bool alone = true;
  bool frame = false;
};

/// A line by the points at which it meets two opposite edges of the frame, or their lines: equal lines have equal
/// hashes of them.
struct LineKey {
  bool across = false;  ///< it meets the facet edges along y
  exact::Residue a = 0, b = 0;
  PlaneId cut = 0;
};

PointSource crossing(PlaneId a, PlaneId b, PlaneId c) {
  std::array<PlaneId, 3> planes{a, b, c};
  std::sort(planes.begin(), planes.end());
  return {PointSource::Kind::planes, planes[0], planes[1], planes[2]};
}

/// The line of each cut. O(n) exact hashes for n cuts.
std::unordered_map<PlaneId, CutLine> cut_lines(const SlicePlane& plane) {
  std::unordered_map<PlaneId, CutLine> lines;
  std::array<PlaneId, 4> facet_edge{};
  std::size_t facet_edges = 0;
  for (const SliceSegment& s : plane.segments) {
    const bool frame = s.facet == SliceSegment::kFrame;
    const std::int8_t side = s.crossing ? plane.table.facets[s.facet].side : std::int8_t{0};
    const auto [line, added] = lines.emplace(s.segment.cut, CutLine{side, true, frame});
    if (!added && line->second.side != side) line->second.side = 0;
    if (frame) facet_edge[facet_edges++] = s.segment.cut;
  }
  std::vector<LineKey> keys;
  std::vector<PointSource> sources;
  for (const auto& [cut, line] : lines) {
    if (line.frame) continue;
    const bool across = plane.space->det(plane.plane, cut, facet_edge[1]) != 0;
    keys.push_back({across, 0, 0, cut});
    sources.push_back(crossing(plane.plane, cut, facet_edge[across ? 1 : 0]));
    sources.push_back(crossing(plane.plane, cut, facet_edge[across ? 3 : 2]));
  }
  const std::vector<exact::Residue> hashes = plane.space->point_hashes(sources);
  for (std::size_t k = 0; k < keys.size(); ++k) keys[k].a = hashes[2 * k], keys[k].b = hashes[2 * k + 1];
  std::sort(keys.begin(), keys.end(), [](const LineKey& x, const LineKey& y) {
    return std::tie(x.across, x.a, x.b, x.cut) < std::tie(y.across, y.a, y.b, y.cut);
  });
  for (std::size_t k = 1; k < keys.size(); ++k)
    if (std::tie(keys[k].across, keys[k].a, keys[k].b) == std::tie(keys[k - 1].across, keys[k - 1].a, keys[k - 1].b))
      lines[keys[k].cut].alone = lines[keys[k - 1].cut].alone = false;
  return lines;
}

class Judge {
 public:
  Judge(const SlicePlane& plane, const Collision& collision)
      : plane_(plane), cells_(plane.cells), collision_(collision), lines_(cut_lines(plane)) {}

  SliceStates run() {
    judge_cells();
    crack_.resize(cells_.edges.size());
    thread_.resize(cells_.edges.size());
    for (std::uint32_t e = 0; e < cells_.edges.size(); ++e) judge_edge(e);
    judge_points();
    for (const PlaneCells::Touch& touch : cells_.touches) judge_touch(touch);
    return std::move(result_);
  }

 private:
  PointSource source(PointId id) const { return plane_.points->source(plane_.point(id)); }
  const CutLine& line(const CellEdge& e) const { return lines_.at(e.cut); }
  SliceState state(std::uint32_t cell) const { return cell == kNoId ? SliceState::outside : result_.cells[cell]; }

  SliceState test(const Flag& flag, bool may_touch) {
    if (!may_touch) return collision_.meets(flag) ? SliceState::open : SliceState::outside;
    if (collision_.overlaps(flag)) return SliceState::open;
    return collision_.meets(flag) ? SliceState::touching : SliceState::outside;
  }

  void judge_cells() {
    result_.cells.assign(cells_.cells.size(), SliceState::outside);
    std::vector<bool> behind(cells_.cells.size());
    for (const CellEdge& e : cells_.edges) {
      // Pieces of one line bear the name of one of its cuts: others of it need not cross the plane there.
      const int side = line(e).side;
      if (side == 0 || !line(e).alone) continue;
      // The cut's normal points to the right of n x n_cut.
      const std::uint32_t back = (side > 0) == e.along ? e.left : e.right;
      if (back != kNoId) behind[back] = true;
    }
    for (std::uint32_t c = 0; c < cells_.cells.size(); ++c) {
      const Cell& cell = cells_.cells[c];
      const bool flat = cell.front > 1 || cell.back > 0;  // under facets beside the frame
      result_.cells[c] = behind[c] ? SliceState::open : test(inside(cell), flat);
    }
  }
  Flag inside(const Cell& cell) const {
    const std::uint32_t h = cells_.half_edges[cells_.loops[cell.first_loop]];
    const CellEdge& e = cells_.edges[h / 2];
    const auto direction = static_cast<std::int8_t>((e.along ? 1 : -1) * (h & 1 ? -1 : 1));
    return {source(h & 1 ? e.b : e.a), plane_.plane, e.cut, direction, 1, 0};
  }

  void judge_edge(std::uint32_t k) {
    const CellEdge& e = cells_.edges[k];
    if (e.left == kNoId || e.right == kNoId) return;
    const SliceState left = state(e.left), right = state(e.right);
    const Flag flag{source(e.a), plane_.plane, e.cut, static_cast<std::int8_t>(e.along ? 1 : -1), 0, 0};
    if (left == SliceState::outside && right == SliceState::outside) {
      thread_[k] = collision_.meets(flag);
      if (thread_[k]) result_.threads.push_back(k);
    } else if (left == SliceState::open && right == SliceState::open) {
      // Facets through the plane whose normals are one, and no others: what is free on them is free in front of them.
      if (line(e).side != 0 && line(e).alone) return;
      crack_[k] = !collision_.overlaps(flag);
      if (crack_[k]) result_.cracks.push_back(k);
    }
  }

  /// The edges at every point.
  void judge_points() {
    std::vector<std::pair<PointId, std::uint32_t>> ends;
    for (std::uint32_t e = 0; e < cells_.edges.size(); ++e) {
      if (line(cells_.edges[e]).frame) continue;
      ends.push_back({cells_.edges[e].a, e});
      ends.push_back({cells_.edges[e].b, e});
    }
    std::sort(ends.begin(), ends.end());
    std::vector<bool> is_end(cells_.known);
    for (const SliceSegment& s : plane_.segments) is_end[s.segment.a] = is_end[s.segment.b] = true;
    for (std::size_t first = 0, last = 0; first < ends.size(); first = last) {
      while (last < ends.size() && ends[last].first == ends[first].first) ++last;
      const PointId at = ends[first].first;
      judge_point(at, {&ends[first], last - first}, at < cells_.known && is_end[at]);
    }
  }

  void judge_point(PointId at, std::span<const std::pair<PointId, std::uint32_t>> edges, bool is_end) {
    bool all_open = true, all_outside = true;
    std::array<PlaneId, 2> cuts{kNoId, kNoId};
    bool plain = !is_end && edges.size() == 4;
    for (const auto& [point, k] : edges) {
      const CellEdge& e = cells_.edges[k];
      for (const std::uint32_t c : {e.left, e.right}) {
        all_open = all_open && state(c) == SliceState::open;
        all_outside = all_outside && state(c) == SliceState::outside;
      }
      all_open = all_open && !crack_[k];
      all_outside = all_outside && !thread_[k];
      plain = plain && line(e).side != 0 && line(e).alone;
      for (PlaneId& cut : cuts) {
        if (cut == kNoId) cut = e.cut;
        if (cut == e.cut) break;
        if (&cut == &cuts[1]) plain = false;
      }
    }
    const Flag flag{source(at), 0, 0, 0, 0, 0};
    // Where two facets cross that end elsewhere, what is free is free in a wedge of this plane.
    if (all_open && !plain && !collision_.overlaps(flag)) result_.punctures.push_back(at);
    if (all_outside && collision_.meets(flag)) result_.dots.push_back(at);
  }

  /// Facets that touch the plane in a point inside a cell.
  void judge_touch(const PlaneCells::Touch& touch) {
    const Flag flag{source(touch.at), 0, 0, 0, 0, 0};
    if (collision_.overlaps(flag)) return;
    const SliceState around = test({source(touch.at), plane_.plane, touch.cut, 1, 1, 0}, true);
    if (around == SliceState::open) result_.punctures.push_back(touch.at);
    if (around == SliceState::outside && collision_.meets(flag)) result_.dots.push_back(touch.at);
  }

  const SlicePlane& plane_;
  const PlaneCells& cells_;
  const Collision& collision_;
  std::unordered_map<PlaneId, CutLine> lines_;
  std::vector<bool> crack_, thread_;
  SliceStates result_;
};

}  // namespace

SliceStates slice_states(const SlicePlane& plane, const Collision& collision) { return Judge(plane, collision).run(); }

}  // namespace dymsum::spatial
