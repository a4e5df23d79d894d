#include "cspace/events/near_events.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cspace/events/overlap_filter.h"

namespace dymsum::planar {
namespace {

/// Segments at a smaller sine are nearly parallel, and have no crossing that is known in the whole window.
constexpr double kSteepCross = 0x1p-6;
/// How far, as a fraction of the span, positions that count as one, and windows, may move.
constexpr double kDeep = 0x1p-12;
/// How far the range of u around the angle itself reaches, which is searched by itself.
constexpr double kMidpoint = 0x1p-44;
/// Fractions of crossings of nearly parallel lines that are known worse are not used.
constexpr double kKnownFraction = 0x1p-30;
/// How far beyond the ends of a segment, relatively, positions are still taken to be on it.
constexpr double kBesideEnds = 0x1p-18;
/// How deep, as a fraction of the span, covered positions lie below an edge at most.
constexpr double kDepth = 0x1p-16;

class Finder {
 public:
  Finder(const EventWindow& window, const TurningForms& forms, const NearAngle& angle, const OverlapFilter& filter,
         bool end_left_out, const std::function<void()>& again)
      : w_(window),
        forms_(forms),
        angle_(angle),
        again_(again),
        low_(angle.range(window.range)[0]),
        high_(angle.range(window.range)[1]),
        aprons_(forms, kDepth * forms.span()),
        inner_(forms, filter),
        open_low_(window.range.t_low == angle.tangent()),
        open_high_(end_left_out && window.range.t_high == angle.tangent()) {
    half_ = std::max(std::abs(low_), std::abs(high_));
  }

  NearEvents run() {
    number_lines();
    find_existence();
    find_partners();
    // Most lines keep their order but for the very middle.
    const double low = low_, high = high_;
    for (const auto& [from, to] : {std::pair{low, -kMidpoint}, {-kMidpoint, kMidpoint}, {kMidpoint, high}}) {
      low_ = std::max(low, from);
      high_ = std::min(high, to);
      if (!(low_ < high_)) continue;
      find_covered();
      for (std::uint32_t a = 0; a < w_.segments.size(); ++a) {
        again_();
        if (covered_[a] == 0) look_along(a);
      }
    }
    return std::move(out_);
  }

 private:
  enum class Kind : std::uint8_t { steep, nearly_parallel, same_direction, opposite };
  /// What meets a segment a, seen from it.
  struct Partner {
    std::uint32_t other = 0;
    Kind kind = Kind::steep;
    PairForm side;                           ///< of a's start beside the other one
    PairForm cross;                          ///< a x other
    ExactQuadratic exact_side, exact_cross;  ///< where the angle has them
    double at = 0, off = 0;  ///< where a steep one crosses a, as fractions of it, and by how much that changes
  };
  /// The same around a position along a.
  struct Line {
    const Partner* partner;
    NearPolynomial side, cross;
  };

  const WalkSegment& segment(std::uint32_t i) const { return w_.segments[i]; }

  // A segment exists while its edge points between the two edges at its vertex.
  void find_existence() {
    exists_.resize(w_.segments.size());
    for (std::uint32_t i = 0; i < exists_.size(); ++i) {
      const WalkSegment& s = segment(i);
      const std::uint32_t op = 1 - s.side;
      if (forms_.is_point(op, s.vertex)) continue;
      exists_[i] = {angle_.cross_polynomial(op, forms_.operand(op).prev[s.vertex], s.side, s.edge),
                    angle_.cross_polynomial(s.side, s.edge, op, s.vertex)};
    }
  }
  bool absent(std::uint32_t i, const NearRoot& at) const {
    if (forms_.is_point(1 - segment(i).side, segment(i).vertex)) return false;
    return exists_[i][0].within(at.low, at.high).sign() < 0 || exists_[i][1].within(at.low, at.high).sign() < 0;
  }

