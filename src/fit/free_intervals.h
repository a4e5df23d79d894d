// Exact sets of scales from the scales at which something comes into contact.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "base/poll.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/result.h"
#include "exact/big.h"
#include "fit/blocked_scales.h"
#include "planar/operand/scale_value.h"

namespace dymsum {

/// Intervals of scales that are known to be blocked, in order; the scale at hand only rises.
class KnownBlocked {
 public:
  void add(std::optional<BlockedScales> more) {
    if (more) intervals_.push_back(*std::move(more));
  }
  /// Whether the open interval, which without `high` has no end, is blocked throughout; of the last that was added.
  bool covers(const exact::BigRational& low, const std::optional<exact::BigRational>& high) const {
    if (intervals_.empty()) return false;
    const BlockedScales& last = intervals_.back();
    return last.low <= low && (!last.high || (high && *high <= *last.high));
  }
  /// Whether a scale is; of scales that rise from call to call.
  bool holds(const exact::BigRational& s) {
    while (at_ < intervals_.size() && intervals_[at_].high && *intervals_[at_].high <= s) ++at_;
    return at_ < intervals_.size() && intervals_[at_].low < s;
  }

 private:
  std::vector<BlockedScales> intervals_;
  std::size_t at_ = 0;
};

/// Knows nothing about blocked scales.
struct NothingAbout {
  std::optional<BlockedScales> operator()(const exact::BigRational&) const { return std::nullopt; }
};

/// The free set from an oracle that is constant between consecutive critical scales and closed: one question per gap,
/// and one per critical scale between two blocked gaps, but for those that `about` knows to be blocked: called after
/// the oracle said that a scale is blocked, it gives an interval about that. Above `limit` (if any) nothing is free.
template <class Contacts, class Range, class Free, class About = NothingAbout>
Result<void> free_intervals(const std::map<exact::BigRational, Contacts>& critical,
                            const std::optional<exact::BigRational>& limit, const Progress& progress, Range& range,
                            Free&& free, About&& about = {}) {
  using exact::BigRational;
  std::vector<BigRational> values;
  for (const auto& [s, contacts] : critical)
    if (!limit || s < *limit) values.push_back(s);
  if (limit) values.push_back(*limit);
  range.critical = values.size();
  const auto contacts_at = [&](const BigRational& s) {
    const auto it = critical.find(s);
    return it == critical.end() ? Contacts{} : it->second;
  };
  const std::size_t n = values.size();
  std::vector<std::uint8_t> gap(n + 1, 0);  // gap i lies below value i
  const auto stopped = [&](std::size_t queried) {
    return progress && !progress("scales", static_cast<double>(queried) / static_cast<double>(2 * n + 1));
  };
  KnownBlocked blocked;
  for (std::size_t i = 0; i <= n; ++i) {
    if (stopped(i)) return cancelled();
    if (i == n && limit) break;
    if (blocked.covers(i == 0 ? BigRational(0) : values[i - 1], i == n ? std::nullopt : std::optional(values[i])))
      continue;
    const BigRational s = n == 0   ? BigRational(1)
                          : i == 0 ? BigRational(values[0] / 2)
                          : i == n ? BigRational(values[n - 1] * 2)
                                   : planar::simple_between(values[i - 1], values[i]);
    gap[i] = free(s);
    if (!gap[i]) blocked.add(about(s));
    ++range.tested;
  }
  bool open = gap[0];
  if (open) range.free.push_back({});
  for (std::size_t i = 0; i < n; ++i) {
    if (stopped(n + 1 + i)) return cancelled();
    const bool here = gap[i] || gap[i + 1] || (!blocked.holds(values[i]) && (++range.tested, free(values[i])));
    if (here && !open) {
      range.free.push_back({});
      range.free.back().low = exact::to_rational(values[i]);
      range.free.back().at_low = contacts_at(values[i]);
    }
    open = gap[i + 1];
    if (here && !open) {
      range.free.back().high = exact::to_rational(values[i]);
      range.free.back().at_high = contacts_at(values[i]);
    }
  }
  return {};
}

// The unit in which a part is measured that is far smaller or larger than what it has to fit.

/// k so that 2^-k times a part is about as large as what it has to fit, whose sizes these are. Scales of the part are
/// 2^-k times those of that one, which are moderate. 0 where they are so already: within 2^+-40, far from the ends of
/// Scale.
inline int part_unit(double part_size, double other_size) {
  if (!(part_size > 0 && other_size > 0 && std::isfinite(part_size) && std::isfinite(other_size))) return 0;
  const int k = std::ilogb(part_size) - std::ilogb(other_size);
  return std::abs(k) <= 40 ? 0 : k;
}

/// 2^-k v where that is a double.
inline std::optional<double> in_unit(double v, int k) {
  const double made = std::scalbn(v, -k);
  if (!std::isfinite(made) || std::scalbn(made, k) != v) return std::nullopt;
  return made;
}

/// Makes scales of the part of scales of the part in its unit.
template <class Range>
Range in_input_units(Range range, int k) {
  const exact::BigInteger power = exact::BigInteger(1) << static_cast<unsigned>(std::abs(k));
  const auto back = [&](std::optional<Rational>& s) {
    if (!s) return;
    const exact::BigRational v = exact::exact_value(*s);
    s = exact::to_rational(k < 0 ? exact::BigRational(v * power) : exact::BigRational(v / power));
  };
  for (auto& interval : range.free) {
    back(interval.low);
    back(interval.high);
  }
  return range;
}

}  // namespace dymsum
