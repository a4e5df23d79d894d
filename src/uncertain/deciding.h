// Questions whose answer changes in one direction only when an operand grows: the smallest and the largest variants
// decide, and where there are finitely many all of them are looked at. For regions and for solids alike.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "dymsum/penetration_depth.h"
#include "dymsum/uncertain_answers.h"
#include "exact/big.h"

namespace dymsum::uncertain {

/// A variant, or a set that stands for one.
template <class Operand>
struct Candidate {
  Operand set;
  std::uint32_t index;
};

/// All variants where there are finitely many, else the inner or outer set.
template <class Operand, class Set>
std::vector<Candidate<Operand>> candidates(const Set& u, bool outer) {
  std::vector<Candidate<Operand>> all;
  for (const auto& variant : u.variants()) all.push_back({variant, static_cast<std::uint32_t>(all.size())});
  if (all.empty()) {
    if (outer) all.push_back({u.outer(), VariantPair::kOuter});
    else all.push_back({u.inner(), VariantPair::kInner});
  }
  return all;
}

template <class Operand>
using Question = std::function<Result<bool>(const Operand&, const Operand&)>;

/// The first pairs, in the order of p, for which a question holds and for which it does not, as far as they are wanted.
struct FirstPairs {
  bool want_yes, want_no;
  std::optional<VariantPair> yes, no;

  template <class Operand>
  Result<void> look(const std::vector<Candidate<Operand>>& p, const std::vector<Candidate<Operand>>& q,
                    const Question<Operand>& question) {
    for (const Candidate<Operand>& a : p)
      for (const Candidate<Operand>& b : q) {
        if ((yes || !want_yes) && (no || !want_no)) return {};
        const Result<bool> answer = question(a.set, b.set);
        if (!answer) return answer.error();
        std::optional<VariantPair>& first = *answer ? yes : no;
        if (!first && (*answer ? want_yes : want_no)) first = VariantPair{a.index, b.index};
      }
    return {};
  }
};

/// A question that holds for larger P where it holds for smaller ones, and likewise for Q; for smaller Q where the part
/// `shrinks`. `hardest`: it holds for the pair of sets, which need not be variants, for which that is hardest.
template <class Operand, class Set>
Result<UncertainAnswer> decide(const Set& p, const Set& q, bool shrinks, bool hardest,
                               const Question<Operand>& question) {
  const auto easy_p = candidates<Operand>(p, true), easy_q = candidates<Operand>(q, !shrinks);
  if (hardest) return UncertainAnswer{Holds::for_all, VariantPair{easy_p[0].index, easy_q[0].index}, std::nullopt};
  const bool lists = !p.variants().empty() && !q.variants().empty();
  FirstPairs pairs{true, lists, {}, {}};
  if (const Result<void> looked = pairs.look(easy_p, easy_q, question); !looked) return looked.error();
  if (!lists) {
    FirstPairs hard{false, true, {}, {}};
    const auto hard_p = candidates<Operand>(p, false), hard_q = candidates<Operand>(q, shrinks);
    if (const Result<void> looked = hard.look(hard_p, hard_q, question); !looked) return looked.error();
    pairs.no = hard.no;
  }
  return UncertainAnswer{!pairs.no   ? Holds::for_all
                         : pairs.yes ? Holds::for_some
                                     : Holds::for_none,
                         pairs.yes, pairs.no};
}

/// How two sets lie, and how far from touching they are.
struct SignedDistance {
  Meeting meeting = Meeting::apart;
  exact::BigRational squared;
  bool infinite = false;
};
template <class Distance>
SignedDistance compared(const Distance& d) {
  return {d.meeting, exact::exact_value(d.squared), std::isinf(d.distance)};
}

/// a has less clearance than b: it is deeper, or not so far apart.
inline bool is_less(const SignedDistance& a, const SignedDistance& b) {
  const auto side = [](const SignedDistance& d) {
    return d.meeting == Meeting::overlapping ? -1 : d.meeting == Meeting::touching ? 0 : 1;
  };
  if (side(a) != side(b)) return side(a) < side(b);
  if (a.infinite || b.infinite) return !a.infinite;
  return side(a) < 0 ? a.squared > b.squared : a.squared < b.squared;
}

/// Of all pairs the least clearance, or the most, as a Bound {distance, pair}; the first one of equal ones.
/// distance_of(a, b) is a Result.
template <class Bound, class Operand, class DistanceOf>
Result<Bound> extreme(const std::vector<Candidate<Operand>>& p, const std::vector<Candidate<Operand>>& q, bool least,
                      const DistanceOf& distance_of) {
  std::optional<Bound> best;
  for (const Candidate<Operand>& a : p)
    for (const Candidate<Operand>& b : q) {
      auto distance = distance_of(a.set, b.set);
      if (!distance) return distance.error();
      const bool better = !best || (least ? is_less(compared(*distance), compared(best->distance))
                                          : is_less(compared(best->distance), compared(*distance)));
      if (better) best = Bound{*std::move(distance), {a.index, b.index}};
    }
  return *std::move(best);
}

}  // namespace dymsum::uncertain
