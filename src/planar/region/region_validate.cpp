#include "planar/region/region_validate.h"

#include <cmath>
#include <string>
#include <utility>

#include "exact/orient.h"
#include "planar/region/plain_rings.h"
#include "planar/region/region_sweep.h"

namespace dymsum {

Result<Region> Region::create(RegionData data) {
  planar::Validation checked = planar::validate(data);
  if (checked.error) return *std::move(checked.error);
  return planar::trusted_region(std::move(data), std::move(checked.touching_points));
}

namespace planar {

Region RegionInternals::make(RegionData data, std::vector<Point> touching_points) {
  Region region;
  region.data_ = std::move(data);
  region.touching_points_ = std::move(touching_points);
  region.prepared_ = not_yet_prepared();
  return region;
}

Region trusted_region(RegionData data, std::vector<Point> touching_points) {
  return RegionInternals::make(std::move(data), std::move(touching_points));
}

namespace {

// The name of a chain of a region: a ring of a part, or a polyline.
struct ChainName {
  std::optional<std::int64_t> part;
  std::int64_t ring;
};

Error chain_error(ErrorCode code, std::string message, ChainName chain, std::optional<std::size_t> vertex,
                  const Point* at) {
  Error error{code, std::move(message), {}};
  error.evidence.part = chain.part;
  error.evidence.ring = chain.ring;
  if (vertex) error.evidence.vertex = static_cast<std::int64_t>(*vertex);
  if (at) {
    error.evidence.x = at->x;
    error.evidence.y = at->y;
  }
  return error;
}

std::optional<Error> check_finite(const std::vector<Point>& chain, ChainName name) {
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (std::isfinite(chain[i].x) && std::isfinite(chain[i].y)) continue;
    return chain_error(ErrorCode::not_finite, "a coordinate is not a finite number", name, i, nullptr);
  }
  return std::nullopt;
}

std::optional<Error> check_length(const std::vector<Point>& chain, ChainName name, std::size_t least) {
  if (chain.size() >= least) return std::nullopt;
  const char* what = name.part ? "a ring needs at least three vertices" : "a polyline needs at least two vertices";
  return chain_error(ErrorCode::too_few_vertices, what, name, std::nullopt, chain.empty() ? nullptr : &chain.front());
}

std::optional<Error> check_repeats(const std::vector<Point>& chain, ChainName name, bool closed) {
  for (std::size_t i = 0; i + (closed ? 0 : 1) < chain.size(); ++i) {
    const std::size_t next = i + 1 == chain.size() ? 0 : i + 1;
    if (chain[i] != chain[next]) continue;
    Error error = chain_error(ErrorCode::repeated_vertex, "two consecutive vertices are equal", name, i, &chain[i]);
    error.evidence.other_vertex = static_cast<std::int64_t>(next);
    return error;
  }
  return std::nullopt;
}

std::optional<Error> check_area(const Ring& ring, ChainName name) {
  for (std::size_t i = 2; i < ring.size(); ++i) {
    if (exact::orient_sign(ring[0], ring[1], ring[i]) != 0) return std::nullopt;
  }
  return chain_error(ErrorCode::no_area, "all vertices of a ring lie on one line", name, 0, &ring[0]);
}

std::optional<Error> check_ring(const Ring& ring, ChainName name) {
  if (auto error = check_length(ring, name, 3)) return error;
  if (auto error = check_repeats(ring, name, true)) return error;
  return check_area(ring, name);
}

std::optional<Error> check_polyline(const Polyline& line, ChainName name) {
  if (auto error = check_length(line, name, 2)) return error;
  return check_repeats(line, name, false);
}

// The checks of every chain by itself, for all rings and then all polylines.
template <class CheckRing, class CheckPolyline>
std::optional<Error> check_chains(const RegionData& data, CheckRing check_ring, CheckPolyline check_polyline) {
  for (std::size_t i = 0; i < data.parts.size(); ++i) {
    const auto part = static_cast<std::int64_t>(i);
    if (auto error = check_ring(data.parts[i].outer, ChainName{part, 0})) return error;
    std::int64_t ring = 0;
    for (const Ring& hole : data.parts[i].holes) {
      if (auto error = check_ring(hole, ChainName{part, ++ring})) return error;
    }
  }
  for (std::size_t i = 0; i < data.polylines.size(); ++i) {
    const ChainName name{std::nullopt, static_cast<std::int64_t>(i)};
    if (auto error = check_polyline(data.polylines[i], name)) return error;
  }
  return std::nullopt;
}

// How the rings of a region lie, read off their layout.
class LayoutCheck {
 public:
  explicit LayoutCheck(const RegionData& data) {
    for (std::size_t i = 0; i < data.parts.size(); ++i) {
      outer_of_part_.push_back(rings_.ring_count());
      add_ring(data.parts[i].outer, i);
      for (const Ring& hole : data.parts[i].holes) add_ring(hole, i);
    }
    layout_ = layout_rings(rings_);
  }

