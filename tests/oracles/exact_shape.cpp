#include "exact_shape.h"

#include <algorithm>

namespace dymsum::oracles {
namespace {

template <class N>
Pt<N> exact_point(const PlanarSum& sum, const SumVertex& vertex) {
  const RationalPoint at = sum.exact(vertex);
  return {from_digits<N>(at.x.numerator(), at.x.denominator()), from_digits<N>(at.y.numerator(), at.y.denominator())};
}

template <class N>
ExactRing<N> exact_ring(const PlanarSum& sum, const SumRing& ring) {
  ExactRing<N> out;
  for (const SumVertex& vertex : ring.vertices) out.push_back(exact_point<N>(sum, vertex));
  return out;
}

template <class N>
void turn_to_smallest(ExactRing<N>& ring) {
  ExactRing<N> best = ring;
  for (std::size_t i = 1; i < ring.size(); ++i) {
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
    if (ring.front() == best.front() ? ring < best : ring.front() < best.front()) best = ring;
  }
  ring = std::move(best);
}

template <class N>
void order_ends(std::vector<Seg<N>>& segments) {
  for (Seg<N>& s : segments)
    if (s.b < s.a) std::swap(s.a, s.b);
  std::sort(segments.begin(), segments.end());
}

}  // namespace

template <class N>
ExactShape<N> exact_shape(const PlanarSum& sum) {
  ExactShape<N> out;
  for (const SumPart& part : sum.parts) {
    ExactPart<N> exact{exact_ring<N>(sum, part.outer), {}};
    for (const SumRing& hole : part.holes) exact.holes.push_back(exact_ring<N>(sum, hole));
    out.parts.push_back(std::move(exact));
  }
  for (const SumSegment& s : sum.segments)
    out.segments.push_back({exact_point<N>(sum, s.from), exact_point<N>(sum, s.to)});
  for (const SumSegment& s : sum.tight_segments)
    out.tight_segments.push_back({exact_point<N>(sum, s.from), exact_point<N>(sum, s.to)});
  for (const SumVertex& v : sum.points) out.points.push_back(exact_point<N>(sum, v));
  for (const SumVertex& v : sum.tight_points) out.tight_points.push_back(exact_point<N>(sum, v));
  return out;
}

template <class N>
ExactShape<N> canonical(ExactShape<N> shape) {
  for (ExactPart<N>& part : shape.parts) {
    turn_to_smallest(part.outer);
    for (ExactRing<N>& hole : part.holes) turn_to_smallest(hole);
    std::sort(part.holes.begin(), part.holes.end());
  }
  std::sort(shape.parts.begin(), shape.parts.end());
  order_ends(shape.segments);
  order_ends(shape.tight_segments);
  std::sort(shape.points.begin(), shape.points.end());
  std::sort(shape.tight_points.begin(), shape.tight_points.end());
  return shape;
}

template <class N>
ExactShape<N> mapped(const ExactShape<N>& shape, const Affine<N>& map) {
  ExactShape<N> out = shape;
  const bool turned = map.xx * map.yy - map.xy * map.yx < N(0);
  const auto move = [&](Pt<N>& c) {
    c = {map.xx * c.x + map.xy * c.y + map.move.x, map.yx * c.x + map.yy * c.y + map.move.y};
  };
  const auto move_ring = [&](ExactRing<N>& ring) {
    for (Pt<N>& c : ring) move(c);
    if (turned) std::reverse(ring.begin(), ring.end());
  };
  for (ExactPart<N>& part : out.parts) {
    move_ring(part.outer);
    for (ExactRing<N>& hole : part.holes) move_ring(hole);
  }
  for (auto* segments : {&out.segments, &out.tight_segments})
    for (Seg<N>& s : *segments) move(s.a), move(s.b);
  for (auto* points : {&out.points, &out.tight_points})
    for (Pt<N>& c : *points) move(c);
  return canonical(std::move(out));
}

template <class N>
N doubled_area(const ExactRing<N>& ring) {
  N total(0);
  for (std::size_t i = 0; i < ring.size(); ++i) total = total + cross(ring[i], ring[(i + 1) % ring.size()]);
  return total;
}

#define DYMSUM_INSTANTIATE(N)                                               \
  template ExactShape<N> exact_shape<N>(const PlanarSum&);                  \
  template ExactShape<N> canonical<N>(ExactShape<N>);                       \
  template ExactShape<N> mapped<N>(const ExactShape<N>&, const Affine<N>&); \
  template N doubled_area<N>(const ExactRing<N>&);
DYMSUM_INSTANTIATE(Small)
DYMSUM_INSTANTIATE(Big)
#undef DYMSUM_INSTANTIATE

}  // namespace dymsum::oracles
