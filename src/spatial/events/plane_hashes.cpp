#include "spatial/events/plane_hashes.h"

namespace dymsum::spatial {

using exact::Residue;

namespace {

Residue value_of(const exact::RootValue& v) {
  constexpr Residue kT = 0x1d3a5b7c9e8f6421ULL % exact::kResiduePrime;
  Residue value = 0;
  for (std::size_t k = v.terms().size(); k-- > 0;)
    value = exact::plus(exact::times(value, kT), exact::residue(exact::Big(v.terms()[k])));
  return value;
}

}  // namespace

std::uint64_t PlaneHashes::of(const PolynomialFrame::Vector& n, SumPoint at) const {
  // From the sum of the vertices 0 on, all places are vectors times one weight.
  const PolynomialFrame::Vector way = frame_.way(0, 0, at.p) + frame_.way(1, 0, at.q);
  const Residue x[3] = {value_of(way.x), value_of(way.y), value_of(way.z)};
  Residue v[4] = {value_of(n.x), value_of(n.y), value_of(n.z), 0};
  for (int k = 0; k < 3; ++k) v[3] = exact::plus(v[3], exact::times(v[k], x[k]));
  Residue lead = 0;
  for (int k = 0; k < 3 && lead == 0; ++k) lead = v[k];
  if (lead == 0) return 1;
  const Residue by = exact::inverse(lead);
  std::uint64_t hash = 0;
  for (const Residue r : v) hash = joined_hashes(hash, exact::times(r, by));
  return hash;
}

}  // namespace dymsum::spatial
