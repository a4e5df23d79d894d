#include "dymsum/decomposition.h"
#include "shape/decompose/cut_search.h"

namespace dymsum {
namespace {

std::optional<Point> what_is_not_cut(const Region& region) {
  if (!region.polylines().empty()) return region.polylines().front().front();
  if (!region.points().empty()) return region.points().front();
  if (!region.touching_points().empty()) return region.touching_points().front();
  return std::nullopt;
}

}  // namespace

Result<Decomposition> decompose(const ShapeFeatures& features, const DecomposeOptions& options) {
  const Region& region = features.region();
  if (const std::optional<Point> place = what_is_not_cut(region)) {
    Evidence evidence;
    evidence.x = place->x;
    evidence.y = place->y;
    return Error{ErrorCode::unsupported_operand, "polylines, points and rings that touch are not cut", evidence};
  }
  if (options.persistence.sign() < 0 || options.alpha_from.sign() < 0)
    return Error{ErrorCode::out_of_range, "persistence and diameters are at least 0", {}};
  if (options.alpha_to && *options.alpha_to < options.alpha_from)
    return Error{ErrorCode::out_of_range, "the range of diameters ends before it begins", {}};
  const shape::RingTable table = shape::ring_table(region);
  Decomposition result;
  result.cuts = shape::find_cuts(table, features.bars(),
                                 features.significant(options.persistence, options.alpha_from, options.alpha_to));
  result.pieces = shape::pieces_between(table, result.cuts);
  return result;
}

Rational twice_area(const RationalRing& ring) {
  Rational sum;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const RationalPoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += (a.x - ring[0].x) * (b.y - ring[0].y) - (b.x - ring[0].x) * (a.y - ring[0].y);
  }
  return sum;
}

Result<std::vector<Region>> rounded(const Decomposition& decomposition) {
  std::vector<Region> regions;
  const auto rounded_ring = [](const RationalRing& ring) {
    Ring result;
    for (const RationalPoint& p : ring) result.push_back({p.x.to_double(), p.y.to_double()});
    return result;
  };
  for (const Piece& piece : decomposition.pieces) {
    Part part{rounded_ring(piece.outer), {}};
    for (const RationalRing& hole : piece.holes) part.holes.push_back(rounded_ring(hole));
    Result<Region> made = Region::create({{std::move(part)}, {}, {}});
    if (!made) return Error{ErrorCode::rounding_changed_topology, made.error().message, made.error().evidence};
    regions.push_back(std::move(made).value());
  }
  return regions;
}

}  // namespace dymsum
