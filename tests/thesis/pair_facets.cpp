#include "thesis/pair_facets.h"

#include "exact/int.h"

namespace dymsum::spatial {

namespace {

/// Coordinates below 2^29: differences take 30 bits, a normal's component 2 * 30 + 1 and a sign, its product with
/// another difference 91, three of them 93.
constexpr double kSmallCoordinate = 0x1p29;
static_assert(2 + (2 * 30 + 1) + 30 <= 127);

template <class V>
std::array<std::int64_t, 3> difference(const V& a, const V& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

}  // namespace

PairFacets::PairFacets(ScalingPair of, StageWatch& watch) : MovingFacets(std::move(of), watch) {
  small_ = std::max(reach(0), reach(1)) < kSmallCoordinate;
  if (!small_) return;
  const auto narrow = [](const BigVector& v) {
    return SmallVector{v[0].convert_to<std::int64_t>(), v[1].convert_to<std::int64_t>(),
                       v[2].convert_to<std::int64_t>()};
  };
  for (int op = 0; op < 2; ++op)
    for (const BigVector& v : exact_positions(op)) integers_[static_cast<std::size_t>(op)].push_back(narrow(v));
  for (std::uint32_t f = 0; f < facets().size(); ++f) small_normals_.push_back(narrow(plane(f).n));
}

ProvedForm PairFacets::form_of(const SmallVector& n, SumPoint from, SumPoint to) const {
  const auto product = [&](int op, std::uint32_t a, std::uint32_t b) {
    const std::vector<SmallVector>& of = integers_[static_cast<std::size_t>(op)];
    const SmallVector d = difference(of[b], of[a]);
    exact::i128 sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += static_cast<exact::i128>(n[k]) * d[k];
    return static_cast<double>(sum);
  };
  const double of_p = product(0, from.p, to.p), of_q = product(1, from.q, to.q);
  return moving() == 0 ? ProvedForm{of_q, of_p} : ProvedForm{of_p, of_q};
}

std::optional<ProvedForm> PairFacets::proved_height(SumPoint corner, std::uint32_t facet) const {
  if (!small_) return std::nullopt;
  return form_of(small_normals_[facet], facets()[facet].corner[0], corner);
}

std::optional<ProvedForm> PairFacets::proved_twist(const SumEdge& e, const SumEdge& h) const {
  if (!small_) return std::nullopt;
  const auto along = [&](const SumEdge& facet_edge) {
    const DirectionSource d = direction_of(facet_edge);
    const std::vector<SmallVector>& of = integers_[d.of == DirectionSource::Of::p ? 0 : 1];
    return difference(of[d.to], of[d.from]);
  };
  const SmallVector u = along(e), v = along(h);
  const SmallVector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  return form_of(n, e.from, h.from);
}

}  // namespace dymsum::spatial
