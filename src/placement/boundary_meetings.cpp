#include "placement/boundary_meetings.h"

#include <algorithm>
#include <optional>

namespace dymsum::placement {
namespace {

using Kind = BoundaryEdge::Kind;

/// A meeting of an edge: what lies before and after it there, where that is known.
struct Cut {
  std::uint32_t edge = 0;
  Site at;
  std::optional<bool> before, after;
};
/// A part of an edge that lies on one of the other set.
struct Along {
  std::uint32_t edge = 0;
  Site from, to;
  bool right_covered = false;
};
struct Found {
  std::vector<Cut> cuts;
  std::vector<Along> along;
};

Site start(EdgeOf f) { return vertex_site(*f.set, f->from); }
Site end(EdgeOf f) { return vertex_site(*f.set, f->to); }

/// A box that holds an edge.
struct EdgeBox {
  double x0, x1, y0, y1;
  explicit EdgeBox(EdgeOf f) {
    const NearPoint &a = f.from(), &b = f.to();
    x0 = std::min(a.x.low(), b.x.low()), x1 = std::max(a.x.high(), b.x.high());
    y0 = std::min(a.y.low(), b.y.low()), y1 = std::max(a.y.high(), b.y.high());
  }
  bool meets(const EdgeBox& o) const { return x0 <= o.x1 && o.x0 <= x1 && y0 <= o.y1 && o.y0 <= y1; }
  bool meets(const std::array<double, 4>& box) const {
    return x0 <= box[2] && box[0] <= x1 && y0 <= box[3] && box[1] <= y1;
  }
};

class MeetingFinder {
 public:
  std::array<Found, 2> run(const PlacedSet& a, const PlacedSet& b) {
    for (std::uint32_t e = 0; e < a.set().edges().size(); ++e) {
      const EdgeOf f{&a, e};
      const EdgeBox box(f);
      if (!box.meets(b.box())) continue;
      const double low = (Interval(box.y0) - b.move().y).low(), high = (Interval(box.y1) - b.move().y).high();
      b.set().for_each_between(low, high, [&](std::uint32_t k) {
        const EdgeOf g{&b, k};
        if (box.meets(EdgeBox(g))) meet(f, g);
      });
    }
    return std::move(found_);
  }

 private:
  void meet(EdgeOf f, EdgeOf g) {
    if (f->kind == Kind::point || g->kind == Kind::point) {
      meet_points(f, g);
      return;
    }
    const int s1 = side(f, *g.set, g->from), s2 = side(f, *g.set, g->to);
    if (s1 * s2 > 0) return;
    if (s1 == 0 && s2 == 0) {
      meet_collinear(f, g);
      return;
    }
    const int r1 = side(g, *f.set, f->from), r2 = side(g, *f.set, f->to);
    if (r1 * r2 > 0) return;
    if (s1 * s2 * r1 * r2 != 0) {
      const Site at = crossing_site(f, g);
      add_crossing(0, f.edge, at, g->kind, r1, r2);
      add_crossing(1, g.edge, at, f->kind, s1, s2);
      return;
    }
    const auto on_f = [&] { return r1 == 0 ? start(f) : end(f); };
    const auto on_g = [&] { return s1 == 0 ? start(g) : end(g); };
    add(0, f.edge, r1 * r2 == 0 ? on_f() : on_g());
    add(1, g.edge, s1 * s2 == 0 ? on_g() : on_f());
  }

  void meet_points(EdgeOf f, EdgeOf g) {
    const bool f_is_point = f->kind == Kind::point;
    const Site p = f_is_point ? start(f) : start(g);
    const EdgeOf e = f_is_point ? g : f;
    if (e->kind == Kind::point) {
      if (compare(p, start(e), 0) != 0 || compare(p, start(e), 1) != 0) return;
    } else if (side(e, *p.set, p.index) != 0 || compare_along(e, start(e), p) > 0 || compare_along(e, p, end(e)) > 0) {
      return;
    }
    add(0, f.edge, f_is_point ? start(f) : p);
    add(1, g.edge, f_is_point ? p : start(g));
  }

