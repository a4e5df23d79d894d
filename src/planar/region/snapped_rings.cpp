#include "planar/region/snapped_rings.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "exact/big.h"
#include "exact/orient.h"
#include "planar/region/region_sweep.h"

namespace dymsum::planar {

namespace {

bool less(Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

struct Less {
  bool operator()(Point a, Point b) const { return less(a, b); }
};

/// A sum of bounds, not below the exact one.
double bound_of_sum(double a, double b) {
  const double sum = a + b;
  return sum == 0 ? 0 : std::nextafter(sum, std::numeric_limits<double>::infinity());
}

/// A segment from a to b, a < b, and the rings that run along it.
struct Piece {
  Point a, b;
  int forth = 0, back = 0;  ///< how many rings run from a to b, and from b to a
  double moved = 0;         ///< from the edges that it is of
  std::vector<std::uint32_t> rings;
};

using PieceMap = std::map<std::pair<Point, Point>, Piece, decltype([](const auto& u, const auto& v) {
                            return u.first == v.first ? less(u.second, v.second) : less(u.first, v.first);
                          })>;

void add(PieceMap& pieces, Point from, Point to, Piece piece) {
  if (less(to, from)) std::swap(from, to), std::swap(piece.forth, piece.back);
  piece.a = from, piece.b = to;
  const auto [at, is_new] = pieces.try_emplace({from, to}, piece);
  if (is_new) return;
  Piece& known = at->second;
  known.forth += piece.forth, known.back += piece.back;
  known.moved = std::max(known.moved, piece.moved);
  known.rings.insert(known.rings.end(), piece.rings.begin(), piece.rings.end());
  std::sort(known.rings.begin(), known.rings.end());
  known.rings.erase(std::unique(known.rings.begin(), known.rings.end()), known.rings.end());
}

struct Cut {
  Point at;
  double off = 0;  ///< from the piece, at most
};

/// The position at which two pieces cross that do so in their interiors.
Cut crossing(const Piece& e, const Piece& f) {
  using exact::exact_value, exact::BigRational;
  const BigRational ax = exact_value(e.a.x), ay = exact_value(e.a.y), dx = exact_value(e.b.x) - ax,
                    dy = exact_value(e.b.y) - ay, cx = exact_value(f.a.x), cy = exact_value(f.a.y),
                    gx = exact_value(f.b.x) - cx, gy = exact_value(f.b.y) - cy;
  const BigRational t = ((cx - ax) * gy - (cy - ay) * gx) / (dx * gy - dy * gx), x = ax + t * dx, y = ay + t * dy;
  const Point at{exact::round_to_double(x), exact::round_to_double(y)};
  const auto off = [](double rounded, const BigRational& v) {
    const BigRational d = abs(BigRational(exact_value(rounded) - v));
    return d.is_zero() ? 0 : std::nextafter(exact::round_to_double(d), std::numeric_limits<double>::infinity());
  };
  return {at, bound_of_sum(std::hypot(off(at.x, x), off(at.y, y)), 0)};
}

/// Whether a point is on a piece and none of its ends.
bool inside(const Piece& e, Point z) {
  return e.a.x <= z.x && z.x <= e.b.x && std::min(e.a.y, e.b.y) <= z.y && z.y <= std::max(e.a.y, e.b.y) && z != e.a &&
         z != e.b && exact::orient_sign(e.a, e.b, z) == 0;
}

/// Cuts pieces where they meet, until they meet in their ends only.
class Noding {
 public:
  explicit Noding(PieceMap pieces) {
    for (auto& [ends, piece] : pieces) pieces_.push_back(std::move(piece));
    while (cut_once()) {
    }
  }
  std::vector<Piece> pieces_;
  std::size_t bends_ = 0;

 private:
  bool cut_once() {
    cuts_.assign(pieces_.size(), {});
    std::vector<std::uint32_t> active;
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {  // sorted by a
      std::size_t kept = 0;
      for (const std::uint32_t j : active) {
        if (pieces_[j].b.x < pieces_[i].a.x) continue;
        active[kept++] = j;
        meet(i, j);
      }
      active.resize(kept);
      active.push_back(i);
    }
    PieceMap next;
    bool any = false;
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      any = any || !cuts_[i].empty();
      replace(std::move(pieces_[i]), std::move(cuts_[i]), next);
    }
    pieces_.clear();
    for (auto& [ends, piece] : next) pieces_.push_back(std::move(piece));
    return any;
  }

  void meet(std::uint32_t i, std::uint32_t j) {
    const Piece &e = pieces_[i], &f = pieces_[j];
    if (std::max(e.a.y, e.b.y) < std::min(f.a.y, f.b.y) || std::max(f.a.y, f.b.y) < std::min(e.a.y, e.b.y)) return;
    const int fa = exact::orient_sign(e.a, e.b, f.a), fb = exact::orient_sign(e.a, e.b, f.b);
    if (fa * fb > 0) return;
    const int ea = exact::orient_sign(f.a, f.b, e.a), eb = exact::orient_sign(f.a, f.b, e.b);
    if (ea * eb > 0) return;
    if (fa * fb < 0 && ea * eb < 0) {
      const Cut cut = crossing(e, f);
      cut_at(i, cut);
      cut_at(j, cut);
      return;
    }
    for (const Point z : {f.a, f.b})
      if (inside(e, z)) cut_at(i, {z, 0});
    for (const Point z : {e.a, e.b})
      if (inside(f, z)) cut_at(j, {z, 0});
  }
  void cut_at(std::uint32_t i, Cut cut) {
    if (cut.at != pieces_[i].a && cut.at != pieces_[i].b) cuts_[i].push_back(cut);
  }

  /// Rounding keeps the order of coordinates: the cuts of a piece are in order along it, in x and in y.
  void replace(Piece piece, std::vector<Cut> cuts, PieceMap& next) {
    const Point a = piece.a, b = piece.b;
    const bool falls = b.y < a.y;
    std::sort(cuts.begin(), cuts.end(), [&](const Cut& u, const Cut& v) {
      return u.at.x != v.at.x ? u.at.x < v.at.x : falls ? u.at.y > v.at.y : u.at.y < v.at.y;
    });
    double off = 0;
    for (const Cut& cut : cuts) off = std::max(off, cut.off);
    piece.moved = bound_of_sum(piece.moved, off);
    Point from = a;
    for (const Cut& cut : cuts) {
      if (cut.at == from) continue;
      add(next, from, cut.at, piece);
      from = cut.at;
      ++bends_;
    }
    add(next, from, b, piece);
  }

  std::vector<std::vector<Cut>> cuts_;
};

/// The winding numbers beside pieces that meet in their ends only.
class WindingSweep {
 public:
  explicit WindingSweep(const std::vector<Piece>& pieces)
      : above(pieces.size()), below(pieces.size()), line_(Order{&pieces}) {
    std::map<Point, Event, Less> events;
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
      events[pieces[i].a].start.push_back(i);
      events[pieces[i].b].end.push_back(i);
    }
    std::vector<Line::iterator> at(pieces.size());
    for (auto& [point, event] : events) {
      for (const std::uint32_t i : event.end) line_.erase(at[i]);
      std::sort(event.start.begin(), event.start.end(), Order{&pieces});
      for (const std::uint32_t i : event.start) {
        at[i] = line_.insert(i).first;
        below[i] = at[i] == line_.begin() ? 0 : above[*std::prev(at[i])];
        above[i] = below[i] + pieces[i].forth - pieces[i].back;
      }
    }
  }