  // Edges of one number are parallel, which doubles do not tell of edges that nearly are. Two that are may have
  // different numbers where others lie between.
  void number_lines() {
    for (std::uint32_t side = 0; side < 2; ++side) {
      std::vector<std::pair<double, std::uint32_t>> order;
      for (std::uint32_t e = 0; e < forms_.size(side); ++e) {
        const Point d = forms_.edge(side, e);
        const double turn = std::atan2(d.y, d.x);
        order.emplace_back(turn < 0 ? turn + std::numbers::pi : turn, e);
      }
      std::sort(order.begin(), order.end());
      line_of_[side].resize(order.size());
      std::uint32_t first = 0;
      for (std::size_t k = 0; k < order.size(); ++k) {
        const std::uint32_t e = order[k].second;
        if (k == 0 || !forms_.parallel({side, first, 0}, {side, e, 0})) first = e;
        line_of_[side][e] = first;
      }
      if (!order.empty() && forms_.parallel({side, order[0].second, 0}, {side, first, 0}))
        for (std::uint32_t& line : line_of_[side])
          if (line == first) line = line_of_[side][order[0].second];
    }
  }
  bool parallel(const WalkSegment& s, const WalkSegment& t) const {
    return s.side == t.side && line_of_[s.side][s.edge] == line_of_[t.side][t.edge];
  }
  bool same_sense(const WalkSegment& s, const WalkSegment& t) const {
    const Point d = forms_.edge(s.side, s.edge), e = forms_.edge(t.side, t.edge);
    return d.x * e.x + d.y * e.y > 0;
  }
  // The same for all edges of a line and for either order.
  bool steep(WalkSegment s, WalkSegment t) const {
    s.edge = line_of_[s.side][s.edge];
    t.edge = line_of_[t.side][t.edge];
    if (std::pair{s.side, s.edge} > std::pair{t.side, t.edge}) std::swap(s, t);
    return least_cross(angle_.cross(s, t).polynomial()) > kSteepCross * angle_.length1(s) * angle_.length1(t);
  }
  double least_cross(const NearPolynomial& cross) const {
    return std::abs(cross.c[0]) - (std::abs(cross.c[1]) + std::abs(cross.c[2])) * half_;
  }

  void find_partners() {
    first_.assign(w_.segments.size() + 1, 0);
    for (const EventWindow::SegmentPair& m : w_.pairs) {
      ++first_[m.a + 1];
      ++first_[m.b + 1];
    }
    for (std::size_t k = 1; k < first_.size(); ++k) first_[k] += first_[k - 1];
    others_.resize(first_.back());
    std::vector<std::uint32_t> fill(first_.begin(), first_.end() - 1);
    for (const EventWindow::SegmentPair& m : w_.pairs) {
      others_[fill[m.a]++] = m.b;
      others_[fill[m.b]++] = m.a;
    }
  }

  // Segments of which another one that is nearly parallel covers all.
  void find_covered() {
    covered_.assign(w_.segments.size(), 0);
    for (std::uint32_t a = 0; a < covered_.size(); ++a) {
      const Pair from = TurningForms::start(segment(a)), to = forms_.end(segment(a));
      for (std::uint32_t k = first_[a]; k < first_[a + 1] && covered_[a] == 0; ++k) {
        const WalkSegment& d = segment(others_[k]);
        if (!same_way_nearly(segment(a), d)) continue;
        covered_[a] = always_covers(d, from) && always_covers(d, to) ? 1 : 0;
      }
    }
  }
  bool same_way_nearly(const WalkSegment& s, const WalkSegment& t) const {
    const Point d = forms_.direction(s, w_.heading), e = forms_.direction(t, w_.heading);
    return d.x * e.x + d.y * e.y > 0 &&
           std::abs(d.x * e.y - d.y * e.x) < kSteepCross * forms_.length1(s) * forms_.length1(t);
  }
  // Whether d always covers an end of a segment that runs beside it. What lies between both ends does so too: it is
  // left of d, and of the edges beside d at convex corners, towards which it does not come nearer.
  bool always_covers(const WalkSegment& d, Pair v) {
    const EdgeAprons::Beside where = beside(d, forms_.position(v, w_.heading), w_.heading);
    if (where == EdgeAprons::Beside::no || !always_left(d, v)) return false;
    if (where == EdgeAprons::Beside::edge) return true;
    const Operand& o = forms_.operand(d.side);
    return always_left({d.side, where == EdgeAprons::Beside::prev ? o.prev[d.edge] : o.next[d.edge], d.vertex}, v);
  }
  // Whether v is on the left of d at all angles that are looked at, but for one at an end that is left out.
  bool always_left(const WalkSegment& d, Pair v) const {
    NearPolynomial p = angle_.side_polynomial(d, v);
    int sign = 1;
    if ((open_low_ && low_ == 0) || (open_high_ && high_ == 0))
      while (p.degree > 0 && p.c[0] == 0 && p.error[0] == 0) {
        p.divide();
        sign *= low_ == 0 ? 1 : -1;
      }
    return sign_in(p, low_, high_) * sign > 0;
  }

