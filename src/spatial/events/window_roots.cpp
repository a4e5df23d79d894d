#include "spatial/events/window_roots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/big.h"
#include "exact/root_bracket.h"

namespace dymsum::spatial {

using exact::AlgebraicRoot;
using exact::Polynomial;

WindowRoots::WindowRoots(const RotationCircle& circle, const RotationRange& range, SolidRotationWork& work)
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

/// Whether a form has no root, by its value at the midpoint and a bound of all slopes. Coefficients are within 2^-51,
/// products of powers and sums of at most a dozen of them within 2^-48 of the sum of their sizes.
bool WindowRoots::has_none(const exact::Terms& form) const {
  std::vector<exact::BinaryParts> parts;
  int top = std::numeric_limits<int>::min();
  for (const exact::BigInteger& c : form) {
    parts.push_back(exact::binary_parts(exact::Big(c)));
    if (!parts.back().is_zero()) top = std::max(top, parts.back().exponent);
  }
  const double midpoint = low_ + (high_ - low_) / 2, half = std::max(high_ - midpoint, midpoint - low_),
               most = std::max(std::abs(low_), std::abs(high_));
  double value = 0, size = 0, slope = 0;
  for (std::size_t k = parts.size(); k-- > 0;) {
    const double c = parts[k].is_zero() ? 0 : parts[k].scaled(-top);
    value = value * midpoint + c;
    size = size * most + std::abs(c);
    if (k > 0) slope = slope * most + static_cast<double>(k) * std::abs(c);
  }
  return std::abs(value) > (half * slope) * (1 + 0x1p-40) + size * 0x1p-46 + 0x1p-900;
}

std::vector<FormRoot> WindowRoots::of(exact::Terms form) {
  if (form.empty()) {
    ++work_.candidates;
    return {};
  }
  std::size_t zeros = 0;
  while (form[zeros].is_zero()) ++zeros;
  form.erase(form.begin(), form.begin() + static_cast<std::ptrdiff_t>(zeros));
  std::vector<FormRoot> found;
  if (has_none(form)) ++work_.candidates;
  else found = of(polynomial(std::move(form)));
  if (zeros == 0 || !(range_.low < 0 && range_.high >= 0)) return found;
  if (!zero_) zero_ = angles_.add(AlgebraicRoot::of(0));
  const auto at = std::find_if(found.begin(), found.end(),
                               [&](const FormRoot& root) { return angles_.is_before(*zero_, root.angle); });
  found.insert(at, {*zero_, zeros % 2 != 0});
  return found;
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
    const std::size_t midpoint = (low + high) / 2;
    const int order = exact::compare(root, roots_[ascending_[midpoint]]);
    if (order == 0) return ascending_[midpoint];
    (order < 0 ? high : low) = order < 0 ? midpoint : midpoint + 1;
  }
  const auto index = static_cast<std::uint32_t>(roots_.size());
  roots_.push_back(root);
  ascending_.insert(ascending_.begin() + static_cast<std::ptrdiff_t>(low), index);
  return index;
}

}  // namespace dymsum::spatial
