#include "spatial/events/meeting_search.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/bit_cast.h"
#include "spatial/events/lasting_crossing.h"

namespace dymsum::spatial {

namespace {

int sign_surely(double value, double error) { return value > error ? 1 : value < -error ? -1 : 0; }

/// The side of a facet's plane on which a corner stays at all scales of a window; 0 where it changes or is not sure.
int lasting_side(const MovingFacets& all, std::uint32_t f, SumPoint c, double low, double high) {
  const PlaneRow& row = all.row(f);
  const Vec3 n{row[0], row[1], row[2]}, x = all.fixed(c), m = all.moved(c);
  const auto size = [&](Vec3 v) { return std::abs(n.x * v.x) + std::abs(n.y * v.y) + std::abs(n.z * v.z); };
  const double a = dot(n, x) - row[4], b = dot(n, m) + row[3];
  const double error = (size(x) + std::abs(row[4]) + high * (size(m) + std::abs(row[3]))) * 0x1p-47;
  const int s = sign_surely(a + low * b, error);
  return s == sign_surely(a + high * b, error) ? s : 0;
}

bool share_corner(const MovingBorder& a, const MovingBorder& b) {
  return a.a == b.a || a.a == b.b || a.b == b.a || a.b == b.b;
}
}  // namespace

std::vector<double> window_ends(const MovingFacets& all, double low, double high) {
  double size = 0, way = 0;
  for (const SumFacet& facet : all.facets()) {
    Box box;
    Vec3 moved;
    for (int k = 0; k < facet.corners; ++k) {
      box.add(all.at(facet.corner[k], high));
      moved = moved + 1.0 / facet.corners * all.moved(facet.corner[k]);
    }
    size += box.size() / 3, way += length(moved);
  }
  const double steps = size > 0 ? std::clamp(std::ceil((high - low) * way / size), 1.0, 4096.0) : 1;
  std::vector<double> ends;
  for (int k = 0; k < static_cast<int>(steps); ++k) ends.push_back(low + (high - low) * k / steps);
  ends.push_back(high);
  return ends;
}

EventSearch::EventSearch(const MovingFacets& all, const ScaledOverlap& overlap, double low, double high)
    : all_(all), overlap_(overlap), low_(low), high_(high), span_(all.span(high)), room_(span_ * 0x1p-44) {
  std::vector<std::uint8_t> border(all.borders().size()), corner(all.corners().size());
  std::vector<Box> boxes;
  for (std::uint32_t f = 0; f < all.facets().size(); ++f) {
    const SumFacet& facet = all.facets()[f];
    if (overlap.deep_inside(facet, low, high)) continue;
    live_.push_back(f);
    boxes.push_back(swept({facet.corner.data(), facet.corners}));
    for (int k = 0; k < facet.corners; ++k) border[all.border_of(f, k)] = 1, corner[all.corner_of(f, k)] = 1;
  }
  facets_ = BoxTree(std::move(boxes));
  boxes.clear();
  for (std::uint32_t e = 0; e < border.size(); ++e) {
    if (border[e] == 0 || all.borders()[e].inner) continue;
    live_borders_.push_back(e);
    boxes.push_back(swept(std::array{all.borders()[e].a, all.borders()[e].b}));
  }
  borders_ = BoxTree(std::move(boxes));
  boxes.clear();
  for (std::uint32_t c = 0; c < corner.size(); ++c) {
    if (corner[c] == 0) continue;
    live_corners_.push_back(c);
    boxes.push_back(swept(all.corners()[c].at));
  }
  corners_ = BoxTree(std::move(boxes));
}

Box EventSearch::swept(SumPoint corner) const { return swept(std::span(&corner, 1)); }
Box EventSearch::swept(std::span<const SumPoint> corners) const {
  Box box;
  for (const SumPoint c : corners) box.add(all_.at(c, low_)), box.add(all_.at(c, high_));
  box.grow(room_);
  return box;
}

std::vector<MeetingEvent> EventSearch::run(const std::function<void()>& ask) {
  ask_ = &ask;
  found_.clear();
  corners_on_facets();
  corners_on_borders();
  borders_on_borders();
  borders_through_facets();
  facet_neighbours();
  four_facets();
  ask_ = nullptr;
  return std::move(found_);
}

namespace {

bool is_same(const ExactMeeting& a, const ExactMeeting& b) {
  const auto equal = [&](const exact::BigInteger& x, const exact::BigInteger& y) { return x * b.w == y * a.w; };
  return equal(a.s, b.s) && equal(a.x[0], b.x[0]) && equal(a.x[1], b.x[1]) && equal(a.x[2], b.x[2]);
}

}  // namespace

std::size_t EventSearch::PlaneNamesHash::operator()(const PlaneNames& names) const {
  std::uint64_t h = 0;
  for (const std::uint32_t n : names) h = (h ^ n) * 0x9e3779b97f4a7c15ULL, h ^= h >> 29;
  return h;
}
std::size_t EventSearch::CellHash::operator()(const Cell& cell) const {
  std::uint64_t h = 0;
  for (const std::int64_t c : cell) {
    h ^= static_cast<std::uint64_t>(c) + 0x9e3779b97f4a7c15ULL + (h << 6) + (h >> 2);
    h ^= h >> 31, h *= 0x7fb5d329728ea185ULL, h ^= h >> 29;
  }
  return h;
}

/// Whether all of the cell of (x, s) around a point surely lies in the open sum. Many tuples meet in one point, and
/// ask.
bool EventSearch::is_covered(const NearMeeting& at) {
  const double step = std::ldexp(1.0, std::ilogb(span_) - 28), s_step = std::ldexp(1.0, std::ilogb(high_) - 28);
  if (at.radius > step || at.s_radius > s_step) return false;
  const auto cell = [](double v, double width) { return std::floor(v / width); };
  const double x = cell(at.x.x, step), y = cell(at.x.y, step), z = cell(at.x.z, step), s = cell(at.s, s_step);
  const auto [known, fresh] = covered_.try_emplace({static_cast<std::int64_t>(x), static_cast<std::int64_t>(y),
                                                    static_cast<std::int64_t>(z), static_cast<std::int64_t>(s)},
                                                   false);
  const Vec3 middle{(x + 0.5) * step, (y + 0.5) * step, (z + 0.5) * step};
  if (fresh)
    known->second = overlap_.at(middle, (s + 0.5) * s_step, 2 * step, 2 * s_step) == ScaledOverlap::Answer::overlap;
  return known->second;
}

/// Of the doubles of an exact point.
bool EventSearch::is_in_window(const NearMeeting& at) const {
  return at.s >= low_ * (1 - 0x1p-50) && at.s <= high_ * (1 + 0x1p-50);
}

void EventSearch::add(ExactMeeting at) {
  MeetingEvent event{std::move(at), {}};
  event.near = near(event.at);
  if (!is_in_window(event.near)) return;
  const auto bits = [](double v) { return base::bit_cast<std::int64_t>(v); };
  const Cell key{bits(event.near.x.x), bits(event.near.x.y), bits(event.near.x.z), bits(event.near.s)};
  if (covered_at_.contains(key)) return;
  const auto [first, last] = found_at_.equal_range(key);
  for (auto k = first; k != last; ++k)
    if (is_same(found_[k->second].at, event.at)) return;
  if (overlap_.at(event.near.x, event.near.s, event.near.radius, event.near.s_radius) ==
      ScaledOverlap::Answer::overlap) {
    covered_at_.insert(key);
    return;
  }
  found_at_.emplace(key, found_.size());
  found_.push_back(std::move(event));
}

/// Lists a point that doubles leave open: `exact` gives it where it is one, and lies in all that is to meet there.
template <class Exact>
void EventSearch::decide(Meets meets, const NearMeeting& around, Exact exact) {
  if (meets == Meets::no) return;
  if (meets == Meets::near) {
    if (around.s < low_ - around.s_radius || around.s > high_ + around.s_radius || is_covered(around)) return;
  }
  ++exact_;
  std::optional<ExactMeeting> at = exact();
  if (!at || at->s <= 0) return;
  if (meets != Meets::near && is_covered(near(*at))) return;
  add(*std::move(at));
}

/// The same of the one point of four hyperplanes: in masses of parallel and coplanar facets many fours of them lie in
/// the same ones, which are decided once. `may_hold` and `holds` tell whether the point lies in these.
template <class MayHold, class Holds>
EventSearch::Common EventSearch::four_planes(PlaneNames names, const std::array<const PlaneRow*, 4>& rows,
                                             const std::array<const MovingPlane*, 4>& planes, MayHold may_hold,
                                             Holds holds) {
  std::sort(names.begin(), names.end());
  if (std::adjacent_find(names.begin(), names.end()) != names.end()) return Common::lasting;
  if (const auto known = known_.find(names); known != known_.end()) return known->second;
  const auto learn = [&](Common what) { return known_.emplace(names, what).first->second; };
  ++candidates_;
  NearMeeting at;
  const Meets meets = meeting_near(rows, span_, at);
  if (meets == Meets::near) {
    if (at.s < low_ - at.s_radius || at.s > high_ + at.s_radius || !may_hold(at)) return Common::open;
    if (is_covered(at)) return learn(Common::done);
  }
  ++exact_;
  std::optional<ExactMeeting> point = meeting_of(planes);
  if (!point) return learn(Common::lasting);
  if (point->s <= 0) return learn(Common::done);
  const NearMeeting around = near(*point);
  if (!is_in_window(around) || (meets != Meets::near && is_covered(around))) return learn(Common::done);
  if (!holds(*point, around)) return Common::open;
  add(*std::move(point));
  return learn(Common::done);
}

void EventSearch::corners_on_facets() {
  for (std::uint32_t k = 0; k < live_corners_.size(); ++k) {
    const SumPoint c = all_.corners()[live_corners_[k]].at;
    facets_.for_each(corners_.box(k), [&](std::uint32_t j) {
      const std::uint32_t f = live_[j];
      ask_now_and_then();
      if (has_corner(all_.facets()[f], c)) return;
      if (lasting_side(all_, f, c, low_, high_) != 0) return;
      ++candidates_;
      NearMeeting at;
      const Meets meets = meeting_near(all_, c, all_.row(f), span_, at);
      if (meets == Meets::near && !may_hold(all_, f, at)) return;
      decide(meets, at, [&]() -> std::optional<ExactMeeting> {
        std::optional<ExactMeeting> point = meeting_of(all_, c, all_.plane(f));
        if (point && (point->s <= 0 || !place_in(all_, f, *point, near(*point)).holds)) return std::nullopt;
        return point;
      });
    });
  }
}

// In general position a corner misses every border. Where it stays in one of two planes along a border, or comes into
// both at once, the facets beside it may not tell when it comes onto it: they may all be in one plane with its way.
void EventSearch::corners_on_borders() {
  for (std::uint32_t k = 0; k < live_corners_.size(); ++k) {
    const SumPoint c = all_.corners()[live_corners_[k]].at;
    borders_.for_each(corners_.box(k), [&](std::uint32_t j) {
      const MovingBorder& border = all_.borders()[live_borders_[j]];
      ask_now_and_then();
      if (border.a == c || border.b == c) return;
      NearMeeting at[2];
      Meets meets[2];
      for (std::size_t i = 0; i < 2; ++i) {
        meets[i] = meeting_near(all_, c, all_.rows_of(live_borders_[j])[i], span_, at[i]);
        if (meets[i] == Meets::no ||
            (meets[i] == Meets::near && (at[i].s < low_ - at[i].s_radius || at[i].s > high_ + at[i].s_radius)))
          return;
      }
      if (meets[0] == Meets::near && meets[1] == Meets::near &&
          std::abs(at[0].s - at[1].s) > 2 * (at[0].s_radius + at[1].s_radius))
        return;
      ++candidates_;
      const std::array<MovingPlane, 2>& planes = all_.planes_of(live_borders_[j]);
      const auto try_point = [&](const std::optional<ExactMeeting>& point) {
        if (!point || point->s <= 0 || !lies_on(all_, border, *point)) return;
        decide(Meets::unsure, {}, [&] { return point; });
      };
      for (const MovingPlane& plane : planes)
        if (!stays_in(all_, c, plane)) return try_point(meeting_of(all_, c, plane));
      // Along the border's own line: it meets the ends.
      for (const SumPoint end : {border.a, border.b}) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const exact::BigInteger a = all_.exact_fixed(c)[axis] - all_.exact_fixed(end)[axis],
                                  b = all_.exact_moved(c)[axis] - all_.exact_moved(end)[axis];
          if (b == 0) continue;
          MovingPlane wall;
          wall.n = {0, 0, 0}, wall.n[axis] = 1;
          wall.d0 = all_.exact_fixed(end)[axis], wall.d1 = all_.exact_moved(end)[axis];
          try_point(meeting_of(all_, c, wall));
          break;
        }
      }
    });
  }
}

