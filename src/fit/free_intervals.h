// Exact sets of scales from the scales at which something comes into contact.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "base/poll.h"
#include "dymsum/progress.h"
#include "dymsum/result.h"
#include "exact/big.h"
#include "planar/operand/scale_value.h"

namespace dymsum {

/// The free set from an oracle that is constant between consecutive critical scales and closed: one question per gap,
/// and one per critical scale between two blocked gaps. Above `limit` (if any) nothing is free.
template <class Contacts, class Range, class Free>
Result<void> free_intervals(const std::map<exact::BigRational, Contacts>& critical,
                            const std::optional<exact::BigRational>& limit, const Progress& progress, Range& range,
                            Free&& free) {
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
  for (std::size_t i = 0; i <= n; ++i) {
    if (stopped(i)) return cancelled();
    if (i == n && limit) break;
    const BigRational s = n == 0   ? BigRational(1)
                          : i == 0 ? BigRational(values[0] / 2)
                          : i == n ? BigRational(values[n - 1] * 2)
                                   : planar::simple_between(values[i - 1], values[i]);
    gap[i] = free(s);
    ++range.tested;
  }
  bool open = gap[0];
  if (open) range.free.push_back({});
  for (std::size_t i = 0; i < n; ++i) {
    if (stopped(n + 1 + i)) return cancelled();
    const bool here = gap[i] || gap[i + 1] || (++range.tested, free(values[i]));
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

}  // namespace dymsum
