#include "depth/facet_lines.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "spatial/mesh/vec3.h"

namespace dymsum::depth {

using spatial::Box;
using spatial::cross;
using spatial::dot;
using spatial::length;
using spatial::SumFacet;
using spatial::Vec3;

namespace {

/// Below this sine of the angle of two planes their line is computed from integers.
constexpr double kFlat = 0x1p-12;

Vec3 nearest_on_segment(Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double size = dot(d, d), t = -dot(a, d);
  if (!(t > 0)) return a;
  return t >= size ? b : a + (t / size) * d;
}

bool is_parallel(const ExactFrame& frame, const SumFacet& a, const SumFacet& b) {
  return exact::leading_sign(exact::cross(frame.plane(a).n, frame.plane(b).n)) == 0;
}

/// Facets with a facet edge in common meet in nothing else, unless they lie in one plane.
bool share_facet_edge(const SumFacet& a, const SumFacet& b) {
  int shared = 0;
  for (std::size_t k = 0; k < a.corners; ++k)
    for (std::size_t l = 0; l < b.corners; ++l) shared += a.corner[k] == b.corner[l];
  return shared >= 2;
}

}  // namespace

Vec3 FacetView::nearest(std::uint32_t f) const {
  const Vec3 n = o.normals[f];
  bool inside = true;
  for (std::size_t k = 0; k < corners(f) && inside; ++k) {
    const Vec3 a = corner(f, k);
    inside = dot(cross(n, corner(f, k + 1) - a), -a) >= 0;
  }
  if (inside) return dot(n, corner(f, 0)) * n;
  Vec3 best = nearest_on_segment(corner(f, 0), corner(f, 1));
  for (std::size_t k = 1; k < corners(f); ++k) {
    const Vec3 x = nearest_on_segment(corner(f, k), corner(f, k + 1));
    if (dot(x, x) < dot(best, best)) best = x;
  }
  return best;
}

namespace {

/// What is seen as y, no further than `within`, and outside of a ball of radius r about -e, has
/// 2 y . e > r^2 - within^2 - e . e: the bound of y . e, less what positions are off.
double least_beyond(Vec3 e, double radius, double within, double off) {
  return 0.5 * (radius * radius - within * within - dot(e, e)) - 4 * off * (1 + length(e) + radius + within);
}

}  // namespace

bool FacetView::cover(Vec3 a, Vec3 b, double off, double within) const {
  return std::any_of(balls.begin(), balls.end(), [&](const CoveredBall& ball) {
    const double radius = ball.radius - 2 * off - slack;
    if (!(radius > 0)) return false;
    const Vec3 e = from - ball.centre;
    if (length(e + a) < radius && length(e + b) < radius) return true;
    return std::max(dot(a, e), dot(b, e)) < least_beyond(e, radius, within, off + slack);
  });
}

bool FacetView::cover(const Box& box, double within) const {
  return std::any_of(balls.begin(), balls.end(), [&](const CoveredBall& ball) {
    if (!(ball.radius > 0)) return false;
    const auto far = [](double low, double high, double v) { return std::max(std::abs(v - low), std::abs(high - v)); };
    const Vec3 m = ball.centre, e = from - m;
    if (length({far(box.low.x, box.high.x, m.x), far(box.low.y, box.high.y, m.y), far(box.low.z, box.high.z, m.z)}) <
        ball.radius)
      return true;
    const auto most = [](double low, double high, double by) { return by > 0 ? high * by : low * by; };
    const Vec3 low = box.low - from, high = box.high - from;
    return most(low.x, high.x, e.x) + most(low.y, high.y, e.y) + most(low.z, high.z, e.z) <
           least_beyond(e, ball.radius, within, slack);
  });
}

double FacetLine::distance() const { return length(at(std::clamp(0.0, first, last))) - off; }

FacetCandidates::FacetCandidates(const FacetView& view, const ExactFrame& frame, std::uint32_t facet, double within)
    : view_(view), frame_(frame), f_(facet), within_(within), normal_(view.o.normals[facet]) {
  add_facet_edges();
  add_neighbours();
  add_feet();
  add_crossings();
  std::sort(candidates_.begin(), candidates_.end(), [](const FacetCandidate& a, const FacetCandidate& b) {
    return std::tie(a.lower, a.corner, a.a, a.b) < std::tie(b.lower, b.corner, b.a, b.b);
  });
}

void FacetCandidates::add_line(const FacetLine& line) {
  if (line.distance() > within_ || view_.cover(line.at(line.first), line.at(line.last), line.off, within_)) return;
  lines_.push_back(line);
}

namespace {

FacetLine facet_edge_line(const FacetView& view, std::uint32_t f, std::size_t k) {
  const Vec3 a = view.corner(f, k), d = view.corner(f, k + 1) - a;
  FacetLine line;
  line.facet = f, line.facet_edge = static_cast<int>(k);
  line.last = length(d);
  line.along = (1 / line.last) * d;
  line.first = dot(a, line.along);
  line.last += line.first;
  line.foot = a - line.first * line.along;
  line.off = view.slack;
  return line;
}

}  // namespace

void FacetCandidates::add_facet_edges() {
  for (std::size_t k = 0; k < view_.corners(f_); ++k) {
    add_line(facet_edge_line(view_, f_, k));
    FacetCandidate c;
    c.at = view_.corner(f_, k), c.off = view_.slack, c.corner = static_cast<int>(k);
    c.lower = length(c.at) - c.off;
    if (!(c.lower > within_)) candidates_.push_back(c);
  }
}

void FacetCandidates::add_neighbours() {
  Box box = view_.o.tree.box(f_), ball;
  ball.add(view_.from);
  ball.grow(within_ + 2 * view_.slack);
  box.grow(2 * view_.slack);
  box.low = {std::max(box.low.x, ball.low.x), std::max(box.low.y, ball.low.y), std::max(box.low.z, ball.low.z)};
  box.high = {std::min(box.high.x, ball.high.x), std::min(box.high.y, ball.high.y), std::min(box.high.z, ball.high.z)};
  view_.o.tree.for_each(box, [&](std::uint32_t g) {
    if (g == f_ || !may_cross(box, g)) return;
    const SumFacet &a = view_.o.facets[f_], &b = view_.o.facets[g];
    const double sine = length(cross(normal_, view_.o.normals[g]));
    if (sine < kFlat && is_parallel(frame_, a, b)) return add_level(g);
    if (!share_facet_edge(a, b)) add_across(g);
  });
}

/// Where the facet's part within reach meets another one lies in both boxes.
bool FacetCandidates::may_cross(const Box& part, std::uint32_t g) const {
  const Box& of = view_.o.tree.box(g);
  const double more = 2 * view_.slack;
  const auto low = [&](double a, double b) { return std::max(a, b - more); };
  const auto high = [&](double a, double b) { return std::min(a, b + more); };
  const Box both{{low(part.low.x, of.low.x), low(part.low.y, of.low.y), low(part.low.z, of.low.z)},
                 {high(part.high.x, of.high.x), high(part.high.y, of.high.y), high(part.high.z, of.high.z)}};
  return !(distance(both, view_.from) > within_ + more) && !view_.cover(both, within_);
}

void FacetCandidates::add_level(std::uint32_t g) {
  if (std::abs(dot(normal_, view_.corner(g, 0) - view_.corner(f_, 0))) > 2 * view_.slack) return;
  for (std::size_t k = 0; k < view_.corners(g); ++k) {
    FacetLine line = facet_edge_line(view_, g, k);
    line.kind = FacetLine::Kind::level;
    if (clip(f_, line)) add_line(line);
  }
}

void FacetCandidates::add_across(std::uint32_t g) {
  const Vec3 m = view_.o.normals[g], t = cross(normal_, m);
  const double sine = length(t);
  FacetLine line;
  line.kind = FacetLine::Kind::across, line.facet = g;
  if (sine >= kFlat) {
    const double d = dot(normal_, view_.corner(f_, 0)), e = dot(m, view_.corner(g, 0));
    line.along = (1 / sine) * t;
    line.foot = (1 / (sine * sine)) * (d * cross(m, t) + e * cross(t, normal_));
    line.off = 4 * view_.slack / sine;
  } else {
    const ExactPlane a = frame_.plane(view_.o.facets[f_]), b = frame_.plane(view_.o.facets[g]);
    const std::optional<ExactPosition> foot = ExactFrame::foot(a, b);
    const std::array<BigRational, 3> x = frame_.absolute(*foot);
    line.along = spatial::unit(exact::cross(a.n, b.n));
    line.foot = view_.o.scaled(x) - view_.from;
    line.off = 4 * view_.slack;
  }
  if (length(line.foot) - line.off > within_) return;
  const double reach = 4 * (1 + length(view_.from)) + length(line.foot);
  line.first = -reach, line.last = reach;
  if (clip(f_, line) && clip(g, line)) add_line(line);
}

/// Keeps the interval of a line in a facet's plane that may lie in the facet.
bool FacetCandidates::clip(std::uint32_t f, FacetLine& line) const {
  const Vec3 n = view_.o.normals[f];
  for (std::size_t k = 0; k < view_.corners(f); ++k) {
    const Vec3 a = view_.corner(f, k), d = view_.corner(f, k + 1) - a;
    const Vec3 inward = (1 / length(d)) * cross(n, d);
    // inward . (foot + s along - a) >= -off, the line's direction off by less than its positions.
    const double rise = dot(inward, line.along), at = dot(inward, line.foot - a) + line.off + view_.slack;
    const double rise_off = line.off + view_.slack, s = -at / rise;
    if (std::abs(rise) < 16 * rise_off) {
      if (at + (std::abs(rise) + rise_off) * (std::abs(line.first) + std::abs(line.last)) < 0) return false;
    } else if (rise > 0) {
      line.first = std::max(line.first, s - std::abs(s) * 2 * rise_off / rise);
    } else {
      line.last = std::min(line.last, s - std::abs(s) * 2 * rise_off / rise);
    }
    if (line.first > line.last) return false;
  }
  return true;
}

void FacetCandidates::add_feet() {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const FacetLine& line = lines_[i];
    if (line.kind == FacetLine::Kind::level) continue;  // one of the other facet
    if (line.kind == FacetLine::Kind::across && line.facet < f_) continue;
    if (line.first > line.off || line.last < -line.off) continue;
    FacetCandidate c;
    c.a = static_cast<int>(i), c.at = line.foot, c.off = line.off;
    c.lower = length(c.at) - c.off;
    if (!(c.lower > within_)) candidates_.push_back(c);
  }
}

