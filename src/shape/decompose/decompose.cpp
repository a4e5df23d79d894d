#include "dymsum/decomposition.h"

#include <string>
#include <utility>

#include "base/poll.h"
#include "shape/decompose/cut_search.h"
#include "shape/features/feature_state.h"

namespace dymsum {
namespace {

std::optional<Point> what_is_not_cut(const Region& region) {
  if (!region.polylines().empty()) return region.polylines().front().front();
  if (!region.points().empty()) return region.points().front();
  if (!region.touching_points().empty()) return region.touching_points().front();
  return std::nullopt;
}

std::vector<shape::BarWorth> worth_of_bars(const ShapeFeatures::State& state) {
  std::vector<shape::BarWorth> worth;
  for (std::size_t i = 0; i < state.bars.size(); ++i) {
    const shape::TrackWorth& own = state.tracks.bars[i].worth;
    worth.emplace_back(state.complex.nodes[own.since.node].rank, own.since.depth, own.depth.value_or(-1),
                       state.bars[i].death);
  }
  return worth;
}

/// Region vertex -> rank; none for vertices in an edge.
std::vector<std::optional<std::uint32_t>> vertex_ranks(const Region& region, const shape::BoundaryLoops& loops) {
  std::size_t count = 0;
  for (const Part& part : region.parts()) {
    count += part.outer.size();
    for (const Ring& hole : part.holes) count += hole.size();
  }
  std::vector<std::optional<std::uint32_t>> rank(count);
  for (std::size_t v = 0; v < loops.vertices.size(); ++v) rank[loops.vertices[v].vertex] = loops.rank[v];
  return rank;
}

}  // namespace

Result<Decomposition> decompose(const ShapeFeatures& features, const DecomposeOptions& options) {
  const Region& region = features.region();
  if (const std::optional<Point> position = what_is_not_cut(region)) {
    Evidence evidence;
    evidence.x = position->x;
    evidence.y = position->y;
    return Error{ErrorCode::unsupported_operand,
                 "decompose takes polygons whose rings do not touch, no polylines and points", evidence};
  }
  if (options.persistence.sign() < 0 || options.alpha_from.sign() < 0)
    return Error{ErrorCode::out_of_range, "persistence and diameters are at least 0", {}};
  if (options.alpha_to && *options.alpha_to < options.alpha_from)
    return Error{ErrorCode::out_of_range, "the range of diameters ends before it begins", {}};
  if (region.empty()) return Decomposition{};
  Poll poll(options.progress);
  try {
    poll.stage("significance");
    const std::vector<std::uint32_t> order =
        features.significant(options.persistence, options.alpha_from, options.alpha_to);
    poll.stage("cuts");
    const ShapeFeatures::State& state = ShapeFeaturesAccess::state(features);
    const shape::RingTable table = shape::ring_table(region, vertex_ranks(region, state.loops));
    std::vector<shape::PlacedCut> cuts = shape::find_cuts(table, features.bars(), worth_of_bars(state), order, poll);
    poll.stage("pieces");
    Decomposition result{{}, shape::pieces_between(table, cuts, poll)};
    for (shape::PlacedCut& cut : cuts) result.cuts.push_back(std::move(cut.cut));
    poll(1);
    return result;
  } catch (const Cancelled&) {
    return cancelled();
  }
}

Rational twice_area(const RationalRing& ring) {
  Rational sum;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const RationalPoint &a = ring[i], &b = ring[(i + 1) % ring.size()];
    sum += (a.x - ring[0].x) * (b.y - ring[0].y) - (b.x - ring[0].x) * (a.y - ring[0].y);
  }
  return sum;
}

namespace {

RegionData rounded_data(const Piece& piece) {
  const auto rounded_ring = [](const RationalRing& ring) {
    Ring result;
    for (const RationalPoint& p : ring) result.push_back({p.x.to_double(), p.y.to_double()});
    return result;
  };
  Part part{rounded_ring(piece.outer), {}};
  for (const RationalRing& hole : piece.holes) part.holes.push_back(rounded_ring(hole));
  return {{std::move(part)}, {}, {}};
}

/// The error of a piece that is no valid region when it is rounded: `part` is its index.
Error changed_by_rounding(const Error& error, std::size_t piece) {
  Evidence evidence = error.evidence;
  evidence.part = std::int64_t(piece);
  return {ErrorCode::rounding_changed_topology,
          "rounded to doubles, piece " + std::to_string(piece) + " is no polygon: " + error.message, evidence};
}

}  // namespace

Result<std::vector<Region>> rounded(const Decomposition& decomposition) {
  std::vector<Region> regions;
  for (const Piece& piece : decomposition.pieces) {
    Result<Region> made = Region::create(rounded_data(piece));
    if (!made) return changed_by_rounding(made.error(), regions.size());
    regions.push_back(std::move(made).value());
  }
  return regions;
}

Result<std::vector<Repaired>> rounded_with_repair(const Decomposition& decomposition) {
  std::vector<Repaired> made;
  for (const Piece& piece : decomposition.pieces) {
    if (Result<Region> plain = Region::create(rounded_data(piece))) {
      made.push_back({std::move(plain).value(), {}});
      continue;
    }
    Result<Repaired> repaired = repair(rounded_data(piece));
    if (!repaired) return changed_by_rounding(repaired.error(), made.size());
    made.push_back(std::move(repaired).value());
  }
  return made;
}

}  // namespace dymsum
