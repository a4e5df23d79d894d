#include "spatial/events/moving_facets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

#include "exact/limbs.h"
#include "spatial/convolution/facet_rule.h"

namespace dymsum::spatial {

using exact::BigInteger;

namespace {

BigVector big_minus(const BigVector& a, const BigVector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
BigVector big_cross(const BigVector& a, const BigVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
BigInteger big_dot(const BigVector& a, const BigVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double nearest(const BigInteger& v) { return exact::to_double(exact::Big(v)); }

/// Names lists of integers that are multiples of each other alike.
template <std::size_t N>
class ProportionalNames {
 public:
  std::uint32_t name(std::array<BigInteger, N> values) {
    BigInteger divisor = 0;
    for (const BigInteger& v : values) divisor = gcd(divisor, v);
    for (const BigInteger& v : values)
      if (v != 0) {
        if (v < 0) divisor = -divisor;
        break;
      }
    if (divisor != 0)
      for (BigInteger& v : values) v /= divisor;
    return names_.try_emplace(std::move(values), static_cast<std::uint32_t>(names_.size())).first->second;
  }

 private:
  std::map<std::array<BigInteger, N>, std::uint32_t> names_;
};

std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) {
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

/// Edges of solid parts between two triangles in one plane, where nothing else meets.
std::unordered_map<std::uint64_t, int> inner_edges_of(const SolidOperand& solid) {
  std::unordered_map<std::uint64_t, int> wedges;
  for (const Wedge& w : solid.wedges) wedges[pair_key(w.from, w.to)] += w.bend == Wedge::Bend::flat ? 1 : 2;
  return wedges;  // 1: a single flat wedge
}

}  // namespace

PlaneRow row_of(const MovingPlane& plane) {
  std::size_t bits = 0;
  for (const BigInteger& n : plane.n)
    if (n != 0) bits = std::max<std::size_t>(bits, msb(abs(n)));
  const auto scaled = [&](const BigInteger& v) { return std::ldexp(nearest(v), -static_cast<int>(bits)); };
  return {scaled(plane.n[0]), scaled(plane.n[1]), scaled(plane.n[2]), -scaled(plane.d1), scaled(plane.d0)};
}

bool has_corner(const SumFacet& facet, SumPoint corner) {
  for (int k = 0; k < facet.corners; ++k)
    if (facet.corner[k] == corner) return true;
  return false;
}
bool share_corner(const SumFacet& a, const SumFacet& b) {
  for (int k = 0; k < a.corners; ++k)
    if (has_corner(b, a.corner[k])) return true;
  return false;
}

MovingFacets::MovingFacets(const SolidPair& pair, int moving, StageWatch& watch) : pair_(&pair), moving_(moving) {
  const PosedSpace space = posed_space(pair, {});
  convolution_ = reduced_convolution(*space.space, pair.p, pair.q, watch);
  for (int op = 0; op < 2; ++op) {
    const GridPlaces& from = op == 0 ? pair.p_places : pair.q_places;
    const std::size_t count = (op == 0 ? pair.p : pair.q).vertices.size();
    for (std::uint32_t v = 0; v < count; ++v) {
      const auto at = from.place<exact::Big>(v);
      exact_[op].push_back({at.x.value(), at.y.value(), at.z.value()});
      const BigVector& x = exact_[op].back();
      places_[op].push_back({nearest(x[0]), nearest(x[1]), nearest(x[2])});
      for (const BigInteger& c : x) reach_[op] = std::max(reach_[op], std::abs(nearest(c)) * (1 + 0x1p-50));
    }
  }
  for (std::size_t f = 0; f < facets().size(); ++f) {
    const SumFacet& facet = facets()[f];
    const PlaneSource source = convolution_.planes[f];
    const auto way = [&](const Way& w) {
      const std::vector<BigVector>& of = exact_[w.of == Way::Of::p ? 0 : 1];
      return big_minus(of[w.to], of[w.from]);
    };
    MovingPlane plane;
    plane.n = source.reversed ? big_cross(way(source.v), way(source.u)) : big_cross(way(source.u), way(source.v));
    plane.d0 = big_dot(plane.n, exact_fixed(facet.corner[0]));
    plane.d1 = big_dot(plane.n, exact_moved(facet.corner[0]));
    rows_.push_back(row_of(plane));
    planes_.push_back(std::move(plane));
  }
  keep_small();
  list_borders();
  name_planes();
  list_corners();
  mark_inner();
}

void MovingFacets::list_borders() {
  struct Use {
    SumPoint a, b;
    std::uint32_t place;
  };
  std::vector<Use> uses;
  facet_borders_.assign(4 * facets().size(), kNoId);
  for (std::uint32_t f = 0; f < facets().size(); ++f) {
    const SumFacet& facet = facets()[f];
    for (int k = 0; k < facet.corners; ++k) {
      const SumPoint a = facet.corner[k], b = facet.corner[(k + 1) % facet.corners];
      uses.push_back({std::min(a, b), std::max(a, b), 4 * f + static_cast<std::uint32_t>(k)});
    }
  }
  std::sort(uses.begin(), uses.end(),
            [](const Use& x, const Use& y) { return std::tie(x.a, x.b, x.place) < std::tie(y.a, y.b, y.place); });
  for (const Use& use : uses) {
    if (borders_.empty() || borders_.back().a != use.a || borders_.back().b != use.b) {
      const auto at = static_cast<std::uint32_t>(border_facets_.size());
      borders_.push_back({use.a, use.b, at, at, false, use.a.q == use.b.q});
    }
    facet_borders_[use.place] = static_cast<std::uint32_t>(borders_.size() - 1);
    border_facets_.push_back(use.place / 4);
    ++borders_.back().last;
  }
  ProportionalNames<3> directions;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known[2];  // by the ends of an operand's edge
  for (MovingBorder& border : borders_) {
    const std::size_t op = border.of_p ? 0 : 1;
    const std::pair ends = op == 0 ? std::pair{border.a.p, border.b.p} : std::pair{border.a.q, border.b.q};
    const auto [at, fresh] = known[op].try_emplace(ends, 0);
    if (fresh) at->second = directions.name(big_minus(exact_[op][ends.second], exact_[op][ends.first]));
    border.direction = at->second;
    border_planes_.push_back(planes_along(border));
    border_rows_.push_back({row_of(border_planes_.back()[0]), row_of(border_planes_.back()[1])});
  }
}

namespace {

/// Coordinates below 2^29: differences take 30 bits, a normal's component 2 * 30 + 1 and a sign, its product with
/// another difference 91, three of them 93.
constexpr double kSmallCoordinate = 0x1p29;
static_assert(2 + (2 * 30 + 1) + 30 <= 127);

template <class V>
std::array<std::int64_t, 3> difference(const V& a, const V& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

}  // namespace

void MovingFacets::keep_small() {
  small_ = std::max(reach_[0], reach_[1]) < kSmallCoordinate;
  if (!small_) return;
  const auto narrow = [](const BigVector& v) {
    return SmallVector{v[0].convert_to<std::int64_t>(), v[1].convert_to<std::int64_t>(),
                       v[2].convert_to<std::int64_t>()};
  };
  for (std::size_t op = 0; op < 2; ++op)
    for (const BigVector& v : exact_[op]) integers_[op].push_back(narrow(v));
  for (const MovingPlane& plane : planes_) small_normals_.push_back(narrow(plane.n));
}

SureForm MovingFacets::form_of(const SmallVector& n, SumPoint from, SumPoint to) const {
  const auto product = [&](int op, std::uint32_t a, std::uint32_t b) {
    const std::vector<SmallVector>& of = integers_[static_cast<std::size_t>(op)];
    const SmallVector d = difference(of[b], of[a]);
    exact::i128 sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += static_cast<exact::i128>(n[k]) * d[k];
    return static_cast<double>(sum);
  };
  const double of_p = product(0, from.p, to.p), of_q = product(1, from.q, to.q);
  return moving_ == 0 ? SureForm{of_q, of_p} : SureForm{of_p, of_q};
}

std::optional<SureForm> MovingFacets::sure_height(SumPoint corner, std::uint32_t facet) const {
  if (!small_) return std::nullopt;
  return form_of(small_normals_[facet], facets()[facet].corner[0], corner);
}

std::optional<SureForm> MovingFacets::sure_twist(const std::array<SumPoint, 2>& e,
                                                 const std::array<SumPoint, 2>& h) const {
  if (!small_) return std::nullopt;
  const auto way = [&](const std::array<SumPoint, 2>& border) {
    return border[0].p != border[1].p ? difference(integers_[0][border[1].p], integers_[0][border[0].p])
                                      : difference(integers_[1][border[1].q], integers_[1][border[0].q]);
  };
  const SmallVector u = way(e), v = way(h);
  const SmallVector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  return form_of(n, e[0], h[0]);
}

void MovingFacets::name_planes() {
  ProportionalNames<5> names;
  const auto name = [&](const MovingPlane& p) { return names.name({p.n[0], p.n[1], p.n[2], p.d0, p.d1}); };
  for (const MovingPlane& plane : planes_) hyperplanes_.push_back(name(plane));
  for (const auto& planes : border_planes_) border_hyperplanes_.push_back({name(planes[0]), name(planes[1])});
}

void MovingFacets::list_corners() {
  struct Use {
    SumPoint at;
    std::uint32_t place;
  };
  std::vector<Use> uses;
  facet_corners_.assign(4 * facets().size(), kNoId);
  for (std::uint32_t f = 0; f < facets().size(); ++f)
    for (int k = 0; k < facets()[f].corners; ++k)
      uses.push_back({facets()[f].corner[k], 4 * f + static_cast<std::uint32_t>(k)});
  std::sort(uses.begin(), uses.end(),
            [](const Use& x, const Use& y) { return std::tie(x.at, x.place) < std::tie(y.at, y.place); });
  for (const Use& use : uses) {
    if (corners_.empty() || corners_.back().at != use.at) {
      const auto at = static_cast<std::uint32_t>(corner_facets_.size());
      corners_.push_back({use.at, at, at});
    }
    facet_corners_[use.place] = static_cast<std::uint32_t>(corners_.size() - 1);
    corner_facets_.push_back(use.place / 4);
    ++corners_.back().last;
  }
}

void MovingFacets::mark_inner() {
  const std::unordered_map<std::uint64_t, int> edges[2] = {inner_edges_of(pair_->p), inner_edges_of(pair_->q)};
  for (MovingBorder& border : borders_) {
    if (border.last - border.first != 2) continue;
    const std::uint64_t key = border.of_p ? pair_key(border.a.p, border.b.p) : pair_key(border.a.q, border.b.q);
    const auto found = edges[border.of_p ? 0 : 1].find(key);
    border.inner = found != edges[border.of_p ? 0 : 1].end() && found->second == 1;
  }
}

std::array<MovingPlane, 2> MovingFacets::planes_along(const MovingBorder& border) const {
  const int op = border.of_p ? 0 : 1;
  const BigVector along = op == 0 ? big_minus(exact_[0][border.b.p], exact_[0][border.a.p])
                                  : big_minus(exact_[1][border.b.q], exact_[1][border.a.q]);
  std::size_t most = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (abs(along[k]) > abs(along[most])) most = k;
  std::array<MovingPlane, 2> planes;
  for (std::size_t k = 0; k < 2; ++k) {
    BigVector axis{0, 0, 0};
    axis[(most + 1 + k) % 3] = 1;
    planes[k].n = big_cross(along, axis);
    planes[k].d0 = big_dot(planes[k].n, exact_fixed(border.a));
    planes[k].d1 = big_dot(planes[k].n, exact_moved(border.a));
  }
  return planes;
}

PosePair MovingFacets::poses(const Scale& s) const {
  PosePair poses;
  (moving_ == 0 ? poses.p : poses.q).scale = {s, s, s};
  return poses;
}

}  // namespace dymsum::spatial
