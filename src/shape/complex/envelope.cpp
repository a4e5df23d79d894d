#include "shape/complex/envelope.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace dymsum::shape {

int Order::compare(const Section& s, const Mark& a, const Mark& b) {
  using Kind = Mark::Kind;
  if (a.kind == b.kind && (a.is_infinite() || a.same(b))) return 0;
  if (a.kind == Kind::minus_infinity || b.kind == Kind::plus_infinity) return -1;
  if (b.kind == Kind::minus_infinity || a.kind == Kind::plus_infinity) return 1;
  const bool decided =
      a.near.high() < b.near.low() || a.near.low() > b.near.high() || (a.near.is_point() && b.near.is_point());
  if (decided) {
    counts.count(exact::Rung::doubles);
    return a.near.low() < b.near.low() ? -1 : a.near.low() > b.near.low();
  }
  if (same_direction(s, a, b)) {
    counts.count(exact::Rung::big);
    return 0;
  }
  return sign_beyond([&](const auto& formulas) { return formulas.value(s, a) - formulas.value(s, b); });
}

bool Order::same_direction(const Section& s, const Mark& a, const Mark& b) {
  if (walks_.is_edge(s.site)) return false;
  const auto v = exact_.direction(s, a), w = exact_.direction(s, b);
  return v && w && v->x * w->y == v->y * w->x && dot(*v, *w) > 0;
}

QuadraticSigns Order::signs(const Section& s, std::uint32_t i, std::uint32_t j, const Quadratic<Interval>& near) {
  std::optional<Quadratic<Fine>> fine;
  std::optional<Quadratic<Exact>> exactly;
  const auto decide = [&](auto&& of) {
    if (const std::optional<int> sign = sign_of(of(near))) return counts.add({*sign, exact::Rung::doubles});
    if (!fine) fine = fine_.difference(s, i, j);
    if (const std::optional<int> sign = sign_of(of(*fine))) return counts.add({*sign, exact::Rung::double_pairs});
    if (!exactly) exactly = exact_.difference(s, i, j);
    return counts.add({exact::sign_of(of(*exactly)), exact::Rung::big});
  };
  QuadraticSigns signs;
  signs.a = decide([](const auto& f) { return f.a; });
  if (signs.a != 0) {
    signs.b = sign_of(near.b).value_or(0);  // for the choice of a formula only
    signs.discriminant = decide([](const auto& f) { return discriminant(f); });
    return signs;
  }
  signs.b = decide([](const auto& f) { return f.b; });
  if (signs.b == 0) signs.c = decide([](const auto& f) { return f.c; });
  return signs;
}

bool Order::is_opposite(const Section& s, std::uint32_t j, int end) {
  const auto direction = [&](auto&& formulas) {
    using F = std::decay_t<decltype(formulas)>;
    const SiteEnds& ends = walks_.ends[j];
    const auto q = formulas.turned(s, formulas.between(walks_.ends[s.site].a, end == 0 ? ends.a : ends.b));
    return F::mirrored(q, right_of(formulas.turned(s, formulas.vector(j))));
  };
  const Vec<Interval> near = direction(near_);
  if (!near.y.contains_zero() || near.x.low() > 0) {
    counts.count(exact::Rung::doubles);
    return false;
  }
  counts.count(exact::Rung::big);
  const Vec<exact::BigInteger> v = direction(exact_);
  return v.y.is_zero() && v.x.sign() < 0;
}

namespace {

using exact::cross_sign;
using exact::dot_sign;
using exact::orient_sign;

Mark infinite(int sign) { return {.kind = sign < 0 ? Mark::Kind::minus_infinity : Mark::Kind::plus_infinity}; }

/// A directed edge by its ends.
struct Line {
  Point a, b;
  explicit Line(const Site& s) : a(s.a), b(s.b) {}
  /// 1: p lies strictly on the right, where the discs are.
  int side(Point p) const { return -orient_sign(a, b, p); }
};

class DomainOf {
 public:
  DomainOf(Order& order, const Section& s, std::uint32_t j) : order_(order), walks_(order.walks()), s_(s), j_(j) {}

  Domain operator()() {
    if (walks_.is_edge(s_.site)) {
      walks_.is_edge(j_) ? edge_along_edge() : vertex_along_edge();
    } else {
      walks_.is_edge(j_) ? edge_about_vertex() : vertex_about_vertex();
    }
    return out_;
  }

 private:
  const Site& site(std::uint32_t s) const { return walks_.sites[s]; }

