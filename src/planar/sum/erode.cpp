#include "planar/sum/erode.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "base/double_text.h"
#include "dymsum/grown_region.h"
#include "dymsum/planar_sum.h"
#include "exact/rounding_bound.h"
#include "planar/operand/operand.h"
#include "planar/region/region.h"
#include "planar/region/region_sweep.h"
#include "planar/result/planar_sum.h"
#include "planar/result/result_region.h"
#include "planar/sum/minkowski_sum.h"

namespace dymsum {

// P (-) Q: the complement of (closure of the complement of P) (+) -Q. The complement is cut off by a frame wide enough
// that the frame's own boundary plays no part.

namespace {

using planar::EngineRegion;
using planar::layout_rings;
using planar::RingLayout;
using planar::RingList;
using planar::RingPosition;
using planar::separate_touching;
using planar::Turning;

// The number of the frame's own vertices and edges.
constexpr std::uint32_t kFrame = SumVertex::kNone;

double size(Point v) { return std::max(std::abs(v.x), std::abs(v.y)); }

/// The vertex with the largest coordinate.
Point farthest(const Region& r) {
  Point best;
  planar::for_each_chain(r.data(), [&](const std::vector<Point>& points) {
    for (const Point& v : points)
      if (size(v) > size(best)) best = v;
  });
  return best;
}

}  // namespace

std::optional<Error> planar::too_large_to_frame(const Region& p, const Region& q) {
  const Point a = farthest(p), b = farthest(q), worst = size(a) >= size(b) ? a : b;
  if (size(worst) <= planar::kLargestFramed) return std::nullopt;
  Error error{ErrorCode::unsupported_operand,
              "a coordinate is larger than 2^996, too large to look for room inside a region",
              {}};
  error.evidence.x = worst.x;
  error.evidence.y = worst.y;
  return error;
}

// Integers are grid points of any grid with a unit of at most 1; a power of two at least as large as everything else is
// one of any.
double planar::frame_margin(const std::array<double, 4>& bp, const std::array<double, 4>& bq, Turning turning) {
  const double reach = std::max({bp[2] - bp[0], bp[3] - bp[1], bq[2] - bq[0], bq[3] - bq[1], std::abs(bp[0]),
                                 std::abs(bp[1]), std::abs(bp[2]), std::abs(bp[3])});
  constexpr double kLeast = 0x1p-1000;  // of a point, which reaches nowhere
  // The frame is farther away than Q is wide, turned by any angle at most sqrt(2) times as much.
  return std::ldexp(1.0, std::ilogb(std::max(reach, kLeast)) + (turning == Turning::any ? 3 : 2));
}

EngineRegion planar::complement_of(const Region& p, const Region& q, Turning turning) {
  RegionData data;
  std::vector<std::uint32_t> vertex_index(4, kFrame), edge_index(4, kFrame);
  const double m = frame_margin(bounds(p), bounds(q), turning);
  data.parts.push_back({{{-m, -m}, {m, -m}, {m, m}, {-m, m}}, {}});
  const auto reversed = [&](const Ring& ring, std::uint32_t first) {
    const std::uint32_t n = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t at = n - 1 - k;
      vertex_index.push_back(first + at);
      edge_index.push_back(first + (at == 0 ? n - 1 : at - 1));
    }
    return Ring(ring.rbegin(), ring.rend());
  };
  // The complement's parts are the frame and P's holes; an outer ring of P is a hole of the one directly around it.
  RingList list;
  std::vector<std::uint32_t> first;  // ring -> number of its first vertex
  std::vector<std::size_t> part_of_hole;
  std::uint32_t at = 0;
  const auto add = [&](const Ring& ring, bool hole) {
    list.add(ring);
    first.push_back(at);
    at += static_cast<std::uint32_t>(ring.size());
    part_of_hole.push_back(hole ? data.parts.size() : 0);
    if (hole) data.parts.emplace_back();
  };
  std::vector<const Ring*> rings;
  for (const Part& part : p.parts()) {
    add(part.outer, false);
    rings.push_back(&part.outer);
    for (const Ring& hole : part.holes) {
      add(hole, true);
      rings.push_back(&hole);
    }
  }
  const RingLayout layout = layout_rings(list);
  for (std::size_t k = 0; k < data.parts.size(); ++k) {
    for (std::size_t r = 0; r < rings.size(); ++r)
      if (k > 0 && part_of_hole[r] == k) data.parts[k].outer = reversed(*rings[r], first[r]);
    for (std::size_t r = 0; r < rings.size(); ++r) {
      if (part_of_hole[r] != 0) continue;
      const std::uint32_t around = layout.rings[r].container;
      if ((around == RingPosition::kNone ? 0 : part_of_hole[around]) == k)
        data.parts[k].holes.push_back(reversed(*rings[r], first[r]));
    }
  }
  EngineRegion complement = separate_touching(data, p.touching_points());
  if (complement.borrowed != nullptr) {
    complement.borrowed = nullptr;
    complement.own = std::move(data);
    complement.vertex_indices = std::move(vertex_index);
    complement.edge_indices = std::move(edge_index);
  } else {
    for (std::uint32_t& n : complement.vertex_indices) n = vertex_index[n];
    for (std::uint32_t& n : complement.edge_indices) n = edge_index[n];
  }
  return complement;
}

