#include "spatial/boundary/thin_crossings.h"

#include <array>

namespace dymsum::spatial {

namespace {

/// Two directions in a plate.
std::array<DirectionSource, 2> directions_in(DirectionSource::Of of, const SolidOperand& solid,
                                             std::uint32_t triangle) {
  const Triangle& t = solid.triangles[triangle];
  return {DirectionSource{of, t[0], t[1]}, DirectionSource{of, t[0], t[2]}};
}

/// Plates of the first operand and segments of the second one.
std::optional<std::array<std::uint32_t, 2>> plate_and_segment(const SumSpace& space, DirectionSource::Of of,
                                                              const SolidOperand& plates,
                                                              const SolidOperand& segments) {
  const DirectionSource::Of other = of == DirectionSource::Of::p ? DirectionSource::Of::q : DirectionSource::Of::p;
  for (std::uint32_t t = plates.first_plate; t < plates.triangles.size(); t += 2) {
    const auto [u, v] = directions_in(of, plates, t);
    for (std::size_t k = 0; k < segments.segments.size(); ++k) {
      const Wedge& w = segments.wedges[segments.segments[k]];
      if (space.det(u, v, {other, w.from, w.to}) != 0) return std::array{plates.face[t], segments.segment_face[k]};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<ThinCrossing> find_thin_crossing(const SumSpace& space, const SolidOperand& p, const SolidOperand& q) {
  if (const auto found = plate_and_segment(space, DirectionSource::Of::p, p, q))
    return ThinCrossing{(*found)[0], (*found)[1]};
  if (const auto found = plate_and_segment(space, DirectionSource::Of::q, q, p))
    return ThinCrossing{(*found)[1], (*found)[0]};
  const auto p_count = static_cast<std::uint32_t>(p.triangles.size()),
             q_count = static_cast<std::uint32_t>(q.triangles.size());
  if (p.first_plate == p_count || q.first_plate == q_count) return std::nullopt;
  const auto cross = [&](std::uint32_t i, std::uint32_t j) {
    const auto [u, v] = directions_in(DirectionSource::Of::p, p, i);
    for (const DirectionSource w : directions_in(DirectionSource::Of::q, q, j))
      if (space.det(u, v, w) != 0) return true;
    return false;
  };
  // All are parallel if all of each are parallel to the first one of the other.
  for (std::uint32_t i = p.first_plate; i < p_count; i += 2)
    if (cross(i, q.first_plate)) return ThinCrossing{p.face[i], q.face[q.first_plate]};
  for (std::uint32_t j = q.first_plate; j < q_count; j += 2)
    if (cross(p.first_plate, j)) return ThinCrossing{p.face[p.first_plate], q.face[j]};
  return std::nullopt;
}

}  // namespace dymsum::spatial