void FacetCandidates::add_crossings() {
  using Kind = FacetLine::Kind;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const FacetLine& a = lines_[i];
    if (a.kind == Kind::level || (a.kind == Kind::across && a.facet < f_)) continue;
    for (std::size_t j = 0; j < lines_.size(); ++j) {
      const FacetLine& b = lines_[j];
      if (b.kind == Kind::own) continue;  // corners are listed by themselves
      const bool both_across = a.kind == Kind::across && b.kind == Kind::across;
      if (a.kind == Kind::across && (b.kind == Kind::level || b.facet < f_ || j <= i)) continue;
      if (both_across && a.facet == b.facet) continue;
      cross_lines(static_cast<int>(i), static_cast<int>(j));
    }
  }
}

/// Two intervals in one plane: each has its ends on both sides of the other one's line, or near it.
void FacetCandidates::cross_lines(int i, int j) {
  const FacetLine &a = lines_[static_cast<std::size_t>(i)], &b = lines_[static_cast<std::size_t>(j)];
  const double off = 8 * (a.off + b.off + view_.slack);
  const auto on_one_side = [&](const FacetLine& s, const FacetLine& l) {
    const Vec3 left = cross(normal_, l.along);
    const double from = dot(left, s.at(s.first) - l.foot), to = dot(left, s.at(s.last) - l.foot);
    return (from > off && to > off) || (from < -off && to < -off);
  };
  if (on_one_side(a, b) || on_one_side(b, a)) return;
  const Vec3 left = cross(normal_, b.along);
  const double rise = dot(left, a.along);
  FacetCandidate c;
  c.a = i, c.b = j;
  double s = 0.5 * (a.first + a.last);
  c.off = 0.5 * (a.last - a.first) + a.off;
  if (std::abs(rise) > 16 * off) {
    const double crossing = dot(left, b.foot - a.foot) / rise;
    const double crossing_off = 2 * off * (1 + std::abs(crossing)) / std::abs(rise);
    if (crossing_off < c.off) s = std::clamp(crossing, a.first, a.last), c.off = crossing_off + a.off;
  }
  c.at = a.at(s);
  c.lower = std::max({length(c.at) - c.off, a.distance(), b.distance()});
  if (!(c.lower > within_)) candidates_.push_back(c);
}

