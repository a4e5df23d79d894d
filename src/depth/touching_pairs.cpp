// The boundaries are complexes, and what they have in common is one, too: its cells are the common positions of the
// relative interiors of a simplex of P and one of Q. Where the solids' interiors do not meet, no edge goes through a
// triangle; so the points among the cells are vertices on simplices and crossings of edges, and the common part of two
// simplices is the hull of the points among their sides' cells (docs/design/penetration-depth.md, "What touches").
#include "depth/touching_pairs.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include "base/scratch.h"
#include "depth/depth_operands.h"
#include "depth/exact_frame.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::depth {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;
using exact::cross;
using exact::dot;
using exact::sign;
using spatial::Box;
using spatial::Vec3;

namespace {

bool is_side(const Simplex& part, const Simplex& of) {
  return std::all_of(part.begin(), part.end(),
                     [&](std::uint32_t v) { return v == kNoVertex || std::find(of.begin(), of.end(), v) != of.end(); });
}

/// The sides of a simplex, itself included, of a dimension.
std::vector<Simplex> sides_of(const Simplex& s, int dimension) {
  const auto [a, b, c] = s;
  const int own = dimension_of(s);
  if (dimension > own) return {};
  if (dimension == own) return {s};
  if (dimension == 1) return {{a, b, kNoVertex}, {b, c, kNoVertex}, {a, c, kNoVertex}};
  std::vector<Simplex> points;
  for (int k = 0; k <= own; ++k) points.push_back({s[static_cast<std::size_t>(k)], kNoVertex, kNoVertex});
  return points;
}

/// The side of a simplex whose relative interior holds a position; nothing outside of it.
std::optional<Simplex> side_at(const BigVector& v, const Simplex& s, const std::array<BigVector, 3>& at) {
  const int dimension = dimension_of(s);
  const BigVector to = v - at[0];
  if (dimension == 0) return exact::leading_sign(to) == 0 ? std::optional(s) : std::nullopt;
  if (dimension == 1) {
    const BigVector d = at[1] - at[0];
    if (exact::leading_sign(cross(d, to)) != 0) return std::nullopt;
    const Big along = dot(d, to), all = dot(d, d);
    if (sign(along) < 0 || all < along) return std::nullopt;
    if (sign(along) == 0) return Simplex{s[0], kNoVertex, kNoVertex};
    return along == all ? Simplex{s[1], kNoVertex, kNoVertex} : s;
  }
  const BigVector n = cross(at[1] - at[0], at[2] - at[0]);
  if (sign(dot(n, to)) != 0) return std::nullopt;
  Simplex left = s;  // without the corner across from every side's line that holds the position
  for (std::size_t k = 0; k < 3; ++k) {
    const BigVector &a = at[(k + 1) % 3], &b = at[(k + 2) % 3];
    const int turn = sign(dot(cross(n, b - a), v - a));
    if (turn < 0) return std::nullopt;
    if (turn == 0) left[k] = kNoVertex;
  }
  std::sort(left.begin(), left.end());
  return left;
}

}  // namespace

/// One question.
class TouchSearch {
 public:
  TouchSearch(const TouchingPairs& of, const RationalVector& x);
  std::vector<SolidTouch> run();

 private:
  struct Cell {
    std::array<Simplex, 2> of;
    SolidFeature p, q;
    int dimension = 0;
    ExactPosition at;                    ///< of a point
    std::vector<std::uint32_t> corners;  ///< points, of a cell that is none
  };

  BigVector exact(int side, std::uint32_t vertex);
  Vec3 approx(int side, std::uint32_t vertex) const;
  Box box(int side, const Simplex& s) const;
  bool provably_apart(const Simplex& a, const Simplex& b) const;
  void look_at(std::uint32_t i, std::uint32_t j);
  void add_vertices(int side, std::uint32_t i, std::uint32_t j, std::vector<std::uint32_t>& points);
  void add_crossings(std::uint32_t i, std::uint32_t j, std::vector<std::uint32_t>& points);
  std::optional<Simplex> find_side(int side, std::uint32_t vertex, const Simplex& other);
  std::optional<ExactPosition> crossing(const Simplex& e, const Simplex& f);
  std::uint32_t cell(const Simplex& p, const Simplex& q, std::uint32_t i, std::uint32_t j, int dimension);
  void add_cells(std::uint32_t i, std::uint32_t j, std::vector<std::uint32_t>& cells);
  std::optional<int> common_dimension(const Simplex& s, const Simplex& t, const std::vector<std::uint32_t>& points);
  BigRational coordinate(const std::vector<std::uint32_t>& points, Big BigVector::*axis) const;
  RationalVector position(const Cell& c) const;