  /// The foot on j goes back as U grows.
  void edge_along_edge() {
    const Line s(site(s_.site)), j(site(j_));
    const int start = s.side(j.a), end = s.side(j.b);
    if (start <= 0 && end <= 0) return;                                                   // j lies behind s
    if (j.side(s.a) <= 0 && j.side(s.b) <= 0) return;                                     // s lies behind j
    if (cross_sign(s.a, s.b, j.a, j.b) == 0 && dot_sign(s.a, s.b, j.a, j.b) > 0) return;  // never both at once
    // An end of j behind s: lines cross, beyond an end of s, and discs between s and j reach as far as s does.
    out_.add(end > 0 ? order_.tangent(s_, j_, 1) : infinite(-1), start > 0 ? order_.tangent(s_, j_, 0) : infinite(1));
  }

  /// The contact's direction at j turns clockwise as U grows, from the one away from s to itself.
  void vertex_along_edge() {
    const Line s(site(s_.site));
    if (s.side(site(j_).a) <= 0) return;
    if (walks_.is_isolated(j_)) {
      out_.add(infinite(-1), infinite(1));
      return;
    }
    const SiteEnds& ends = walks_.ends[j_];
    const Line in(site(ends.prev)), next(site(ends.next));
    const int in_cross = -cross_sign(s.a, s.b, in.a, in.b), out_cross = -cross_sign(s.a, s.b, next.a, next.b);
    const bool from_away = in_cross == 0 && dot_sign(s.a, s.b, in.a, in.b) > 0;
    const bool to_away = out_cross == 0 && dot_sign(s.a, s.b, next.a, next.b) > 0;
    const Mark low = to_away ? infinite(-1) : order_.tangent(s_, ends.next, 0);
    const Mark high = from_away ? infinite(1) : order_.tangent(s_, ends.prev, 1);
    if (in_cross > 0 && out_cross < 0) {  // the direction away from s is one of j's
      out_.add(infinite(-1), high);
      out_.add(low, infinite(1));
    } else {
      out_.add(low, high);
    }
  }

  void edge_about_vertex() {
    const Line j(site(j_));
    if (j.side(site(s_.site).a) <= 0) return;
    add_turn(j_, 1, j_, 0);
  }

  void vertex_about_vertex() {
    if (behind()) return;
    if (walks_.is_isolated(j_)) {
      out_.add(infinite(-1), infinite(1));
      return;
    }
    add_turn(walks_.ends[j_].next, 0, walks_.ends[j_].prev, 1);
  }

  /// No direction of the vertex has j in front.
  bool behind() const {
    if (walks_.is_isolated(s_.site)) return false;
    const SiteEnds& ends = walks_.ends[s_.site];
    const Line in(site(ends.prev)), out(site(ends.next));
    const Point v = site(s_.site).a, p = site(j_).a;
    const bool of_first = cross_sign(in.a, in.b, v, p) < 0, of_last = cross_sign(out.a, out.b, v, p) < 0;
    const bool between = dot_sign(in.a, in.b, v, p) >= 0 && dot_sign(out.a, out.b, v, p) <= 0;
    return !of_first && !of_last && !between;
  }

  /// Counter-clockwise from one tangent to another.
  void add_turn(std::uint32_t from, int from_end, std::uint32_t to, int to_end) {
    const bool from_opposite = order_.is_opposite(s_, from, from_end);
    const bool to_opposite = order_.is_opposite(s_, to, to_end);
    const Mark low = from_opposite ? infinite(-1) : order_.tangent(s_, from, from_end);
    const Mark high = to_opposite ? infinite(1) : order_.tangent(s_, to, to_end);
    if (order_.compare(s_, low, high) < 0) {
      out_.add(low, high);
    } else {  // past the direction opposite to the axis
      out_.add(infinite(-1), high);
      out_.add(low, infinite(1));
    }
  }

  Order& order_;
  const Walks& walks_;
  Section s_;
  std::uint32_t j_;
  Domain out_;
};

}  // namespace

Domain domain(Order& order, const Section& s, std::uint32_t j) { return DomainOf(order, s, j)(); }

Envelope::Envelope(Order& order, const Section& section)
    : order_(order), section_(section), on_edge_(order.walks().is_edge(section.site)) {
  functions_.push_back({});
  parts_.push_back(
      {order.mark(section, {.kind = Mark::Kind::start}), order.mark(section, {.kind = Mark::Kind::end}), 0});
}

void Envelope::insert(std::uint32_t j) {
  const Domain where = domain(order_, section_, j);
  if (where.count == 0) return;
  functions_.push_back({j, order_.near().function(section_, j)});
  for (int i = 0; i < where.count; ++i)
    insert_interval(static_cast<std::uint32_t>(functions_.size() - 1), where.intervals[static_cast<std::size_t>(i)]);
}

