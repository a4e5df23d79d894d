#include "planar/operand/fraction_lattice.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <unordered_map>

#include "exact/grid.h"
#include "planar/operand/lattice.h"
#include "planar/operand/make_lattice.h"

namespace dymsum::planar {
namespace {

using exact::BigInteger;
using exact::HomogeneousPoint;

// num 2^shift / den, rounded once; of a nonzero one that underflows the smallest number of its sign.
double rounded(const BigInteger& num, const BigInteger& den, int shift) {
  const double nearest = shift == 0  ? exact::round_to_double(num, den)
                         : shift > 0 ? exact::round_to_double(BigInteger(num << shift), den)
                                     : exact::round_to_double(num, BigInteger(den << -shift));
  return with_sign_of(num.sign(), nearest);
}

// The largest double that is no larger than num / den.
double rounded_down(const BigInteger& num, const BigInteger& den) {
  const double nearest = exact::round_to_double(num, den);
  if (!std::isfinite(nearest)) return nearest;
  const exact::Dyadic d = exact::to_dyadic(nearest);
  const BigInteger product = BigInteger(d.mantissa) * den;
  const bool above =
      d.exponent >= 0 ? BigInteger(product << d.exponent) > num : product > BigInteger(num << -d.exponent);
  return above ? std::nextafter(nearest, -INFINITY) : nearest;
}

// num / den - offset in units of 2^unit, rounded once.
double coordinate(const BigInteger& num, const BigInteger& den, double offset, int unit) {
  const exact::Dyadic d = exact::to_dyadic(offset);
  const BigInteger product = BigInteger(d.mantissa) * den;
  if (d.exponent >= 0) return rounded(BigInteger(num - (product << d.exponent)), den, -unit);
  return rounded(BigInteger((num << -d.exponent) - product), BigInteger(den << -d.exponent), -unit);
}

// The exponent of a coordinate over a power of two; nothing for other fractions and for zero.
std::optional<int> exponent_of(const BigInteger& num, const BigInteger& den) {
  if (num.is_zero() || msb(den) != lsb(den)) return std::nullopt;
  return static_cast<int>(lsb(abs(num))) - static_cast<int>(lsb(den));
}

}  // namespace

HomogeneousPoint FractionPoints::difference(std::uint32_t from, std::uint32_t to) const {
  const HomogeneousPoint &a = at[from], &b = at[to];
  if (a.w == b.w) return {b.x - a.x, b.y - a.y, a.w};
  return {b.x * a.w - a.x * b.w, b.y * a.w - a.y * b.w, a.w * b.w};
}

Point FractionPoints::vector(std::uint32_t from, std::uint32_t to, int unit) const {
  const HomogeneousPoint d = difference(from, to);
  return {rounded(d.x, d.w, -unit), rounded(d.y, d.w, -unit)};
}

Point FractionPoints::direction(std::uint32_t from, std::uint32_t to) const {
  const HomogeneousPoint d = difference(from, to);
  const auto top = [](const BigInteger& v) { return v.is_zero() ? 0 : msb(BigInteger(abs(v))); };
  const auto longer = std::max(top(d.x), top(d.y)), shift = longer > 61 ? longer - 61 : 0;
  const auto leading = [&](const BigInteger& v) {
    const auto bits = static_cast<std::int64_t>(static_cast<std::uint64_t>(BigInteger(abs(v)) >> shift));
    return with_sign_of(v.sign(), static_cast<double>(v.sign() < 0 ? -bits : bits));
  };
  return {leading(d.x), leading(d.y)};
}

int FractionPoints::compare(std::uint32_t i, std::uint32_t j, int axis) const {
  const Point &p = nearest[i], &q = nearest[j];
  if (const double gap = axis == 0 ? p.x - q.x : p.y - q.y; gap != 0) return gap > 0 ? 1 : -1;
  const HomogeneousPoint &a = at[i], &b = at[j];
  const BigInteger &u = axis == 0 ? a.x : a.y, &v = axis == 0 ? b.x : b.y;
  const int order = a.w == b.w ? u.compare(v) : BigInteger(u * b.w).compare(BigInteger(v * a.w));
  return (order > 0) - (order < 0);
}

int FractionPoints::cross(const Edge& d, const Edge& e) const {
  const HomogeneousPoint a = difference(d.from, d.to), b = difference(e.from, e.to);
  return BigInteger(a.x * b.y - a.y * b.x).sign();
}

int FractionPoints::dot(const Edge& d, const Edge& e) const {
  const HomogeneousPoint a = difference(d.from, d.to), b = difference(e.from, e.to);
  return BigInteger(a.x * b.x + a.y * b.y).sign();
}

void fractions_in_units(PlacedPoints& points, int unit) {
  points.unit = unit;
  points.x.clear();
  points.y.clear();
  points.width = points.height = 0;
  for (const HomogeneousPoint& v : points.fractions->at) {
    points.x.push_back(coordinate(v.x, v.w, points.offset.x, unit));
    points.y.push_back(coordinate(v.y, v.w, points.offset.y, unit));
    points.width = std::max(points.width, points.x.back());
    points.height = std::max(points.height, points.y.back());
  }
}

std::shared_ptr<const PlacedPoints> fractions_as_points(std::vector<HomogeneousPoint> at) {
  auto points = std::make_shared<PlacedPoints>();
  auto fractions = std::make_shared<FractionPoints>(FractionPoints{std::move(at), {}});
  for (const HomogeneousPoint& v : fractions->at)
    points->input.push_back({exact::round_to_double(v.x, v.w), exact::round_to_double(v.y, v.w)});
  fractions->nearest = points->input;
  std::uint32_t min_x = 0, min_y = 0;
  std::optional<int> exponent;
  for (std::uint32_t i = 0; i < fractions->at.size(); ++i) {
    const HomogeneousPoint& v = fractions->at[i];
    if (fractions->compare(i, min_x, 0) < 0) min_x = i;
    if (fractions->compare(i, min_y, 1) < 0) min_y = i;
    for (const BigInteger* num : {&v.x, &v.y})
      if (const std::optional<int> own = exponent_of(*num, v.w)) exponent = std::min(*own, exponent.value_or(*own));
  }
  points->offset = {rounded_down(fractions->at[min_x].x, fractions->at[min_x].w),
                    rounded_down(fractions->at[min_y].y, fractions->at[min_y].w)};
  points->fractions = std::move(fractions);
  points->exponent = exponent.value_or(0);
  fractions_in_units(*points, 0);
  points->extent = std::max(points->width, points->height);
  points->top = top_of(points->extent);
  if (!points->moderate()) fractions_in_units(*points, unit_for(points->extent, points->exponent, kNarrowBits));
  return points;
}

Point LatticeDoubles::fraction_vector(const PlacedPoints& points, const Edge& e) {
  return points.fractions->vector(e.from, e.to, points.unit);
}

Point LatticeDoubles::fraction_direction(const PlacedPoints& points, const Edge& e) {
  return points.fractions->direction(e.from, e.to);
}

// The exact layer of operands whose vertices are fractions: lines and positions in integers of any size. A line of an
// edge keeps the numbers of the first operands, in lowest terms, however many operations lie between (the lemma of
// docs/design/planar-operand.md), so neither these numbers nor those of positions grow with the depth.

namespace {

using exact::Big;
using Vec = exact::HomogeneousPoint;

Vec sum_of(const Vec& a, const Vec& b) {
  if (a.w == b.w) return {a.x + b.x, a.y + b.y, a.w};
  if (b.w == 1) return {a.x + b.x * a.w, a.y + b.y * a.w, a.w};
  if (a.w == 1) return {a.x * b.w + b.x, a.y * b.w + b.y, b.w};
  return {a.x * b.w + b.x * a.w, a.y * b.w + b.y * a.w, a.w * b.w};
}
Vec difference_of(const Vec& a, const Vec& b) { return sum_of(a, {-b.x, -b.y, b.w}); }
BigInteger cross_of(const Vec& a, const Vec& b) { return a.x * b.y - a.y * b.x; }
int compare_fractions(const BigInteger& a, const BigInteger& aw, const BigInteger& b, const BigInteger& bw) {
  const int order = aw == bw ? a.compare(b) : BigInteger(a * bw).compare(BigInteger(b * aw));
  return (order > 0) - (order < 0);
}

/// { x : direction x x = height / w }: w > 0; the direction is that of the segment, in integers.
struct Line {
  BigInteger dx, dy, height, w;
};
// A common factor of a numerator and its denominator is divided out.
void lower(BigInteger& n, BigInteger& d) {
  if (d == 1) return;
  const BigInteger common = gcd(n, d);
  n /= common;
  d /= common;
}

class FractionLattice final : public Lattice {
 public:
  explicit FractionLattice(LatticeDoubles doubles) : Lattice(std::move(doubles)) {
    for (std::uint32_t op = 0; op < 2; ++op) {
      if (points[op]->fractions != nullptr)
        for (const Vec& v : points[op]->fractions->at) vertices_[op].push_back(on_grid(v));
      else
        for (const Point& v : points[op]->input)
          vertices_[op].push_back({exact::grid_coordinate<Big>(v.x, grid_exponent).value(),
                                   exact::grid_coordinate<Big>(v.y, grid_exponent).value(), 1});
    }
  }