  Partner partner_of(std::uint32_t a, std::uint32_t b) const {
    const WalkSegment &s = segment(a), &t = segment(b);
    Partner p{b, Kind::steep, angle_.side(t, TurningForms::start(s)), {}, {}, {}, 0, 0};
    if (angle_.exact()) {
      p.exact_side = angle_.exact_side(t, TurningForms::start(s));
      if (!parallel(s, t)) p.exact_cross = angle_.exact_cross(s, t);
    }
    if (parallel(s, t)) {
      p.kind = same_sense(s, t) ? Kind::same_direction : Kind::opposite;
      return p;
    }
    p.cross = angle_.cross(s, t);
    if (!steep(s, t)) {
      p.kind = Kind::nearly_parallel;
      return p;
    }
    const NearPolynomial side = p.side.polynomial(), cross = p.cross.polynomial();
    const double least = least_cross(cross) / 2;
    p.at = side.c[0] / cross.c[0];
    double moves = 0;
    for (const std::size_t k : {1U, 2U})
      moves += std::abs(side.c[k] - p.at * cross.c[k]) * (k == 1 ? half_ : half_ * half_);
    p.off = 2 * (moves + side.error[0]) / least + 0x1p-40 * (1 + std::abs(p.at));
    return p;
  }

  // A position is covered in all of the window. One on a segment moves by a few times the span for every radian, and
  // the other operand by less than the span; those of a run are nearer to each other.
  bool deep(std::uint32_t a, double fraction) {
    const WalkSegment& s = segment(a);
    const Point d = forms_.direction(s, w_.heading), at = forms_.position(TurningForms::start(s), w_.heading);
    return deep(Point{at.x + fraction * d.x, at.y + fraction * d.y});
  }
  bool deep(Pair v) { return deep(forms_.position(v, w_.heading)); }
  bool deep(Point at) { return inner_.inside(at, w_.heading, kDeep * forms_.span()); }

  Line around(const Partner& p, double at) const {
    if (at == 0 && angle_.exact()) return {&p, p.exact_side.polynomial(), p.exact_cross.polynomial()};
    return {&p, p.side.minus(at, p.cross).polynomial(), p.cross.polynomial()};
  }

  void look_along(std::uint32_t a) {
    partners_.clear();
    for (std::uint32_t k = first_[a]; k < first_[a + 1]; ++k) {
      Partner p = partner_of(a, others_[k]);
      if (p.kind == Kind::steep && (p.at + p.off < -kBesideEnds || p.at - p.off > 1 + kBesideEnds)) continue;
      partners_.push_back(std::move(p));
    }
    std::sort(partners_.begin(), partners_.end(), [](const Partner& x, const Partner& y) {
      if ((x.kind == Kind::steep) != (y.kind == Kind::steep)) return x.kind == Kind::steep;
      const double u = x.at - x.off, v = y.at - y.off;
      return u != v ? u < v : x.other < y.other;
    });
    const auto parallels =
        static_cast<std::size_t>(std::partition_point(partners_.begin(), partners_.end(),
                                                      [](const Partner& p) { return p.kind == Kind::steep; }) -
                                 partners_.begin());
    last_cover_ = 0;
    for (std::size_t first = 0; first < parallels;) {
      std::size_t last = first + 1;
      double high = partners_[first].at + partners_[first].off;
      for (; last < parallels && partners_[last].at - partners_[last].off <= high; ++last)
        high = std::max(high, partners_[last].at + partners_[last].off);
      if (last - first > 1) look_at_run(a, first, last, parallels);
      first = last;
    }
    look_at_parallels(a, parallels);
    look_at_vertices(a);
  }