ExactPlane FacetCandidates::support(const FacetLine& line) const {
  const SumFacet& facet = view_.o.facets[line.facet];
  return line.kind == FacetLine::Kind::across ? frame_.plane(facet) : frame_.facet_edge(facet, line.facet_edge);
}

std::optional<ExactPosition> FacetCandidates::exact(const FacetCandidate& c) const {
  const SumFacet& facet = view_.o.facets[f_];
  if (c.corner >= 0)
    return ExactPosition{frame_.corner(facet.corner[static_cast<std::size_t>(c.corner)]), Big::from_int64(1)};
  const ExactPlane plane = frame_.plane(facet), a = support(lines_[static_cast<std::size_t>(c.a)]);
  return c.b < 0 ? ExactFrame::foot(plane, a)
                 : ExactFrame::meet(plane, a, support(lines_[static_cast<std::size_t>(c.b)]));
}

namespace {

constexpr double kNearlyFlat = 0x1p-12;

/// How a way from a to b lies to a facet: off it, inside of its facet edges, or unknown.
enum class Passage : std::uint8_t { off, within, unknown };

Passage passage_of(const FacetView& view, std::uint32_t g, Vec3 a, Vec3 b) {
  const Vec3 n = view.o.normals[g], o = view.corner(g, 0);
  const double margin = 8 * view.slack, from = spatial::dot(n, a - o), to = spatial::dot(n, b - o);
  if (std::min(from, to) > margin || std::max(from, to) < -margin) return Passage::off;
  bool within = true;
  for (std::size_t k = 0; k < view.corners(g); ++k) {
    const Vec3 c = view.corner(g, k), d = view.corner(g, k + 1) - c;
    const double size = spatial::length(d), reach = spatial::length(a - c) + spatial::length(b - c);
    const Vec3 inward = (1 / size) * spatial::cross(n, d);
    const double u = spatial::dot(inward, a - c), v = spatial::dot(inward, b - c);
    const double off = margin + reach * 0x1p-46 / size;
    if (std::max(u, v) < -off) return Passage::off;
    within = within && std::min(u, v) > off;
  }
  return within ? Passage::within : Passage::unknown;
}

}  // namespace

bool in_one_plane(const FacetView& view, const ExactFrame& frame, std::uint32_t f, std::uint32_t g) {
  if (f == g) return true;
  if (spatial::length(spatial::cross(view.o.normals[f], view.o.normals[g])) > kNearlyFlat) return false;
  const ExactPlane a = frame.plane(view.o.facets[f]), b = frame.plane(view.o.facets[g]);
  if (exact::leading_sign(exact::cross(a.n, b.n)) != 0) return false;
  return ExactFrame::side(a, {frame.corner(view.o.facets[g].corner[0]), Big::from_int64(1)}) == 0;
}

bool same_cell(const FacetView& view, const ExactFrame& frame, std::uint32_t facet, Vec3 a, Vec3 b) {
  spatial::Box box;
  box.add(view.from + a), box.add(view.from + b);
  box.grow(4 * view.slack);
  bool same = true;
  view.o.tree.for_each(box, [&](std::uint32_t g) {
    if (!same) return;
    const Passage way = passage_of(view, g, a, b);
    same = way == Passage::off || (way == Passage::within && in_one_plane(view, frame, facet, g));
  });
  return same;
}

}  // namespace dymsum::depth
