#include "shape/complex/order.h"

namespace dymsum::shape {

int Order::compare(const Section& s, const Mark& a, const Mark& b) {
  using Kind = Mark::Kind;
  if (a.kind == b.kind && (a.is_infinite() || a.same(b))) return 0;
  if (a.kind == Kind::minus_infinity || b.kind == Kind::plus_infinity) return -1;
  if (b.kind == Kind::minus_infinity || a.kind == Kind::plus_infinity) return 1;
  const bool decided =
      a.near.high() < b.near.low() || a.near.low() > b.near.high() || (a.near.is_point() && b.near.is_point());
  if (decided) {
    counts.count(exact::Rung::doubles);
    return a.near.low() < b.near.low() ? -1 : a.near.low() > b.near.low();
  }
  if (same_direction(s, a, b)) {
    counts.count(exact::Rung::big);
    return 0;
  }
  return sign_beyond([&](const auto& formulas) { return formulas.value(s, a) - formulas.value(s, b); });
}

bool Order::same_direction(const Section& s, const Mark& a, const Mark& b) {
  if (walks_.is_edge(s.site)) return false;
  const auto v = exact_.direction(s, a), w = exact_.direction(s, b);
  return v && w && v->x * w->y == v->y * w->x && dot(*v, *w) > 0;
}

QuadraticSigns Order::signs(const Section& s, std::uint32_t i, std::uint32_t j, const Quadratic<Interval>& near) {
  std::optional<Quadratic<Fine>> fine;
  std::optional<Quadratic<Exact>> exactly;
  const auto decide = [&](auto&& of) {
    if (const std::optional<int> sign = sign_of(of(near))) return counts.add({*sign, exact::Rung::doubles});
    if (!fine) fine = fine_.difference(s, i, j);
    if (const std::optional<int> sign = sign_of(of(*fine))) return counts.add({*sign, exact::Rung::double_pairs});
    if (!exactly) exactly = exact_.difference(s, i, j);
    return counts.add({exact::sign_of(of(*exactly)), exact::Rung::big});
  };
  QuadraticSigns signs;
  signs.a = decide([](const auto& f) { return f.a; });
  if (signs.a != 0) {
    signs.b = sign_of(near.b).value_or(0);  // for the choice of a formula only
    signs.discriminant = decide([](const auto& f) { return discriminant(f); });
    return signs;
  }
  signs.b = decide([](const auto& f) { return f.b; });
  if (signs.b == 0) signs.c = decide([](const auto& f) { return f.c; });
  return signs;
}

bool Order::is_opposite(const Section& s, std::uint32_t j, int end) {
  const auto direction = [&](auto&& formulas) {
    using F = std::decay_t<decltype(formulas)>;
    const SiteEnds& ends = walks_.ends[j];
    const auto q = formulas.turned(s, formulas.between(walks_.ends[s.site].a, end == 0 ? ends.a : ends.b));
    return F::mirrored(q, right_of(formulas.turned(s, formulas.vector(j))));
  };
  const Vec<Interval> near = direction(near_);
  if (!near.y.contains_zero() || near.x.low() > 0) {
    counts.count(exact::Rung::doubles);
    return false;
  }
  counts.count(exact::Rung::big);
  const Vec<exact::BigInteger> v = direction(exact_);
  return v.y.is_zero() && v.x.sign() < 0;
}

}  // namespace dymsum::shape
