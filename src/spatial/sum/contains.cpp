// Whether positions lie in the sum of two solids, by definition.
#include <memory>
#include <optional>
#include <stdexcept>

#include "base/poll.h"
#include "dymsum/spatial_sum.h"
#include "exact/big.h"
#include "spatial/boundary/collision.h"
#include "spatial/boundary/thin_crossings.h"

namespace dymsum {

namespace {

using spatial::Flag;
using spatial::PointSource;

Error error_of(const char* message) { return {ErrorCode::unsupported_operand, message, {}}; }

}  // namespace

Result<std::vector<bool>> contains_each(const Mesh& p, const Mesh& q, std::span<const RationalPoint3> positions,
                                        Semantics semantics, const Progress& progress) {
  std::vector<bool> inside(positions.size());
  if (p.empty() || q.empty()) return inside;
  const spatial::SolidOperand a = spatial::solid_operand(p.data(), p.thin_faces(), spatial::FlatFeatures::kept),
                              b = spatial::solid_operand(q.data(), q.thin_faces(), spatial::FlatFeatures::kept);
  std::unique_ptr<spatial::SumSpace> space;
  try {
    space = spatial::make_sum_space(p.vertices(), q.vertices());
  } catch (const std::invalid_argument& e) {
    return error_of(e.what());
  }
  const bool open = semantics == Semantics::open;
  if (p.has_thin_parts() && q.has_thin_parts()) {
    if (semantics == Semantics::regular)
      return error_of(
          "both operands have parts without volume: what of their sum is near its interior cannot be asked");
    if (open && spatial::find_thin_crossing(*space, a, b))
      return error_of("both operands have parts without volume that can cross: they have no open sum");
  }
  const spatial::Collision collision(*space, a, b);
  for (std::size_t k = 0; k < positions.size(); ++k) {
    if (progress && !progress("positions", static_cast<double>(k) / static_cast<double>(positions.size())))
      return cancelled();
    const RationalPoint3& z = positions[k];
    const std::optional<PointSource> at =
        space->add_position({exact::exact_value(z.x), exact::exact_value(z.y), exact::exact_value(z.z)});
    if (!at) continue;
    const Flag flag{*at, 0, 0, 0, 0, 0};
    inside[k] = open ? collision.overlaps(flag) : collision.touches(flag);
  }
  return inside;
}

Result<bool> contains(const Mesh& p, const Mesh& q, const Point3& z, Semantics semantics) {
  const Result<Rational> x = Rational::of(z.x), y = Rational::of(z.y), height = Rational::of(z.z);
  if (!x || !y || !height) return false;
  const RationalPoint3 at{*x, *y, *height};
  const Result<std::vector<bool>> inside = contains_each(p, q, std::span(&at, 1), semantics);
  if (!inside) return inside.error();
  return static_cast<bool>(inside->front());
}

}  // namespace dymsum
