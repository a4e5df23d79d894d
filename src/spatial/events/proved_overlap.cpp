#include "spatial/events/proved_overlap.h"

#include <algorithm>
#include <cmath>

namespace dymsum::spatial {

namespace {

double size1(Vec3 v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); }

/// The sign of det(u, v, w), each component of which is within `blur`; 0 where that does not decide.
int proved_det(Vec3 u, Vec3 v, Vec3 w, double blur) {
  const double U = size1(u) + 3 * blur, V = size1(v) + 3 * blur, W = size1(w) + 3 * blur;
  const double value = dot(u, cross(v, w)), error = 3 * blur * (U * V + V * W + U * W) + U * V * W * 0x1p-48;
  return value > error ? 1 : value < -error ? -1 : 0;
}

enum class Pierce : std::uint8_t { no, yes, unsure };

/// Whether the segment pq passes through the inside of the triangle; `hp`, `hq` are the sides of its plane.
Pierce pierce(Vec3 p, Vec3 q, int hp, int hq, const Vec3 (&t)[3], double blur) {
  if (hp * hq > 0) return Pierce::no;
  bool unsure = hp * hq == 0;
  int turn = 0;
  for (int k = 0; k < 3; ++k) {
    const int s = proved_det(q - p, t[k] - p, t[(k + 1) % 3] - p, blur);
    if (s == 0) unsure = true;
    else if (turn * s < 0) return Pierce::no;
    else turn = s;
  }
  return unsure ? Pierce::unsure : Pierce::yes;
}

BoxTree tree_of(const SolidOperand& solid, const std::vector<Vec3>& positions) {
  std::vector<Box> boxes(solid.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (const std::uint32_t v : solid.triangles[t]) boxes[t].add(positions[v]);
  return BoxTree(std::move(boxes));
}

InnerBalls balls_on_grid(const ScalingPair& all, int op) {
  const double unit = std::ldexp(1.0, -all.pair().p_positions.exponent);
  InnerBalls balls = inner_balls(all.operand(op));
  for (InnerBalls::Ball& ball : balls.balls) ball.centre = unit * ball.centre, ball.radius *= unit;
  return balls;
}

}  // namespace

ProvedOverlap::ProvedOverlap(const SolidOperand& f, std::vector<Vec3> f_positions, const SolidOperand& m,
                             std::vector<Vec3> m_positions)
    : f_(f), m_(m), f_positions_(std::move(f_positions)), m_positions_(std::move(m_positions)) {
  f_tree_ = tree_of(f_, f_positions_), m_tree_ = tree_of(m_, m_positions_);
}

ProvedOverlap::Answer ProvedOverlap::triangles(const Position& at, std::uint32_t i, std::uint32_t j) const {
  Vec3 a[3], b[3];
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = f_positions_[f_.triangles[i][k]];
    b[k] = at.x - at.s * m_positions_[m_.triangles[j][k]];
  }
  int ha[3], hb[3];
  for (int k = 0; k < 3; ++k) hb[k] = proved_det(a[1] - a[0], a[2] - a[0], b[k] - a[0], at.blur);
  if (hb[0] * hb[1] > 0 && hb[1] * hb[2] > 0) return Answer::apart;
  for (int k = 0; k < 3; ++k) ha[k] = proved_det(b[1] - b[0], b[2] - b[0], a[k] - b[0], at.blur);
  if (ha[0] * ha[1] > 0 && ha[1] * ha[2] > 0) return Answer::apart;
  bool unsure = false;
  for (int k = 0; k < 3; ++k) {
    for (const Pierce p : {pierce(a[k], a[(k + 1) % 3], ha[k], ha[(k + 1) % 3], b, at.blur),
                           pierce(b[k], b[(k + 1) % 3], hb[k], hb[(k + 1) % 3], a, at.blur)}) {
      if (p == Pierce::yes) return Answer::overlap;
      unsure |= p == Pierce::unsure;
    }
  }
  return unsure ? Answer::unsure : Answer::apart;
}