void Envelope::insert_interval(std::uint32_t slot, Interval s) {
  // The parts that it meets, and one on either side, which may be of the same function.
  auto first = std::partition_point(parts_.begin(), parts_.end(), [&](const Part& p) { return !less(s.low, p.to); });
  auto last = std::partition_point(first, parts_.end(), [&](const Part& p) { return less(p.from, s.high); });
  if (first != parts_.begin()) --first;
  if (last != parts_.end()) ++last;
  scratch_.clear();
  for (auto p = first; p != last; ++p) {
    const Part& part = *p;
    const bool from_inside = less(part.from, s.low), to_inside = less(s.high, part.to);
    const Mark &low = from_inside ? s.low : part.from, &high = to_inside ? s.high : part.to;
    if (!less(low, high)) {
      put(part.from, part.to, part.slot);
      continue;
    }
    if (from_inside) put(part.from, low, part.slot);
    compete(part, slot, low, high);
    if (to_inside) put(high, part.to, part.slot);
  }
  const auto kept = std::min<std::ptrdiff_t>(last - first, std::ssize(scratch_));
  const auto at = std::copy_n(scratch_.begin(), kept, first);
  parts_.insert(parts_.erase(at, last), scratch_.begin() + kept, scratch_.end());
}

/// The smaller disc, or greater curvature, of the part's function and another, from low to high.
void Envelope::compete(const Part& part, std::uint32_t slot, const Mark& low, const Mark& high) {
  const Function &f = functions_[slot], &g = functions_[part.slot];
  if (part.slot == 0 && on_edge_) return put(low, high, slot);
  // About a vertex, 1 / radius is (1 + n.w) / h for an edge: never negative.
  if (part.slot == 0 && order_.walks().is_edge(f.site)) return put(low, high, slot);
  const bool second = part.slot != 0 && f.site < g.site;
  const std::uint32_t i = part.slot == 0 ? f.site : second ? f.site : g.site;
  const std::uint32_t j = part.slot == 0 ? kNoIndex : second ? g.site : f.site;
  // f - g, or g - f if second; f wins where it is negative, times this
  const Quadratic<exact::Interval> h = part.slot == 0 ? f.near : second ? g.near - f.near : f.near - g.near;
  const int sense = (second ? -1 : 1) * (on_edge_ ? 1 : -1);
  const bool alone = part.slot == 0;
  const QuadraticSigns signs = alone ? order_.signs(section_, kNoIndex, i, h) : order_.signs(section_, i, j, h);
  const auto whole = [&](bool wins) { put(low, high, wins ? slot : part.slot); };
  if (signs.a == 0 && signs.b == 0) return whole(sense * signs.c < 0);
  if (signs.a != 0 && signs.discriminant <= 0) return whole(sense * signs.a < 0);
  const auto root = [&](int k) {
    return order_.mark(section_, {.kind = Mark::Kind::crossing,
                                  .root = static_cast<std::uint8_t>(k),
                                  .lead = static_cast<std::int8_t>(signs.a),
                                  .slope = static_cast<std::int8_t>(signs.b),
                                  .i = i,
                                  .j = j});
  };
  // The signs before the first root, between the roots, after the last.
  const int roots = signs.a == 0 ? 1 : 2;
  int sign = sense * (signs.a == 0 ? -signs.b : signs.a);
  Mark at = low;
  for (int k = 0; k < roots; ++k, sign = -sign) {
    const Mark x = root(k);
    if (!less(at, x)) continue;
    if (!less(x, high)) break;
    put(at, x, sign < 0 ? slot : part.slot);
    at = x;
  }
  put(at, high, sign < 0 ? slot : part.slot);
}

void Envelope::put(const Mark& from, const Mark& to, std::uint32_t slot) {
  if (!scratch_.empty() && scratch_.back().slot == slot) {
    scratch_.back().to = to;
  } else {
    scratch_.push_back({from, to, slot});
  }
}

std::vector<Piece> Envelope::pieces() const {
  std::vector<Piece> out;
  out.reserve(parts_.size());
  for (const Part& part : parts_) out.push_back({functions_[part.slot].site, part.from, part.to});
  return out;
}

std::vector<Section> sections_of(const Walks& walks, std::uint32_t site) {
  if (walks.is_edge(site)) return {{site, 0}};
  if (walks.is_isolated(site)) return {{site, 0}, {site, 2}};
  const SiteEnds& ends = walks.ends[site];
  const Site &in = walks.sites[ends.prev], &out = walks.sites[ends.next];
  const Point o{0, 0};
  constexpr std::array<Point, 4> kAxes{Point{1, 0}, Point{0, 1}, Point{-1, 0}, Point{0, -1}};
  for (std::uint8_t axis = 0; axis < 4; ++axis) {
    const Point back = kAxes[(axis + 2) % 4];
    if (exact::dot_sign(in.a, in.b, o, back) < 0 || exact::dot_sign(out.a, out.b, o, back) > 0) return {{site, axis}};
  }
  throw std::logic_error("a corner with all directions");
}