  const TouchingPairs& pairs_;
  std::array<const TouchSide*, 2> side_;
  std::array<BigInteger, 2> factor_;  // of vertices, to one denominator
  BigVector moved_;                   // Q's reference point
  struct {
    BigInteger num = 1, den = 1;
  } unit_;
  Vec3 near_;
  double off_ = 0;
  std::array<std::map<std::uint32_t, BigVector>, 2> exact_;
  std::array<std::map<std::pair<std::uint32_t, Simplex>, std::optional<Simplex>>, 2> on_;
  std::map<std::array<Simplex, 2>, std::optional<ExactPosition>> crossings_;
  std::map<std::array<Simplex, 2>, std::uint32_t> index_;
  std::vector<Cell> cells_;
  UnionFind pieces_, patches_;
};

TouchSearch::TouchSearch(const TouchingPairs& of, const RationalVector& x) : pairs_(of), side_{&of.p_, &of.q_} {
  const auto shifted = [](BigRational v, int by) {
    const BigInteger two = BigInteger(1) << static_cast<unsigned>(std::abs(by));
    return by < 0 ? BigRational(v / two) : BigRational(v * two);
  };
  BigInteger all = lcm(BigInteger(of.p_.den), BigInteger(of.q_.den));
  RationalVector in_units = x;
  for (BigRational& c : in_units) c = shifted(c, -of.exponent_), all = lcm(all, denominator(c));
  factor_ = {BigInteger(all / of.p_.den), BigInteger(all / of.q_.den)};
  const auto whole = [&](const BigRational& c) { return Big(BigInteger(numerator(c) * (all / denominator(c)))); };
  moved_ = {whole(in_units[0]), whole(in_units[1]), whole(in_units[2])};
  (of.exponent_ < 0 ? unit_.den : unit_.num) <<= static_cast<unsigned>(std::abs(of.exponent_));
  unit_.den *= all;
  const auto rounded = [&](const BigRational& c) { return exact::round_to_double(shifted(c, -of.scale_)); };
  near_ = {rounded(x[0]), rounded(x[1]), rounded(x[2])};
  off_ = 0x1p-46 * (2 + largest(near_));
}

BigVector TouchSearch::exact(int side, std::uint32_t vertex) {
  const auto k = static_cast<std::size_t>(side);
  const auto found = exact_[k].find(vertex);
  if (found != exact_[k].end()) return found->second;
  BigVector v = times(Big(factor_[k]), side_[k]->exact(vertex, pairs_.exponent_));
  if (side == 1) v = v + moved_;
  return exact_[k].emplace(vertex, std::move(v)).first->second;
}

Vec3 TouchSearch::approx(int side, std::uint32_t vertex) const {
  return side == 0 ? pairs_.p_at_[vertex] : near_ + pairs_.q_at_[vertex];
}

Box TouchSearch::box(int side, const Simplex& s) const {
  Box box;
  for (const std::uint32_t v : s)
    if (v != kNoVertex) box.add(approx(side, v));
  box.grow(off_);
  return box;
}

/// All corners of one lie on one side of the other's plane.
bool TouchSearch::provably_apart(const Simplex& a, const Simplex& b) const {
  const auto off_plane = [&](int side, const Simplex& s, const Simplex& t) {
    if (dimension_of(t) < 2) return false;
    const Vec3 o = approx(1 - side, t[0]), u = approx(1 - side, t[1]) - o, v = approx(1 - side, t[2]) - o;
    int first = 0;
    for (const std::uint32_t k : s) {
      if (k == kNoVertex) continue;
      const int here = proved_sign(u, v, approx(side, k) - o, 2 * off_);
      if (here == 0 || here == -first) return false;
      first = here;
    }
    return true;
  };
  return off_plane(0, a, b) || off_plane(1, b, a);
}

