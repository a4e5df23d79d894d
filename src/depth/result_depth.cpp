#include "depth/result_depth.h"

#include <algorithm>
#include <stdexcept>
#include <variant>

namespace dymsum::depth {
namespace {

using exact::BigRational;

RationalVector between(const RationalVector& from, const RationalVector& to) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}
BigRational inner(const RationalVector& a, const RationalVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
RationalVector outer(const RationalVector& a, const RationalVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
bool is_zero(const RationalVector& v) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

RationalVector exact_at(const SpatialSum& sum, std::uint32_t vertex) {
  const RationalPoint3 p = sum.exact(vertex);
  return {exact::exact_value(p.x), exact::exact_value(p.y), exact::exact_value(p.z)};
}

/// Whether x lies on the segment.
bool lies_between(const RationalVector& x, const RationalVector& a, const RationalVector& b) {
  return is_zero(outer(between(a, x), between(a, b))) && inner(between(a, x), between(b, x)) <= 0;
}

}  // namespace

bool ResultDepth::is_free(const RationalVector& at) const {
  if (locator_.of(at) != spatial::ExactLocator::Where::inside || locator_.on_tight_face(at)) return true;
  const auto on = [&](const auto& s) { return lies_between(at, exact_at(sum_, s[0]), exact_at(sum_, s[1])); };
  return std::any_of(sum_.tight_segments.begin(), sum_.tight_segments.end(), on) ||
         std::any_of(sum_.tight_points.begin(), sum_.tight_points.end(),
                     [&](std::uint32_t v) { return exact_at(sum_, v) == at; });
}

/// Where the segment meets tight segments and points: parameters from 0 to 1.
void ResultDepth::add_tight_crossings(const RationalVector& from, const RationalVector& to,
                                      std::vector<BigRational>& cuts) const {
  const RationalVector d = between(from, to);
  const auto add_point = [&](const RationalVector& at) {
    const RationalVector v = between(from, at);
    if (is_zero(outer(v, d))) cuts.push_back(inner(v, d) / inner(d, d));
  };
  for (const std::uint32_t v : sum_.tight_points) add_point(exact_at(sum_, v));
  for (const auto& s : sum_.tight_segments) {
    const RationalVector a = exact_at(sum_, s[0]), b = exact_at(sum_, s[1]), n = outer(d, between(a, b));
    if (is_zero(n)) add_point(a), add_point(b);
    else if (inner(between(from, a), n) == 0)
      cuts.push_back(inner(outer(between(from, a), between(a, b)), n) / inner(n, n));
  }
  std::erase_if(cuts, [](const BigRational& t) { return t <= 0 || t > 1; });
}

BigRational ResultDepth::exit_along(const RationalVector& from, const RationalVector& direction) const {
  if (is_free(from)) return 0;
  // As far as any position of the sum is.
  BigRational length = 1;
  for (std::uint32_t v = 0; v < sum_.vertices.size(); ++v)
    for (const BigRational& c : between(from, exact_at(sum_, v))) length += abs(c);
  BigRational steps = 0;
  for (const BigRational& c : direction) steps = std::max(steps, BigRational(abs(c)));
  const BigRational whole = length / steps;
  const RationalVector to{from[0] + whole * direction[0], from[1] + whole * direction[1],
                          from[2] + whole * direction[2]};
  std::vector<BigRational> cuts = locator_.cuts(from, to);
  add_tight_crossings(from, to, cuts);
  std::sort(cuts.begin(), cuts.end());
  for (const BigRational& t : cuts)
    if (is_free(spatial::position_between(from, to, t))) return t * whole;
  throw std::logic_error("exit_along: the sum is bounded, and no way leads out of it");
}

Result<SpatialSum> sum_with_reflected(const SpatialOperand& p, const SpatialOperand& q, const SpatialOptions& options) {
  return std::visit([&](const auto* set) { return minkowski_sum(p, negated(*set), options); }, q.set());
}

}  // namespace dymsum::depth
