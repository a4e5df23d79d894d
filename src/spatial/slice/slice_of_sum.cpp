#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/double_text.h"
#include "base/memory_budget.h"
#include "base/poll.h"
#include "dymsum/solid_slice.h"
#include "exact/big.h"
#include "planar/position/exact_source.h"
#include "planar/result/planar_sum.h"
#include "spatial/convolution/stage_watch.h"
#include "spatial/slice/slice_plane.h"
#include "spatial/sum/common_grid.h"
#include "spatial/sum/exact_set.h"
#include "spatial/sum/feature_pairs.h"

namespace dymsum::spatial {
namespace {

// Rings around cells of a slice.

/// The rings that bound the union of some cells, as half-edges with the union to the left. A ring comes by no point
/// twice; inside of each the union is connected.
std::vector<std::vector<std::uint32_t>> rings_around(const PlaneCells& cells,
                                                     const std::function<bool(std::uint32_t cell)>& taken);

/// The point at which a half-edge begins.
inline PointId start_of(const PlaneCells& cells, std::uint32_t half_edge) {
  const CellEdge& e = cells.edges[half_edge / 2];
  return half_edge & 1 ? e.b : e.a;
}

class Tracer {
 public:
  Tracer(const PlaneCells& cells, const std::function<bool(std::uint32_t)>& taken)
      : cells_(cells), next_(2 * cells.edges.size(), kNoId), inside_(next_.size()), seen_(next_.size()) {
    for (std::uint32_t c = 0; c < cells.cells.size(); ++c) {
      const bool in = taken(c);
      for (std::uint32_t l = cells.cells[c].first_loop; l < cells.cells[c].last_loop; ++l) {
        const std::uint32_t begin = cells.loops[l], end = cells.loops[l + 1];
        for (std::uint32_t k = begin; k < end; ++k) {
          next_[cells.half_edges[k]] = cells.half_edges[k + 1 < end ? k + 1 : begin];
          inside_[cells.half_edges[k]] = in;
        }
      }
    }
  }

  std::vector<std::vector<std::uint32_t>> run() {
    for (std::uint32_t h = 0; h < next_.size(); ++h)
      if (is_boundary(h) && !seen_[h]) follow(h);
    return std::move(rings_);
  }

 private:
  bool is_boundary(std::uint32_t h) const { return inside_[h] && !inside_[h ^ 1]; }

  /// Follows a ring from edge to edge through what is taken at the point between them: the parts that meet there in a
  /// point only stay apart.
  void follow(std::uint32_t start) {
    std::vector<std::uint32_t> path;
    std::unordered_map<PointId, std::size_t> length_at;  // of the path up to a point
    std::uint32_t h = start;
    do {
      const PointId from = start_of(cells_, h);
      if (const auto here = length_at.find(from); here != length_at.end()) cut(path, length_at, here->second);
      length_at[from] = path.size();
      seen_[h] = true;
      path.push_back(h);
      h = next_[h];
      while (!is_boundary(h)) h = next_[h ^ 1];
    } while (h != start);
    rings_.push_back(std::move(path));
  }
  /// A path that comes back to a point leaves a ring of its own.
  void cut(std::vector<std::uint32_t>& path, std::unordered_map<PointId, std::size_t>& length_at, std::size_t first) {
    rings_.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(first), path.end());
    for (const std::uint32_t h : rings_.back()) length_at.erase(start_of(cells_, h));
    path.resize(first);
  }

  const PlaneCells& cells_;
  std::vector<std::uint32_t> next_;
  std::vector<bool> inside_, seen_;
  std::vector<std::vector<std::uint32_t>> rings_;
};

std::vector<std::vector<std::uint32_t>> rings_around(const PlaneCells& cells,
                                                     const std::function<bool(std::uint32_t)>& taken) {
  return Tracer(cells, taken).run();
}

// The cells, edges and points of a slice put together to a planar set.

/// Positions of vertices named by `corner_p`: points of a space, in a unit.
class SliceSource final : public ExactSource {
 public:
  SliceSource(std::shared_ptr<const SumSpace> space, exact::BigRational unit)
      : space_(std::move(space)), unit_(std::move(unit)) {}

