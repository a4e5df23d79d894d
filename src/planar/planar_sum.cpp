// The questions a sum answers after it has been computed.
#include "dymsum/planar_sum.h"

#include <algorithm>
#include <stdexcept>

#include "planar/exact_area.h"
#include "planar/exact_source.h"
#include "planar/rounding.h"
#include "planar/vertex_order.h"

namespace dymsum {

namespace {

using planar::Position;

planar::ExactArea area_of(const PlanarSum& sum) {
  std::vector<std::vector<Position>> rings;
  const auto add = [&](const SumRing& ring) {
    std::vector<Position>& to = rings.emplace_back();
    for (const SumVertex& v : ring.vertices) to.push_back(sum.source->position(v));
  };
  if (!sum.parts.empty() && !sum.source) throw std::logic_error("PlanarSum: vertices without exact positions");
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return planar::exact_area(rings);
}

/// Compares vertices of two sums by their exact positions; those of one source and one provenance without asking it.
class SameVertices {
 public:
  SameVertices(const PlanarSum& a, const PlanarSum& b) : a_(a.source.get()), b_(b.source.get()) {}

  bool operator()(const SumVertex& a, const SumVertex& b) const {
    if (a_ == b_ && planar::same_place(a, b)) return true;
    if (a_ == nullptr || b_ == nullptr) throw std::logic_error("PlanarSum: vertices without exact positions");
    const Position p = a_->position(a), q = b_->position(b);
    return planar::compare(p, q) == 0;
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

Rational PlanarSum::area_exact() const { return area_of(*this).to_rational(); }

double PlanarSum::area() const { return area_of(*this).to_double(); }

RationalPoint PlanarSum::exact(const SumVertex& vertex) const {
  if (!source) throw std::logic_error("PlanarSum: vertices without exact positions");
  const Position p = source->position(vertex);
  return {exact::to_rational(p.x), exact::to_rational(p.y)};
}

Result<Region> PlanarSum::rounded() const { return planar::rounded(*this); }

Result<Repaired> PlanarSum::rounded_with_repair() const { return planar::rounded_with_repair(*this); }

bool operator==(const PlanarSum& a, const PlanarSum& b) {
  const SameVertices same(a, b);
  return same_sizes(a, b) && same(a.parts, b.parts) && same(a.segments, b.segments) && same(a.points, b.points) &&
         same(a.tight_segments, b.tight_segments) && same(a.tight_points, b.tight_points);
}

}  // namespace dymsum
