#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "base/poll.h"
#include "dymsum/decomposition.h"
#include "shape/decompose/cut_search.h"
#include "shape/features/shape_features.h"

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

namespace {

/// A vertex with its nearest doubles, which decide nearly all comparisons: rounding keeps the order of what it
/// distinguishes.
struct Corner {
  const RationalPoint* at = nullptr;
  double x = 0, y = 0;
};

bool before(const Corner& a, const Corner& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.at->x != b.at->x) return a.at->x < b.at->x;
  if (a.y != b.y) return a.y < b.y;
  return a.at->y < b.at->y;
}

/// An edge of a piece, whichever way the piece runs along it.
struct PieceEdge {
  Corner low, high;
  std::uint32_t piece = 0;
};

bool before(const PieceEdge& a, const PieceEdge& b) {
  if (before(a.low, b.low)) return true;
  return !before(b.low, a.low) && before(a.high, b.high);
}

void add_edges(const RationalRing& ring, std::uint32_t piece, std::vector<PieceEdge>& edges) {
  std::vector<Corner> corners;
  for (const RationalPoint& at : ring) corners.push_back({&at, at.x.to_double(), at.y.to_double()});
  for (std::size_t i = 0; i < corners.size(); ++i) {
    PieceEdge edge{corners[i], corners[(i + 1) % corners.size()], piece};
    if (before(edge.high, edge.low)) std::swap(edge.low, edge.high);
    edges.push_back(edge);
  }
}

using Neighbours = std::vector<std::vector<std::uint32_t>>;

Neighbours neighbours_of(const std::vector<Piece>& pieces) {
  std::vector<PieceEdge> edges;
  for (std::uint32_t piece = 0; piece < pieces.size(); ++piece) {
    add_edges(pieces[piece].outer, piece, edges);
    for (const RationalRing& hole : pieces[piece].holes) add_edges(hole, piece, edges);
  }
  std::sort(edges.begin(), edges.end(), [](const PieceEdge& a, const PieceEdge& b) { return before(a, b); });
  Neighbours made(pieces.size());
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && !before(edges[begin], edges[end])) ++end;
    for (std::size_t i = begin; i < end; ++i)
      for (std::size_t j = begin; j < end; ++j)
        if (edges[i].piece != edges[j].piece) made[edges[i].piece].push_back(edges[j].piece);
  }
  for (std::vector<std::uint32_t>& list : made) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return made;
}

/// Each piece has the fewest neighbours of all that stand no later; of several such pieces the one of the least index
/// stands last.
std::vector<std::uint32_t> smallest_last(const Neighbours& neighbours) {
  std::vector<std::size_t> degree;
  std::set<std::pair<std::size_t, std::uint32_t>> left;
  for (std::uint32_t piece = 0; piece < neighbours.size(); ++piece) {
    degree.push_back(neighbours[piece].size());
    left.insert({degree[piece], piece});
  }
  std::vector<std::uint32_t> order;
  while (!left.empty()) {
    const std::uint32_t piece = left.begin()->second;
    left.erase(left.begin());
    order.push_back(piece);
    for (const std::uint32_t other : neighbours[piece])
      if (left.erase({degree[other], other}) > 0) left.insert({--degree[other], other});
  }
  std::reverse(order.begin(), order.end());
  return order;
}

}  // namespace

// Pieces are connected open sets that do not meet, so that the graph of those with a common edge is planar; and in
// every planar graph some vertex has at most five neighbours (Euler). In smallest-last order every piece has at most
// five neighbours that are coloured before it. (Matula, Beck 1983.)
std::vector<std::uint32_t> piece_colours(const Decomposition& decomposition) {
  const Neighbours neighbours = neighbours_of(decomposition.pieces);
  const auto none = std::uint32_t(neighbours.size());
  std::vector<std::uint32_t> colours(neighbours.size(), none);
  for (const std::uint32_t piece : smallest_last(neighbours)) {
    std::set<std::uint32_t> taken;
    for (const std::uint32_t other : neighbours[piece]) taken.insert(colours[other]);
    std::uint32_t colour = 0;
    while (taken.count(colour) > 0) ++colour;
    colours[piece] = colour;
  }
  return colours;
}

}  // namespace dymsum