  void meet_collinear(EdgeOf f, EdgeOf g) {
    const bool same = same_direction(f, g);
    const Site g_low = same ? start(g) : end(g), g_high = same ? end(g) : start(g);
    const Site low = compare_along(f, start(f), g_low) < 0 ? g_low : start(f);
    const Site high = compare_along(f, end(f), g_high) > 0 ? g_high : end(f);
    const int order = compare_along(f, low, high);
    if (order > 0) return;
    for (int k = 0; k < 2; ++k) {
      const std::uint32_t edge = k == 0 ? f.edge : g.edge;
      add(k, edge, low);
      if (order == 0) continue;
      add(k, edge, high);
      const bool forward = k == 0 || same, right = !same || (k == 0 ? g : f)->kind == Kind::crack;
      found_[static_cast<std::size_t>(k)].along.push_back({edge, forward ? low : high, forward ? high : low, right});
    }
  }

  void add(int k, std::uint32_t edge, const Site& at) {
    found_[static_cast<std::size_t>(k)].cuts.push_back({edge, at, std::nullopt, std::nullopt});
  }
  // An edge that comes from the left of a ring's edge has been in the set.
  void add_crossing(int k, std::uint32_t edge, const Site& at, Kind other, int from_side, int to_side) {
    Cut cut{edge, at, std::nullopt, std::nullopt};
    if (other == Kind::ring) cut.before = from_side > 0, cut.after = to_side > 0;
    found_[static_cast<std::size_t>(k)].cuts.push_back(std::move(cut));
  }

  std::array<Found, 2> found_;
};

/// The cover of a set by another, given where they meet.
class CoverBuilder {
 public:
  CoverBuilder(const PlacedSet& set, const PlacedSet& by, Found found) : set_(set), by_(by), found_(std::move(found)) {
    const auto by_edge = [](const auto& a, const auto& b) { return a.edge < b.edge; };
    std::stable_sort(found_.cuts.begin(), found_.cuts.end(), by_edge);
    std::stable_sort(found_.along.begin(), found_.along.end(), by_edge);
  }

  Cover run() {
    cover_.by = &by_;
    const auto& edges = set_.set().edges();
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      if (e == 0 || edges[e - 1].to != edges[e].from) last_ = std::nullopt;
      const std::vector<Cut> cuts = cuts_of({&set_, e});
      if (cuts.empty()) add_whole({&set_, e});
      else add_cut({&set_, e}, cuts);
    }
    return std::move(cover_);
  }

 private:
  // Sorted, each position once.
  std::vector<Cut> cuts_of(EdgeOf f) {
    const std::size_t first = next_cut_;
    while (next_cut_ < found_.cuts.size() && found_.cuts[next_cut_].edge == f.edge) ++next_cut_;
    const auto begin = found_.cuts.begin() + static_cast<std::ptrdiff_t>(first),
               end = found_.cuts.begin() + static_cast<std::ptrdiff_t>(next_cut_);
    if (f->kind == Kind::point && begin != end) return {*begin};
    std::stable_sort(begin, end, [&](const Cut& a, const Cut& b) { return compare_along(f, a.at, b.at) < 0; });
    std::vector<Cut> cuts;
    for (auto c = begin; c != end; ++c) {
      if (cuts.empty() || compare_along(f, cuts.back().at, c->at) != 0) cuts.push_back(std::move(*c));
      else cuts.back().before = cuts.back().after = std::nullopt;
    }
    return cuts;
  }

  void add_whole(EdgeOf f) {
    if (!last_) {
      const Site at = start(f);
      last_ = EdgeBox(f).meets(by_.box()) ? lies_in(by_, Probe(at, at)) : by_.set().unbounded();
    }
    if (*last_) cover_.edges.push_back({f.edge, {}, {Gap{true, false, false}}});
  }