namespace {

bool of_frame(const Contact& c) { return c.p == kFrame; }

}  // namespace

std::optional<Error> planar::not_erodible(const Region& p, const Region& q) {
  if (!p.polylines().empty() || !p.points().empty())
    return Error{ErrorCode::unsupported_operand, "only a region without polylines and points can be eroded", {}};
  if (q.empty()) return Error{ErrorCode::unsupported_operand, "every position holds the empty region", {}};
  return p.empty() ? std::nullopt : too_large_to_frame(p, q);
}

SumOptions planar::options_inside(const SumOptions& options) {
  SumOptions open = options;
  if (open.semantics == Semantics::closed) open.semantics = Semantics::open;
  return open;
}

PlanarSum planar::inside_of_frame(SumState&& state, const SumOptions& options) {
  // Positions that hold Q are what the sum leaves free: its rings the other way round, without the frame's.
  RawBoundary inner;
  inner.at_error = state.boundary.at_error;
  const bool may_touch = state.boundary.may_touch;
  for (std::size_t i = 0; i < state.boundary.rings.size(); ++i) {
    SumRing& ring = state.boundary.rings[i];
    if (std::any_of(ring.vertices.begin(), ring.vertices.end(), [](const SumVertex& v) { return of_frame(v.in); }))
      continue;
    std::reverse(ring.vertices.begin(), ring.vertices.end());
    for (SumVertex& v : ring.vertices) std::swap(v.in, v.out);
    inner.rings.push_back(std::move(ring));
    inner.outer.push_back(!state.boundary.outer[i]);
  }
  inner.cracks = std::move(state.boundary.cracks);
  inner.punctures = std::move(state.boundary.punctures);
  state.boundary = std::move(inner);
  PlanarSum result = finish_sum(std::move(state), options_inside(options));
  if (may_touch) separate_parts(result);
  if (options.semantics == Semantics::closed) {
    result.segments = result.tight_segments;
    result.points = result.tight_points;
  }
  return result;
}

Result<PlanarSum> erode(const Region& p, const Region& q, const SumOptions& options) {
  if (std::optional<Error> error = planar::not_erodible(p, q)) return *std::move(error);
  if (p.empty()) return minkowski_sum(p, q, options);  // empty too
  Result<planar::SumState> computed =
      planar::compute_boundary(planar::make_operand(planar::complement_of(p, q), 0),
                               planar::prepared_operand(q, 1, true), planar::options_inside(options));
  if (!computed.ok()) return computed.error();
  return planar::inside_of_frame(std::move(computed).value(), options);
}

namespace {

double largest_coordinate(const Region& region) {
  double most = 0;
  planar::for_each_chain(region.data(), [&](const std::vector<Point>& points) {
    for (const Point& p : points) most = std::max({most, std::abs(p.x), std::abs(p.y)});
  });
  return most;
}

}  // namespace

// The error of coordinates: a vertex of the sum is rounded once, and so is every edge; a vertex of the disc three
// times.
constexpr double kMoved = exact::rounding_bound(2 + 3, 8);

// A disc that is larger by more than what vertices and edges are moved by holds the given one whichever way they move.
Result<GrownRegion> grown(const Region& region, double margin, int sides) {
  if (!(margin >= 0 && margin <= 0x1p400))
    return Error{
        ErrorCode::out_of_range, "the margin must be from 0 to 2^400, not " + base::general_text(margin, 6), {}};
  if (sides < 3 || sides > 4096)
    return Error{ErrorCode::out_of_range, "sides must be from 3 to 4096, not " + std::to_string(sides), {}};
  if (margin == 0) return GrownRegion{region, 0, 0};
  const double half = std::numbers::pi / sides, coordinates = largest_coordinate(region) + 4 * margin;
  const double inner = margin * exact::kOutwards + kMoved * coordinates,
               outer = inner / std::cos(half) * exact::kOutwards;
  Part polygon;
  for (int k = 0; k < sides; ++k) {
    const double angle = (2 * k + 1) * half;
    polygon.outer.push_back({outer * std::cos(angle), outer * std::sin(angle)});
  }
  const Result<Region> disc = Region::create({{polygon}, {}, {}});
  if (!disc) return disc.error();
  const Result<PlanarSum> sum = minkowski_sum(region, *disc);
  if (!sum) return sum.error();
  Result<Region> rounded = sum->rounded();
  if (!rounded) return rounded.error();
  return GrownRegion{std::move(rounded).value(), margin, outer * exact::kOutwards + kMoved * coordinates};
}

}  // namespace dymsum