/// Whether a shell of one solid lies in the other one, where the surfaces are apart.
bool ProvedOverlap::contained(const Position& at, double far, bool& proved) const {
  const auto inside = [&](const SolidOperand& solid, auto position, Vec3 from) {
    const Vec3 to = from + far * Vec3{0.5377, 0.6431, 0.5453};
    bool in = false;
    for (const Triangle& t : solid.triangles) {
      const Vec3 c[3] = {position(t[0]), position(t[1]), position(t[2])};
      const int hp = proved_det(c[1] - c[0], c[2] - c[0], from - c[0], at.blur),
                hq = proved_det(c[1] - c[0], c[2] - c[0], to - c[0], at.blur);
      const Pierce p = pierce(from, to, hp, hq, c, at.blur);
      if (p == Pierce::unsure) proved = false;
      in ^= p == Pierce::yes;
    }
    return in;
  };
  const auto of_f = [&](std::uint32_t v) { return f_positions_[v]; };
  const auto of_m = [&](std::uint32_t v) { return at.x - at.s * m_positions_[v]; };
  for (const std::uint32_t v : m_.shell_vertex)
    if (inside(f_, of_f, of_m(v))) return true;
  for (const std::uint32_t v : f_.shell_vertex)
    if (inside(m_, of_m, of_f(v))) return true;
  return false;
}

ProvedOverlap::Answer ProvedOverlap::surfaces(const Position& at) const {
  Box box;
  box.add(at.x), box.grow(2 * at.blur);
  bool unsure = false;
  const bool cross = f_tree_.any_reflected_pair(m_tree_, box, at.s, [&](std::uint32_t i, std::uint32_t j) {
    const Answer answer = triangles(at, i, j);
    unsure |= answer == Answer::unsure;
    return answer == Answer::overlap;
  });
  return cross ? Answer::overlap : unsure ? Answer::unsure : Answer::apart;
}

ProvedOverlap::Answer ProvedOverlap::at(const Position& at, double far) const {
  const Answer answer = surfaces(at);
  if (answer != Answer::apart) return answer;
  bool proved = true;
  const bool in = contained(at, far, proved);
  return !proved ? Answer::unsure : in ? Answer::overlap : Answer::apart;
}

ScaledOverlap::ScaledOverlap(const ScalingPair& all)
    : all_(all),
      solids_(all.operand(1 - all.moving()), all.positions(1 - all.moving()), all.operand(all.moving()),
              all.positions(all.moving())),
      f_balls_(balls_on_grid(all, 1 - all.moving())),
      m_balls_(balls_on_grid(all, all.moving())) {}

double ScaledOverlap::gap(BallPair pair, Vec3 x, double s) const {
  const InnerBalls::Ball &a = f_balls_.balls[pair.f], &b = m_balls_.balls[pair.m];
  return length(x - a.centre - s * b.centre) - (a.radius + s * b.radius) * (1 - 0x1p-40);
}

/// Downhill from the best of some pairs.
ScaledOverlap::BallPair ScaledOverlap::nearest_balls(Vec3 x, double s) const {
  const auto some = [](const InnerBalls& of) {
    return static_cast<std::uint32_t>(std::min<std::size_t>(of.balls.size(), 14));
  };
  BallPair best;
  double least = 1e300;
  const auto try_pair = [&](BallPair pair) {
    const double g = gap(pair, x, s);
    if (g >= least) return false;
    least = g, best = pair;
    return true;
  };
  for (std::uint32_t i = 0; i < some(f_balls_); ++i)
    for (std::uint32_t j = 0; j < some(m_balls_); ++j) try_pair({i, j});
  for (bool better = true; better;) {
    better = false;
    const BallPair from = best;
    for (const std::uint32_t i : f_balls_.neighbours[from.f]) better |= try_pair({i, from.m});
    for (const std::uint32_t j : m_balls_.neighbours[from.m]) better |= try_pair({from.f, j});
  }
  return best;
}

// The distance of a moving corner from a moving centre, less the radius, is a convex function of s: what holds at both
// ends holds between them.
bool ScaledOverlap::deep_inside(const SumFacet& facet, double low, double high) const {
  if (!has_balls()) return false;
  const double s = (low + high) / 2, margin = all_.span(high) * 0x1p-38;
  Vec3 midpoint;
  for (int k = 0; k < facet.corners; ++k) midpoint = midpoint + 1.0 / facet.corners * all_.at(facet.corner[k], s);
  const BallPair pair = nearest_balls(midpoint, s);
  for (int k = 0; k < facet.corners; ++k)
    for (const double end : {low, high})
      if (gap(pair, all_.at(facet.corner[k], end), end) > -margin) return false;
  return true;
}

ScaledOverlap::Answer ScaledOverlap::at(Vec3 x, double s, double radius, double s_radius) const {
  const double span = all_.span(s), blur = 2 * (radius + s_radius * span / std::max(s, 1e-300)) + span * 0x1p-49;
  if (has_balls() && gap(nearest_balls(x, s), x, s) < -(2 * blur + span * 0x1p-40)) return Answer::overlap;
  return solids_.at({x, s, blur}, 8 * span);
}

}  // namespace dymsum::spatial
