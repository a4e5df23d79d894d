#include "cspace/obstacle/convex_obstacle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/memory_budget.h"
#include "base/poll.h"
#include "exact/rounding_bound.h"
#include "planar/motion/orientation.h"

namespace dymsum::planar {
namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;

// An edge as a complex number: exactly, up to a positive factor that all edges of the operand share; and its direction
// in doubles, within 2^-50.
struct Direction {
  BigInteger x, y;
  double angle = 0;
};

std::vector<Direction> directions(const Operand& o, const Lattice& lattice) {
  std::vector<std::array<BigRational, 2>> exact;
  BigInteger common = 1;  // denominators are powers of two
  for (std::uint32_t i = 0; i < o.size(); ++i) {
    const Point a = o.points->input[o.source[i]], b = o.points->input[o.source[o.next[i]]];
    exact.push_back({BigRational(exact::exact_value(b.x) - exact::exact_value(a.x)),
                     BigRational(exact::exact_value(b.y) - exact::exact_value(a.y))});
    for (const BigRational& v : exact.back()) common = std::max(common, BigInteger(denominator(v)));
  }
  std::vector<Direction> all;
  for (std::uint32_t i = 0; i < o.size(); ++i) {
    const auto scaled = [&](const BigRational& v) {
      return BigInteger(numerator(v) * BigInteger(common / denominator(v)));
    };
    const Point d = lattice.vector(o.edge(i));
    all.push_back({scaled(exact[i][0]), scaled(exact[i][1]), std::atan2(d.y, d.x)});
  }
  return all;
}

// The alignment of a robot edge e with an obstacle edge f, R(theta) e and f having the same sense: theta is the
// argument of f times the conjugate of e.
struct EdgeAlignment {
  std::uint32_t e = 0, f = 0;
  double key = 0;  // theta within kKeyError, on the proper side of pi
};
// Two directions (an arc tangent of at most pi, 4, of a vector, 3), their difference and its sum with a whole turn, of
// less than 8 each.
constexpr double kKeyError = exact::rounding_bound(2 * (4 + 3) + 4 + 4 + 3, 32);

class ConvexMerge {
 public:
  ConvexMerge(planar::ObstacleState& state, const ObstacleOptions& options)
      : state_(state),
        options_(options),
        obstacle_(state.base->operands[0]),
        robot_(state.base->operands[1]),
        obstacle_edges_(directions(obstacle_, *state.base->lattice)),
        robot_edges_(directions(robot_, *state.base->lattice)) {}

  Result<void> run() {
    base::HeldMemory held;
    held.add(kOfPair * n() * m());
    if (!going_on(0)) return cancelled();
    align();
    if (!going_on(0.5)) return cancelled();
    for (std::uint32_t f = 0; f < m(); ++f)
      for (std::uint32_t r = 0; r < n(); ++r) add_fixed(f, r);
    for (std::uint32_t e = 0; e < n(); ++e)
      for (std::uint32_t o = 0; o < m(); ++o) add_rotating(e, o);
    finish();
    return {};
  }

 private:
  // The bytes of a pair of edges: an alignment, which may be an event at an angle of its own, with the digits of its
  // polynomial; and two contacts, each of which has up to three patches of one cell.
  static constexpr std::uint64_t kOfPair = 2 * sizeof(EdgeAlignment) + sizeof(ObstacleEvent) + sizeof(EventAngle) +
                                           sizeof(ExactAngle) + 256 + 6 * (2 * sizeof(Patch) + 48);
  std::uint32_t m() const { return static_cast<std::uint32_t>(obstacle_.size()); }
  std::uint32_t n() const { return static_cast<std::uint32_t>(robot_.size()); }
  bool going_on(double fraction) const { return !options_.progress || options_.progress("alignments", fraction); }

  BigInteger real(const EdgeAlignment& a) const {
    const Direction &e = robot_edges_[a.e], &f = obstacle_edges_[a.f];
    return e.x * f.x + e.y * f.y;
  }
  BigInteger imaginary(const EdgeAlignment& a) const {
    const Direction &e = robot_edges_[a.e], &f = obstacle_edges_[a.f];
    return e.x * f.y - e.y * f.x;
  }

