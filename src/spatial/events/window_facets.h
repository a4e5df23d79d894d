// The facets of the convolution that exist at some angle of a window, and what each of them hangs on.
#pragma once

#include <vector>

#include "spatial/convolution/facet_rule.h"
#include "spatial/events/facet_graph.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/motion/rotation_forms.h"

namespace dymsum::spatial {

/// sense (n . d) <= 0 for the normal n of a triangle of one operand and a way d of the other one.
struct SlantCondition {
  std::int8_t op = 0, sense = 1;
  std::uint32_t triangle = 0;
  DirectionSource direction;
};

struct WindowFacet {
  SumFacet facet;
  PlaneSource plane;
  std::vector<SlantCondition> unsure;  ///< hold at some angles of the window perhaps; others do at all
  Box box;                             ///< of the facet at all angles, in units

  SumEdge facet_edge(int k) const { return facet_edge_of(facet, k); }
  bool has_corner(SumPoint v) const { return spatial::has_corner(facet, v); }
};

/// The Gauss maps of two operands without thin parts: their edges' directions and normals, as unit vectors.
class GaussMaps {
 public:
  explicit GaussMaps(const RotatingPair& pair);
  /// All facets whose closed conditions hold at some angle within `half` of `midpoint`, and perhaps some more.
  std::vector<WindowFacet> facets(double midpoint, double half) const;

 private:
  struct Side {
    std::vector<Vec3> normals, edges, rays;
    std::vector<std::uint32_t> convex;  // wedges
  };
  void add_face_vertex(int op, const JetFrame& frame, double margin, std::vector<WindowFacet>& facets) const;
  void add_edge_edge(const JetFrame& frame, double margin, std::vector<WindowFacet>& facets) const;
  Vec3 turned(int op, const Mat3& m, Vec3 v) const { return op == pair_.turning ? m * v : v; }

  const RotatingPair& pair_;
  std::array<Side, 2> sides_;
};

}  // namespace dymsum::spatial
