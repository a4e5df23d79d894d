#include "spatial/slice/slice_plane.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "exact/big.h"
#include "spatial/erode/erosion.h"
#include "spatial/sum/solid_boundary.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {
namespace {

/// The height as a sum of two doubles, one for each operand: near the operands where that is exact, so that the common
/// grid stays narrow.
std::array<double, 2> split(double height, double near_q) {
  const double near_p = height - near_q;
  const bool exact =
      std::isfinite(near_p) && exact::exact_value(near_p) + exact::exact_value(near_q) == exact::exact_value(height);
  return exact ? std::array{near_p, near_q} : std::array{height, 0.0};
}

std::array<double, 2> range_of(const std::vector<Point3>& vertices, double Point3::*axis) {
  const auto [low, high] = std::minmax_element(vertices.begin(), vertices.end(),
                                               [&](const Point3& a, const Point3& b) { return a.*axis < b.*axis; });
  return {(*low).*axis, (*high).*axis};
}

/// The end of a facet's interval: at a corner, or on the facet edge that begins there.
struct End {
  int corner = 0;
  bool on_facet_edge = false;
};

class Builder {
 public:
  Builder(const SolidOperand& p, const SolidOperand& q, const SliceHeight& height, StageWatch& watch)
      : p_(p), q_(q), height_(height), watch_(watch) {}

  SlicePlane run() {
    make_space();
    take_facets();
    add_frame();
    for (std::uint32_t f = 0; f < result_.table.facets.size(); ++f) add_facet(f);
    name_points();
    std::vector<PlaneSegment> segments;
    for (const SliceSegment& s : result_.segments) segments.push_back(s.segment);
    result_.cells = PlaneArranger(*result_.space, *result_.points).run(result_.plane, segments);
    result_.names = result_.points->add(result_.cells.found, watch_);
    return std::move(result_);
  }

 private:
  /// Vertices behind those of the operands make sums in the plane: the corners of the frame.
  void make_space() {
    first_corner_ = static_cast<std::uint32_t>(p_.vertices.size());
    anchor_ = static_cast<std::uint32_t>(q_.vertices.size());
    result_.space = p_.exact.empty() ? space_of_doubles() : space_of_fractions();
    const PlaneSource plane{
        {first_corner_, anchor_}, {DirectionSource::Of::axis, 0, 0}, {DirectionSource::Of::axis, 1, 0}, false};
    result_.plane = result_.space->add_planes(std::array{plane});
  }

  std::unique_ptr<SumSpace> space_of_doubles() const {
    std::vector<Point3> p = p_.vertices, q = q_.vertices;
    const auto [z, anchor_z] = split(height_.z, q[0].z);
    const std::array<double, 2> x = frame('x', &Point3::x), y = frame('y', &Point3::y);
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      p.push_back({x[static_cast<std::size_t>(i)], y[static_cast<std::size_t>(j)], z});
    q.push_back({q[0].x, q[0].y, anchor_z});
    if (const GridNeed need = grid_need(p, q); need.bits > kMostGridBits) throw NoGridForSlice{too_fine(need)};
    return make_sum_space(p, q);
  }

  std::unique_ptr<SumSpace> space_of_fractions() const {
    std::vector<ExactVertex> p = p_.exact, q = q_.exact;
    const std::array<double, 2> x = frame('x', &Point3::x), y = frame('y', &Point3::y);
    // Integers, so that integers stay what coordinates are.
    const auto in_units = [&](const std::array<double, 2>& ends, int end) {
      const exact::BigRational v =
          exact::exact_value(std::ldexp(height_.by * ends[static_cast<std::size_t>(end)], -p_.exponent));
      return exact::Fraction(exact::BigInteger(numerator(v) / denominator(v)) + 2 * end - 1);
    };
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      p.push_back({in_units(x, i), in_units(y, j), height_.in_units - q[0].z});
    q.push_back(q[0]);
    return make_sum_space(p, q, p_.exponent);
  }

  std::array<double, 2> frame(char name, double Point3::*axis) const {
    const auto [low, high] = range_of(p_.vertices, axis);
    const auto [q_low, q_high] = range_of(q_.vertices, axis);
    const std::array<double, 2> wide = framed(low, high, q_high - q_low);
    if (std::isfinite(wide[0]) && std::isfinite(wide[1])) return wide;
    throw NoGridForSlice{{ErrorCode::unsupported_operand,
                          std::string("no doubles are wide enough for a frame around the slice along ") + name,
                          {}}};
  }

  /// What is wrong with the operands, or else with them and the height, or with the frame.
  Error too_fine(const GridNeed& need) const {
    if (std::optional<Error> error = grid_error(p_.vertices, q_.vertices)) return *std::move(error);
    const bool height = need.axis == 'z';
    Error error{ErrorCode::unsupported_operand,
                std::string(height ? "the height z" : "the frame") + " of the slice and the operands' vertices need " +
                    std::to_string(need.bits) + " bits on their common grid along " + need.axis + ", and " +
                    std::to_string(kMostGridBits) + " are the most",
                {}};
    if (height) error.evidence.z = height_.z;
    else error.evidence.x = need.at.x, error.evidence.y = need.at.y, error.evidence.z = need.at.z;
    return error;
  }