std::vector<SolidTouch> TouchSearch::run() {
  Box at;
  at.add(near_);
  at.grow(2 * off_);
  std::vector<std::array<std::uint32_t, 2>> near;
  pairs_.p_tree_.any_reflected_pair(pairs_.q_tree_, at, [&](std::uint32_t i, std::uint32_t j) {
    if (!provably_apart(side_[0]->simplices[i], side_[1]->simplices[j])) near.push_back({i, j});
    return false;
  });
  std::sort(near.begin(), near.end());
  for (const auto& [i, j] : near) look_at(i, j);

  // Of every piece a cell of its greatest dimension stands for it.
  std::map<std::uint32_t, std::uint32_t> best;
  for (std::uint32_t k = 0; k < cells_.size(); ++k) {
    std::uint32_t& b = best.emplace(pieces_.root(k), k).first->second;
    if (cells_[k].dimension > cells_[b].dimension) b = k;
  }
  struct Found {
    std::uint32_t cell;
    RationalVector at;
  };
  std::vector<Found> found;
  for (const auto& [piece, cell] : best) found.push_back({cell, position(cells_[cell])});
  std::sort(found.begin(), found.end(), [&](const Found& a, const Found& b) {
    const Cell &x = cells_[a.cell], &y = cells_[b.cell];
    return std::tie(y.dimension, x.p, x.q, a.at) < std::tie(x.dimension, y.p, y.q, b.at);
  });
  std::map<std::uint32_t, std::uint32_t> patch;
  std::vector<SolidTouch> all;
  for (const Found& f : found) {
    const Cell& c = cells_[f.cell];
    const auto index = static_cast<std::uint32_t>(patch.size());
    all.push_back({c.p,
                   c.q,
                   c.dimension,
                   {exact::to_rational(f.at[0]), exact::to_rational(f.at[1]), exact::to_rational(f.at[2])},
                   patch.emplace(patches_.root(f.cell), index).first->second});
  }
  return all;
}

void TouchSearch::look_at(std::uint32_t i, std::uint32_t j) {
  std::vector<std::uint32_t> cells;
  add_vertices(0, i, j, cells);
  add_vertices(1, i, j, cells);
  add_crossings(i, j, cells);
  if (cells.empty()) return;
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  add_cells(i, j, cells);
  // The common part of two simplices is convex, and what of it belongs to one pair of features, too.
  for (const std::uint32_t a : cells) {
    patches_.unite(a, cells.front());
    for (const std::uint32_t b : cells)
      if (b < a && cells_[a].p == cells_[b].p && cells_[a].q == cells_[b].q) pieces_.unite(a, b);
  }
}

/// Vertices of simplex i of P on simplex j of Q, or (side 1) of j on i.
void TouchSearch::add_vertices(int side, std::uint32_t i, std::uint32_t j, std::vector<std::uint32_t>& points) {
  const Simplex &own = side == 0 ? side_[0]->simplices[i] : side_[1]->simplices[j],
                &other = side == 0 ? side_[1]->simplices[j] : side_[0]->simplices[i];
  for (const std::uint32_t v : own) {
    if (v == kNoVertex) continue;
    const std::optional<Simplex> on = find_side(side, v, other);
    if (!on) continue;
    const Simplex point{v, kNoVertex, kNoVertex};
    points.push_back(side == 0 ? cell(point, *on, i, j, 0) : cell(*on, point, i, j, 0));
    cells_[points.back()].at = {exact(side, v), Big::from_int64(1)};
  }
}

std::optional<Simplex> TouchSearch::find_side(int side, std::uint32_t vertex, const Simplex& other) {
  Box at;
  at.add(approx(side, vertex));
  at.grow(off_);
  if (!overlap(at, box(1 - side, other))) return std::nullopt;
  auto& known = on_[static_cast<std::size_t>(side)];
  const auto found = known.find({vertex, other});
  if (found != known.end()) return found->second;
  std::optional<Simplex> on;
  std::array<Vec3, 3> near;
  std::array<BigVector, 3> corners;
  const std::size_t count = static_cast<std::size_t>(dimension_of(other)) + 1;
  for (std::size_t k = 0; k < count; ++k) near[k] = approx(1 - side, other[k]) - approx(side, vertex);
  if (count < 3 || proved_sign(near[0], near[1], near[2], 2 * off_) == 0) {
    for (std::size_t k = 0; k < count; ++k) corners[k] = exact(1 - side, other[k]);
    on = side_at(exact(side, vertex), other, corners);
  }
  return known.emplace(std::pair(vertex, other), on).first->second;
}

