// The cells of all sites side by side: every walk as a circular row of pieces, each with its mate on the other side.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/complex/envelope.h"

namespace dymsum::shape {

/// An interval of a site along which discs first touch `other`. Unless the site is an isolated point, `section` and
/// `to_section` are the same.
struct CellPiece {
  std::uint32_t site = 0, other = kNoIndex;
  Section section, to_section;
  Mark from, to;
  bool wraps = false;                ///< it begins before the first direction of an isolated point and ends after it
  std::uint32_t next = 0, prev = 0;  ///< in the walk
  std::uint32_t mate = kNoIndex;     ///< the same discs as seen from the other site; they go backwards there
};

struct Cells {
  std::vector<CellPiece> pieces;
};

/// Joins the envelopes of all sites (their sections in order). `rows[i]` are the pieces of section i.
Cells join_cells(const Walks& walks, const std::vector<Section>& sections, const std::vector<std::vector<Piece>>& rows);

/// Finds mates: along two sites the pieces that they share come in opposite orders. False where some piece has none:
/// then candidates are missing.
bool match_cells(Order& order, Cells& cells);

}  // namespace dymsum::shape
