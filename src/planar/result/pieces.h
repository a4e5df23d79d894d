// Lower-dimensional pieces of a set: what candidate segments and points add to its regular parts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "dymsum/planar_sum.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"
#include "planar/position/exact_source.h"
#include "planar/result/planar_sum.h"

namespace dymsum::planar {

/// A closed segment that may belong to the set. Requires: a != b.
struct PieceCandidate {
  Position a, b;
};

/// An end of a piece: an end of candidate segment `candidate`, or the position where edge `cut_edge` of ring `cut_ring`
/// meets it (the edge that starts at the vertex of that number). At a vertex of the ring it is one of its two edges
/// that does not run along the piece's line.
struct PieceEnd {
  static constexpr std::uint32_t kNone = 0xffffffff;
  Position at;
  std::size_t candidate = 0;  ///< the smallest number of a candidate that contains the end and some of the piece
  std::uint32_t cut_ring = kNone, cut_edge = kNone;
};

struct PieceSegment {
  PieceEnd from, to;          ///< from < to lexicographically
  std::size_t candidate = 0;  ///< the smallest number of a candidate that shares a segment with it
};

struct PiecePoint {
  Position at;
  std::size_t candidate = 0;  ///< the smallest number of an equal candidate point
};

struct Pieces {
  std::vector<PieceSegment> segments;  ///< sorted by from, then to
  std::vector<PiecePoint> points;      ///< sorted
};

/// Let A be the closed set bounded by `rings` (which do not cross; even-odd) and S the closure of the union of the
/// candidate segments minus A. Returns the maximal segments in S and the candidate points that lie neither in A nor in
/// S; pieces on one line that share no more than an end are one segment, also where that end lies in A.
/// Exact. Requires candidate segments with two different ends (throws std::invalid_argument).
/// Cost: O(c (n + k n)) for c candidates, n ring edges and k edges that meet a candidate.
Pieces lower_dimensional_pieces(std::span<const std::vector<Position>> rings, std::span<const PieceCandidate> segments,
                                std::span<const Position> points);

// Lower-dimensional pieces of a sum with the contacts that carry them.

/// Segments and points, not yet cut and merged.
struct PieceCandidates {
  std::vector<SumSegment> segments;
  std::vector<SumVertex> points;
};

/// What pairs of components without area add to the closed sum, parallelograms left out.
PieceCandidates lower_dimensional_candidates(const Lattice& lattice, const Operand& p, const Operand& q);

/// Appends the maximal pieces of the candidates outside the parts: lower_dimensional_pieces, with contacts.
void merge_pieces(const SumSource& source, const std::vector<SumPart>& parts, const PieceCandidates& candidates,
                  std::vector<SumSegment>& segments, std::vector<SumVertex>& points);

}  // namespace dymsum::planar
