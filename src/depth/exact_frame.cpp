#include "depth/exact_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace dymsum::depth {

using exact::BigInteger;
using exact::cross;
using exact::dot;
using spatial::SumFacet;
using spatial::SumPoint;

namespace {

int lowest_exponent(const Point3& v, int least) {
  for (const double c : {v.x, v.y, v.z})
    if (c != 0) least = std::min(least, exact::to_dyadic(c).exponent);
  return least;
}

bool is_zero(const BigVector& v) { return exact::leading_sign(v) == 0; }

ExactPosition whole(BigVector x) { return {std::move(x), Big::from_int64(1)}; }

/// The position nearest to the origin of the segment from a to b.
ExactPosition nearest_of_segment(const BigVector& a, const BigVector& b) {
  const BigVector d = b - a;
  const Big t = -dot(a, d), size = dot(d, d);
  if (sign(t) <= 0) return whole(a);
  if (t >= size) return whole(b);
  return {times(size, a) + times(t, d), size};
}

}  // namespace

Big in_units(double v, int exponent) {
  const exact::Dyadic d = exact::to_dyadic(v);
  if (d.mantissa == 0) return Big::from_int64(0);
  return Big(BigInteger(BigInteger(d.mantissa) << static_cast<unsigned>(d.exponent - exponent)));
}

BigVector times(const Big& s, const BigVector& v) { return {s * v.x, s * v.y, s * v.z}; }

int common_exponent(const std::vector<Point3>& p, const std::vector<Point3>& q) {
  constexpr int kNone = std::numeric_limits<int>::max();
  int least = kNone;
  for (const Point3& v : p) least = lowest_exponent(v, least);
  for (const Point3& v : q) least = lowest_exponent(v, least);
  return least == kNone ? 0 : least;
}

ExactFrame::ExactFrame(const std::vector<Point3>& p, const std::vector<Point3>& q, int exponent,
                       std::array<BigRational, 3> origin)
    : p_(p), q_(q), at_(std::move(origin)), exponent_(exponent) {
  for (const BigRational& c : at_) {
    if (c == 0) continue;
    const BigInteger below = denominator(c);
    const auto halvings = static_cast<int>(lsb(below));
    parts_ = lcm(parts_, BigInteger(below >> static_cast<unsigned>(halvings)));
    exponent_ = std::min(exponent_, static_cast<int>(lsb(abs(numerator(c)))) - halvings);
  }
  origin_ = position(at_).x;
}

BigVector ExactFrame::vertex(const Point3& v) const {
  const BigVector whole{in_units(v.x, exponent_), in_units(v.y, exponent_), in_units(v.z, exponent_)};
  return parts_ == 1 ? whole : times(Big(parts_), whole);
}

BigVector ExactFrame::corner(SumPoint s) const { return vertex(p_[s.p]) + vertex(q_[s.q]) - origin_; }

ExactPlane ExactFrame::plane(const SumFacet& facet) const {
  const BigVector a = corner(facet.corner[0]), b = corner(facet.corner[1]), c = corner(facet.corner[2]);
  const BigVector n = cross(b - a, c - a);
  return {n, dot(n, a)};
}

ExactPlane ExactFrame::facet_edge(const SumFacet& facet, int k, const ExactPlane& plane) const {
  const BigVector a = corner(facet.corner[static_cast<std::size_t>(k)]),
                  b = corner(facet.corner[static_cast<std::size_t>((k + 1) % facet.corners)]);
  const BigVector n = cross(plane.n, b - a);
  return {n, dot(n, a)};
}

ExactPosition ExactFrame::foot(const ExactPlane& a) { return {times(a.d, a.n), dot(a.n, a.n)}; }

std::optional<ExactPosition> ExactFrame::foot(const ExactPlane& a, const ExactPlane& b) {
  const BigVector along = cross(a.n, b.n);
  if (is_zero(along)) return std::nullopt;
  return meet(a, b, {along, Big::from_int64(0)});
}

