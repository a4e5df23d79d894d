#include "shape/disc/disc_positions.h"

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

DiscPositions::DiscPositions(const Complex& complex, const Level& level)
    : complex_(complex), level_(level), reach_(level.radius) {
  for (const Site& site : complex.sites) reach_ = std::max({reach_, std::abs(site.a.x), std::abs(site.a.y)});
}

CornerDisc DiscPositions::disc_on(std::uint32_t edge) const {
  const Edge& e = complex_.edges[edge];
  if (level_.holds(e.low)) return {true, e.low};
  if (e.high != kNoIndex && level_.holds(e.high)) return {true, e.high};
  return {false, edge};
}

Point DiscPositions::centre(const CornerDisc& disc) const {
  if (disc.at_node) return complex_.nodes[disc.index].centre;
  // The vector is from a position of the region: coordinates far from the origin cost the vector no digits.
  const Point anchor = complex_.sites[complex_.edges[disc.index].left].a;
  const Point v =
      near_vector([&](const auto& r) { return centre_on_edge(complex_, disc.index, r, anchor); }, level_, reach_);
  return {anchor.x + v.x, anchor.y + v.y};
}

Point DiscPositions::centre_from(const CornerDisc& disc, Point vertex) const {
  if (disc.at_node) {
    const Vector<exact::RootExpression> v = exact_centre_from(disc, vertex);
    return {exact::nearest_double(v.x), exact::nearest_double(v.y)};
  }
  return near_vector([&](const auto& r) { return centre_on_edge(complex_, disc.index, r, vertex); }, level_,
                     level_.radius);
}

Vector<exact::RootExpression> DiscPositions::exact_centre_from(const CornerDisc& disc, Point origin) const {
  using exact::RootExpression;
  if (!disc.at_node) return centre_on_edge(complex_, disc.index, level_.exact, origin);
  const ExactDisc node = exact_disc(complex_, disc.index);
  return {node.centre.x - RootExpression(origin.x), node.centre.y - RootExpression(origin.y)};
}

Point DiscPositions::normal(const Site& site) const {
  double dx = site.b.x - site.a.x, dy = site.b.y - site.a.y;
  if (constexpr double kFewDigits = 0x1p-1000; std::abs(dx) < kFewDigits && std::abs(dy) < kFewDigits)
    dx = std::scalbn(dx, 1000), dy = std::scalbn(dy, 1000);  // what is below normal doubles has no length in doubles
  const double length = std::hypot(dx, dy);
  return {dy / length, -dx / length};
}

Point DiscPositions::towards(const CornerDisc& disc, const Site& site) const {
  if (site.kind == Site::Kind::edge) {
    const Point n = normal(site);
    return {-n.x * level_.radius, -n.y * level_.radius};
  }
  const Point v = centre_from(disc, site.a);
  return {-v.x, -v.y};
}

Point DiscPositions::contact(const CornerDisc& disc, const Site& site) const {
  if (site.kind == Site::Kind::vertex) return site.a;
  const Point c = centre(disc), v = towards(disc, site);
  return {c.x + v.x, c.y + v.y};
}

}  // namespace dymsum::shape
