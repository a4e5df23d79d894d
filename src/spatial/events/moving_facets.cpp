#include "spatial/events/moving_facets.h"

#include <map>
#include <unordered_map>

namespace dymsum::spatial {

using exact::BigInteger;

namespace {

/// Names lists of integers that are multiples of each other alike.
template <std::size_t N>
class ProportionalNames {
 public:
  std::uint32_t name(std::array<BigInteger, N> values) {
    BigInteger divisor = 0;
    for (const BigInteger& v : values) divisor = gcd(divisor, v);
    for (const BigInteger& v : values)
      if (v != 0) {
        if (v < 0) divisor = -divisor;
        break;
      }
    if (divisor != 0)
      for (BigInteger& v : values) v /= divisor;
    return names_.try_emplace(std::move(values), static_cast<std::uint32_t>(names_.size())).first->second;
  }

 private:
  std::map<std::array<BigInteger, N>, std::uint32_t> names_;
};

std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

/// What every edge of a solid is: 1 where it is one of solid parts between two triangles in one plane, at which nothing
/// else meets.
std::unordered_map<std::uint64_t, int> inner_edges_of(const SolidOperand& solid) {
  std::unordered_map<std::uint64_t, int> wedges;
  for (const Wedge& w : solid.wedges) wedges[pair_key(w.from, w.to)] += w.bend == Wedge::Bend::flat ? 1 : 2;
  return wedges;
}

}  // namespace

MovingFacets::MovingFacets(ScalingPair of, StageWatch& watch) : ScalingPair(std::move(of)) {
  const PosedSpace space = posed_space(pair(), {});
  convolution_ = reduced_convolution(*space.space, pair().p, pair().q, watch);
  graph_ = FacetGraph(facets());
  for (const PlaneSource& source : convolution_.planes) planes_.push_back(plane(source));
  ProportionalNames<3> directions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known[2];  // by the ends of an operand's edge
  const std::unordered_map<std::uint64_t, int> edges[2] = {inner_edges_of(pair().p), inner_edges_of(pair().q)};
  for (std::uint32_t b = 0; b < facet_edges().size(); ++b) {
    const DirectionSource direction = direction_of(facet_edges()[b]);
    const std::size_t op = direction.of == DirectionSource::Of::p ? 0 : 1;
    const auto [at, fresh] = known[op].try_emplace({direction.from, direction.to}, 0);
    if (fresh) at->second = directions.name(along(direction));
    directions_.push_back(at->second);
    const auto found = edges[op].find(pair_key(direction.from, direction.to));
    inner_.push_back(facet_edges().around(b).size() == 2 && found != edges[op].end() && found->second == 1);
    add_planes_along(facet_edges()[b]);
  }
  ProportionalNames<5> names;
  for (const MovingPlane& p : planes_) {
    names_.push_back(names.name({p.n[0], p.n[1], p.n[2], p.d0, p.d1}));
    rows_.push_back(row_of(p));
  }
}

void MovingFacets::add_planes_along(const SumEdge& facet_edge) {
  const BigVector direction = along(direction_of(facet_edge));
  std::size_t most = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (abs(direction[k]) > abs(direction[most])) most = k;
  for (std::size_t k = 0; k < 2; ++k) {
    BigVector axis{0, 0, 0};
    axis[(most + 1 + k) % 3] = 1;
    const BigVector n = cross(direction, axis);
    planes_.push_back({n, dot(n, exact_fixed(facet_edge.from)), dot(n, exact_moved(facet_edge.from))});
  }
}

}  // namespace dymsum::spatial
