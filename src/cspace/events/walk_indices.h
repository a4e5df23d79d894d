// Regions whose rings touch: several walk vertices may have one number, and an edge that is cut where a ring touches it
// is several walk edges. Numbers of walks are unique.
#pragma once

#include <array>
#include <memory>

#include "dymsum/region.h"
#include "planar/motion/turning_forms.h"

namespace dymsum::planar {

/// The same base, but contacts name the vertices and edges of its walked rings (walked_rings.h), so that the two sides
/// of a polyline differ.
std::shared_ptr<const OperandPair> numbered_there_and_back(const OperandPair& base,
                                                           const std::array<const Region*, 2>& regions);

/// The same base, but contacts in its slices name walk edges and walk vertices.
std::shared_ptr<const OperandPair> numbered_by_walk(const OperandPair& base);

/// Appends the segments from the first to the last one along an edge of a slice's ring. Where the boundary goes
/// straight on at a touching point, from one edge of a region to another, the slice has no vertex, and names the two
/// where its edge begins and where it ends: here what lies between follows.
void append_run(WalkSegment first, const WalkSegment& last, const TurningForms& forms, std::vector<WalkSegment>& to);

/// Whether one segment ends where the other starts, at every angle: in a common pair of vertices, whichever visits of
/// them.
bool meet_at_ends(const TurningForms& forms, const WalkSegment& s, const WalkSegment& t);

/// The ends of walk edges that are ends of the region's edges, and not cuts.
class EdgeEnds {
 public:
  /// `operand`: of the region, or of its reflection.
  EdgeEnds(const Region& region, const Operand& operand);
  bool starts(std::uint32_t walk_edge) const { return starts_[walk_edge]; }
  bool ends(std::uint32_t walk_edge) const { return ends_[walk_edge]; }

 private:
  std::vector<bool> starts_, ends_;
};

}  // namespace dymsum::planar
