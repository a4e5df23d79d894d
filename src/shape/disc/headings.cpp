#include "shape/disc/headings.h"

#include <stdexcept>
#include <type_traits>

#include "shape/disc/lazy_vector.h"

namespace dymsum::shape {

namespace {

using exact::Interval;
using exact::RootExpression;

/// The direction whose passes are counted. Any one does: edges along it are rare, and zeros take long.
constexpr int kFixed[] = {1021, 577};

template <class T>
Vector<T> left_of(const Vector<T>& v) {
  return {-v.y, v.x};
}
template <class T>
Vector<T> right_of(const Vector<T>& v) {
  return {v.y, -v.x};
}

/// Directions as vectors in a number type.
template <class T>
class HeadingVectors {
 public:
  explicit HeadingVectors(const DiscPositions& positions) : positions_(positions) {}

  Vector<T> of(const Heading& heading) const {
    if (heading.of == Heading::Of::edge) {
      const Site& site = positions_.complex().sites[heading.site];
      return between<T>(site.a, site.b);
    }
    if (heading.of == Heading::Of::vertex)
      return left_of(centre(heading.disc, positions_.complex().sites[heading.site].a));
    const Point origin = touched_by(heading.disc);
    const Vector<T> d = minus(centre(heading.other, origin), centre(heading.disc, origin));
    return right_of(heading.of == Heading::Of::touch ? d : crossing(d, radius(), !heading.entered));
  }

 private:
  T radius() const;
  Vector<T> centre(const CornerDisc& disc, Point origin) const;

  Point touched_by(const CornerDisc& disc) const {
    const Complex& complex = positions_.complex();
    const std::uint32_t edge = disc.at_node ? complex.spokes[complex.first_spoke[disc.index]].edge : disc.index;
    return complex.sites[complex.edges[edge].left].a;
  }

  const DiscPositions& positions_;
};

template <>
Interval HeadingVectors<Interval>::radius() const {
  return positions_.level().near;
}
template <>
RootExpression HeadingVectors<RootExpression>::radius() const {
  return positions_.level().exact;
}

template <>
Vector<Interval> HeadingVectors<Interval>::centre(const CornerDisc& disc, Point origin) const {
  if (!disc.at_node) return centre_on_edge(positions_.complex(), disc.index, positions_.level().near, origin);
  const Point c = positions_.complex().nodes[disc.index].centre;
  const double off = positions_.at_error();
  return {Interval(c.x - off, c.x + off) - Interval(origin.x), Interval(c.y - off, c.y + off) - Interval(origin.y)};
}
template <>
Vector<RootExpression> HeadingVectors<RootExpression>::centre(const CornerDisc& disc, Point origin) const {
  return positions_.exact_centre_from(disc, origin);
}

/// Counts the passes of one ring.
class PassCount {
 public:
  PassCount(const DiscPositions& positions, Bend bend)
      : positions_(positions), near_(positions), exact_(positions), bend_(bend) {}

  int of(const Headings& headings) {
    bool before = is_behind(headings.back()[1]);
    for (const auto& [start, end] : headings) {
      const bool at_start = is_behind(start);
      add(before, at_start, bend_ == Bend::clockwise ? Bend::counter_clockwise : Bend::clockwise);
      before = at_start;
      if (start.of == Heading::Of::edge && start == end) continue;  // straight on
      before = is_behind(end);
      add(at_start, before, bend_);
      if (bend_ == Bend::counter_clockwise && at_start == before && is_isolated(start) && is_long_way(start, end))
        ++count_;
    }
    return count_;
  }

 private:
  /// Whether a direction is half a turn or less clockwise of the fixed one, but not that one itself.
  bool is_behind(const Heading& heading) const {
    const auto across = [](const auto& v) {
      using T = std::decay_t<decltype(v.x)>;
      return T(kFixed[0]) * v.y - T(kFixed[1]) * v.x;
    };
    if (const auto side = sign_of(across(near_.of(heading))); side && *side != 0) return *side < 0;
    const Vector<RootExpression> v = exact_.of(heading);
    const int side = exact::sign_of(across(v));
    return side != 0 ? side < 0 : exact::sign_of(v.x) < 0;
  }

  /// Turning by half a turn at most.
  void add(bool from_behind, bool to_behind, Bend bend) {
    if (bend == Bend::counter_clockwise && from_behind && !to_behind) ++count_;
    if (bend == Bend::clockwise && !from_behind && to_behind) --count_;
  }

  bool is_isolated(const Heading& heading) const {
    const std::vector<Site>& sites = positions_.complex().sites;
    const auto shares_loop = [&](std::uint32_t site) {
      return site < sites.size() && sites[site].loop == sites[heading.site].loop;
    };
    return heading.of == Heading::Of::vertex && sites[heading.site].kind == Site::Kind::vertex &&
           !shares_loop(heading.site + 1) && !shares_loop(heading.site - 1);
  }

  /// Whether, of two directions in one half plane, it takes more than half a turn counter-clockwise, past the fixed
  /// direction, or a whole one.
  bool is_long_way(const Heading& from, const Heading& to) const {
    if (const auto side = sign_of(cross(near_.of(from), near_.of(to)))) return *side <= 0;
    return exact::sign_of(cross(exact_.of(from), exact_.of(to))) <= 0;
  }

  const DiscPositions& positions_;
  HeadingVectors<Interval> near_;
  HeadingVectors<RootExpression> exact_;
  Bend bend_;
  int count_ = 0;
};

}  // namespace

bool runs_counter_clockwise(const DiscPositions& positions, const Headings& headings, Bend bend) {
  if (headings.empty()) return bend == Bend::counter_clockwise;
  const int count = PassCount(positions, bend).of(headings);
  if (count != 1 && count != -1) throw std::logic_error("a ring of a disc's set does not go round once");
  return count > 0;
}

}  // namespace dymsum::shape