void EventSearch::borders_on_borders() {
  for (std::uint32_t k = 0; k < live_borders_.size(); ++k) {
    const std::uint32_t e = live_borders_[k];
    const MovingBorder& one = all_.borders()[e];
    borders_.for_each(borders_.box(k), [&](std::uint32_t j) {
      const std::uint32_t g = live_borders_[j];
      if (j <= k) return;
      ask_now_and_then();
      const MovingBorder& other = all_.borders()[g];
      if (share_corner(one, other) || one.direction == other.direction) return;
      const auto &r = all_.rows_of(e), &q = all_.rows_of(g);
      const auto &u = all_.planes_of(e), &v = all_.planes_of(g);
      const auto &m = all_.hyperplanes_of(e), &n = all_.hyperplanes_of(g);
      const Common common = four_planes(
          {m[0], m[1], n[0], n[1]}, {&r[0], &r[1], &q[0], &q[1]}, {&u[0], &u[1], &v[0], &v[1]},
          [&](const NearMeeting& at) { return may_hold(all_, one, at) && may_hold(all_, other, at); },
          [&](const ExactMeeting& at, const NearMeeting&) {
            return lies_on(all_, one, at) && lies_on(all_, other, at);
          });
      if (common == Common::lasting) lasting_crossing(e, g);
    });
  }
}

