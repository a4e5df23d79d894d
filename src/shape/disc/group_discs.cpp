#include "shape/disc/group_discs.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dymsum::shape {

using exact::Interval;
using exact::RootExpression;

GroupDiscs::GroupDiscs(const DiscPositions& positions, const ArcSet& arcs, std::vector<std::uint32_t> indices,
                       Point origin)
    : positions_(positions), indices_(std::move(indices)), origin_(origin) {
  if (indices_.size() < 2) return;
  for (const std::uint32_t disc : indices_) {
    centres_.push_back(centre_of(arcs.discs[disc]));
    vertices_.push_back(vertices_of(arcs.discs[disc]));
  }
}

std::uint32_t GroupDiscs::local(std::uint32_t disc) const {
  return static_cast<std::uint32_t>(std::lower_bound(indices_.begin(), indices_.end(), disc) - indices_.begin());
}

LazyVector GroupDiscs::centre_of(const CornerDisc& disc) const {
  LazyVector made;
  made.exact = [this, disc] { return positions_.exact_centre_from(disc, origin_); };
  if (disc.at_node) {
    const auto v = made.exact();
    made.near = {exact::narrow_interval(v.x), exact::narrow_interval(v.y)};
  } else {
    made.near = centre_on_edge(positions_.complex(), disc.index, positions_.level().near, origin_);
  }
  return made;
}

std::vector<Point> GroupDiscs::vertices_of(const CornerDisc& disc) const {
  const Complex& complex = positions_.complex();
  std::vector<Point> made;
  const auto see = [&](std::uint32_t edge) {
    for (const std::uint32_t site : {complex.edges[edge].left, complex.edges[edge].right})
      if (complex.sites[site].kind == Site::Kind::vertex) made.push_back(complex.sites[site].a);
  };
  if (!disc.at_node) {
    see(disc.index);
  } else {
    for (std::uint32_t i = complex.first_spoke[disc.index]; i < complex.first_spoke[disc.index + 1]; ++i)
      see(complex.spokes[i].edge);
  }
  return made;
}

bool GroupDiscs::touches(std::uint32_t j, const std::optional<Point>& vertex) const {
  return vertex && std::find(vertices_[j].begin(), vertices_[j].end(), *vertex) != vertices_[j].end();
}

std::vector<std::uint32_t> GroupDiscs::sorted_by_x() const {
  std::vector<std::uint32_t> by_x(centres_.size());
  std::iota(by_x.begin(), by_x.end(), 0);
  std::sort(by_x.begin(), by_x.end(), [&](std::uint32_t i, std::uint32_t j) {
    return std::pair(centres_[i].near.x.low(), i) < std::pair(centres_[j].near.x.low(), j);
  });
  return by_x;
}

bool GroupDiscs::may_reach(std::uint32_t i, std::uint32_t j) const {
  const double reach = 2 * positions_.level().near.high();
  return !(centres_[j].near.x.low() - centres_[i].near.x.high() > reach * (1 + 0x1p-50));
}

int GroupDiscs::meeting(std::uint32_t i, std::uint32_t j) const {
  const auto reach = [](const auto& a, const auto& b, const auto& r) {
    const auto d = minus(a, b);
    return r * r - dot(d, d) / (decltype(r * r)(4));
  };
  if (const auto sign = sign_of(reach(centres_[i].near, centres_[j].near, positions_.level().near))) return *sign;
  return exact::sign_of(reach(centres_[i].exact(), centres_[j].exact(), positions_.level().exact));
}

LazyVector GroupDiscs::difference(std::uint32_t i, std::uint32_t j) const {
  LazyVector made;
  made.near = minus(centres_[j].near, centres_[i].near);
  made.exact = [this, i, j] { return minus(centres_[j].exact(), centres_[i].exact()); };
  return made;
}

LazyVector GroupDiscs::towards_circle(std::uint32_t i, std::uint32_t j, bool clockwise) const {
  LazyVector made;
  made.near = crossing(minus(centres_[j].near, centres_[i].near), positions_.level().near, clockwise);
  made.exact = [this, i, j, clockwise] {
    return crossing(minus(centres_[j].exact(), centres_[i].exact()), positions_.level().exact, clockwise);
  };
  return made;
}

LazyVector GroupDiscs::towards_contact(std::uint32_t i, std::uint32_t site, const std::optional<Point>& vertex) const {
  const Site& s = positions_.complex().sites[site];
  LazyVector made;
  if (s.kind == Site::Kind::edge) {
    const auto n = long_normal<Interval>(s);
    made.near = {-n.x, -n.y};
    made.exact = [&s] {
      const auto m = long_normal<RootExpression>(s);
      return Vector<RootExpression>{-m.x, -m.y};
    };
  } else {
    made.near = minus(between<Interval>(origin_, *vertex), centres_[i].near);
    made.exact = [this, i, vertex] { return minus(between<RootExpression>(origin_, *vertex), centres_[i].exact()); };
  }
  return made;
}

}  // namespace dymsum::shape
