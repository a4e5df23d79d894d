// Whether a position lies in the sum of two solids, by definition.
#include <cmath>
#include <stdexcept>

#include "dymsum/spatial_sum.h"
#include "spatial/boundary/collision.h"

namespace dymsum {

Result<bool> contains(const Mesh& p, const Mesh& q, const Point3& z, Semantics semantics) {
  using namespace spatial;
  if (p.empty() || q.empty() || !std::isfinite(z.x) || !std::isfinite(z.y) || !std::isfinite(z.z)) return false;
  if (p.has_thin_parts() && q.has_thin_parts())
    return Error{ErrorCode::unsupported_operand, "both operands have parts without volume", {}};
  // z is the sum of one more vertex of each, of which no triangle knows.
  std::vector<Point3> p_points = p.vertices(), q_points = q.vertices();
  const SumPoint at{static_cast<std::uint32_t>(p_points.size()), static_cast<std::uint32_t>(q_points.size())};
  p_points.push_back(z);
  q_points.push_back({0, 0, 0});
  const SolidOperand a = solid_operand(p.data(), p.thin_faces(), FlatFeatures::kept),
                     b = solid_operand(q.data(), q.thin_faces(), FlatFeatures::kept);
  try {
    const std::unique_ptr<SumSpace> space = make_sum_space(p_points, q_points);
    const Collision collision(*space, a, b);
    const Flag flag{{PointSource::Kind::sum, at.p, at.q, 0}, 0, 0, 0, 0, 0};
    return semantics == Semantics::open ? collision.overlaps(flag) : collision.touches(flag);
  } catch (const std::invalid_argument& e) {
    return Error{ErrorCode::unsupported_operand, e.what(), {}};
  }
}

}  // namespace dymsum