/// Whether a hyperplane of this name is one of those that are known to hold a border at all scales.
bool EventSearch::bounds_plane(std::uint32_t border, std::uint32_t name) const {
  const auto& along = all_.hyperplanes_of(border);
  if (name == along[0] || name == along[1]) return true;
  const auto facets = all_.facets_of(all_.borders()[border]);
  return std::any_of(facets.begin(), facets.end(), [&](std::uint32_t f) { return all_.hyperplane(f) == name; });
}

/// Two borders that cross at all scales, in one plane: where their crossing passes something else.
void EventSearch::lasting_crossing(std::uint32_t e, std::uint32_t g) {
  const MovingBorder &one = all_.borders()[e], &other = all_.borders()[g];
  const LastingCrossing crossing = lasting_crossing_of(all_, one, other, low_, high_);
  if (crossing.misses) return;
  struct Plane {
    const MovingPlane* plane;
    const PlaneRow* row;
    std::uint32_t name;
  };
  const auto plane_of = [&](std::uint32_t border, std::size_t k) {
    return Plane{&all_.planes_of(border)[k], &all_.rows_of(border)[k], all_.hyperplanes_of(border)[k]};
  };
  const std::array<Plane, 4> all4{plane_of(e, 0), plane_of(e, 1), plane_of(g, 0), plane_of(g, 1)};
  // Whether the crossing does not stay in the plane at all scales.
  const auto try_plane = [&](const Plane& plane, auto may_hold_too, auto holds_too) {
    if (bounds_plane(e, plane.name) || bounds_plane(g, plane.name)) return false;
    if (crossing.stays_beside(*plane.row)) return true;
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      std::array<Plane, 4> four = all4;
      four[left_out] = plane;
      const auto of_all = [&](auto member) {
        return std::array{four[0].*member, four[1].*member, four[2].*member, four[3].*member};
      };
      const Common common = four_planes(
          of_all(&Plane::name), of_all(&Plane::row), of_all(&Plane::plane),
          [&](const NearMeeting& at) {
            return may_hold(all_, one, at) && may_hold(all_, other, at) && may_hold_too(at);
          },
          [&](const ExactMeeting& at, const NearMeeting& around) {
            return lies_on(all_, one, at) && lies_on(all_, other, at) && holds_too(at, around);
          });
      if (common != Common::lasting) return true;
    }
    return false;
  };
  const Box a = swept(std::array{one.a, one.b}), b = swept(std::array{other.a, other.b});
  const Box both{{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
                 {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
  facets_.for_each(both, [&](std::uint32_t j) {
    const std::uint32_t f = live_[j];
    try_plane(
        {&all_.plane(f), &all_.row(f), all_.hyperplane(f)},
        [&](const NearMeeting& at) { return may_hold(all_, f, at); },
        [&](const ExactMeeting& at, const NearMeeting& around) { return place_in(all_, f, at, around).holds; });
  });
  borders_.for_each(both, [&](std::uint32_t j) {
    const std::uint32_t t = live_borders_[j];
    const MovingBorder& third = all_.borders()[t];
    if (t == e || t == g) return;
    for (std::size_t k = 0; k < 2; ++k)
      if (try_plane(
              plane_of(t, k), [&](const NearMeeting& at) { return may_hold(all_, third, at); },
              [&](const ExactMeeting& at, const NearMeeting&) { return lies_on(all_, third, at); }))
        break;
  });
}

void EventSearch::borders_through_facets() {
  std::vector<std::uint32_t> through;
  for (std::uint32_t k = 0; k < live_borders_.size(); ++k) {
    const std::uint32_t e = live_borders_[k];
    const MovingBorder& border = all_.borders()[e];
    through.clear();
    facets_.for_each(borders_.box(k), [&](std::uint32_t j) {
      const std::uint32_t f = live_[j];
      ask_now_and_then();
      if (has_corner(all_.facets()[f], border.a) || has_corner(all_.facets()[f], border.b)) return;
      if (bounds_plane(e, all_.hyperplane(f))) return;
      const int a = lasting_side(all_, f, border.a, low_, high_);
      if (a != 0 && a == lasting_side(all_, f, border.b, low_, high_)) return;
      through.push_back(f);
    });
    std::sort(through.begin(), through.end());
    const auto& r = all_.rows_of(e);
    for (std::size_t i = 0; i < through.size(); ++i) {
      for (std::size_t j = i + 1; j < through.size(); ++j) {
        const std::uint32_t f = through[i], g = through[j];
        ask_now_and_then();
        if (all_.hyperplane(f) == all_.hyperplane(g)) continue;
        const auto& u = all_.planes_of(e);
        const auto& m = all_.hyperplanes_of(e);
        four_planes(
            {m[0], m[1], all_.hyperplane(f), all_.hyperplane(g)}, {&r[0], &r[1], &all_.row(f), &all_.row(g)},
            {&u[0], &u[1], &all_.plane(f), &all_.plane(g)},
            [&](const NearMeeting& at) {
              return may_hold(all_, border, at) && may_hold(all_, f, at) && may_hold(all_, g, at);
            },
            [&](const ExactMeeting& at, const NearMeeting& around) {
              return lies_on(all_, border, at) && place_in(all_, f, at, around).holds &&
                     place_in(all_, g, at, around).holds;
            });
      }
    }
  }
}

/// Whether two facets may meet in more than a border or a corner that they share.
bool EventSearch::may_cross(std::uint32_t f, std::uint32_t g) const {
  const SumFacet &a = all_.facets()[f], &b = all_.facets()[g];
  if (all_.hyperplane(f) == all_.hyperplane(g)) return false;
  int shared = 0;
  const auto passes = [&](const SumFacet& facet, const SumFacet& other, std::uint32_t plane) {
    int below = 0, above = 0, open = 0;
    for (int k = 0; k < facet.corners; ++k) {
      if (has_corner(other, facet.corner[k])) continue;
      const int s = lasting_side(all_, plane, facet.corner[k], low_, high_);
      ++(s > 0 ? above : s < 0 ? below : open);
    }
    return open > 0 || (below > 0 && above > 0);
  };
  for (int k = 0; k < a.corners; ++k) shared += has_corner(b, a.corner[k]);
  return shared < 2 && passes(a, b, g) && passes(b, a, f);
}

void EventSearch::facet_neighbours() {
  neighbours_.assign(live_.size(), {});
  for (std::uint32_t k = 0; k < live_.size(); ++k) {
    facets_.for_each(facets_.box(k), [&](std::uint32_t j) {
      ask_now_and_then();
      if (j > k && may_cross(live_[k], live_[j])) neighbours_[k].push_back(j);
    });
    std::sort(neighbours_[k].begin(), neighbours_[k].end());
  }
}

void EventSearch::four_facets() {
  const auto common = [](const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    std::vector<std::uint32_t> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return both;
  };
  const auto of_three = [&](std::uint32_t f, std::uint32_t g, std::uint32_t h) {
    const SumFacet &a = all_.facets()[live_[f]], &b = all_.facets()[live_[g]], &c = all_.facets()[live_[h]];
    for (int k = 0; k < a.corners; ++k)
      if (has_corner(b, a.corner[k]) && has_corner(c, a.corner[k])) return true;
    return false;
  };
  for (std::uint32_t f = 0; f < live_.size(); ++f) {
    for (const std::uint32_t g : neighbours_[f]) {
      const std::vector<std::uint32_t> near_both = common(neighbours_[f], neighbours_[g]);
      for (const std::uint32_t h : near_both) {
        if (of_three(f, g, h)) continue;
        for (const std::uint32_t i : near_both) {
          if (i <= h || !std::binary_search(neighbours_[h].begin(), neighbours_[h].end(), i)) continue;
          ask_now_and_then();
          const std::array<std::uint32_t, 4> four{live_[f], live_[g], live_[h], live_[i]};
          const auto of_all = [&](auto get) {
            return std::array{get(four[0]), get(four[1]), get(four[2]), get(four[3])};
          };
          four_planes(
              of_all([&](std::uint32_t k) { return all_.hyperplane(k); }),
              of_all([&](std::uint32_t k) { return &all_.row(k); }),
              of_all([&](std::uint32_t k) { return &all_.plane(k); }),
              [&](const NearMeeting& at) {
                return std::all_of(four.begin(), four.end(), [&](std::uint32_t k) { return may_hold(all_, k, at); });
              },
              [&](const ExactMeeting& at, const NearMeeting& around) {
                return std::all_of(four.begin(), four.end(),
                                   [&](std::uint32_t k) { return place_in(all_, k, at, around).holds; });
              });
        }
      }
    }
  }
}

}  // namespace dymsum::spatial
