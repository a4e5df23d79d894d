// Planes that turn, by hashes: equal for planes that are one at every angle.
#pragma once

#include "exact/residue.h"
#include "spatial/motion/rotation_forms.h"

namespace dymsum::spatial {

constexpr std::uint64_t mixed_bits(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15ULL;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ULL;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebULL;
  return v ^ (v >> 31);
}
constexpr std::uint64_t joined_hashes(std::uint64_t a, std::uint64_t b) { return mixed_bits(a ^ mixed_bits(b)); }

/// Of a plane's equation at one t modulo the prime 2^61 - 1, up to a factor.
class PlaneHashes {
 public:
  PlaneHashes(const RotatingPair& pair, int chart) : pair_(pair), frame_(pair, chart) {}
  std::uint64_t of(const PolynomialFrame::Vector& normal, SumPoint at) const;
  std::uint64_t of(const RotationSigns<PolynomialFrame>& signs, const PlaneSource& plane) const {
    return of(signs.normal(plane), plane.at);
  }

 private:
  const RotatingPair& pair_;
  PolynomialFrame frame_;
};

}  // namespace dymsum::spatial
