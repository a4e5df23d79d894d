// Static slices in the sweep's terms: contacts as segments, loops, and which loops of free space belong together.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "cspace/boundary/slice_difference.h"
#include "dymsum/orientation.h"

namespace dymsum::planar {

class SliceReader {
 public:
  SliceReader(const TurningForms& forms, std::shared_ptr<const OperandPair> base);

  const OperandPair& base() const { return *base_; }
  /// The boundary, without tight features. A loop is `outer` only where each operand is of one part.
  std::vector<SliceLoop> loops(const Orientation& at) const;
  PlanarSum slice(const Orientation& at, Semantics semantics) const;
  WalkSegment segment(const Contact& c) const;
  std::uint32_t index(const Contact& c) const { return index_.of(segment(c)); }
  Pair corner(const SumVertex& v) const { return {walk_vertex_[0][v.corner_p], walk_vertex_[1][v.corner_q]}; }

  /// Sums of several parts: what lies in a hole, or outside of everything, has several loops.
  struct Faces {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> same;  ///< cells of one face
    std::vector<std::uint32_t> unbounded;                       ///< cells of the outer face
  };
  /// Requires that the graph is the boundary at the orientation.
  Faces faces(const Orientation& at, const BoundaryGraph& graph) const;
  /// Whether the face on the right of a new loop of crossing segments is free, exactly.
  bool is_free(const std::vector<WalkSegment>& loop, const Orientation& at) const;

 private:
  std::vector<std::uint32_t> segments(const SumRing& ring) const;
  std::uint32_t cell_at(const SumRing& ring, const BoundaryGraph& graph) const;

  const TurningForms& forms_;
  std::shared_ptr<const OperandPair> base_;
  SegmentIndex index_;
  std::array<std::vector<std::uint32_t>, 2> walk_vertex_, walk_edge_;  // by index in the region
};

}  // namespace dymsum::planar
