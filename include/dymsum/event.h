// What happens at one parameter of a motion: one type for scales and angles, in the plane and in space.
#pragma once

#include <cstdint>

#include "dymsum/names.h"
#include "dymsum/rational.h"

namespace dymsum {

/// What meets at an event, if nothing else does. Facets, segments and edges are those of the convolution.
enum class EventKind : std::uint8_t {
  vertex_on_segment,  ///< in the plane: the end of a segment lies on another one
  three_segments,     ///< in the plane: three segments have a point in common
  normal_on_arc,      ///< a face is parallel to an edge of the other operand: facets come and go
  vertex_on_facet,    ///< a corner of a facet comes onto another facet, or onto an edge or a corner of one
  edge_on_edge,       ///< two edges of facets cross
  edge_and_facets,    ///< an edge meets two facets in a point; while an operand scales that is one of four_facets
  four_facets,        ///< four facets have a point in common, two of them perhaps at a common edge
  coplanar_facets,    ///< parallel facets come into one plane
};

/// What an event has to change to be looked for.
enum class EventChange : std::uint8_t {
  visible,   ///< Event::visible
  topology,  ///< Event::topology
};

/// An exact parameter of a motion at which something meets on the boundary of a sum: a scale (Rational), or an angle.
template <class Parameter>
struct Event {
  using Kind = EventKind;
  Parameter parameter{};
  double approx = 0;      ///< the scale, or the angle in radians
  Kind kind = Kind{};     ///< of several at one parameter the last of these; in the plane the first
  bool visible = false;   ///< the sum's structure differs before, at or after it
  bool topology = false;  ///< so do counts of parts, holes, shells or tight features, or the genus of a shell
  friend bool operator==(const Event&, const Event&) = default;
};
using ScaleEvent = Event<Rational>;

}  // namespace dymsum
