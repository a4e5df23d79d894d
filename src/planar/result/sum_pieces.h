// Lower-dimensional pieces of a sum with the contacts that carry them.
#pragma once

#include <vector>

#include "dymsum/planar_sum.h"
#include "planar/operand/lattice.h"
#include "planar/operand/operand.h"
#include "planar/result/sum_source.h"

namespace dymsum::planar {

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