  std::vector<int> above, below;  ///< beside the piece, as seen from its smaller end: on the left, on the right

 private:
  struct Event {
    std::vector<std::uint32_t> start, end;
  };
  /// The order from below of pieces that meet the sweep line.
  struct Order {
    const std::vector<Piece>* pieces;
    bool operator()(std::uint32_t i, std::uint32_t j) const {
      if (i == j) return false;
      const Piece &e = (*pieces)[i], &f = (*pieces)[j];
      if (e.a == f.a) return exact::orient_sign(e.a, e.b, f.b) > 0;
      return less(e.a, f.a) ? exact::orient_sign(e.a, e.b, f.a) > 0 : exact::orient_sign(f.a, f.b, e.a) < 0;
    }
  };
  using Line = std::set<std::uint32_t, Order>;

  Line line_;
};

/// A piece with the set on its left.
struct Side {
  Point from, to;
  std::uint32_t next = 0;
};

/// Around every point, each way in goes on with the other side of the sector of the set that it bounds.
void join(std::vector<Side>& sides) {
  struct Ray {
    std::uint32_t side;
    bool out;
  };
  std::map<Point, std::vector<Ray>, Less> points;
  for (std::uint32_t i = 0; i < sides.size(); ++i) {
    points[sides[i].from].push_back({i, true});
    points[sides[i].to].push_back({i, false});
  }
  for (auto& [at, rays] : points) {
    const Point z = at;
    const auto end = [&](const Ray& r) { return r.out ? sides[r.side].to : sides[r.side].from; };
    const auto half = [&](Point p) { return p.y > z.y || (p.y == z.y && p.x > z.x) ? 0 : 1; };
    std::sort(rays.begin(), rays.end(), [&](const Ray& r, const Ray& s) {
      const Point p = end(r), q = end(s);
      return half(p) != half(q) ? half(p) < half(q) : exact::orient_sign(z, p, q) > 0;
    });
    for (std::size_t i = 0; i < rays.size(); ++i)
      if (!rays[i].out) sides[rays[i].side].next = rays[(i + rays.size() - 1) % rays.size()].side;
  }
}

/// The walks along the sides, taken apart where they visit a point again.
std::vector<Ring> simple_rings(const std::vector<Side>& sides) {
  std::vector<Ring> rings;
  std::vector<std::uint8_t> done(sides.size(), 0);
  for (std::uint32_t start = 0; start < sides.size(); ++start) {
    if (done[start]) continue;
    Ring walk;
    std::map<Point, std::size_t, Less> position;
    for (std::uint32_t i = start; !done[i]; i = sides[i].next) {
      done[i] = 1;
      const auto [seen, is_new] = position.try_emplace(sides[i].from, walk.size());
      if (!is_new) {
        const auto first = walk.begin() + static_cast<std::ptrdiff_t>(seen->second);
        for (auto p = first + 1; p != walk.end(); ++p) position.erase(*p);
        rings.emplace_back(first, walk.end());
        walk.erase(first, walk.end());
      }
      walk.push_back(sides[i].from);
    }
    rings.push_back(std::move(walk));
  }
  for (Ring& ring : rings) std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), less), ring.end());
  return rings;
}

