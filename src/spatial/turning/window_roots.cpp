#include "spatial/turning/window_roots.h"

#include <cmath>
#include <limits>

#include "exact/root_bracket.h"

namespace dymsum::spatial {

using exact::AlgebraicRoot;
using exact::Polynomial;

WindowRoots::WindowRoots(const TurnCircle& circle, const TurnRangeOfT& range, TurningSolidWork& work)
    : circle_(circle), range_(range), work_(work) {
  low_ = std::nextafter(exact::double_bounds(range.low).first, -std::numeric_limits<double>::infinity());
  high_ = exact::double_bounds(range.high).second;
}

Polynomial WindowRoots::polynomial(exact::Terms form) const {
  while (form.size() > 3 && exact::divide_exactly(form, circle_.divisor())) continue;
  std::vector<exact::Big> c;
  for (exact::BigInteger& term : form) c.emplace_back(std::move(term));
  return exact::primitive_part(Polynomial(std::move(c)));
}

std::vector<AlgebraicRoot> WindowRoots::of(const Polynomial& p) {
  ++work_.candidates;
  if (p.degree() < 1) return {};
  std::vector<AlgebraicRoot> all = exact::roots_in(p, low_, high_, counts_);
  std::erase_if(all, [&](const AlgebraicRoot& root) {
    return exact::compare(root, range_.low) <= 0 || exact::compare(root, range_.high) > 0;
  });
  return all;
}

}  // namespace dymsum::spatial