namespace {

/// Direction `away` lies before the piece begins, counted from the first direction of the site's first section.
bool begins_past(Order& order, const CellPiece& piece, std::uint32_t other) {
  const Walks& walks = order.walks();
  for (const Section& s : sections_of(walks, piece.site)) {
    const Mark away = order.mark(s, {.kind = Mark::Kind::away, .i = other});
    const Mark start = order.mark(s, {.kind = Mark::Kind::start}), end = order.mark(s, {.kind = Mark::Kind::end});
    const bool inside = order.compare(s, start, away) <= 0 && order.compare(s, away, end) <= 0;
    if (s.axis == piece.section.axis) return inside && order.compare(s, away, piece.from) <= 0;
    if (inside) return true;  // in the section before the piece's
  }
  return false;
}

using Iterator = std::vector<std::uint32_t>::iterator;

/// Pieces of one site with one other site, so that those of a vertex begin after the direction away from the other.
/// The piece across the first direction begins last of all, though it is the first of its row.
void order_from_away(Order& order, const Cells& cells, Iterator first, Iterator last) {
  const CellPiece& piece = cells.pieces[*first];
  if (last - first < 2 || order.walks().is_edge(piece.site)) return;
  if (piece.wraps) std::rotate(first, first + 1, last);
  std::stable_partition(first, last, [&](std::uint32_t i) { return begins_past(order, cells.pieces[i], piece.other); });
}

}  // namespace

Cells join_cells(const Walks& walks, const std::vector<Section>& sections,
                 const std::vector<std::vector<Piece>>& rows) {
  Cells cells;
  std::vector<CellPiece>& out = cells.pieces;
  std::size_t i = 0;
  for (const SiteLoop& loop : walks.loops) {
    const std::size_t first = out.size();
    for (; i < sections.size() && sections[i].site < loop.last; ++i) {
      const Section& s = sections[i];
      for (const Piece& p : rows[i]) {
        const bool goes_on = out.size() > first && out.back().site == s.site && out.back().other == p.other;
        if (goes_on) {
          out.back().to_section = s;
          out.back().to = p.to;
        } else {
          out.push_back({.site = s.site, .other = p.other, .section = s, .to_section = s, .from = p.from, .to = p.to});
        }
      }
    }
    // Round an isolated point the last piece may be the beginning of the first.
    if (out.size() > first + 1 && out[first].site == out.back().site && out[first].other == out.back().other) {
      out[first].section = out.back().section;
      out[first].from = out.back().from;
      out[first].wraps = true;
      out.pop_back();
    }
    for (std::size_t k = first; k < out.size(); ++k) {
      out[k].prev = static_cast<std::uint32_t>(k == first ? out.size() - 1 : k - 1);
      out[k].next = static_cast<std::uint32_t>(k + 1 == out.size() ? first : k + 1);
    }
  }
  return cells;
}

bool match_cells(Order& order, Cells& cells) {
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = 0; i < cells.pieces.size(); ++i) {
    if (cells.pieces[i].other != kNoIndex) list.push_back(i);
  }
  const auto pair_of = [&](std::uint32_t i) {
    const CellPiece& p = cells.pieces[i];
    return std::array<std::uint32_t, 3>{std::min(p.site, p.other), std::max(p.site, p.other), p.site};
  };
  std::stable_sort(list.begin(), list.end(), [&](std::uint32_t i, std::uint32_t j) { return pair_of(i) < pair_of(j); });
  for (auto first = list.begin(); first != list.end();) {
    const auto pair = pair_of(*first);
    auto midpoint = first, last = first;
    while (midpoint != list.end() && pair_of(*midpoint) == pair) ++midpoint;
    for (last = midpoint; last != list.end() && pair_of(*last)[0] == pair[0] && pair_of(*last)[1] == pair[1];) ++last;
    if (midpoint - first != last - midpoint) return false;
    order_from_away(order, cells, first, midpoint);
    order_from_away(order, cells, midpoint, last);
    const auto count = midpoint - first;
    for (std::ptrdiff_t k = 0; k < count; ++k) {
      const std::uint32_t i = first[k], j = midpoint[count - 1 - k];
      cells.pieces[i].mate = j;
      cells.pieces[j].mate = i;
    }
    first = last;
  }
  return true;
}

}  // namespace dymsum::shape
