// Exact decisions about the positions of a site, intervals first.
#pragma once

#include <cstdint>
#include <optional>

#include "exact/orient.h"
#include "shape/complex/formulas.h"

namespace dymsum::shape {

/// The signs that determine where a quadratic is negative, as far as they matter.
struct QuadraticSigns {
  int a = 0, b = 0, c = 0;
  int discriminant = 0;  ///< only where a is not zero
};

class Order {
 public:
  using Interval = exact::Interval;
  using Fine = exact::FineInterval;
  using Exact = exact::RootExpression;

  explicit Order(const Walks& walks) : walks_(walks), near_(walks), fine_(walks), exact_(walks) {}

  const Walks& walks() const { return walks_; }
  const Formulas<Interval>& near() const { return near_; }
  const Formulas<Exact>& exact() const { return exact_; }

  /// The sign of a - b.
  int compare(const Section& s, const Mark& a, const Mark& b);
  /// The signs of the difference that Formulas::difference names; `near` contains it.
  QuadraticSigns signs(const Section& s, std::uint32_t i, std::uint32_t j, const Quadratic<Interval>& near);
  /// Whether the disc that touches edge j at an end lies exactly opposite the section's axis.
  bool is_opposite(const Section& s, std::uint32_t j, int end);

  /// The sign of form(formulas), which is Formulas for one type of numbers after the other.
  template <class Form>
  int sign(Form&& form) {
    if (const std::optional<int> sign = sign_of(form(near_))) {
      counts.count(exact::Rung::doubles);
      return *sign;
    }
    return sign_beyond(form);
  }
  /// The same where intervals of doubles do not decide.
  template <class Form>
  int sign_beyond(Form&& form) {
    if (const std::optional<int> sign = sign_of(form(fine_))) {
      counts.count(exact::Rung::double_pairs);
      return *sign;
    }
    counts.count(exact::Rung::big);
    return exact::sign_of(form(exact_));
  }

  /// The mark with `near` filled in.
  Mark mark(const Section& s, Mark m) const {
    if (!m.is_infinite()) m.near = near_.value(s, m);
    return m;
  }
  Mark tangent(const Section& s, std::uint32_t j, int end) const {
    return mark(s, {.kind = Mark::Kind::tangent, .root = static_cast<std::uint8_t>(end), .i = j});
  }

  exact::RungCounts counts;

 private:
  /// Whether both marks are directions of integer vectors, and the same one: without roots.
  bool same_direction(const Section& s, const Mark& a, const Mark& b);

  const Walks& walks_;
  Formulas<Interval> near_;
  Formulas<Fine> fine_;
  Formulas<Exact> exact_;
};

}  // namespace dymsum::shape
