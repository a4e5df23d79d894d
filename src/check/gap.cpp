#include "check/gap.h"

#include <vector>

namespace dymsum::check {
namespace {

HomogeneousPoint sum(const HomogeneousPoint& p, const HomogeneousPoint& q) {
  return {p.x * q.w + q.x * p.w, p.y * q.w + q.y * p.w, p.w * q.w};
}

/// A vertex that may be one of the nearest.
struct Candidate {
  double rough;
  bool of_a;
  PointRef vertex;
};

}  // namespace

std::optional<Gap> gap_between(const EdgeTree& a, const EdgeTree& b, const HomogeneousPoint& b_moved_by, double reach) {
  if (a.empty() || b.empty()) return std::nullopt;
  const HomogeneousPoint back{-b_moved_by.x, -b_moved_by.y, b_moved_by.w};
  const ExactPoint move(b_moved_by);
  std::vector<Candidate> candidates;
  double least = std::numeric_limits<double>::infinity();
  for (const bool of_a : {true, false}) {
    const EdgeTree &own = of_a ? a : b, &other = of_a ? b : a;
    const double dx = of_a ? -move.near.x : move.near.x, dy = of_a ? -move.near.y : move.near.y;
    for (std::uint32_t e = 0; e < own.size(); ++e)
      for (const PointRef& v : {own[e].from, own[e].to}) {
        const double rough = other.rough_distance({v->near.x + dx, v->near.y + dy});
        candidates.push_back({rough, of_a, v});
        if (rough < least) least = rough;
      }
  }
  const double slack = 2 * a.slack(b, move);
  if (least > reach + slack) return std::nullopt;
  std::optional<Gap> gap;
  for (const Candidate& c : candidates) {
    if (c.rough > least + slack) continue;  // not so for what is no number
    const ExactPoint seen(sum(c.vertex->exact, c.of_a ? back : b_moved_by));
    const EdgeTree& other = c.of_a ? b : a;
    EdgeTree::Nearest nearest = other.nearest(seen);
    if (gap && !(nearest.squared < gap->squared)) continue;
    const HomogeneousPoint foot = nearest_on(seen, other[nearest.edge]);
    const auto point = [](const HomogeneousPoint& p) { return std::make_shared<const ExactPoint>(p); };
    gap = c.of_a ? Gap{c.vertex, point(sum(foot, b_moved_by)), std::move(nearest.squared)}
                 : Gap{point(foot), point(seen.exact), std::move(nearest.squared)};
  }
  return gap;
}

}  // namespace dymsum::check