std::vector<Part> nested(std::vector<Ring> rings) {
  RingList list;
  for (const Ring& ring : rings) list.add(ring);
  const RingLayout layout = layout_rings(list);
  if (layout.clash) throw std::logic_error("snapped_rings: rings cross");
  std::vector<Part> parts;
  std::vector<std::size_t> part_of(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (!layout.rings[r].counter_clockwise) continue;
    part_of[r] = parts.size();
    parts.push_back({std::move(rings[r]), {}});
  }
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (!layout.rings[r].counter_clockwise) parts[part_of[layout.rings[r].container]].holes.push_back(rings[r]);
  return parts;
}

/// Chains of segments that are as long as no third one begins.
std::vector<Polyline> chains(const std::vector<const Piece*>& lines) {
  std::map<Point, std::vector<std::size_t>, Less> at;
  for (std::size_t i = 0; i < lines.size(); ++i) at[lines[i]->a].push_back(i), at[lines[i]->b].push_back(i);
  std::vector<std::uint8_t> done(lines.size(), 0);
  std::vector<Polyline> made;
  const auto walk = [&](Point from, std::size_t i) {
    Polyline line{from};
    while (!done[i]) {
      done[i] = 1;
      line.push_back(lines[i]->a == line.back() ? lines[i]->b : lines[i]->a);
      const std::vector<std::size_t>& there = at[line.back()];
      if (there.size() == 2) i = there[0] == i ? there[1] : there[0];
    }
    made.push_back(std::move(line));
  };
  for (const auto& [point, there] : at)
    if (there.size() != 2)
      for (const std::size_t i : there)
        if (!done[i]) walk(point, i);
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!done[i]) walk(lines[i]->a, i);
  return made;
}