void TouchSearch::add_crossings(std::uint32_t i, std::uint32_t j, std::vector<std::uint32_t>& points) {
  for (const Simplex& e : sides_of(side_[0]->simplices[i], 1)) {
    const Box around = box(0, e);
    for (const Simplex& f : sides_of(side_[1]->simplices[j], 1)) {
      if (!overlap(around, box(1, f))) continue;
      auto known = crossings_.find({e, f});
      if (known == crossings_.end()) known = crossings_.emplace(std::array<Simplex, 2>{e, f}, crossing(e, f)).first;
      if (!known->second) continue;
      points.push_back(cell(e, f, i, j, 0));
      cells_[points.back()].at = *known->second;
    }
  }
}

/// The position that the relative interiors of two edges have in common, if it is one.
std::optional<ExactPosition> TouchSearch::crossing(const Simplex& e, const Simplex& f) {
  const Vec3 near = approx(0, e[0]);
  if (proved_sign(approx(0, e[1]) - near, approx(1, f[0]) - near, approx(1, f[1]) - near, 2 * off_) != 0)
    return std::nullopt;
  const BigVector a = exact(0, e[0]), u = exact(0, e[1]) - a, c = exact(1, f[0]), v = exact(1, f[1]) - c, w = c - a;
  const BigVector n = cross(u, v);
  if (exact::leading_sign(n) == 0 || sign(dot(n, w)) != 0) return std::nullopt;
  const Big all = dot(n, n), s = dot(cross(w, v), n), t = dot(cross(w, u), n);
  if (sign(s) <= 0 || !(s < all) || sign(t) <= 0 || !(t < all)) return std::nullopt;
  return ExactPosition{times(all, a) + times(s, u), all};
}

std::uint32_t TouchSearch::cell(const Simplex& p, const Simplex& q, std::uint32_t i, std::uint32_t j, int dimension) {
  const auto [at, is_new] = index_.emplace(std::array<Simplex, 2>{p, q}, static_cast<std::uint32_t>(cells_.size()));
  if (!is_new) return at->second;
  pieces_.add(), patches_.add();
  cells_.push_back({{p, q}, side_[0]->feature(p, i), side_[1]->feature(q, j), dimension, {}, {}});
  return at->second;
}

/// Cells of a dimension above 0, by the points on their sides.
void TouchSearch::add_cells(std::uint32_t i, std::uint32_t j, std::vector<std::uint32_t>& cells) {
  const std::vector<std::uint32_t> points = cells;
  for (int dp = 1; dp <= 2; ++dp)
    for (int dq = 1; dq <= 2; ++dq)
      for (const Simplex& s : sides_of(side_[0]->simplices[i], dp))
        for (const Simplex& t : sides_of(side_[1]->simplices[j], dq)) {
          std::vector<std::uint32_t> corners;
          for (const std::uint32_t k : points)
            if (is_side(cells_[k].of[0], s) && is_side(cells_[k].of[1], t)) corners.push_back(k);
          const std::optional<int> dimension = common_dimension(s, t, corners);
          if (!dimension) continue;
          cells.push_back(cell(s, t, i, j, *dimension));
          cells_[cells.back()].corners = std::move(corners);
        }
}

/// The dimension of the relative interiors' common positions, of which these are the corners; nothing where they lie on
/// one side of either, or are one point.
std::optional<int> TouchSearch::common_dimension(const Simplex& s, const Simplex& t,
                                                 const std::vector<std::uint32_t>& points) {
  if (points.size() < 2) return std::nullopt;
  for (int k = 0; k < 2; ++k) {
    const Simplex& whole = k == 0 ? s : t;
    if (dimension_of(whole) < 2) continue;
    for (const Simplex& edge : sides_of(whole, 1))
      if (std::all_of(points.begin(), points.end(),
                      [&](std::uint32_t at) { return is_side(cells_[at].of[static_cast<std::size_t>(k)], edge); }))
        return std::nullopt;
  }
  return dimension_of(s) == 2 && dimension_of(t) == 2 ? 2 : 1;
}