  int cross(const Edge& d, const Edge& e) const override {
    const Line &a = line(d), &b = line(e);
    return BigInteger(a.dx * b.dy - a.dy * b.dx).sign();
  }
  int dot(const Edge& d, const Edge& e) const override {
    const Line &a = line(d), &b = line(e);
    return BigInteger(a.dx * b.dx + a.dy * b.dy).sign();
  }
  int compare_extent(const Edge& d, const Edge& e, int axis) const override {
    const Vec a = vector_of(d), b = vector_of(e);
    return axis == 0 ? compare_fractions(a.x, a.w, b.x, b.w) : compare_fractions(a.y, a.w, b.y, b.w);
  }
  int side(const Segment& s, Pair v) const override { return side_of(s, sum(v)); }
  int along(const Segment& s, Pair v) const override { return along_of(s, sum(v)); }
  bool same(Pair a, Pair b) const override {
    return compare_coordinate(a, b, 0) == 0 && compare_coordinate(a, b, 1) == 0;
  }
  int compare_coordinate(Pair a, Pair b, int axis) const override {
    if (a.p == b.p) return compare_at(vertices_[1][a.q], vertices_[1][b.q], axis);
    if (a.q == b.q) return compare_at(vertices_[0][a.p], vertices_[0][b.p], axis);
    return compare_at(sum(a), sum(b), axis);
  }
  int side(const Segment& s, const SegmentPosition& x) const override { return side_of(s, at(x)); }
  int along(const Segment& s, const SegmentPosition& x) const override { return along_of(s, at(x)); }
  int compare(const Segment& on, const Cut& a, const Cut& b) const override {
    const Vec u = cut(on, a), v = cut(on, b);
    const Line& d = line(on.edge);
    return d.dx.is_zero() ? d.dy.sign() * compare_at(u, v, 1) : d.dx.sign() * compare_at(u, v, 0);
  }
  int compare_coordinate(Pair a, const SegmentPosition& b, int axis) const override {
    return compare_at(sum(a), at(b), axis);
  }
  int compare_coordinate(const SegmentPosition& a, const SegmentPosition& b, int axis) const override {
    const Vec u = at(a);
    return compare_at(u, at(b), axis);
  }
  Homogeneous homogeneous(const SegmentPosition& x) const override { return in_input(at(x)); }
  Homogeneous homogeneous(Pair v) const override { return in_input(sum(v)); }
  std::optional<NearFrame> near_frame() const override { return std::nullopt; }
  NearPosition near(const SegmentPosition&) const override { throw std::logic_error("fractions have no near frame"); }
  NearPosition near(Pair) const override { throw std::logic_error("fractions have no near frame"); }
  const SharedIntegers& unscaled_integers() const override { throw std::logic_error("fractions do not move"); }