  std::uint32_t add(const PointSource& at) {
    at_.push_back(at);
    return static_cast<std::uint32_t>(at_.size() - 1);
  }
  Position position(const SumVertex& v) const override {
    const PointSource& at = at_.at(v.corner_p);
    return {space_->world_coordinate(at, 0) * unit_, space_->world_coordinate(at, 1) * unit_};
  }

 private:
  std::shared_ptr<const SumSpace> space_;
  exact::BigRational unit_;
  std::vector<PointSource> at_;
};

/// Operands as the engine sees them: coordinates are these numbers times `unit`.
struct SlicedPair {
  SolidOperand p, q;
  SliceHeight height;
  exact::BigRational unit = 1;
};

class Collector {
 public:
  Collector(SlicePlane plane, const SliceStates& states, const SlicedPair& pair, SolidSlice& slice)
      : plane_(std::move(plane)),
        space_(std::move(plane_.space)),
        states_(states),
        p_(pair.p),
        q_(pair.q),
        unit_(exact::round_to_double(pair.unit)),
        slice_(slice),
        source_(std::make_shared<SliceSource>(space_, pair.unit)),
        vertex_of_(plane_.points->size(), SumVertex::kNone) {}

  void run() {
    for (std::uint32_t s = 0; s < plane_.segments.size(); ++s) by_cut_[plane_.segments[s].segment.cut].push_back(s);
    exact_source(slice_.section) = source_;
    std::vector<SumPart> in = parts([&](std::uint32_t c) { return states_.cells[c] != SliceState::outside; });
    std::vector<SumPart> touching = parts([&](std::uint32_t c) { return states_.cells[c] == SliceState::touching; });
    slice_.section.segments = segments(states_.threads);
    slice_.section.tight_segments = segments(states_.cracks);
    slice_.section.points = points(states_.dots);
    slice_.section.tight_points = points(states_.punctures);
    slice_.section.parts = std::move(in);
    slice_.touching = std::move(touching);
    slice_.section.at_error = error_;
    planar::canonicalize(slice_.section.parts, *source_, error_);
    planar::canonicalize(slice_.touching, *source_, error_);
    planar::canonicalize(slice_.section.segments, *source_, error_);
    planar::canonicalize(slice_.section.tight_segments, *source_, error_);
    planar::canonicalize(slice_.section.points, *source_, error_);
    planar::canonicalize(slice_.section.tight_points, *source_, error_);
  }

 private:
  /// The vertex at a point of the plane's table, in doubles of the operands' own coordinates.
  SumVertex vertex(PointId at) {
    if (vertex_of_[at] == SumVertex::kNone) vertex_of_[at] = source_->add(plane_.points->source(at));
    const Approx& approx = plane_.points->approx(at);
    const double near[2] = {approx.at.x, approx.at.y};
    double world[2];
    for (int axis = 0; axis < 2; ++axis) {
      const SumSpace::Line line = space_->line(axis);
      const double unit = std::ldexp(1.0, line.unit), offset = line.p_offset + line.q_offset;
      world[axis] = near[axis] * unit + offset;
      const double size = (space_->span() + approx.radius) * unit + std::abs(offset);
      error_ = std::max(error_, (approx.radius * unit + size * 0x1p-51) * std::max(1.0, unit_));
    }
    SumVertex v;
    if (unit_ != 1) {
      for (double& c : world) c *= unit_, error_ = std::max(error_, std::abs(c) * 0x1p-51);
    }
    v.at = {world[0], world[1]};
    v.in.p = v.out.p = SumVertex::kNone;
    v.corner_p = vertex_of_[at];
    v.corner_q = 0;
    return v;
  }
  PointId start(std::uint32_t half_edge) const { return plane_.point(start_of(plane_.cells, half_edge)); }

  template <class Taken>
  std::vector<SumPart> parts(const Taken& taken) {
    std::vector<SumRing> rings;
    std::vector<std::uint8_t> outer;
    for (std::vector<std::uint32_t>& path : rings_around(plane_.cells, taken)) {
      rings.push_back(ring(path));
      outer.push_back(runs_around(rings.back()));
    }
    return planar::group_rings(std::move(rings), outer, *source_, error_);
  }

