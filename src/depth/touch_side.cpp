#include "depth/touch_side.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "depth/exact_frame.h"

namespace dymsum::depth {
namespace {

using exact::Big;
using Kind = SolidFeature::Kind;
using Segment = std::array<std::uint32_t, 2>;

Segment segment(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

Simplex simplex_of(const Face& face) {
  Simplex s{kNoVertex, kNoVertex, kNoVertex};
  std::copy(face.begin(), face.end(), s.begin());
  std::sort(s.begin(), s.end());
  return s;
}

/// The edges from every vertex to the next one; from the last one too, where they close.
void add_chain(const std::vector<Point>& chain, bool closes, TouchSide& side) {
  const auto first = static_cast<std::uint32_t>(side.at.size());
  const auto count = static_cast<std::uint32_t>(chain.size());
  for (std::uint32_t k = 0; k < count; ++k) {
    side.at.push_back({chain[k].x, chain[k].y, 0});
    if (!closes && k + 1 == count) continue;
    const SolidFeature edge{Kind::edge, first + k, 0};
    const Segment ends = segment(first + k, first + (k + 1) % count);
    side.simplices.push_back({ends[0], ends[1], kNoVertex});
    side.inside.push_back(edge);
    side.sides.emplace(ends, edge);
  }
}

}  // namespace

void TouchSide::turn(const Rotation& rotation) { matrix = rotation.matrix(), den = rotation.norm(); }

SolidFeature TouchSide::feature(const Simplex& side, std::uint32_t of) const {
  if (side[1] == kNoVertex) return {Kind::vertex, side[0], 0};
  if (side == simplices[of]) return inside[of];
  const auto found = sides.find({side[0], side[1]});
  return found != sides.end() ? found->second : SolidFeature{Kind::edge, side[0], side[1]};
}

BigVector TouchSide::exact(std::uint32_t vertex, int exponent) const {
  const Point3& v = at[vertex];
  const BigVector x{in_units(v.x, exponent), in_units(v.y, exponent), in_units(v.z, exponent)};
  if (den == 1 && matrix == TouchSide().matrix) return x;
  const auto row = [&](std::size_t k) {
    return Big::from_int64(matrix[k]) * x.x + Big::from_int64(matrix[k + 1]) * x.y +
           Big::from_int64(matrix[k + 2]) * x.z;
  };
  return {row(0), row(3), row(6)};
}

spatial::Vec3 TouchSide::approx(std::uint32_t vertex, int scale) const {
  const Point3& v = at[vertex];
  const spatial::Vec3 x{std::ldexp(v.x, -scale), std::ldexp(v.y, -scale), std::ldexp(v.z, -scale)};
  const double s = 1 / static_cast<double>(den);
  const auto row = [&](std::size_t k) {
    return s * static_cast<double>(matrix[k]) * x.x + s * static_cast<double>(matrix[k + 1]) * x.y +
           s * static_cast<double>(matrix[k + 2]) * x.z;
  };
  return {row(0), row(3), row(6)};
}

TouchSide touch_side(const Mesh& mesh) {
  TouchSide side;
  side.at = mesh.vertices();
  std::set<Segment> edges;
  for (const Face& face : mesh.faces())
    for (std::size_t k = 0; face.size() > 2 && k < face.size(); ++k)
      edges.insert(segment(face[k], face[(k + 1) % face.size()]));
  const TriangulatedMesh cut = triangulated(mesh);
  for (std::size_t t = 0; t < cut.face.size(); ++t) {
    const Face& corners = cut.mesh.faces()[t];
    const Simplex s = simplex_of(corners);
    const SolidFeature face{Kind::face, cut.face[t], 0};
    side.simplices.push_back(s);
    side.inside.push_back(corners.size() == 1   ? SolidFeature{Kind::vertex, s[0], 0}
                          : corners.size() == 2 ? SolidFeature{Kind::edge, s[0], s[1]}
                                                : face);
    for (std::size_t k = 0; corners.size() > 2 && k < 3; ++k)
      if (const Segment ends = segment(corners[k], corners[(k + 1) % 3]); edges.count(ends) == 0)
        side.sides.emplace(ends, face);
  }
  return side;
}

TouchSide touch_side(const Region& region) {
  TouchSide side;
  for (const Part& part : region.parts()) {
    add_chain(part.outer, true, side);
    for (const Ring& hole : part.holes) add_chain(hole, true, side);
  }
  for (const Polyline& line : region.polylines()) add_chain(line, false, side);
  for (const Point& point : region.points()) {
    const auto v = static_cast<std::uint32_t>(side.at.size());
    side.at.push_back({point.x, point.y, 0});
    side.simplices.push_back({v, kNoVertex, kNoVertex});
    side.inside.push_back({Kind::vertex, v, 0});
  }
  return side;
}

}  // namespace dymsum::depth