  void take_facets() {
    // Facets do not depend on the height, whose digits may need a finer grid than the operands.
    const std::unique_ptr<SumSpace> own = space_of(p_, q_);
    const ReducedConvolution all = reduced_convolution(*own, p_, q_, watch_);
    result_.facets = all.facets.size();
    ReducedConvolution met;
    for (std::size_t f = 0; f < all.facets.size(); ++f) {
      const auto sides = sides_of(all.facets[f]);
      const auto [low, high] = std::minmax_element(sides.begin(), sides.begin() + all.facets[f].corners);
      if (*low > 0 || *high < 0) continue;
      met.facets.push_back(all.facets[f]);
      met.planes.push_back(all.planes[f]);
    }
    result_.table = facet_table(*result_.space, met, watch_);
  }
  std::array<int, 4> sides_of(const SumFacet& facet) const {
    std::array<int, 4> sides{};
    for (int k = 0; k < facet.corners; ++k)
      sides[static_cast<std::size_t>(k)] =
          result_.space->side(result_.plane, facet.corner[static_cast<std::size_t>(k)]);
    return sides;
  }

  void add(const PointSource& a, const PointSource& b, SliceSegment segment) {
    sources_.push_back(a);
    sources_.push_back(b);
    result_.segments.push_back(segment);
  }
  static PointSource source(SumPoint s) { return {PointSource::Kind::sum, s.p, s.q, 0}; }

  /// The upright plane through a way: the way is n x n_cut, n pointing up.
  PlaneId upright(SumPoint at, DirectionSource direction) {
    return result_.space->add_planes(std::array{PlaneSource{at, direction, {DirectionSource::Of::axis, 2, 0}, false}});
  }
  void add_frame() {
    for (std::uint32_t k = 0; k < 4; ++k) {
      const SumPoint a{first_corner_ + k, anchor_}, b{first_corner_ + (k + 1) % 4, anchor_};
      add(source(a), source(b),
          {{0, 0, upright(a, {DirectionSource::Of::p, a.p, b.p}), 1, 1}, SliceSegment::kFrame, false});
    }
  }

  void add_facet(std::uint32_t f) {
    const TableFacet& facet = result_.table.facets[f];
    const std::array<int, 4> sides = sides_of(facet.facet);
    const bool flat = std::all_of(sides.begin(), sides.begin() + facet.facet.corners, [](int s) { return s == 0; });
    if (flat) add_flat(f);
    else add_interval(f, sides);
  }

  void add_flat(std::uint32_t f) {
    const TableFacet& facet = result_.table.facets[f];
    const std::size_t n = facet.facet.corners;
    const bool up = result_.space->exact_normal(facet.plane, 2) * facet.side > 0;
    for (std::size_t k = 0; k < n; ++k) {
      const SumPoint a = facet.facet.corner[k], b = facet.facet.corner[(k + 1) % n];
      const DirectionSource direction = a.q == b.q ? DirectionSource{DirectionSource::Of::p, a.p, b.p}
                                                   : DirectionSource{DirectionSource::Of::q, a.q, b.q};
      const auto side = static_cast<std::int8_t>(up ? 1 : -1);
      add(source(a), source(b), {{0, 0, upright(a, direction), side, side}, f, false});
    }
  }

  /// Counter-clockwise about the facet's own normal m, its facet edge comes up through the plane at the beginning of
  /// the interval in the direction m x z and goes down at its end. A facet edge in the plane is one that comes down at
  /// its first corner and goes up at its second one where the facet lies above it, and the other way round below.
  void add_interval(std::uint32_t f, const std::array<int, 4>& sides) {
    const TableFacet& facet = result_.table.facets[f];
    const std::size_t n = facet.facet.corners;
    PointSource from, to;
    bool has_from = false, has_to = false;
    const auto take = [&](bool rises, const PointSource& at) {
      (rises ? from : to) = at;
      (rises ? has_from : has_to) = true;
    };
    for (std::size_t k = 0; k < n; ++k) {
      const int before = sides[(k + n - 1) % n], here = sides[k], after = sides[(k + 1) % n];
      const PointSource corner = source(facet.facet.corner[k]);
      if (here * after < 0) take(after > 0, {PointSource::Kind::edge, facet.edge[k], result_.plane, 0});
      if (here != 0) continue;
      if (before == after) take(true, corner), take(false, corner);
      else take(before != 0 ? before < 0 : after > 0, corner);
    }
    if (!has_from || !has_to) throw std::logic_error("slice: a facet that meets the plane without a stretch");
    // The way of a segment is z x n_cut, that is z x m where the facet's normal is its plane's.
    if (facet.side > 0) std::swap(from, to);
    const auto [low, high] = std::minmax_element(sides.begin(), sides.begin() + facet.facet.corners);
    add(from, to, {{0, 0, facet.plane, 0, 1}, f, *low < 0 && *high > 0});
  }

  void name_points() {
    result_.points = std::make_unique<PointTable>(*result_.space);
    const std::vector<PointId> ids = result_.points->add(sources_, watch_);
    for (std::size_t k = 0; k < result_.segments.size(); ++k) {
      result_.segments[k].segment.a = ids[2 * k];
      result_.segments[k].segment.b = ids[2 * k + 1];
    }
  }

  const SolidOperand &p_, &q_;
  const SliceHeight& height_;
  StageWatch& watch_;
  std::uint32_t first_corner_ = 0, anchor_ = 0;
  std::vector<PointSource> sources_;  // two for every segment
  SlicePlane result_;
};

}  // namespace

SlicePlane slice_plane(const SolidOperand& p, const SolidOperand& q, const SliceHeight& height, StageWatch& watch) {
  return Builder(p, q, height, watch).run();
}

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