  SumRing ring(const std::vector<std::uint32_t>& path) {
    SumRing result;
    const std::size_t n = path.size();
    std::vector<std::size_t> corners;
    for (std::size_t k = 0; k < n; ++k)
      if (!goes_straight(path[(k + n - 1) % n], path[k])) corners.push_back(k);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      SumVertex v = vertex(start(path[corners[c]]));
      v.out.p = contact(path[corners[c]]);
      result.vertices.push_back(v);
    }
    for (std::size_t c = 0; c < corners.size(); ++c)
      result.vertices[(c + 1) % corners.size()].in = result.vertices[c].out;
    return result;
  }
  /// Whether half-edge h goes on along the line of g, which ends where it begins.
  bool goes_straight(std::uint32_t g, std::uint32_t h) const {
    const PlaneId cut = plane_.cells.edges[g / 2].cut;
    if (cut == plane_.cells.edges[h / 2].cut) return true;
    const PointId to = start(h ^ 1);
    return space_->side(cut, plane_.points->source(to), plane_.points->approx(to)) == 0;
  }
  /// Counter-clockwise: it turns left at its smallest vertex.
  bool runs_around(const SumRing& ring) const {
    const std::size_t n = ring.vertices.size();
    std::vector<planar::Spot> spots;
    for (const SumVertex& v : ring.vertices) spots.push_back(planar::make_spot(source_->position(v)));
    std::size_t least = 0;
    for (std::size_t k = 1; k < n; ++k)
      if (planar::compare(spots[k], spots[least]) < 0) least = k;
    return planar::orientation(spots[(least + n - 1) % n], spots[least], spots[(least + 1) % n]) > 0;
  }

  std::vector<SumSegment> segments(const std::vector<std::uint32_t>& edges) {
    std::vector<std::array<PointId, 2>> pieces;
    for (const std::uint32_t e : edges) pieces.push_back({start(2 * e), start(2 * e + 1)});
    std::vector<SumSegment> result;
    for (const TightLine& line : joined_lines(*space_, *plane_.points, pieces)) {
      SumSegment segment{vertex(line.from), vertex(line.to)};
      segment.from.out.p = segment.to.in.p = contact(2 * edges[line.first]);
      result.push_back(segment);
    }
    return result;
  }
  std::vector<SumVertex> points(const std::vector<PointId>& at) {
    std::vector<SumVertex> result;
    for (const PointId p : at) result.push_back(vertex(plane_.point(p)));
    return result;
  }

  /// The index of what touches along a half-edge: of the first facet with its cut whose interval holds it.
  std::uint32_t contact(std::uint32_t half_edge) {
    const PointId a = start(half_edge), b = start(half_edge ^ 1);
    for (const std::uint32_t s : by_cut_.at(plane_.cells.edges[half_edge / 2].cut)) {
      const SliceSegment& segment = plane_.segments[s];
      if (segment.facet == SliceSegment::kFrame || !holds(segment.segment, a) || !holds(segment.segment, b)) continue;
      const auto [position, added] =
          index_of_.emplace(segment.facet, static_cast<std::uint32_t>(slice_.contacts.size()));
      if (added) slice_.contacts.push_back(features_of(plane_.table.facets[segment.facet].facet, p_, q_));
      return position->second;
    }
    return SumVertex::kNone;
  }
  /// Whether a point of its line lies on a segment.
  bool holds(const PlaneSegment& s, PointId at) const {
    if (at == s.a || at == s.b) return true;
    const PointTable& points = *plane_.points;
    for (int axis = 0; axis < 2; ++axis) {
      const int direction = space_->exact_order(points.source(s.a), points.source(s.b), axis);
      if (direction == 0) continue;
      return space_->exact_order(points.source(s.a), points.source(at), axis) == direction &&
             space_->exact_order(points.source(at), points.source(s.b), axis) == direction;
    }
    return false;
  }

  SlicePlane plane_;
  std::shared_ptr<const SumSpace> space_;
  const SliceStates& states_;
  const SolidOperand &p_, &q_;
  double unit_;
  SolidSlice& slice_;
  std::shared_ptr<SliceSource> source_;
  std::vector<std::uint32_t> vertex_of_;  // per point of the table
  std::unordered_map<PlaneId, std::vector<std::uint32_t>> by_cut_;
  std::unordered_map<std::uint32_t, std::uint32_t> index_of_;  // of facets: of their contacts
  double error_ = 0;
};

/// Fills section, touching and contacts, in canonical order. Takes the plane's space.
void collect_region(SlicePlane plane, const SliceStates& states, const SlicedPair& pair, SolidSlice& slice) {
  Collector(std::move(plane), states, pair, slice).run();
}

