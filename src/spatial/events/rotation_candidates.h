// What may meet in a window of angles: candidates, each with the exact roots at which it does.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "spatial/events/facet_cells.h"

namespace dymsum::spatial {

/// Features of a window that come together; indices are those of its facets.
struct Meeting {
  using Kind = EventKind;
  Kind kind = Kind::normal_on_arc;
  SlantCondition slant;                   ///< normal_on_arc
  SumPoint vertex;                        ///< vertex_on_facet
  std::array<SumEdge, 2> edges{};         ///< 2 of edge_on_edge, 1 of edge_and_facets
  std::array<std::uint32_t, 4> facets{};  ///< 1 of vertex_on_facet, 2 of edge_and_facets, 4 of four_facets

  std::span<const SumEdge> all_edges() const {
    return std::span(edges).first(kind == Kind::edge_on_edge ? 2 : kind == Kind::edge_and_facets ? 1 : 0);
  }
  std::span<const std::uint32_t> all_facets() const {
    return std::span(facets).first(kind == Kind::vertex_on_facet   ? 1
                                   : kind == Kind::edge_and_facets ? 2
                                   : kind == Kind::four_facets     ? 4
                                                                   : 0);
  }
};

struct RootMeeting {
  std::uint32_t angle = 0;  ///< its index
  Meeting meeting;
};

/// The facets of a window with what they are made of.
struct RotationWindow {
  RotationRange range;
  double midpoint = 0, half = 0;  ///< in radians
  std::vector<WindowFacet> facets;
  std::vector<std::uint32_t> plane_of;  ///< per facet: equal where planes are one at every angle, whatever their sides
  FacetGraph graph;
  std::vector<bool> bounds;  ///< per edge: false inside a face of an operand, where it bounds nothing

  RotationWindow(const RotatingPair& pair, const GaussMaps& maps, const RotationRange& range);
};

struct WindowMeetings {
  RootOrder angles;
  std::vector<RootMeeting> meetings;  ///< in any order of angles
  FacetCells cells;
  /// The parameters inside the window at which it is to be divided instead, ascending: then nothing else is reported.
  std::vector<exact::BigRational> parts;
};

/// Everything that may change how the facets of a window lie among each other, at every angle where its polynomial
/// vanishes: a superset. At crowded angles edge_and_facets and four_facets are left out: a CrossingSearch there has
/// them. `again` is called now and then and may throw.
WindowMeetings meetings_in(const RotatingPair& pair, const RotationWindow& window, SolidRotationWork& work,
                           const std::function<void()>& again);

}  // namespace dymsum::spatial
