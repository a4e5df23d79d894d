#include "spatial/moving/inner_facets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "spatial/convolution/inner_cells.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::spatial {
namespace {

constexpr std::size_t kMostTried = 200;

/// The nearest point of a segment or a triangle.
Vec3 nearest_on(Vec3 x, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double t = dot(x - a, d) / dot(d, d);
  return t <= 0 ? a : t >= 1 ? b : a + t * d;
}
Vec3 nearest_on(Vec3 x, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = cross(b - a, c - a);
  const auto outside = [&](Vec3 u, Vec3 v) { return dot(cross(v - u, x - u), n) < 0; };
  if (!outside(a, b) && !outside(b, c) && !outside(c, a)) return x - (dot(x - a, n) / dot(n, n)) * n;
  const Vec3 of[3] = {nearest_on(x, a, b), nearest_on(x, b, c), nearest_on(x, c, a)};
  const Vec3* best = &of[0];
  for (const Vec3& p : of)
    if (length(x - p) < length(x - *best)) best = &p;
  return *best;
}

class Finder {
 public:
  explicit Finder(const SolidOperand& solid) : solid_(solid) {
    for (const Point3& v : solid.vertices) at_.push_back({v.x, v.y, v.z}), box_.add(at_.back());
    // Far more than doubles lose of a distance in the solid; nothing is gained from balls that small.
    margin_ = (length(box_.high) + length(box_.low)) * 0x1p-24;
  }

  std::vector<InnerBalls::Ball> run() const {
    const std::size_t count = solid_.triangles.size(), step = (count + kMostTried - 1) / kMostTried;
    std::vector<InnerBalls::Ball> found, chosen;
    for (std::size_t t = 0; t < count; t += step) {
      const InnerBalls::Ball ball = touching(t);
      if (ball.radius > margin_) found.push_back(ball);
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.radius > b.radius; });
    for (const InnerBalls::Ball& ball : found) {
      const bool known = std::any_of(chosen.begin(), chosen.end(), [&](const InnerBalls::Ball& other) {
        return length(ball.centre - other.centre) < 0.4 * other.radius;
      });
      if (!known && is_inside(ball.centre)) chosen.push_back(ball);
    }
    return spread(chosen);
  }

 private:
  /// The largest first, then always the one furthest from those before it: the first ones stand for all.
  static std::vector<InnerBalls::Ball> spread(std::vector<InnerBalls::Ball> balls) {
    std::vector<double> far(balls.size(), 1e300);
    for (std::size_t k = 0; k + 1 < balls.size(); ++k) {
      std::size_t next = k + 1;
      for (std::size_t i = k + 1; i < balls.size(); ++i) {
        far[i] = std::min(far[i], length(balls[i].centre - balls[k].centre));
        if (far[i] > far[next]) next = i;
      }
      std::swap(balls[k + 1], balls[next]), std::swap(far[k + 1], far[next]);
    }
    return balls;
  }

  Vec3 nearest(Vec3 x) const {
    Vec3 best = at_[solid_.triangles[0][0]];
    double least = length(x - best);
    for (const Triangle& t : solid_.triangles) {
      const Vec3 p = nearest_on(x, at_[t[0]], at_[t[1]], at_[t[2]]);
      if (const double d = length(x - p); d < least) least = d, best = p;
    }
    return best;
  }

  /// The largest ball inside that touches the centre of a triangle, or about that.
  InnerBalls::Ball touching(std::size_t triangle) const {
    const Triangle& t = solid_.triangles[triangle];
    const Vec3 a = at_[t[0]], b = at_[t[1]], c = at_[t[2]], m = 1.0 / 3 * (a + b + c), up = cross(b - a, c - a);
    const Vec3 n = (1 / length(up)) * up;
    double r = 0.5 * length(box_.high - box_.low);
    for (int k = 0; k < 12; ++k) {
      const Vec3 s = nearest(m - r * n);
      const double far = dot(s - m, s - m), below = dot(m - s, n);
      if (!(below > 0) || far / (2 * below) > r * (1 - 0x1p-10)) break;
      r = far / (2 * below);
    }
    const Vec3 centre = m - r * n;
    return {centre, length(centre - nearest(centre)) * (1 - 0x1p-20) - margin_};
  }

  /// Whether x is inside, by a ray; one that passes too near an edge says nothing.
  bool is_inside(Vec3 x) const {
    bool inside = false;
    for (const Triangle& t : solid_.triangles) {
      const int pass = passes_upward(x, at_[t[0]], at_[t[1]], at_[t[2]], margin_ * 0x1p-16);
      if (pass < 0) return false;
      inside ^= pass == 1;
    }
    return inside;
  }

  const SolidOperand& solid_;
  std::vector<Vec3> at_;
  Box box_;
  double margin_ = 0;
};

}  // namespace

InnerBalls inner_balls(const SolidOperand& solid) {
  InnerBalls result{Finder(solid).run(), {}};
  const std::vector<InnerBalls::Ball>& balls = result.balls;
  const auto count = static_cast<std::uint32_t>(balls.size());
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t k = 0; k < count; ++k) order[k] = k;
    const std::size_t some = std::min<std::size_t>(InnerBalls::kNeighbours + 1, count);
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(some), order.end(),
                      [&](std::uint32_t a, std::uint32_t b) {
                        const double x = length(balls[a].centre - balls[i].centre),
                                     y = length(balls[b].centre - balls[i].centre);
                        return x != y ? x < y : a < b;
                      });
    std::array<std::uint32_t, InnerBalls::kNeighbours>& near = result.neighbours.emplace_back();
    for (std::size_t k = 0; k < near.size(); ++k) near[k] = k + 1 < some ? order[k + 1] : i;
  }
  return result;
}