 private:
  Vec on_grid(const Vec& v) const {
    Vec out = v;
    if (grid_exponent >= 0) {
      out.w <<= grid_exponent;
    } else {
      out.x <<= -grid_exponent;
      out.y <<= -grid_exponent;
    }
    return exact::without_twos(std::move(out));  // the fractions given are in lowest terms
  }
  Homogeneous in_input(Vec v) const {
    if (grid_exponent >= 0) {
      v.x <<= grid_exponent;
      v.y <<= grid_exponent;
    } else {
      v.w <<= -grid_exponent;
    }
    return v;
  }

  static int compare_at(const Vec& a, const Vec& b, int axis) {
    return axis == 0 ? compare_fractions(a.x, a.w, b.x, b.w) : compare_fractions(a.y, a.w, b.y, b.w);
  }
  Vec sum(Pair v) const { return sum_of(vertices_[0][v.p], vertices_[1][v.q]); }
  Vec vector_of(const Edge& e) const { return difference_of(vertices_[e.op][e.to], vertices_[e.op][e.from]); }

  // The line of an edge alone is kept: lowest terms cost more than what they are used for.
  const Line& line(const Edge& e) const {
    const std::uint64_t key = (std::uint64_t{e.from} << 32) | e.to;
    const std::lock_guard lock(making_);
    const auto [it, fresh] = lines_[e.op].try_emplace(key);
    if (fresh) it->second = made_line(e);
    return it->second;
  }
  Line made_line(const Edge& e) const {
    const Vec &from = vertices_[e.op][e.from], &to = vertices_[e.op][e.to];
    const Vec d = difference_of(to, from);
    Line line{d.x, d.y, 0, from.w};
    if (d.w != 1) {
      const BigInteger common = gcd(d.x, d.y);
      if (!common.is_zero()) line.dx /= common, line.dy /= common;
    }
    line.height = line.dx * from.y - line.dy * from.x;
    lower(line.height, line.w);
    return line;
  }
  // The line of a segment is that of its edge, moved by its vertex.
  Line line(const Segment& s) const {
    const Line& own = line(s.edge);
    const Vec& by = vertices_[1 - s.edge.op][s.vertex];
    const BigInteger moved = own.dx * by.y - own.dy * by.x;
    if (own.w == by.w) return {own.dx, own.dy, own.height + moved, own.w};
    Line line{own.dx, own.dy, own.height * by.w + moved * own.w, own.w * by.w};
    if (own.w != 1 && by.w != 1) lower(line.height, line.w);
    return line;
  }