  // Steep ones that cross a at nearly the same position.
  void look_at_run(std::uint32_t a, std::size_t first, std::size_t last, std::size_t parallels) {
    const double at = partners_[first].at;
    if (partners_[last - 1].at - at < kDeep / 8 && half_ < kDeep / 64 && deep(a, at)) return;
    lines_.clear();
    for (std::size_t k = first; k < last; ++k) lines_.push_back(around(partners_[k], at));
    const std::size_t count = lines_.size();
    bool with_parallels = false;
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t l = k + 1; l < count; ++l) {
        const Partner &p = *lines_[k].partner, &q = *lines_[l].partner;
        if (p.at + p.off < q.at - q.off || q.at + q.off < p.at - p.off) continue;
        if (covered_[p.other] != 0 || covered_[q.other] != 0) continue;
        const std::uint32_t b = std::min(p.other, q.other), c = std::max(p.other, q.other);
        const WalkSegment &s = segment(b), &t = segment(c);
        if (!w_.meet(b, c)) continue;
        if (parallel(s, t)) {
          if (same_sense(s, t)) continue;  // seen as an overlap
        } else if (a > b && steep(s, t)) {
          continue;  // found from its smallest member
        }
        ++out_.looked_at;
        if (!with_parallels)
          for (std::size_t m = parallels; m < partners_.size(); ++m) lines_.push_back(around(partners_[m], at));
        with_parallels = true;
        add(a, {a, b, c}, at, k, l);
      }
  }

  // Looks at threes of which no two cross steeply, or two that do while neither crosses the third one steeply.
  void look_at_parallels(std::uint32_t a, std::size_t parallels) {
    lines_.clear();
    for (std::size_t m = parallels; m < partners_.size(); ++m) lines_.push_back(around(partners_[m], 0));
    const std::size_t count = lines_.size();
    for (std::size_t k = 0; k < count; ++k) {
      if (lines_[k].partner->kind != Kind::nearly_parallel || covered_[lines_[k].partner->other] != 0) continue;
      for (std::size_t l = k + 1; l < count; ++l) {
        if (lines_[l].partner->kind != Kind::nearly_parallel || covered_[lines_[l].partner->other] != 0) continue;
        const std::uint32_t b = std::min(lines_[k].partner->other, lines_[l].partner->other),
                            c = std::max(lines_[k].partner->other, lines_[l].partner->other);
        if (!w_.meet(b, c)) continue;
        const WalkSegment &s = segment(b), &t = segment(c);
        if (parallel(s, t)) {
          if (same_sense(s, t)) continue;
        } else if (a > b && !steep(s, t)) {
          continue;
        }
        ++out_.looked_at;
        add(a, {a, b, c}, 0, k, l);
      }
    }
  }

  void add(std::uint32_t a, std::array<std::uint32_t, 3> segments, double at, std::size_t k, std::size_t l) {
    std::vector<NearRoot> where = where_met(a, at, lines_[k], lines_[l]);
    if (!where.empty()) out_.triples.push_back({segments, std::move(where)});
  }

  // That of a base segment's crossings with b and c, as TurningForms::concurrency.
  NearPolynomial exact_concurrency(const Partner& b, const Partner& c) const {
    return difference_of_products(b.exact_side, c.exact_cross, c.exact_side, b.exact_cross);
  }

  // The angles at which a, and two others that are seen from a position `at` along it, may meet at a position that is
  // not covered.
  std::vector<NearRoot> where_met(std::uint32_t a, double at, const Line& b, const Line& c) {
    NearPolynomial g = difference_of_products(b.side, c.cross, c.side, b.cross);
    if (sign_in(g, low_, high_) != 0) return {};
    if (angle_.exact()) g = exact_concurrency(*b.partner, *c.partner);
    std::vector<NearRoot> where = near_roots(g, low_, high_);
    std::erase_if(where, [&](const NearRoot& root) { return excluded(root) || !may_matter(a, at, b, c, root); });
    return where;
  }