/// The sets and the height on one grid, where no doubles hold both sets.
SlicedPair pair_of(const ExactSet& p, const ExactSet& q, double z) {
  ExactSet height;
  height.at.push_back({0, 0, exact::exact_value(z)});
  const ExactSet* const sets[]{&p, &q, &height};
  const CommonGrid grid = common_grid(sets);
  const auto on_grid = [&](const ExactSet& set) {
    return solid_operand(set.set, set.thin, vertices_on(grid, set), grid.unit());
  };
  const exact::BigRational unit(exact::BigInteger(1) << grid.shift(), grid.scale);
  return {on_grid(p), on_grid(q), {z, vertices_on(grid, height)[0].z, 1 / exact::round_to_double(unit)}, unit};
}

/// Whether the plane meets the box of the sum.
bool is_within(const ExactSet& p, const ExactSet& q, double z) {
  const auto by_height = [](const ExactPosition& a, const ExactPosition& b) { return a[2] < b[2]; };
  const auto [p_low, p_high] = std::minmax_element(p.at.begin(), p.at.end(), by_height);
  const auto [q_low, q_high] = std::minmax_element(q.at.begin(), q.at.end(), by_height);
  const exact::BigRational at = exact::exact_value(z);
  return (*p_low)[2] + (*q_low)[2] <= at && at <= (*p_high)[2] + (*q_high)[2];
}

}  // namespace
}  // namespace dymsum::spatial

namespace dymsum {
namespace {

/// Whether the plane meets the box of the sum.
bool within(const Mesh& p, const Mesh& q, double z) {
  const auto a = bounds(p), b = bounds(q);
  const exact::BigRational at = exact::exact_value(z);
  return exact::exact_value(a[2]) + exact::exact_value(b[2]) <= at &&
         at <= exact::exact_value(a[5]) + exact::exact_value(b[5]);
}

/// Nothing where the plane misses the sum.
std::optional<spatial::SlicedPair> sliced_pair(const spatial::OperandSet& p, const spatial::OperandSet& q, double z) {
  if (p.mesh() && q.mesh()) {
    if (p.mesh()->empty() || q.mesh()->empty() || !within(*p.mesh(), *q.mesh(), z)) return std::nullopt;
    return spatial::SlicedPair{
        spatial::solid_operand(p.mesh()->data()), spatial::solid_operand(q.mesh()->data()), {z, {}}};
  }
  const spatial::ExactSet a = spatial::regular_triangles(p), b = spatial::regular_triangles(q);
  if (a.at.empty() || b.at.empty() || !spatial::is_within(a, b, z)) return std::nullopt;
  return spatial::pair_of(a, b, z);
}

}  // namespace

Result<SolidSlice> slice_of_sum(const SpatialOperand& p, const SpatialOperand& q, double z,
                                const SpatialOptions& options) {
  if (!std::isfinite(z))
    return Error{ErrorCode::not_finite, "the height of a slice must be finite, not " + base::general_text(z, 6), {}};
  SolidSlice slice;
  slice.z = z;
  const spatial::OperandSet first(p, Semantics::regular), second(q, Semantics::regular);
  if (first.has_thin() || second.has_thin())
    return Error{ErrorCode::unsupported_operand, "slices are of solids without thin parts", {}};
  const std::optional<spatial::SlicedPair> pair = sliced_pair(first, second, z);
  if (!pair) return slice;
  SpatialStats stats;
  spatial::StageWatch watch(options, stats);
  try {
    watch.begin("convolution");
    spatial::SlicePlane plane = spatial::slice_plane(pair->p, pair->q, pair->height, watch);
    watch.begin("collisions");
    const spatial::Collision collision(*plane.space, pair->p, pair->q);
    const spatial::SliceStates states = spatial::slice_states(plane, collision);
    slice.stats = {plane.space->bits(), plane.facets, plane.table.facets.size(), plane.cells.cells.size(),
                   collision.tests()};
    spatial::collect_region(std::move(plane), states, *pair, slice);
  } catch (const Cancelled&) {
    return cancelled();
  } catch (const spatial::OverBudget& e) {
    return base::budget_error("the slice takes at least", e.bytes, options.memory);
  } catch (const spatial::NoGridForSlice& e) {
    return e.error;
  }
  return slice;
}

}  // namespace dymsum