/// Whether a point lies in what the pieces bound, or on one of them.
bool is_covered(const std::vector<Piece>& pieces, Point z) {
  int winding = 0;
  for (const Piece& e : pieces) {
    if (z == e.a || z == e.b || inside(e, z)) return true;
    const bool rises = e.a.y <= z.y && z.y < e.b.y, falls = e.b.y <= z.y && z.y < e.a.y;
    const int side = rises || falls ? exact::orient_sign(e.a, e.b, z) : 0;
    if (rises && side > 0) winding += e.forth - e.back;
    if (falls && side < 0) winding -= e.forth - e.back;
  }
  return winding > 0;
}

class Snapping {
 public:
  explicit Snapping(const RegionData& data) {
    for (const Part& part : data.parts) {
      add_ring(part.outer, true);
      for (const Ring& hole : part.holes) add_ring(hole, false);
    }
    add_thin(data);
  }

  SnappedRings run() {
    Noding noding(std::move(edges_));
    pieces_ = std::move(noding.pieces_);
    made_.bends = noding.bends_;
    for (const Piece& piece : pieces_) made_.moved = std::max(made_.moved, piece.moved);
    collect();
    for (const auto& [at, ring] : dots_)
      if (!is_covered(pieces_, at)) {
        made_.data.points.push_back(at);
        left_[ring] = true;
        ++made_.points;
      }
    std::sort(made_.data.points.begin(), made_.data.points.end(), less);
    made_.data.points.erase(std::unique(made_.data.points.begin(), made_.data.points.end()), made_.data.points.end());
    made_.vanished_rings = static_cast<std::size_t>(std::count(left_.begin(), left_.end(), false));
    return std::move(made_);
  }

 private:
  void add_ring(const Ring& ring, bool outer) {
    const auto index = static_cast<std::uint32_t>(left_.size());
    left_.push_back(false);
    bool any = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point from = ring[i], to = ring[i + 1 == ring.size() ? 0 : i + 1];
      if (from == to) {
        ++made_.collapsed_edges;
        continue;
      }
      any = true;
      add(edges_, from, to, {from, to, 1, 0, 0, {index}});
    }
    if (!any && outer && !ring.empty()) dots_.push_back({ring.front(), index});
  }
  void add_thin(const RegionData& data) {
    made_.data.points = data.points;
    for (const Polyline& line : data.polylines) {
      Polyline kept;
      for (const Point p : line) {
        if (kept.empty() || kept.back() != p) kept.push_back(p);
        else ++made_.collapsed_edges;
      }
      if (kept.size() == 1) {
        made_.data.points.push_back(kept.front());
        ++made_.points;
      } else {
        made_.data.polylines.push_back(std::move(kept));
      }
    }
  }

  void collect() {
    const WindingSweep sweep(pieces_);
    std::vector<Side> sides;
    std::vector<const Piece*> lines;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const Piece& piece = pieces_[i];
      const bool left = sweep.above[i] > 0, right = sweep.below[i] > 0;
      if (left && right) continue;
      for (const std::uint32_t ring : piece.rings) left_[ring] = true;
      if (left) sides.push_back({piece.a, piece.b});
      else if (right) sides.push_back({piece.b, piece.a});
      else lines.push_back(&piece);
    }
    join(sides);
    made_.data.parts = nested(simple_rings(sides));
    std::vector<Polyline> thin = chains(lines);
    made_.lines = thin.size();
    for (Polyline& line : thin) made_.data.polylines.push_back(std::move(line));
  }

  PieceMap edges_;
  std::vector<Piece> pieces_;
  std::vector<bool> left_;  ///< ring -> whether the result has something of it
  std::vector<std::pair<Point, std::uint32_t>> dots_;
  SnappedRings made_;
};

}  // namespace

SnappedRings snapped_rings(const RegionData& data) { return Snapping(data).run(); }

}  // namespace dymsum::planar
