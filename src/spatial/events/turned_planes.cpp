#include "spatial/events/turned_planes.h"

#include <algorithm>

namespace dymsum::spatial {

std::uint32_t TurnedPlanes::triangle_of(int op, std::uint32_t face) const {
  const std::vector<std::uint32_t>& faces = pair_.operand(op).face;
  return static_cast<std::uint32_t>(std::find(faces.begin(), faces.end(), face) - faces.begin());
}

std::uint32_t TurnedPlanes::vertex_of(int op, const SolidFeature& f) const {
  return f.kind == SolidFeature::Kind::face ? pair_.operand(op).triangles[triangle_of(op, f.a)][0] : f.a;
}

PolynomialFrame::Vector TurnedPlanes::normal(const SolidContact& c) const {
  for (int op = 0; op < 2; ++op) {
    const SolidFeature& f = op == 0 ? c.p : c.q;
    if (f.kind != SolidFeature::Kind::face) continue;
    const Triangle& t = pair_.operand(op).triangles[triangle_of(op, f.a)];
    return frame_.normal(op, t[0], t[1], t[2]);
  }
  return frame_.across(c.p.a, c.p.b, c.q.a, c.q.b);
}

}  // namespace dymsum::spatial