  // Whether a root is at the angle itself, where that is an end and left out.
  bool excluded(const NearRoot& root) const {
    return root.low == 0 && root.high == 0 && ((open_low_ && low_ == 0) || (open_high_ && high_ == 0));
  }

  bool may_matter(std::uint32_t a, double at, const Line& b, const Line& c, const NearRoot& root) {
    if (!root.known) return true;
    if (absent(a, root) || absent(b.partner->other, root) || absent(c.partner->other, root)) return false;
    // The one that is less parallel decides.
    const bool first = std::abs(b.cross.c[0]) / length(b) >= std::abs(c.cross.c[0]) / length(c);
    const Line& by = first ? b : c;
    const double u = 0.5 * (root.low + root.high);
    const NearPolynomial::Value cross = by.cross.within(root.low, root.high),
                                side = by.side.within(root.low, root.high);
    // Where the two are nearly parallel the fraction may not be known.
    if (cross.sign() == 0 || !(side.error < kKnownFraction * std::abs(cross.at)) ||
        !(cross.error < kKnownFraction * std::abs(cross.at)))
      return true;
    const double fraction = at + by.side(u).at / cross.at;
    const Heading h = Heading::of(angle_.theta_of(u));
    const Point from = forms_.position(TurningForms::start(segment(a)), h), d = forms_.direction(segment(a), h);
    const Point position{from.x + fraction * d.x, from.y + fraction * d.y};
    if (beyond_ends(a, position, h) || beyond_ends(b.partner->other, position, h) ||
        beyond_ends(c.partner->other, position, h))
      return false;
    return !covered(a, at, by, cross.sign(), position, h, root);
  }
  double length(const Line& l) const { return angle_.length1(segment(l.partner->other)); }

  bool beyond_ends(std::uint32_t i, Point position, Heading h) const {
    const WalkSegment& s = segment(i);
    const Point d = forms_.direction(s, h), from = forms_.position(TurningForms::start(s), h);
    const double along = d.x * (position.x - from.x) + d.y * (position.y - from.y), whole = d.x * d.x + d.y * d.y,
                 slack = 4 * kBesideEnds * (whole + std::sqrt(whole) * forms_.span());
    return along < -slack || along > whole + slack;
  }

  EdgeAprons::Beside beside(const WalkSegment& s, Point position, Heading h) {
    const Point d = forms_.direction(s, h), from = forms_.position(TurningForms::start(s), h);
    const double length = std::hypot(d.x, d.y), x = position.x - from.x, y = position.y - from.y;
    return aprons_.beside(s.side, s.edge, (d.x * x + d.y * y) / length, (d.x * y - d.y * x) / length);
  }

  // Whether the position at which `by` crosses a lies in the open sum. That is left of a line d where
  // (side_d (a x by) - side_by (a x d)) / (a x by) is positive.
  bool covered(std::uint32_t a, double at, const Line& by, int sign, Point position, Heading h, const NearRoot& root) {
    const auto left_of = [&](const NearPolynomial& side, const NearPolynomial& cross, auto&& exactly) {
      const int known = difference_of_products(side, by.cross, by.side, cross).within(root.low, root.high).sign();
      if (known != 0 || !angle_.exact()) return known * sign > 0;
      return exactly().within(root.low, root.high).sign() * sign > 0;
    };
    const auto covers = [&](const Line& d) {
      if (&d == &by) return false;
      const WalkSegment& s = segment(d.partner->other);
      const EdgeAprons::Beside where = beside(s, position, h);
      if (where == EdgeAprons::Beside::no ||
          !left_of(d.side, d.cross, [&] { return exact_concurrency(*d.partner, *by.partner); }))
        return false;
      if (where == EdgeAprons::Beside::edge) return true;
      const Operand& o = forms_.operand(s.side);
      const WalkSegment next{s.side, where == EdgeAprons::Beside::prev ? o.prev[s.edge] : o.next[s.edge], s.vertex};
      const PairForm cross = angle_.cross(segment(a), next);
      const Pair start = TurningForms::start(segment(a));
      return left_of(angle_.side(next, start).minus(at, cross).polynomial(), cross.polynomial(), [&] {
        return difference_of_products(angle_.exact_side(next, start), by.partner->exact_cross, by.partner->exact_side,
                                      angle_.exact_cross(segment(a), next));
      });
    };
    if (last_cover_ < lines_.size() && covers(lines_[last_cover_])) return true;
    for (std::size_t k = 0; k < lines_.size(); ++k)
      if (k != last_cover_ && covers(lines_[k])) {
        last_cover_ = k;
        return true;
      }
    return false;
  }