InnerFacets::InnerFacets(const SolidPair& pair) : own_{inner_balls(pair.p), inner_balls(pair.q)} {}

void InnerFacets::move(const PosedSpace& at, const PosePair& poses) {
  space_ = at.space.get();
  kept_ = tested_ = 0, last_ = kUnknown;
  margin_ = 8 * space_->sum_radius() + space_->span() * 0x1p-40;
  const double unit = std::ldexp(exact::round_to_double(exact::BigRational(at.scale)), -space_->line(0).unit);
  for (int op = 0; op < 2; ++op) {
    const SolidPose& pose = op == 0 ? poses.p : poses.q;
    const Mat3 turn = matrix_of(relative_rotation(Rotation(), pose.rotation));
    const Vec3 s = scale_factors(pose);
    // A scaled ball holds the ball of its least half-axis.
    const double least = unit * std::min({s.x, s.y, s.z}) * (1 - 0x1p-40);
    posed_[op].clear();
    for (const InnerBalls::Ball& ball : own_[op].balls) {
      const Vec3& m = ball.centre;
      posed_[op].push_back({unit * (turn * Vec3{s.x * m.x, s.y * m.y, s.z * m.z}), least * ball.radius});
    }
  }
  make_some();
}

/// Sums of some balls of either operand.
void InnerFacets::make_some() {
  some_ = {};
  const auto some = [](const std::vector<InnerBalls::Ball>& balls) {
    return static_cast<std::uint32_t>(std::min<std::size_t>(balls.size(), 20));
  };
  for (std::uint32_t i = 0; i < some(posed_[0]); ++i) {
    for (std::uint32_t j = 0; j < some(posed_[1]); ++j) {
      const InnerBalls::Ball &a = posed_[0][i], &b = posed_[1][j];
      const Vec3 centre = a.centre + b.centre;
      some_.x.push_back(centre.x), some_.y.push_back(centre.y), some_.z.push_back(centre.z);
      some_.radius.push_back(a.radius + b.radius), some_.pair.push_back({i, j});
    }
  }
}

/// A ball holds all of a facet with its corners.
bool InnerFacets::covers(BallPair pair, const SumFacet& facet) const {
  for (int k = 0; k < facet.corners; ++k)
    if (gap(pair, space_->approx(facet.corner[k])) > -margin_) return false;
  return true;
}

bool InnerFacets::hold(std::uint32_t slot, const SumFacet& facet) {
  if (posed_[0].empty() || posed_[1].empty()) return false;
  BallPair& pair = pairs_[slot];
  if (pair.p != kUnknown.p && covers(pair, facet)) {
    ++kept_;
    last_ = pair;
    return true;
  }
  ++tested_;
  Vec3 centre;
  for (int k = 0; k < facet.corners; ++k) centre = centre + 1.0 / facet.corners * space_->approx(facet.corner[k]);
  if (pair.p != kUnknown.p) {
    pair = descend(pair, centre);
  } else {
    // Facets come in an order in which neighbours are often near to one another.
    if (last_.p != kUnknown.p) pair = descend(last_, centre);
    if (pair.p == kUnknown.p || !covers(pair, facet)) pair = search(centre);
  }
  last_ = pair;
  return covers(pair, facet);
}

/// Searches from the best pairs of those that stand for all others.
InnerFacets::BallPair InnerFacets::search(Vec3 x) {
  constexpr std::size_t kStarts = 4;
  std::array<std::pair<double, BallPair>, kStarts> starts;
  starts.fill({std::numeric_limits<double>::infinity(), {0, 0}});
  // Balls are compared by their powers, many at a time: roots would take longer than all else.
  powers_.resize(some_.x.size());
  for (std::size_t k = 0; k < powers_.size(); ++k) {
    const double dx = x.x - some_.x[k], dy = x.y - some_.y[k], dz = x.z - some_.z[k], r = some_.radius[k];
    powers_[k] = dx * dx + dy * dy + dz * dz - r * r;
  }
  for (std::size_t k = 0; k < powers_.size(); ++k) {
    if (powers_[k] >= starts.back().first) continue;
    std::size_t at = kStarts - 1;
    for (; at > 0 && powers_[k] < starts[at - 1].first; --at) starts[at] = starts[at - 1];
    starts[at] = {powers_[k], some_.pair[k]};
  }
  BallPair best = starts[0].second;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [value, start] : starts) {
    const BallPair end = descend(start, x);
    if (const double g = gap(end, x); g < least) least = g, best = end;
  }
  return best;
}

InnerFacets::BallPair InnerFacets::descend(BallPair from, Vec3 x) const {
  BallPair best = from;
  double least = gap(best, x);
  for (bool better = true; better;) {
    better = false;
    const auto try_pair = [&](BallPair other) {
      if (const double g = gap(other, x); g < least) least = g, best = other, better = true;
    };
    const BallPair at = best;
    for (const std::uint32_t i : own_[0].neighbours[at.p]) try_pair({i, at.q});
    for (const std::uint32_t j : own_[1].neighbours[at.q]) try_pair({at.p, j});
  }
  return best;
}

}  // namespace dymsum::spatial