/// The mean over points, reduced once.
BigRational TouchSearch::coordinate(const std::vector<std::uint32_t>& points, Big BigVector::*axis) const {
  BigInteger num = 0, den = 1;
  for (const std::uint32_t k : points) {
    const ExactPosition& at = cells_[k].at;
    num = num * at.w.value() + (at.x.*axis).value() * den;
    den *= at.w.value();
  }
  den *= unit_.den * static_cast<std::int64_t>(points.size()), num *= unit_.num;
  return exact::ratio(Big(num), Big(den));
}

/// The mean of the corners lies inside of a cell.
RationalVector TouchSearch::position(const Cell& c) const {
  if (c.dimension == 0 && dimension_of(c.of[0]) == 0 && side_[0]->den == 1) {  // a vertex of P, which never turns
    const Point3& v = side_[0]->at[c.of[0][0]];
    return {exact::exact_value(v.x), exact::exact_value(v.y), exact::exact_value(v.z)};
  }
  const std::vector<std::uint32_t> own{static_cast<std::uint32_t>(&c - cells_.data())};
  const std::vector<std::uint32_t>& points = c.dimension == 0 ? own : c.corners;
  return {coordinate(points, &BigVector::x), coordinate(points, &BigVector::y), coordinate(points, &BigVector::z)};
}

namespace {

int top_exponent(const TouchSide& side) {
  double most = 0;
  for (const Point3& v : side.at) most = std::max({most, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return most > 0 ? std::ilogb(most) + 2 : std::numeric_limits<int>::min();
}

spatial::BoxTree tree_of(const TouchSide& side, const std::vector<Vec3>& at, double sense) {
  std::vector<Box> boxes;
  for (const Simplex& s : side.simplices) {
    Box& box = boxes.emplace_back();
    for (const std::uint32_t v : s)
      if (v != kNoVertex) box.add(sense * at[v]);
  }
  return spatial::BoxTree(std::move(boxes));
}

}  // namespace

TouchingPairs::TouchingPairs(TouchSide p, TouchSide q) : p_(std::move(p)), q_(std::move(q)) {
  exponent_ = common_exponent(p_.at, q_.at);
  scale_ = std::max(top_exponent(p_), top_exponent(q_));
  if (scale_ == std::numeric_limits<int>::min()) scale_ = 0;
  for (std::uint32_t v = 0; v < p_.at.size(); ++v) p_at_.push_back(p_.approx(v, scale_));
  for (std::uint32_t v = 0; v < q_.at.size(); ++v) q_at_.push_back(q_.approx(v, scale_));
  p_tree_ = tree_of(p_, p_at_, 1), q_tree_ = tree_of(q_, q_at_, -1);
}

std::vector<SolidTouch> TouchingPairs::at(const RationalVector& x) const { return TouchSearch(*this, x).run(); }

namespace {

/// Numbers that are not all zero, by one common factor: rounded only then.
Point3 unit_direction(const RationalVector& v) {
  BigInteger all = 1;
  for (const BigRational& c : v) all = lcm(all, denominator(c));
  const auto whole = [&](std::size_t k) { return Big(BigInteger(numerator(v[k]) * (all / denominator(v[k])))); };
  const BigVector n{whole(0), whole(1), whole(2)};
  if (exact::leading_sign(n) == 0) return {};
  const Vec3 u = spatial::unit(n);
  return {u.x, u.y, u.z};
}

}  // namespace

std::vector<SolidWay> ways_of(std::vector<RationalVector> moves, const RationalVector& from,
                              const TouchingPairs* touching) {
  std::sort(moves.begin(), moves.end());
  std::vector<SolidWay> ways;
  for (const RationalVector& move : moves) {
    SolidWay& way = ways.emplace_back();
    way.move = {exact::to_rational(move[0]), exact::to_rational(move[1]), exact::to_rational(move[2])};
    way.direction = unit_direction(move);
    if (touching) way.contacts = touching->at({from[0] + move[0], from[1] + move[1], from[2] + move[2]});
  }
  return ways;
}

}  // namespace dymsum::depth