  int side_of(const Segment& s, const Vec& x) const {
    const Line l = line(s);
    return BigInteger(l.w * (l.dx * x.y - l.dy * x.x) - l.height * x.w).sign();
  }
  int along_of(const Segment& s, const Vec& x) const {
    const Line& d = line(s.edge);
    const Vec from = sum(start_of(s));
    const BigInteger ahead = d.dx * x.x + d.dy * x.y, start = d.dx * from.x + d.dy * from.y;
    return compare_fractions(ahead, x.w, start, from.w);
  }

  // The position at which two lines meet that are not parallel.
  static Vec meeting(const Line& a, const Line& b) {
    BigInteger w = a.dx * b.dy - a.dy * b.dx, ah = a.height * b.w, bh = b.height * a.w;
    Vec out{ah * b.dx - bh * a.dx, ah * b.dy - bh * a.dy, w * a.w * b.w};
    if (out.w.sign() < 0) out = {-out.x, -out.y, -out.w};
    return out;
  }
  Vec cut(const Segment& on, const Cut& cut) const {
    return cut.kind == Cut::Kind::pair ? sum(cut.pair) : meeting(line(on), line(cut.by));
  }
  // The denominator of a cut's parameter times that of the segment's vector, as the engine takes it for mediants.
  struct Weight {
    BigInteger n, d;
  };
  Weight weight(const Segment& on, const Cut& cut) const {
    const Vec d = vector_of(on.edge);
    if (cut.kind == Cut::Kind::pair) return {abs(d.x.is_zero() ? d.y : d.x), 1};
    const Vec b = vector_of(cut.by.edge);
    return {abs(cross_of(d, b)), b.w};
  }
  Vec made_position(const SegmentPosition& x) const {
    const Vec a = cut(x.on, x.first);
    if (!x.between) return a;
    const Vec b = cut(x.on, x.second);
    const Weight u = weight(x.on, x.first), v = weight(x.on, x.second);
    const BigInteger of_a = u.n * v.d, of_b = v.n * u.d, na = of_a * b.w, nb = of_b * a.w;
    return {a.x * na + b.x * nb, a.y * na + b.y * nb, a.w * b.w * (of_a + of_b)};
  }
  // Many segments are compared with one position, one after the other: each thread remembers the last one.
  Vec at(const SegmentPosition& x) const {
    struct Last {
      std::uint64_t lattice = 0;
      SegmentPosition position;
      Vec at;
    };
    static thread_local Last last;
    if (last.lattice != number_ || !same_name(last.position, x)) last = {number_, x, made_position(x)};
    return last.at;
  }
  static bool same_segment(const Segment& a, const Segment& b) {
    return a.edge.op == b.edge.op && a.edge.from == b.edge.from && a.edge.to == b.edge.to && a.vertex == b.vertex;
  }
  static bool same_cut(const Cut& a, const Cut& b) {
    return a.kind == b.kind && (a.kind == Cut::Kind::pair ? a.pair == b.pair : same_segment(a.by, b.by));
  }
  static bool same_name(const SegmentPosition& a, const SegmentPosition& b) {
    return a.between == b.between && same_segment(a.on, b.on) && same_cut(a.first, b.first) &&
           (!a.between || same_cut(a.second, b.second));
  }
  static std::uint64_t next_number() {
    static std::atomic<std::uint64_t> last = 0;
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
  }

  std::uint64_t number_ = next_number();
  std::array<std::vector<Vec>, 2> vertices_;
  mutable std::mutex making_;
  mutable std::array<std::unordered_map<std::uint64_t, Line>, 2> lines_;
};

// Two vertices differ by at least the grid's unit over both denominators, or not at all.
int least_difference(const LatticePoints& points) {
  unsigned most = 0;
  for (const auto& o : points.points)
    if (o->fractions != nullptr)
      for (const Vec& v : o->fractions->at) most = std::max(most, static_cast<unsigned>(msb(v.w)));
  return std::min(points.grid_exponent, 0) - 2 * static_cast<int>(most) - 2;
}

}  // namespace

std::shared_ptr<const Lattice> make_fraction_lattice(LatticePoints points) {
  const bool wide = points.unit != 0 || least_difference(points) < -2 * PlacedPoints::kModerateBits;
  points.bits = kNarrowBits;  // no signs are those of doubles
  LatticeDoubles doubles = lattice_doubles(points, std::nullopt);
  doubles.tier_bits = 0;
  doubles.wide |= wide;
  return std::make_shared<FractionLattice>(std::move(doubles));
}

}  // namespace dymsum::planar
