#include "planar/result/planar_sum.h"

#include <algorithm>
#include <stdexcept>

#include "dymsum/area_text.h"
#include "dymsum/planar_sum.h"
#include "exact/rational_text.h"
#include "planar/position/area.h"
#include "planar/position/exact_source.h"
#include "planar/result/rounding.h"

namespace dymsum {

// The questions a sum answers after it has been computed.

namespace {

/// Both coordinates, crosswise: no greatest common divisor is needed to compare.
bool equal(const ExactSource::Homogeneous& p, const ExactSource::Homogeneous& q) {
  if (p.w == q.w) return p.x == q.x && p.y == q.y;
  return p.x * q.w == q.x * p.w && p.y * q.w == q.y * p.w;
}

/// n / w, w > 0. Most denominators are powers of two, which need no greatest common divisor.
Rational lowest_terms(exact::BigInteger n, exact::BigInteger w) {
  if (n.is_zero()) return {};
  const auto twos = std::min(lsb(exact::BigInteger(abs(n))), lsb(w));
  n >>= twos;
  w >>= twos;
  if (msb(w) != lsb(w)) {
    const exact::BigInteger common = gcd(n, w);
    n /= common;
    w /= common;
  }
  return exact::to_rational(std::move(n), std::move(w));
}

/// Compares vertices of two sums by their exact positions; those of one source and one provenance without asking it.
class SameVertices {
 public:
  SameVertices(const PlanarSum& a, const PlanarSum& b) : a_(exact_source(a).get()), b_(exact_source(b).get()) {}

  bool operator()(const SumVertex& a, const SumVertex& b) const {
    if (a_ == b_ && planar::same_position(a, b)) return true;
    if (a_ == nullptr || b_ == nullptr) throw std::logic_error("PlanarSum: vertices without exact positions");
    return equal(a_->homogeneous(a), b_->homogeneous(b));
  }
  bool operator()(const SumSegment& a, const SumSegment& b) const {
    return (*this)(a.from, b.from) && (*this)(a.to, b.to);
  }
  bool operator()(const SumRing& a, const SumRing& b) const { return (*this)(a.vertices, b.vertices); }
  bool operator()(const SumPart& a, const SumPart& b) const {
    return (*this)(a.outer, b.outer) && (*this)(a.holes, b.holes);
  }

  template <class T>
  bool operator()(const std::vector<T>& a, const std::vector<T>& b) const {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), *this);
  }

 private:
  const ExactSource* a_;
  const ExactSource* b_;
};

/// The numbers of holes and vertices of every part agree: checked before any position is computed.
bool same_sizes(const PlanarSum& a, const PlanarSum& b) {
  const auto ring = [](const SumRing& r, const SumRing& s) { return r.vertices.size() == s.vertices.size(); };
  const auto part = [&](const SumPart& p, const SumPart& q) {
    return ring(p.outer, q.outer) && std::equal(p.holes.begin(), p.holes.end(), q.holes.begin(), q.holes.end(), ring);
  };
  return a.segments.size() == b.segments.size() && a.points.size() == b.points.size() &&
         a.tight_segments.size() == b.tight_segments.size() && a.tight_points.size() == b.tight_points.size() &&
         std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(), part);
}

}  // namespace

std::size_t PlanarSum::hole_count() const {
  std::size_t count = 0;
  for (const SumPart& part : parts) count += part.holes.size();
  return count;
}

std::size_t PlanarSum::vertex_count() const {
  std::size_t count = 0;
  for (const SumPart& part : parts) {
    count += part.outer.vertices.size();
    for (const SumRing& hole : part.holes) count += hole.vertices.size();
  }
  return count;
}

Rational PlanarSum::area_exact() const { return planar::area_fraction(*this); }

std::optional<Rational> PlanarSum::area_exact_within(std::size_t bits) const {
  return planar::area_within(*this, bits);
}

double PlanarSum::area() const { return planar::nearest_area(*this); }

RationalPoint PlanarSum::exact(const SumVertex& vertex) const {
  if (!source_) throw std::logic_error("PlanarSum: vertices without exact positions");
  const ExactSource::Homogeneous p = source_->homogeneous(vertex);
  return {lowest_terms(p.x, p.w), lowest_terms(p.y, p.w)};
}

Result<Region> PlanarSum::rounded() const { return planar::rounded(*this); }

Result<SnapRounded> snap_rounded(const PlanarSum& sum) { return planar::snap_rounded(sum); }

Result<Repaired> PlanarSum::rounded_with_repair() const { return planar::rounded_with_repair(*this); }

bool operator==(const PlanarSum& a, const PlanarSum& b) {
  const SameVertices same(a, b);
  return same_sizes(a, b) && same(a.parts, b.parts) && same(a.segments, b.segments) && same(a.points, b.points) &&
         same(a.tight_segments, b.tight_segments) && same(a.tight_points, b.tight_points);
}

namespace {

constexpr int kDigits = 17;  // enough to distinguish any two doubles

}  // namespace

std::string area_text(const PlanarSum& sum) {
  std::string text;
  planar::narrow_area(sum, [&](const planar::AreaRange& range) {
    text = exact::decimal_text(range.first, kDigits);
    return exact::decimal_text(range.second, kDigits) == text;
  });
  return text;
}

std::string area_text(const Region& region) {
  std::vector<std::vector<planar::Position>> rings;
  const auto add = [&](const Ring& ring) {
    std::vector<planar::Position>& to = rings.emplace_back();
    for (const Point p : ring) to.push_back({exact::exact_value(p.x), exact::exact_value(p.y)});
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  const planar::ExactArea area = planar::exact_area(rings);
  return exact::decimal_text(exact::BigRational(area.numerator, area.denominator), kDigits);
}

}  // namespace dymsum