  EdgeAlignment alignment(std::uint32_t e, std::uint32_t f) const {
    EdgeAlignment a{e, f, std::remainder(obstacle_edges_[f].angle - robot_edges_[e].angle, 2 * std::numbers::pi)};
    // Half a turn or a little more or less: the imaginary part distinguishes the sides.
    if (std::abs(a.key) > std::numbers::pi - kKeyError)
      a.key = std::copysign(a.key, imaginary(a).sign() < 0 ? -1.0 : 1.0);
    return a;
  }

  // The sign of a - b. Exact: keys apart decide; angles that close are in the order of the cross product.
  int compare(const EdgeAlignment& a, const EdgeAlignment& b) {
    if (a.key < b.key - 2 * kKeyError) return -1;
    if (a.key > b.key + 2 * kKeyError) return 1;
    ++state_.work.exact_signs;
    return BigInteger(imaginary(a) * real(b) - real(a) * imaginary(b)).sign();
  }

  // Sorts the alignments; equal angles become one.
  void align() {
    std::vector<EdgeAlignment> all;
    for (std::uint32_t e = 0; e < n(); ++e)
      for (std::uint32_t f = 0; f < m(); ++f) all.push_back(alignment(e, f));
    std::sort(all.begin(), all.end(), [&](const EdgeAlignment& a, const EdgeAlignment& b) {
      const int c = compare(a, b);
      return c != 0 ? c < 0 : std::pair{a.e, a.f} < std::pair{b.e, b.f};
    });
    angle_of_.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i == 0 || compare(all[i - 1], all[i]) != 0) add_angle(all[i]);
      const std::uint32_t angle = static_cast<std::uint32_t>(state_.angles.size() - 1);
      angle_of_[all[i].e * std::size_t{m()} + all[i].f] = angle;
      add_event(all[i], angle);
    }
  }

  // Let z = a + b i with a >= 0, or -z in chart 1: t is the root in (-1, 1] of b (1 - t^2) - 2 a t; the other one is
  // -1/t.
  void add_angle(const EdgeAlignment& at) {
    BigInteger a = real(at), b = imaginary(at);
    const int chart = a.sign() > 0 || (a.sign() == 0 && b.sign() > 0) ? 0 : 1;
    if (chart == 1) {
      a = -a;
      b = -b;
    }
    const BigInteger divisor = gcd(a, b);
    a /= divisor;
    b /= divisor;
    const exact::Polynomial f({Big(b), Big(BigInteger(-2 * a)), Big(BigInteger(-b))});
    state_.exact_angles.push_back({chart, exact::roots_in(f, -1, 1).front()});
    state_.angles.push_back(event_angle(state_.exact_angles.back()));
  }

  void add_event(const EdgeAlignment& a, std::uint32_t angle) {
    const double theta = state_.angles[angle].theta, c = std::cos(theta), s = std::sin(theta);
    const auto midpoint = [](const Operand& o, std::uint32_t i) {
      const Point u = o.points->input[o.source[i]], v = o.points->input[o.source[o.next[i]]];
      return Point{u.x / 2 + v.x / 2, u.y / 2 + v.y / 2};
    };
    const Point p = midpoint(obstacle_, a.f), q = midpoint(robot_, a.e);
    state_.events.push_back(
        {ObstacleEvent::Kind::alignment, angle, {p.x + (c * q.x - s * q.y), p.y + (s * q.x + c * q.y)}});
  }

  std::uint32_t angle(std::uint32_t e, std::uint32_t f) const { return angle_of_[e * std::size_t{m()} + f]; }
  std::uint32_t after(std::uint32_t a, std::uint32_t b) const {
    return b >= a ? b - a : b + static_cast<std::uint32_t>(state_.angles.size()) - a;
  }

  Contact fixed(std::uint32_t f, std::uint32_t r) const {
    return {Contact::Kind::edge_of_p, obstacle_.edge_index[f], robot_.vertex_index[r]};
  }
  Contact rotating(std::uint32_t e, std::uint32_t o) const {
    return {Contact::Kind::edge_of_q, obstacle_.vertex_index[o], robot_.edge_index[e]};
  }

  // Obstacle edge f + robot vertex r, while the direction of f is between those of the edges at r: from its alignment
  // with the edge after r until that with the edge before r. Walk edge i starts at walk vertex i.
  void add_fixed(std::uint32_t f, std::uint32_t r) {
    const std::uint32_t e_in = robot_.prev[r], e_out = r, f_in = obstacle_.prev[f], f_out = obstacle_.next[f];
    const std::uint32_t begin = angle(e_out, f), end = angle(e_in, f);
    const Neighbours left{late_swap(begin, end, angle(e_in, f_in)), fixed(f_in, r), rotating(e_in, f)};
    const Neighbours right{early_swap(begin, end, angle(e_out, f_out)), rotating(e_out, f_out), fixed(f_out, r)};
    add_patches(fixed(f, r), begin, end, left, right);
  }

  // Robot edge e + obstacle vertex o: from the alignment with the edge before o until that with the edge after it.
  void add_rotating(std::uint32_t e, std::uint32_t o) {
    const std::uint32_t f_in = obstacle_.prev[o], f_out = o, e_in = robot_.prev[e], e_out = robot_.next[e];
    const std::uint32_t begin = angle(e, f_in), end = angle(e, f_out);
    const Neighbours left{early_swap(begin, end, angle(e_in, f_in)), fixed(f_in, e), rotating(e_in, o)};
    const Neighbours right{late_swap(begin, end, angle(e_out, f_out)), rotating(e_out, o), fixed(f_out, e_out)};
    add_patches(rotating(e, o), begin, end, left, right);
  }

  // On either side of a contact there is the nearer of two directions, an edge of each operand; the second one becomes
  // the nearer at their alignment.
  struct Neighbours {
    std::uint32_t swap = 0;  // slabs after the begin of the contact, at most its length
    Contact first, then;
  };

  // The swap of an alignment that comes after the begin by less than pi, or comes before the end by less than pi.
  std::uint32_t early_swap(std::uint32_t begin, std::uint32_t end, std::uint32_t at) const {
    return std::min(after(begin, at), after(begin, end));
  }
  std::uint32_t late_swap(std::uint32_t begin, std::uint32_t end, std::uint32_t at) const {
    return after(begin, at) < after(begin, end) ? after(begin, at) : 0;
  }

  void add_patches(const Contact& contact, std::uint32_t begin, std::uint32_t end, const Neighbours& left,
                   const Neighbours& right) {
    std::array<std::uint32_t, 4> cuts{0, left.swap, right.swap, after(begin, end)};
    std::sort(cuts.begin(), cuts.end());
    const std::uint32_t slabs = static_cast<std::uint32_t>(state_.angles.size());
    for (std::size_t k = 0; k < 3; ++k) {
      if (cuts[k] == cuts[k + 1]) continue;
      Patch p;
      p.contact = contact;
      p.left = cuts[k] < left.swap ? left.first : left.then;
      p.right = cuts[k] < right.swap ? right.first : right.then;
      p.left_corner = p.right_corner = true;
      p.begin = (begin + cuts[k]) % slabs;
      p.end = (begin + cuts[k + 1]) % slabs;
      state_.patches.push_back(p);
    }
    ++state_.work.surfaces;
  }

  // The boundary is one closed curve at every angle, and the curves of a whole turn form a torus: Euler number 0.
  // Around it there is one free cell.
  void finish() {
    Shell shell;
    shell.patches = static_cast<std::uint32_t>(state_.patches.size());
    state_.shells.push_back(shell);
    FreeCell cell;
    cell.unbounded = true;
    state_.cells.push_back(cell);
    for (const Patch& p : state_.patches) state_.patch_cells.push_back({{p.begin, 0}});
    ObstacleWork& work = state_.work;
    work.segments = m() + n();
    work.potential_events = work.alignments = std::uint64_t{m()} * n();
    work.visible_events = work.local_updates = state_.angles.size();
  }

  planar::ObstacleState& state_;
  const ObstacleOptions& options_;
  const Operand &obstacle_, &robot_;
  std::vector<Direction> obstacle_edges_, robot_edges_;
  std::vector<std::uint32_t> angle_of_;  // [robot edge][obstacle edge] -> index of the angle
};

}  // namespace

bool is_convex_pair(const planar::ObstacleState& state) {
  return std::all_of(state.base->operands.begin(), state.base->operands.end(), [](const Operand& o) {
    return o.components.size() == 1 && o.components[0].convex && o.loops.size() == 1;
  });
}

Result<void> convex_obstacle(planar::ObstacleState& state, const ObstacleOptions& options) {
  return ConvexMerge(state, options).run();
}

}  // namespace dymsum::planar
