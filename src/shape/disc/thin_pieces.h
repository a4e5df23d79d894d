// What a closing keeps of polylines and points: where no disc is cut off on either side of them, they stay as thin as
// they are.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "shape/disc/disc_positions.h"

namespace dymsum::shape {

// Directions of a boundary at the ends of its pieces, by what they are made of, and how often they go round.

/// A direction in which a boundary runs, exactly.
struct Heading {
  enum class Of : std::uint8_t {
    edge,      ///< along site `site`
    vertex,    ///< square to what leads from vertex `site` to the centre of `disc`: counter-clockwise about the vertex,
               ///< clockwise about the centre
    crossing,  ///< clockwise about `disc` where it is crossed by the circle about `other`
    touch,     ///< the same where they touch
  };
  Of of = Of::edge;
  std::uint32_t site = kNoIndex;
  CornerDisc disc = {}, other = {};
  bool entered = false;  ///< crossing: clockwise about `disc`, `other` is entered there, not left
  friend bool operator==(const Heading&, const Heading&) = default;
};

/// The headings of the pieces of a ring, at the start of each and at its end. A whole circle has none.
using Headings = std::vector<std::array<Heading, 2>>;

/// How arcs bend. The corners of such a ring turn the other way, by half a turn at most.
enum class Bend : std::uint8_t { counter_clockwise, clockwise };

/// Whether a ring runs counter-clockwise: a simple closed curve turns by 2 pi one way or the other. Counts how often
/// its direction passes a fixed one, by exact signs. Arcs cover half a turn at most or, about an isolated point, a
/// whole one. Cost: two signs for each piece. Throws std::logic_error where the count is neither 1 nor -1.
bool runs_counter_clockwise(const DiscPositions& positions, const Headings& headings, Bend bend);

/// One boundary ring between the discs, on the right, and what they do not reach.
struct DiscBoundary {
  std::vector<DiscPiece> pieces;
  Headings headings;
  std::vector<std::uint32_t> sites;     ///< piece -> the site where it begins, if at a contact
  std::vector<std::uint32_t> touching;  ///< sites that its runs begin on and its arcs touch
  std::uint32_t edge = kNoIndex;        ///< of the complex, beyond the level; none about a convex region
};

/// Whether a segment of a polyline, or a point by itself, is among the sites.
bool has_thin_walks(const Complex& complex);

struct ThinPieces {
  std::vector<DiscBoundary> rings;    ///< with area beside every piece; nothing is said of `touching` and `edge`
  std::vector<DiscSegment> segments;  ///< maximal
  std::vector<DiscCorner> points;
};

/// Takes the pieces of rings apart that run along one another, there and back: they are the thin pieces of the set, and
/// without them the rings go on as the faces of a plane graph do where an edge is deleted. Exact.
ThinPieces without_thin_pieces(const DiscPositions& positions, const std::vector<DiscBoundary>& rings);

}  // namespace dymsum::shape
