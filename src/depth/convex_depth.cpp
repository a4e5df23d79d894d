// How deep a point lies in a sum: the least distance to the plane of a facet. Doubles leave few candidates, which are
// compared exactly.
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "depth/exact_facet_distances.h"
#include "depth/facet_distances.h"
#include "exact/big.h"
#include "spatial/convex/assemble.h"
#include "spatial/convex/convex_state.h"
#include "spatial/convex/facet_corners.h"
#include "spatial/convex/posed_doubles.h"
#include "spatial/mesh/rounded_vector.h"

namespace dymsum {
namespace {

using spatial::GenericFacet;
using spatial::Vec3;

bool is_finite(Point3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

void name_features(const spatial::ConvexState& s, const GenericFacet& facet, ConvexDepth& depth) {
  const spatial::Overlay& o = s.overlay;
  if (facet.op == 2) {
    const spatial::Crossing& c = o.crossing(facet.id);
    depth.p = spatial::edge_feature(*s.p, s.p->origin[2 * c.p], s.p->target(2 * c.p));
    depth.q = spatial::edge_feature(*s.q, s.q->origin[c.q], s.q->target(c.q));
    return;
  }
  std::vector<spatial::VertexPair> corners;
  const spatial::FacetFeatures features = spatial::append_face(o, facet.op, facet.id, corners);
  depth.p = features.p;
  depth.q = features.q;
}

/// Edges whose arcs do not truly cross span a part of a facet that a face makes, which is as near.
bool is_part_of_another(const spatial::Overlay& o, const GenericFacet& facet) {
  return facet.op == 2 && !spatial::crosses_properly(o, o.crossing(facet.id));
}

}  // namespace

namespace spatial {

std::pair<std::uint32_t, std::uint32_t> corner_of(const Overlay& o, int op, std::uint32_t id) {
  if (op == 2) return {o.poly(0).origin[2 * o.crossing(id).p], o.poly(1).origin[o.crossing(id).q]};
  const std::uint32_t mine = o.poly(op).origin[o.poly(op).first[id]], other = o.extreme(op, id);
  return op == 0 ? std::pair{mine, other} : std::pair{other, mine};
}

}  // namespace spatial

ConvexDepth ConvexSum::depth(Point3 point) const {
  if (!is_finite(point)) throw std::invalid_argument("ConvexSum::depth: the point is not finite");
  const spatial::ExactFacetDistances exact_distances(*state_, point);
  spatial::FacetDistances distances(state_->overlay, spatial::PosedDoubles(state_->p_factors),
                                    spatial::PosedDoubles(state_->q_factors), exact_distances.base());
  std::optional<spatial::SignedSquare> least;
  GenericFacet nearest;
  for (const GenericFacet& facet : distances.candidates()) {
    std::optional<spatial::SignedSquare> d = exact_distances.signed_square(facet);
    if (!d || (least && !(*d < *least)) || is_part_of_another(state_->overlay, facet)) continue;
    least = std::move(d);
    nearest = facet;
  }
  ConvexDepth result;
  result.inside = sign(least->num) > 0;
  if (result.inside) {
    const exact::BigRational square = exact_distances.value(*least);
    result.depth_squared = exact::to_rational(square);
    result.depth = exact::root_to_double(square);
  }
  const Vec3 n = spatial::unit(exact_distances.normal(nearest));
  result.direction = {n.x, n.y, n.z};
  name_features(*state_, nearest, result);
  return result;
}

Result<ConvexDepth> penetration_depth(const Mesh& p, const Mesh& q, const SolidPose& p_pose, const SolidPose& q_pose,
                                      Point3 q_moved_by) {
  if (!is_finite(q_moved_by)) return Error{ErrorCode::not_finite, "the translation is not finite", {}};
  Result<ConvexSum> sum = ConvexSum::create(p, negated(q));
  if (!sum) return sum.error();
  ConvexSum difference = std::move(sum).value();
  difference.set(p_pose, q_pose);
  return difference.depth(q_moved_by);
}

}  // namespace dymsum
