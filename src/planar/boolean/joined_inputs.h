// The inputs of a Boolean expression as one operand of a sum, and which input every segment of it belongs to.
#pragma once

#include <cstdint>
#include <vector>

#include "planar/boolean/boolean_terms.h"
#include "planar/operand/operand.h"
#include "planar/region/engine_region.h"

namespace dymsum::planar {

/// What the segments of an operand's walk are.
struct SegmentInputs {
  enum class Kind : std::uint8_t {
    ring,        ///< of a ring
    line,        ///< of a polyline, there or back
    from_point,  ///< from a point to some other vertex, so that the point is a node of the graph
    to_point,    ///< the same segment back
  };
  std::vector<std::uint32_t> input;  ///< by segments
  std::vector<Kind> kind;
  bool thin = false;  ///< there are others than rings
  bool is_of_input(std::uint32_t segment) const { return kind[segment] == Kind::ring || kind[segment] == Kind::line; }
};

/// Every ring as a part of its own, every polyline as one, and one of two vertices from every point. Vertices have the
/// indices that planar_boolean.h says; the other end of a point's polyline has one beyond these.
struct JoinedInputs {
  EngineRegion region;
  std::vector<std::uint32_t> input;       ///< of the region's vertices in their order
  std::vector<SegmentInputs::Kind> kind;  ///< of the segments that begin there
};
JoinedInputs joined_inputs(const BooleanTerms& terms);

/// Of the walk edges of the operand made of that region.
SegmentInputs segments_of(const JoinedInputs& joined, const Operand& operand);

}  // namespace dymsum::planar
