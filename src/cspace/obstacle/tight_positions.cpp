#include "cspace/obstacle/tight_positions.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dymsum::planar {

// Known to be one position without exact signs where the lines that cross at the one go through the other.
bool PositionsAtAngle::same_position(const TightCandidate& y, const TightCandidate& z) const {
  const auto crosses_on = [&](const ExactPosition::Simple& crossing, const TightCandidate& other) {
    return crossing.crossing && other.goes_through(segments_.of(crossing.a)) &&
           other.goes_through(segments_.of(crossing.b));
  };
  return crosses_on(y.position.first, z) || crosses_on(z.position.first, y) || signs_.same(y.position, z.position);
}

std::vector<TightCandidate> PositionsAtAngle::each_once(std::vector<TightCandidate> all) const {
  const double apart = SignsAt::kNear * forms_.span();
  std::stable_sort(all.begin(), all.end(),
                   [](const TightCandidate& y, const TightCandidate& z) { return y.near.x < z.near.x; });
  std::vector<TightCandidate> once;
  for (TightCandidate& z : all) {
    bool known = false;
    for (std::size_t k = once.size(); k-- > 0 && !known;) {
      TightCandidate& y = once[k];
      if (z.near.x - y.near.x > apart) break;
      if (std::abs(z.near.y - y.near.y) > apart) continue;
      if (!same_position(y, z)) continue;
      known = true;
      y.through.insert(y.through.end(), z.through.begin(), z.through.end());
    }
    if (!known) once.push_back(std::move(z));
  }
  for (TightCandidate& z : once) {
    std::sort(z.through.begin(), z.through.end());
    z.through.erase(std::unique(z.through.begin(), z.through.end()), z.through.end());
  }
  return once;
}

std::vector<std::array<std::uint32_t, 2>> PositionsAtAngle::opposite_intervals(
    const std::vector<TightCandidate>& positions, double theta) const {
  std::vector<std::array<std::uint32_t, 2>> found;
  const auto exists = [&](std::uint32_t s) {
    return catalog_.exists(segments_.segment(s), theta) != RotationCatalog::Existence::no;
  };
  const auto holds = [&](std::uint32_t s, const TightCandidate& z) {
    return z.goes_through(s) ? signs_.within(segments_.segment(s), z.position, z.near)
                             : signs_.holds(segments_.segment(s), z.position, z.near);
  };
  for (std::uint32_t k = 0; k < positions.size(); ++k)
    for (const std::uint32_t s : positions[k].through)
      for (const std::uint32_t t : positions[k].through) {
        if (s >= t || !signs_.antiparallel(segments_.segment(s), segments_.segment(t)) || !exists(s) || !exists(t) ||
            !holds(s, positions[k]) || !holds(t, positions[k]))
          continue;
        // The next place on both, in the direction of s.
        std::optional<std::uint32_t> next;
        const auto follows = [&](std::uint32_t l, std::uint32_t m) {
          return signs_.order(segments_.segment(s), positions[l].position, positions[l].near, positions[m].position,
                              positions[m].near) > 0;
        };
        for (std::uint32_t l = 0; l < positions.size(); ++l)
          if (l != k && holds(s, positions[l]) && follows(l, k) && (!next || follows(*next, l))) next = l;
        if (!next || !holds(t, positions[*next])) continue;
        const std::array<std::uint32_t, 2> pair{k, *next};
        if (std::find(found.begin(), found.end(), pair) == found.end()) found.push_back(pair);
      }
  return found;
}

std::vector<NodeNow> PositionsAtAngle::nodes_now(bool before) const {
  std::vector<NodeNow> all;
  const Heading h = signs_.heading();
  const auto add = [&](std::uint32_t n) {
    const BoundaryGraph::Node& node = graph_[n];
    const Point e = forms_.edge(node.segment.side, node.segment.edge);
    const double length2 = e.x * e.x + e.y * e.y;
    const Located from = position_on(forms_, node.segment, segments_.segment(node.left), true, h),
                  to = position_on(forms_, node.segment, segments_.segment(node.right), false, h);
    NodeNow now{n, from.t * length2, to.t * length2, 2 * (from.error + to.error) * length2};
    now.error += SignsAt::kNear * forms_.span() * forms_.length1(node.segment);
    if (!std::isfinite(now.error)) now = {n, 0, 0, INFINITY};
    all.push_back(now);
  };
  for (const std::uint32_t n : graph_.alive()) add(n);
  for (const std::uint32_t n : graph_.ended())
    if (before && graph_[n].begin != graph_.angle()) add(n);
  return all;
}