  void add_cut(EdgeOf f, const std::vector<Cut>& cuts) {
    EdgeCover cover;
    cover.edge = f.edge;
    for (const Cut& c : cuts) cover.cuts.push_back(c.at);
    cover.gaps.resize(cuts.size() + 1);
    mark_along(f, cover);
    const bool starts = compare_along(f, start(f), cuts.front().at) == 0;
    const bool ends = f->kind == Kind::point || compare_along(f, end(f), cuts.back().at) == 0;
    for (std::size_t k = starts ? 1 : 0; k < cuts.size() + (ends ? 0 : 1); ++k)
      if (!cover.gaps[k].along) cover.gaps[k].covered = covered(f, cuts, k);
    last_ = ends ? std::nullopt : std::optional(cover.gaps.back().covered);
    cover_.edges.push_back(std::move(cover));
  }

  void mark_along(EdgeOf f, EdgeCover& cover) {
    for (; next_along_ < found_.along.size() && found_.along[next_along_].edge == f.edge; ++next_along_) {
      const Along& a = found_.along[next_along_];
      for (std::size_t k = 1; k < cover.cuts.size(); ++k) {
        if (compare_along(f, cover.cuts[k - 1], a.from) < 0 || compare_along(f, cover.cuts[k], a.to) > 0) continue;
        cover.gaps[k].along = true;
        cover.gaps[k].right_covered |= a.right_covered;
      }
    }
  }

  bool covered(EdgeOf f, const std::vector<Cut>& cuts, std::size_t gap) const {
    if (gap == 0 && last_) return *last_;
    if (gap > 0 && cuts[gap - 1].after) return *cuts[gap - 1].after;
    if (gap < cuts.size() && cuts[gap].before) return *cuts[gap].before;
    const Site from = gap == 0 ? start(f) : cuts[gap - 1].at, to = gap == cuts.size() ? end(f) : cuts[gap].at;
    return lies_in(by_, Probe(from, to));
  }

  const PlacedSet &set_, &by_;
  Found found_;
  Cover cover_;
  std::size_t next_cut_ = 0, next_along_ = 0;
  std::optional<bool> last_;  // whether the end of the last edge lies in the other set, where it is not on its boundary
};

/// Whether a vertex lies no higher than a position.
bool not_above(const PlacedSet& set, std::uint32_t vertex, const Probe& probe) {
  const Interval &y = set.near(vertex).y, &at = probe.near().y;
  if (y.high() < at.low()) return true;
  if (y.low() > at.high()) return false;
  if (y.is_point() && at.is_point()) return y.low() <= at.low();
  ++exact_signs();
  const HomogeneousPoint v = set.exact(vertex);
  return BigInteger(v.y * probe.exact().w) <= BigInteger(probe.exact().y * v.w);
}

}  // namespace

std::array<Cover, 2> covers(const PlacedSet& a, const PlacedSet& b) {
  std::array<Found, 2> found = MeetingFinder().run(a, b);
  return {CoverBuilder(a, b, std::move(found[0])).run(), CoverBuilder(b, a, std::move(found[1])).run()};
}

bool lies_in(const PlacedSet& set, const Probe& probe) {
  const NearPoint& at = probe.near();
  bool inside = set.set().unbounded();
  const double low = (Interval(at.y.low()) - set.move().y).low(), high = (Interval(at.y.high()) - set.move().y).high();
  set.set().for_each_between(low, high, [&](std::uint32_t e) {
    const EdgeOf f{&set, e};
    if (f->kind != Kind::ring || std::max(f.from().x.high(), f.to().x.high()) < at.x.low()) return;
    const bool up = not_above(set, f->from, probe);
    if (up == not_above(set, f->to, probe)) return;
    if (std::min(f.from().x.low(), f.to().x.low()) > at.x.high() || side(f, probe) == (up ? 1 : -1)) inside = !inside;
  });
  return inside;
}

}  // namespace dymsum::placement