  void look_at_vertices(std::uint32_t a) {
    vertices_.clear();
    const WalkSegment& s = segment(a);
    for (const Partner& p : partners_)
      for (const Pair v : {TurningForms::start(segment(p.other)), forms_.end(segment(p.other))})
        if (covered_[p.other] == 0 && s.vertex != (s.side == 0 ? v.q : v.p))
          vertices_.push_back({v.p, v.q});  // others do not move against a
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    for (const auto& [p, q] : vertices_) {
      std::vector<NearRoot> where = where_met(a, {p, q});
      if (!where.empty()) out_.vertices.push_back({a, {p, q}, std::move(where)});
    }
  }

  std::vector<NearRoot> where_met(std::uint32_t a, Pair v) {
    const WalkSegment& s = segment(a);
    if (forms_.side(s, v).far_from_zero(w_.heading, w_.half, forms_.side_error(s))) return {};
    if (half_ < kDeep / 64 && deep(v)) return {};
    std::vector<NearRoot> where = near_roots(angle_.side_polynomial(s, v), low_, high_);
    std::erase_if(where, [&](const NearRoot& root) {
      if (excluded(root)) return true;
      if (!root.known) return false;
      if (absent(a, root)) return true;
      const Heading h = Heading::of(angle_.theta_of(0.5 * (root.low + root.high)));
      const Point position = forms_.position(v, h);
      return beyond_ends(a, position, h) || covered(v, position, h, root);
    });
    return where;
  }

  bool covered(Pair v, Point position, Heading h, const NearRoot& root) {
    const auto left_of = [&](const WalkSegment& d) {
      return angle_.side_polynomial(d, v).within(root.low, root.high).sign() > 0;
    };
    const auto covers = [&](const Partner& p) {
      const WalkSegment& d = segment(p.other);
      const EdgeAprons::Beside where = beside(d, position, h);
      if (where == EdgeAprons::Beside::no || !left_of(d)) return false;
      if (where == EdgeAprons::Beside::edge) return true;
      const Operand& o = forms_.operand(d.side);
      return left_of({d.side, where == EdgeAprons::Beside::prev ? o.prev[d.edge] : o.next[d.edge], d.vertex});
    };
    if (last_partner_ < partners_.size() && covers(partners_[last_partner_])) return true;
    for (std::size_t k = 0; k < partners_.size(); ++k)
      if (k != last_partner_ && covers(partners_[k])) {
        last_partner_ = k;
        return true;
      }
    return false;
  }

  const EventWindow& w_;
  const TurningForms& forms_;
  const NearAngle& angle_;
  const std::function<void()>& again_;
  double low_, high_, half_ = 0;  // of u
  EdgeAprons aprons_;
  InnerPoints inner_;
  bool open_low_, open_high_;
  std::vector<std::uint8_t> covered_;  // segments, as wholes at all angles that are looked at
  std::vector<std::array<NearPolynomial, 2>> exists_;
  std::array<std::vector<std::uint32_t>, 2> line_of_;  // of edges
  std::vector<std::uint32_t> first_, others_;
  // What the segment that is looked along has:
  std::vector<Partner> partners_;  // steep ones first, by their positions
  std::vector<Line> lines_;
  std::vector<std::array<std::uint32_t, 2>> vertices_;
  std::size_t last_cover_ = 0, last_partner_ = 0;  // what covered the position before
  NearEvents out_;
};

}  // namespace

NearEvents near_events(const EventWindow& window, const TurningForms& forms, const NearAngle& angle,
                       const OverlapFilter& filter, bool end_left_out, const std::function<void()>& again) {
  return Finder(window, forms, angle, filter, end_left_out, again).run();
}

}  // namespace dymsum::planar