// Whether an end of a sub-edge comes after z along it (1), is z (0) or comes before it (-1). z is on its line.
int PositionsAtAngle::order_of_end(const NodeNow& n, const TightCandidate& z, bool at_end) const {
  const BoundaryGraph::Node& node = graph_[n.node];
  const double d = (at_end ? n.to : n.from) - signs_.along_near(node.segment, z.near);
  if (std::abs(d) > n.error) return d > 0 ? 1 : -1;
  const std::uint32_t by = at_end ? node.right : node.left;
  if (z.goes_through(node.id) && z.goes_through(by) && signs_.cross(node.segment, segments_.segment(by)) != 0) return 0;
  const std::optional<Fraction> end = end_along(signs_, node.segment, graph_.sub_edge(n.node), at_end);
  if (!end) throw std::logic_error("PlacesAtAngle: a sub-edge ends nowhere on its line");
  return signs_.compare(*end, signs_.along(node.segment, z.position));
}

bool PositionsAtAngle::on_line(const NodeNow& n, const TightCandidate& z) const {
  return z.goes_through(graph_[n.node].id) || signs_.side_sign(graph_[n.node].segment, z.position, z.near) == 0;
}

bool PositionsAtAngle::reaches(const NodeNow& n, const TightCandidate& z) const {
  const double at = signs_.along_near(graph_[n.node].segment, z.near);
  if (at < n.from - n.error || at > n.to + n.error || !on_line(n, z)) return false;
  return order_of_end(n, z, false) <= 0 && order_of_end(n, z, true) >= 0;
}

std::array<Fraction, 2> PositionsAtAngle::limit_along(const WalkSegment& line, std::uint32_t node) const {
  std::optional<Fraction> from = end_along(signs_, line, graph_.sub_edge(node), false),
                          to = end_along(signs_, line, graph_.sub_edge(node), true);
  if (!from || !to) throw std::logic_error("PlacesAtAngle: a sub-edge ends nowhere on its line");
  if (signs_.compare(*to, *from) < 0) std::swap(from, to);
  return {*from, *to};
}

Point PositionsAtAngle::point_on(const WalkSegment& line, const Fraction& along) const {
  const double t = signs_.quotient(along.num, product(along.den, signs_.length(line).num));
  const Point from = forms_.position(TurningForms::start(line), signs_.heading()),
              d = forms_.direction(line, signs_.heading());
  return {from.x + t * d.x, from.y + t * d.y};
}

// Limits are closed: what is left out between two of them is longer than nothing.
std::vector<PositionsAtAngle::PartEnds> PositionsAtAngle::not_reached(const std::vector<NodeNow>& nodes,
                                                                      const TightCandidate& y,
                                                                      const TightCandidate& z) const {
  std::vector<std::uint32_t> line;
  for (const NodeNow& n : nodes) {
    const double a = signs_.along_near(graph_[n.node].segment, y.near),
                 b = signs_.along_near(graph_[n.node].segment, z.near);
    if (std::max(a, b) < n.from - n.error || std::min(a, b) > n.to + n.error || !on_line(n, y) || !on_line(n, z))
      continue;
    if (reaches(n, y) && reaches(n, z)) return {};
    line.push_back(n.node);
  }
  if (line.empty()) return {{}};
  const WalkSegment first = graph_[line[0]].segment;
  std::vector<std::array<Fraction, 2>> limits;
  for (const std::uint32_t n : line) limits.push_back(limit_along(first, n));
  std::stable_sort(limits.begin(), limits.end(),
                   [&](const auto& a, const auto& b) { return signs_.compare(a[0], b[0]) < 0; });
  Fraction at = signs_.along(first, y.position), end = signs_.along(first, z.position);
  const bool turned = signs_.compare(end, at) < 0;
  if (turned) std::swap(at, end);
  std::vector<PartEnds> parts;
  std::optional<Point> from;
  for (const auto& [low, high] : limits) {
    if (signs_.compare(low, end) >= 0 || signs_.compare(at, end) >= 0) break;
    if (signs_.compare(high, at) <= 0) continue;
    if (signs_.compare(low, at) > 0) parts.push_back({from, point_on(first, low)});
    at = high;
    from = point_on(first, high);
  }
  if (signs_.compare(at, end) < 0) parts.push_back({from, std::nullopt});
  if (turned)
    for (PartEnds& part : parts) std::swap(part[0], part[1]);
  return parts;
}

std::optional<TightCandidate> PositionsAtAngle::meeting_of(const AlwaysConcurrent& three) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const WalkSegment &a = three[k], &b = three[(k + 1) % 3], &c = three[(k + 2) % 3];
    if (signs_.cross(a, b) == 0) continue;
    const ExactPosition at{{true, {}, a, b}, {}};
    const std::optional<Point> near = signs_.near(at);
    if (!near) return std::nullopt;
    for (const WalkSegment& s : {a, b, c})
      if (!signs_.within(s, at, *near)) return std::nullopt;
    return TightCandidate{at, *near, {segments_.of(a), segments_.of(b), segments_.of(c)}, false};
  }
  return std::nullopt;
}

std::vector<TightCandidate> PositionsAtAngle::positions_of(const std::vector<AlwaysConcurrent>& curves) const {
  std::vector<TightCandidate> all;
  for (const AlwaysConcurrent& three : curves)
    if (std::optional<TightCandidate> z = meeting_of(three)) all.push_back(std::move(*z));
  return each_once(std::move(all));
}

}  // namespace dymsum::planar
