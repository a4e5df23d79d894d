#include "spatial/events/meeting_list.h"

#include <cmath>
#include <optional>

#include "base/doubles.h"

namespace dymsum::spatial {

using exact::BigInteger;

namespace {

bool is_same(const ExactMeeting& a, const ExactMeeting& b) {
  const auto equal = [&](const BigInteger& x, const BigInteger& y) { return x * b.w == y * a.w; };
  return equal(a.s, b.s) && equal(a.x[0], b.x[0]) && equal(a.x[1], b.x[1]) && equal(a.x[2], b.x[2]);
}

}  // namespace

bool MeetingList::is_covered(const NearMeeting& at) {
  const double step = std::ldexp(1.0, std::ilogb(span_) - 28), s_step = std::ldexp(1.0, std::ilogb(high_) - 28);
  if (at.radius > step || at.s_radius > s_step) return false;
  const auto cell = [](double v, double width) { return std::floor(v / width); };
  const double x = cell(at.x.x, step), y = cell(at.x.y, step), z = cell(at.x.z, step), s = cell(at.s, s_step);
  const auto [known, fresh] = covered_.try_emplace({static_cast<std::int64_t>(x), static_cast<std::int64_t>(y),
                                                    static_cast<std::int64_t>(z), static_cast<std::int64_t>(s)},
                                                   false);
  const Vec3 centre{(x + 0.5) * step, (y + 0.5) * step, (z + 0.5) * step};
  if (fresh)
    known->second = overlap_.at(centre, (s + 0.5) * s_step, 2 * step, 2 * s_step) == ScaledOverlap::Answer::overlap;
  return known->second;
}

void MeetingList::add(ExactMeeting at) {
  MeetingEvent event{std::move(at), {}};
  event.near = near(event.at);
  if (!is_in_window(event.near)) return;
  const auto bits = [](double v) { return base::bit_cast<std::int64_t>(v); };
  const GridCell key{bits(event.near.x.x), bits(event.near.x.y), bits(event.near.x.z), bits(event.near.s)};
  if (covered_at_.contains(key)) return;
  const auto [first, last] = found_at_.equal_range(key);
  for (auto k = first; k != last; ++k)
    if (is_same(found_[k->second].at, event.at)) return;
  if (overlap_.at(event.near.x, event.near.s, event.near.radius, event.near.s_radius) ==
      ScaledOverlap::Answer::overlap) {
    covered_at_.insert(key);
    return;
  }
  found_at_.emplace(key, found_.size());
  found_.push_back(std::move(event));
}

}  // namespace dymsum::spatial
