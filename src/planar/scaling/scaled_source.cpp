#include "planar/scaling/scaled_source.h"

namespace dymsum::planar {

// Sums of vertices need no lattice: (p - p') num + (q - q') den, with P and Q the other way round when Q scales.
std::optional<int> ScaledSource::compare_corners(const SumVertex& a, const SumVertex& b, int axis) const {
  const Lattice& l = *base().given;
  if (l.tier_bits == 0) return std::nullopt;
  const SharedIntegers& integers = l.unscaled_integers();
  exact::BigInteger sum = 0;
  for (std::uint32_t op = 0; op < 2; ++op) {
    const auto& source = base().operands[op].numbered_vertex;
    const std::uint32_t i = source[op == 0 ? a.corner_p : a.corner_q], j = source[op == 0 ? b.corner_p : b.corner_q];
    const exact::i128 d = integers.at[op][i][axis] - integers.at[op][j][axis];
    if (d == 0) continue;
    sum += exact::to_big(d).value() * (op != scale_.op ? scale_.den : axis == 0 ? scale_.x : scale_.y);
  }
  return sum.sign();
}

}  // namespace dymsum::planar
