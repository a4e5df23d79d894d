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

const std::vector<FormRoot>& WindowRoots::of(const Polynomial& p) {
  ++work_.candidates;
  std::vector<exact::BigInteger> key;
  for (int k = 0; k <= p.degree(); ++k) key.push_back(p[k].value());
  if (!key.empty() && key.back().sign() < 0)
    for (exact::BigInteger& c : key) c = -c;
  const auto [at, fresh] = known_.try_emplace(std::move(key));
  if (fresh) at->second = find(p);
  return at->second;
}

std::vector<FormRoot> WindowRoots::find(const Polynomial& p) {
  std::vector<FormRoot> found;
  if (p.degree() < 1) return found;
  for (const AlgebraicRoot& root : exact::roots_in(p, low_, high_, counts_))
    if (exact::compare(root, range_.low) > 0 && exact::compare(root, range_.high) <= 0)
      found.push_back({angles_.add(root), root.changes_sign()});
  return found;
}

std::uint32_t RootOrder::add(const AlgebraicRoot& root) {
  std::size_t low = 0, high = ascending_.size();
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    const int order = exact::compare(root, roots_[ascending_[middle]]);
    if (order == 0) return ascending_[middle];
    (order < 0 ? high : low) = order < 0 ? middle : middle + 1;
  }
  const auto index = static_cast<std::uint32_t>(roots_.size());
  roots_.push_back(root);
  ascending_.insert(ascending_.begin() + static_cast<std::ptrdiff_t>(low), index);
  return index;
}

}  // namespace dymsum::spatial