std::optional<ExactPosition> ExactFrame::meet(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c) {
  const BigVector bc = cross(b.n, c.n), ca = cross(c.n, a.n), ab = cross(a.n, b.n);
  const Big w = dot(a.n, bc);
  if (sign(w) == 0) return std::nullopt;
  const BigVector x = times(a.d, bc) + times(b.d, ca) + times(c.d, ab);
  if (sign(w) < 0) return ExactPosition{{-x.x, -x.y, -x.z}, -w};
  return ExactPosition{x, w};
}

int ExactFrame::side(const ExactPlane& plane, const ExactPosition& x) {
  return sign(dot(plane.n, x.x) - plane.d * x.w);
}

ExactPosition ExactFrame::nearest(const SumFacet& facet) const {
  const ExactPlane own = plane(facet);
  ExactPosition best = foot(own);
  if (within_facet_edges(facet, own, best)) return best;
  for (int k = 0; k < facet.corners; ++k) {
    ExactPosition x = nearest_of_segment(corner(facet.corner[static_cast<std::size_t>(k)]),
                                         corner(facet.corner[static_cast<std::size_t>((k + 1) % facet.corners)]));
    if (k == 0 || compare_lengths(x, best) < 0) best = std::move(x);
  }
  return best;
}

bool ExactFrame::holds(const SumFacet& facet, const ExactPosition& x) const {
  const ExactPlane own = plane(facet);
  return side(own, x) == 0 && within_facet_edges(facet, own, x);
}

bool ExactFrame::within_facet_edges(const SumFacet& facet, const ExactPlane& plane, const ExactPosition& x) const {
  for (int k = 0; k < facet.corners; ++k)
    if (side(facet_edge(facet, k, plane), x) < 0) return false;
  return true;
}

BigRational ExactFrame::in_operand_units(const BigRational& v) const {
  const BigInteger power = BigInteger(1) << static_cast<unsigned>(std::abs(exponent_));
  return exponent_ < 0 ? BigRational(v / BigInteger(power * parts_)) : BigRational(v * power / parts_);
}

std::array<BigRational, 3> ExactFrame::relative(const ExactPosition& x) const {
  const auto coordinate = [&](const Big& c) { return in_operand_units(exact::ratio(c, x.w)); };
  return {coordinate(x.x.x), coordinate(x.x.y), coordinate(x.x.z)};
}

ExactPosition ExactFrame::position(const std::array<BigRational, 3>& relative) const {
  const BigInteger power = BigInteger(1) << static_cast<unsigned>(std::abs(exponent_));
  std::array<BigRational, 3> v = relative;
  BigInteger all = 1;
  for (BigRational& c : v) {
    if (exponent_ < 0) c *= BigInteger(power * parts_);
    else c = BigRational(c * parts_ / power);
    all = lcm(all, denominator(c));
  }
  const auto whole = [&](const BigRational& c) { return Big(BigInteger(numerator(c) * (all / denominator(c)))); };
  return {{whole(v[0]), whole(v[1]), whole(v[2])}, Big(all)};
}

std::array<BigRational, 3> ExactFrame::absolute(const ExactPosition& x) const {
  std::array<BigRational, 3> at = relative(x);
  for (std::size_t k = 0; k < 3; ++k) at[k] += at_[k];
  return at;
}

int compare_lengths(const ExactPosition& a, const ExactPosition& b) {
  const Big left = dot(a.x, a.x) * (b.w * b.w), right = dot(b.x, b.x) * (a.w * a.w);
  return left < right ? -1 : right < left ? 1 : 0;
}

bool same_position(const ExactPosition& a, const ExactPosition& b) {
  return a.x.x * b.w == b.x.x * a.w && a.x.y * b.w == b.x.y * a.w && a.x.z * b.w == b.x.z * a.w;
}

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
