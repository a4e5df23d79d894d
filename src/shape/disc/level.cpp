#include "shape/disc/level.h"

#include <algorithm>
#include <cmath>

#include "base/double_text.h"

namespace dymsum::shape {

namespace {

std::uint32_t rank_of_first_event(const Complex& complex) {
  return !complex.nodes.empty() && complex.nodes.front().kind == Node::Kind::corner ? 1 : 0;
}

Level level_of_event(const Complex& complex, std::uint32_t rank) {
  const auto at = [&](std::uint32_t r) {
    const auto found = std::partition_point(complex.nodes.begin(), complex.nodes.end(),
                                            [r](const Node& node) { return node.rank < r; });
    return static_cast<std::uint32_t>(found - complex.nodes.begin());
  };
  Level level;
  level.below = at(rank);
  level.up_to = at(rank + 1);
  level.exact = exact_radius(complex, level.below);
  level.text = exact::to_text(level.exact);
  return level;
}

}  // namespace

std::vector<DiscEvent> disc_events(const Complex& complex) {
  std::vector<DiscEvent> events;
  const std::uint32_t first = rank_of_first_event(complex);
  for (const Node& node : complex.nodes) {
    if (node.rank < first) continue;
    if (events.size() == node.rank - first) events.push_back({node.radius, 0});
    ++events.back().nodes;
  }
  return events;
}

Result<Level> level_at(const Complex& complex, const DiscRadius& r) {
  Level level;
  if (r.event) {
    const std::uint32_t first = rank_of_first_event(complex);
    const std::uint32_t events = complex.nodes.empty() ? 0 : complex.nodes.back().rank + 1 - first;
    if (*r.event >= events)
      return Error{ErrorCode::out_of_range,
                   "there is no event " + std::to_string(*r.event) + ": there are " + std::to_string(events),
                   {}};
    level = level_of_event(complex, *r.event + first);
  } else {
    if (r.value.sign() < 0)
      return Error{ErrorCode::out_of_range, "the radius must be at least 0, not " + r.value.to_string(), {}};
    level.exact = exact::RootExpression(exact::exact_value(r.value));
    level.text = r.value.is_integer() ? r.value.numerator() : r.value.to_string();
    level.below = nodes_below(complex, r.value);
    level.up_to = nodes_up_to(complex, r.value);
  }
  level.near = exact::narrow_interval(level.exact);
  level.radius = r.event ? exact::nearest_double(level.exact) : r.value.to_double();
  const bool zero = !r.event && r.value.sign() == 0;
  if (!zero && !(level.radius >= 0x1p-500 && level.radius <= 0x1p500))
    return Error{ErrorCode::out_of_range,
                 "the radius must be 0 or from 2^-500 to 2^500, not " + base::general_text(level.radius, 6),
                 {}};
  return level;
}

}  // namespace dymsum::shape