  std::optional<Error> run() const {
    if (layout_.clash) return crossing();
    for (std::uint32_t r = 0; r < rings_.ring_count(); ++r) {
      if (layout_.rings[r].counter_clockwise == is_outer(r)) continue;
      const char* what = is_outer(r) ? "an outer ring runs clockwise" : "a hole runs counter-clockwise";
      return ring_error(ErrorCode::wrong_orientation, what, r);
    }
    for (const std::uint32_t r : outer_of_part_) {
      if (auto error = misplaced_outer(r)) return error;
    }
    for (std::uint32_t r = 0; r < rings_.ring_count(); ++r) {
      if (is_outer(r)) continue;
      if (auto error = misplaced_hole(r)) return error;
    }
    return std::nullopt;
  }

  const std::vector<Point>& touching_points() const { return layout_.touching_points; }

 private:
  void add_ring(const Ring& ring, std::size_t part) {
    rings_.add(ring);
    part_of_.push_back(part);
  }

  bool is_outer(std::uint32_t ring) const { return outer_of_part_[part_of_[ring]] == ring; }
  std::int64_t part_index(std::uint32_t ring) const { return static_cast<std::int64_t>(part_of_[ring]); }
  std::int64_t ring_index(std::uint32_t ring) const { return std::int64_t{ring} - outer_of_part_[part_of_[ring]]; }
  std::int64_t vertex_index(std::uint32_t vertex) const {
    return std::int64_t{vertex} - rings_.ring_begin[rings_.ring_of[vertex]];
  }

  Error vertex_error(ErrorCode code, std::string message, std::uint32_t vertex, Point at) const {
    const std::uint32_t ring = rings_.ring_of[vertex];
    return chain_error(code, std::move(message), {part_index(ring), ring_index(ring)},
                       static_cast<std::size_t>(vertex_index(vertex)), &at);
  }

  Error ring_error(ErrorCode code, std::string message, std::uint32_t ring,
                   std::uint32_t other = RingPosition::kNone) const {
    const std::uint32_t vertex = layout_.rings[ring].first_vertex;
    Error error = vertex_error(code, std::move(message), vertex, rings_.points[vertex]);
    if (other != RingPosition::kNone) {
      error.evidence.other_part = part_index(other);
      error.evidence.other_ring = ring_index(other);
    }
    return error;
  }

  Error crossing() const {
    const RingClash& clash = *layout_.clash;
    const std::uint32_t other = rings_.ring_of[clash.other_edge];
    const bool same = rings_.ring_of[clash.edge] == other;
    const char* what = same ? "a ring crosses itself or runs along itself" : "two rings cross or run along each other";
    Error error = vertex_error(same ? ErrorCode::self_crossing : ErrorCode::rings_cross, what, clash.edge, clash.at);
    error.evidence.other_part = part_index(other);
    error.evidence.other_ring = ring_index(other);
    error.evidence.other_vertex = vertex_index(clash.other_edge);
    return error;
  }

  // A part may lie outside all others, or directly inside a hole.
  std::optional<Error> misplaced_outer(std::uint32_t ring) const {
    const std::uint32_t around = layout_.rings[ring].container;
    if (around == RingPosition::kNone) return std::nullopt;
    if (is_outer(around)) return ring_error(ErrorCode::parts_overlap, "a part lies inside another part", ring, around);
    if (part_of_[around] != part_of_[ring]) return std::nullopt;
    return ring_error(ErrorCode::hole_outside, "a hole is not inside its outer ring", around);
  }

  // A hole must lie directly inside the outer ring of its part.
  std::optional<Error> misplaced_hole(std::uint32_t ring) const {
    const std::uint32_t outer = outer_of_part_[part_of_[ring]];
    const std::uint32_t container = layout_.rings[ring].container;
    if (container == outer) return std::nullopt;
    bool inside = false;
    for (std::uint32_t around = container; around != RingPosition::kNone; around = layout_.rings[around].container) {
      if (part_of_[around] != part_of_[ring]) continue;
      if (!is_outer(around))
        return ring_error(ErrorCode::hole_outside, "a hole lies inside another hole", ring, around);
      inside = true;
    }
    if (!inside) return ring_error(ErrorCode::hole_outside, "a hole is not inside its outer ring", ring);
    return ring_error(ErrorCode::parts_overlap, "a hole of a part lies inside another part", ring, container);
  }

  RingList rings_;
  std::vector<std::size_t> part_of_;
  std::vector<std::uint32_t> outer_of_part_;
  RingLayout layout_;
};

}  // namespace

std::optional<Error> check_finite(const RegionData& data) {
  const auto check = [](const std::vector<Point>& chain, ChainName name) { return check_finite(chain, name); };
  if (auto error = check_chains(data, check, check)) return error;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Point p = data.points[i];
    if (std::isfinite(p.x) && std::isfinite(p.y)) continue;
    Error error{ErrorCode::not_finite, "a coordinate is not a finite number", {}};
    error.evidence.vertex = static_cast<std::int64_t>(i);
    return error;
  }
  return std::nullopt;
}

Validation validate(const RegionData& data) { return plainly_valid(data) ? Validation{} : validate_in_full(data); }

Validation validate_in_full(const RegionData& data) {
  if (auto error = check_finite(data)) return {std::move(error), {}};
  if (auto error = check_chains(data, check_ring, check_polyline)) return {std::move(error), {}};
  LayoutCheck layout(data);
  if (auto error = layout.run()) return {std::move(error), {}};
  return {std::nullopt, layout.touching_points()};
}

}  // namespace planar
}  // namespace dymsum
