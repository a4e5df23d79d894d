#include "dymsum/solid_scale_range.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "dymsum/solid_scale_events.h"
#include "fit/free_intervals.h"
#include "spatial/boundary/collision.h"
#include "spatial/erode/erosion.h"
#include "spatial/events/meeting_point.h"
#include "spatial/events/proved_overlap.h"
#include "spatial/motion/posed_pair.h"
#include "spatial/moving/moving_solid_sum.h"
#include "spatial/sum/feature_pairs.h"

namespace dymsum::spatial {
namespace {

// A path of translations against the open sum of solid obstacles and a scaled, reflected part.

class SolidPath {
 public:
  /// P: obstacles; Q: the reflected part, which scales. Requires at least one waypoint, no two of them equal in
  /// succession; the facets have to live as long.
  SolidPath(const MovingFacets& all, const ScaledOverlap& overlap, const std::vector<RationalPoint3>& path);

  using Critical = std::map<exact::BigRational, std::vector<SolidScaleContact>>;
  /// Scales at which a facet comes to a waypoint or a facet edge of one to a leg, with what touches. `query` may throw.
  Critical critical(const std::function<void(double)>& query) const;
  /// Whether the part at this scale overlaps the obstacles nowhere on the path. Exact.
  bool free(const exact::BigRational& s) const;

 private:
  struct Leg {
    std::array<MovingPlane, 2> planes;
    std::array<PlaneRow, 2> rows;
  };
  void add(Critical& to, const ExactMeeting& at, std::uint32_t facet, std::uint32_t leg) const;
  exact::BigRational along(std::uint32_t leg, const ExactMeeting& at) const;
  std::vector<exact::BigRational> cuts(std::uint32_t leg, const exact::BigRational& s) const;
  bool overlaps(const std::array<exact::BigRational, 3>& x, const exact::BigRational& s) const;
  std::array<exact::BigRational, 3> position(std::uint32_t leg, const exact::BigRational& t) const;

  const MovingFacets& all_;
  const ScaledOverlap& overlap_;
  std::vector<std::array<exact::BigRational, 3>> way_;  // on the grid
  std::vector<Leg> legs_;
  double unit_;
};

using exact::BigInteger;

using exact::BigRational;

/// n . x = d for a rational plane, in integers.
MovingPlane still_plane(const std::array<BigRational, 3>& n, const BigRational& d) {
  BigInteger scale = denominator(d);
  for (const BigRational& c : n) scale = lcm(scale, denominator(c));
  const auto whole = [&](const BigRational& v) { return BigInteger(numerator(v) * (scale / denominator(v))); };
  MovingPlane plane;
  plane.n = {whole(n[0]), whole(n[1]), whole(n[2])}, plane.d0 = whole(d), plane.d1 = 0;
  return plane;
}

/// The hyperplane of one scale.
MovingPlane level_plane(const BigRational& s) {
  MovingPlane level;
  level.n = {0, 0, 0}, level.d0 = -numerator(s), level.d1 = denominator(s);
  return level;
}

SolidPath::SolidPath(const MovingFacets& all, const ScaledOverlap& overlap, const std::vector<RationalPoint3>& path)
    : all_(all), overlap_(overlap), unit_(std::ldexp(1.0, all.pair().p_positions.exponent)) {
  const BigRational unit = exact::exact_value(unit_);
  for (const RationalPoint3& p : path)
    way_.push_back({exact::exact_value(p.x) / unit, exact::exact_value(p.y) / unit, exact::exact_value(p.z) / unit});
  for (std::size_t k = 0; k + 1 < way_.size(); ++k) {
    std::array<BigRational, 3> along;
    std::size_t most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      along[axis] = way_[k + 1][axis] - way_[k][axis];
      if (abs(along[axis]) > abs(along[most])) most = axis;
    }
    Leg leg;
    for (std::size_t i = 0; i < 2; ++i) {
      // along x axis: upright on both.
      const std::size_t axis = (most + 1 + i) % 3, b = (axis + 1) % 3, c = (axis + 2) % 3;
      std::array<BigRational, 3> n;
      n[b] = along[c], n[c] = -along[b];
      leg.planes[i] = still_plane(n, n[0] * way_[k][0] + n[1] * way_[k][1] + n[2] * way_[k][2]);
      leg.rows[i] = row_of(leg.planes[i]);
    }
    legs_.push_back(std::move(leg));
  }
}

BigRational SolidPath::along(std::uint32_t leg, const ExactMeeting& at) const {
  BigRational up = 0, size = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const BigRational way = way_[leg + 1][axis] - way_[leg][axis];
    up += way * (exact::ratio(exact::Big(at.x[axis]), exact::Big(at.w)) - way_[leg][axis]);
    size += way * way;
  }
  return up / size;
}

std::array<BigRational, 3> SolidPath::position(std::uint32_t leg, const BigRational& t) const {
  std::array<BigRational, 3> x;
  for (std::size_t axis = 0; axis < 3; ++axis) x[axis] = way_[leg][axis] + t * (way_[leg + 1][axis] - way_[leg][axis]);
  return x;
}

void SolidPath::add(Critical& to, const ExactMeeting& at, std::uint32_t facet, std::uint32_t leg) const {
  if (at.s <= 0) return;
  const SolidContact features = features_of(all_.facets()[facet], all_.pair().p, all_.pair().q);
  SolidScaleContact contact;
  contact.part = features.q, contact.obstacle = features.p, contact.leg = leg;
  if (!legs_.empty()) contact.along = exact::to_rational(along(leg, at));
  const BigRational unit = exact::exact_value(unit_);
  const auto coordinate = [&](std::size_t axis) {
    return exact::to_rational(BigRational(exact::ratio(exact::Big(at.x[axis]), exact::Big(at.w)) * unit));
  };
  contact.at = {coordinate(0), coordinate(1), coordinate(2)};
  std::vector<SolidScaleContact>& list = to[at.scale()];
  if (std::find(list.begin(), list.end(), contact) == list.end()) list.push_back(std::move(contact));
}

SolidPath::Critical SolidPath::critical(const std::function<void(double)>& query) const {
  Critical found;
  const auto facets = static_cast<std::uint32_t>(all_.facets().size());
  for (std::uint32_t f = 0; f < facets; ++f) {
    if (f % 64 == 0) query(static_cast<double>(f) / facets);
    for (std::uint32_t k = 0; k < way_.size(); ++k) {
      const std::array<MovingPlane, 3> still{still_plane({1, 0, 0}, way_[k][0]), still_plane({0, 1, 0}, way_[k][1]),
                                             still_plane({0, 0, 1}, way_[k][2])};
      const auto at = meeting_of({&still[0], &still[1], &still[2], &all_.plane(f)});
      if (!at || at->s <= 0 || !position_in(all_, f, *at, near(*at)).holds) continue;
      add(found, *at, f, k < legs_.size() || k == 0 ? k : k - 1);
    }
    for (std::uint32_t k = 0; k < legs_.size(); ++k) {
      for (int i = 0; i < all_.facets()[f].corners; ++i) {
        const std::uint32_t b = all_.facet_edges().of(f, i);
        const auto along_it = all_.planes_of(b);
        NearMeeting around;
        const Meets meets =
            meeting_near({&legs_[k].rows[0], &legs_[k].rows[1], &all_.row(along_it[0]), &all_.row(along_it[1])},
                         all_.span(1), around);
        if (meets == Meets::near && (around.s < -around.s_radius || !may_hold(all_, {{b}, {}}, around))) continue;
        const auto at =
            meeting_of({&legs_[k].planes[0], &legs_[k].planes[1], &all_.plane(along_it[0]), &all_.plane(along_it[1])});
        if (!at || at->s <= 0 || !hold(all_, {{b}, {}}, *at, {})) continue;
        const BigRational t = along(k, *at);
        if (t >= 0 && t <= 1) add(found, *at, f, k);
      }
    }
  }
  return found;
}

/// The parameters at which facets cross a leg at a scale, from 0 to 1 along it, both included.
std::vector<BigRational> SolidPath::cuts(std::uint32_t leg, const BigRational& s) const {
  std::vector<BigRational> cuts{0, 1};
  const MovingPlane level = level_plane(s);
  const PlaneRow level_row = row_of(MovingPlane{{0, 0, 0}, level.d0, level.d1});
  const double near_s = exact::round_to_double(s);
  for (std::uint32_t f = 0; f < all_.facets().size(); ++f) {
    NearMeeting around;
    const Meets meets =
        meeting_near({&legs_[leg].rows[0], &legs_[leg].rows[1], &all_.row(f), &level_row}, all_.span(near_s), around);
    if (meets == Meets::near && provably_holds(all_, f, around) < 0) continue;
    const auto at = meeting_of({&legs_[leg].planes[0], &legs_[leg].planes[1], &all_.plane(f), &level});
    if (!at || !position_in(all_, f, *at, near(*at)).holds) continue;
    if (const BigRational t = along(leg, *at); t > 0 && t < 1) cuts.push_back(t);
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

bool SolidPath::overlaps(const std::array<BigRational, 3>& x, const BigRational& s) const {
  const Vec3 near_x{exact::round_to_double(x[0]), exact::round_to_double(x[1]), exact::round_to_double(x[2])};
  const double near_s = exact::round_to_double(s), far = std::abs(near_x.x) + std::abs(near_x.y) + std::abs(near_x.z);
  const ScaledOverlap::Answer answer = overlap_.at(near_x, near_s, far * 0x1p-51, near_s * 0x1p-51);
  if (answer != ScaledOverlap::Answer::unsure) return answer == ScaledOverlap::Answer::overlap;
  const PosedSpace posed = posed_space(all_.pair(), all_.poses(computed_scale(s)));
  const BigRational scale = BigRational(posed.scale) * exact::exact_value(unit_);
  const std::optional<PointSource> at = posed.space->add_position({x[0] * scale, x[1] * scale, x[2] * scale});
  if (!at) return false;
  return Collision(*posed.space, all_.pair().p, all_.pair().q).overlaps({*at, 0, 0, 0, 0, 0});
}

// Between the cuts no facet is passed, so the leg lies inside or outside the open sum as a whole.
bool SolidPath::free(const BigRational& s) const {
  for (const std::array<BigRational, 3>& x : way_)
    if (overlaps(x, s)) return false;
  for (std::uint32_t k = 0; k < legs_.size(); ++k) {
    const std::vector<BigRational> at = cuts(k, s);
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
      if (overlaps(position(k, BigRational((at[i] + at[i + 1]) / 2)), s)) return false;
  }
  return true;
}

}  // namespace
}  // namespace dymsum::spatial

namespace dymsum {

using namespace spatial;
using exact::BigRational;

namespace {

Error refused_solid(const char* text) { return {ErrorCode::unsupported_operand, text, {}}; }

std::optional<Error> check_solids(const Mesh& part, const Mesh& other) {
  if (part.empty()) return refused_solid("the part is empty");
  if (other.empty()) return refused_solid("the solid of obstacles, or the container, is empty");
  if (part.has_thin_parts() || other.has_thin_parts())
    return refused_solid("part, obstacles and containers have to be solids without parts that have no volume");
  return std::nullopt;
}

bool is_finite_point(const Point3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

RationalPoint3 exactly(const Point3& p) {
  return {Rational::of(p.x).value(), Rational::of(p.y).value(), Rational::of(p.z).value()};
}

Result<SolidScaleRange> range_of_path(const Mesh& part, const std::vector<RationalPoint3>& path, const Mesh& obstacles,
                                      const std::optional<BigRational>& limit, const Progress& progress) {
  Result<Result<SolidScaleRange>> made = within_scales([&] {
    return guarded([&]() -> Result<SolidScaleRange> {
      SpatialOptions stages;
      stages.threads = 1, stages.progress = progress;
      SpatialStats stats;
      StageWatch watch(stages, stats);
      watch.begin("convolution");
      const MovingFacets facets(ScalingPair(solid_pair(obstacles, negated(part)), 1), watch);
      const ScaledOverlap overlap(facets);
      const SolidPath walk(facets, overlap, path);
      watch.begin("contacts");
      const SolidPath::Critical critical = walk.critical([&](double fraction) { watch.query(fraction); });
      SolidScaleRange range;
      const Result<void> done =
          free_intervals(critical, limit, progress, range, [&](const BigRational& s) { return walk.free(s); });
      if (!done) return done.error();
      return range;
    });
  });
  if (!made) return made.error();
  return *std::move(made);
}

/// The largest scale at which the part's bounding box is no larger than the container's.
BigRational box_limit_of(const Mesh& part, const Mesh& container) {
  std::optional<BigRational> least;
  for (double Point3::*axis : {&Point3::x, &Point3::y, &Point3::z}) {
    const auto width = [&](const Mesh& mesh) {
      const auto [low, high] = std::minmax_element(mesh.vertices().begin(), mesh.vertices().end(),
                                                   [&](const Point3& a, const Point3& b) { return a.*axis < b.*axis; });
      return BigRational(exact::exact_value((*high).*axis) - exact::exact_value((*low).*axis));
    };
    const BigRational ratio = width(container) / width(part);
    if (!least || ratio < *least) least = ratio;
  }
  return *least;
}

/// The container's complement in a frame that has room for the part at all scales up to the limit, wherever it is.
Result<Mesh> frame_of(const Mesh& part, const Mesh& container, const BigRational& limit, const Point3& at) {
  double reach = 0;
  for (const Point3& v : part.vertices()) reach = std::max({reach, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  reach = reach * exact::round_to_double(limit) * 1.01 + std::abs(at.x) + std::abs(at.y) + std::abs(at.z);
  for (const Point3& v : container.vertices()) reach = std::max({reach, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  constexpr double kMost = 0x1p1000;
  if (!(reach <= kMost))
    return Error{ErrorCode::out_of_range, "the frame of the container would reach beyond 2^1000", {}};
  reach = std::ldexp(1.0, std::ilogb(reach) + 2);
  Result<MeshData> framed =
      framed_complement(container.data(), {{{-reach, -reach, -reach}, {reach, reach, reach}}, {}});
  if (!framed) return framed.error();
  return Mesh::create(*std::move(framed));
}

/// Anywhere inside a container: what the sum of its framed complement and the reflected part leaves free.
class SolidRoom {
 public:
  SolidRoom(SolidScaleEvents sum, const Progress& progress) : sum_(std::move(sum)), progress_(progress) {}

  /// Free placements are the shells of the sum behind that of the frame, and its tight features.
  Result<void> look(const BigRational& s) {
    const Result<Scale> scale = Scale::of(exact::to_rational(s));
    if (!scale) return scale.error();
    Result<SpatialSum> at = sum_.at(*scale, progress_);
    if (!at) return at.error();
    fits = at->shells > 1 || !at->tight_faces.empty() || !at->tight_segments.empty() || !at->tight_points.empty();
    contacts.clear();
    const auto add = [&](const std::vector<SolidContact>& list, std::uint32_t vertex) {
      const RationalPoint3 position = at->exact(vertex);
      for (const SolidContact& c : list) contacts.push_back({c.q, c.p, 0, {}, position});
    };
    for (std::size_t k = 0; k < at->tight_points.size(); ++k) add(at->tight_point_contacts[k], at->tight_points[k]);
    for (std::size_t k = 0; k < at->tight_segments.size(); ++k)
      add(at->tight_segment_contacts[k], at->tight_segments[k][0]);
    return {};
  }
  const SolidScaleEvents& sum() const { return sum_; }

  bool fits = false;
  std::vector<SolidScaleContact> contacts;

 private:
  SolidScaleEvents sum_;
  const Progress& progress_;
};

Result<SolidRoom> room_for(const Mesh& part, const Mesh& frame, const Progress& progress) {
  Result<SolidScaleEvents> sum = SolidScaleEvents::create(frame, negated(part));
  if (!sum) return sum.error();
  return SolidRoom(*std::move(sum), progress);
}

/// A scale below the limit at which the part's bounding box has room: it is convex, so every smaller part has, too.
Result<BigRational> proved_room(const Mesh& part, const Mesh& frame, BigRational low, const Progress& progress) {
  Point3 a = part.vertices()[0], b = a;
  for (const Point3& v : part.vertices()) {
    a = {std::min(a.x, v.x), std::min(a.y, v.y), std::min(a.z, v.z)};
    b = {std::max(b.x, v.x), std::max(b.y, v.y), std::max(b.z, v.z)};
  }
  const MeshData box{{{a.x, a.y, a.z},
                      {b.x, a.y, a.z},
                      {b.x, b.y, a.z},
                      {a.x, b.y, a.z},
                      {a.x, a.y, b.z},
                      {b.x, a.y, b.z},
                      {b.x, b.y, b.z},
                      {a.x, b.y, b.z}},
                     {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  Result<SolidRoom> made = room_for(Mesh::create(box).value(), frame, progress);
  if (!made) return made.error();
  SolidRoom room = *std::move(made);
  for (int k = 0; k < 60; ++k) {
    low /= 2;
    if (const Result<void> seen = room.look(low); !seen) return seen.error();
    if (room.fits) return low;
  }
  return refused_solid("the container is too thin for its size");
}

Result<SolidScaleRange> range_along(const Mesh& part, std::span<const RationalPoint3> path, const Mesh& obstacles,
                                    const Progress& progress) {
  if (path.empty()) return refused_solid("a path needs at least one waypoint");
  std::vector<RationalPoint3> way;
  for (const RationalPoint3& at : path)
    if (way.empty() || !(way.back() == at)) way.push_back(at);
  if (std::optional<Error> error = check_solids(part, obstacles)) return *std::move(error);
  return range_of_path(part, way, obstacles, std::nullopt, progress);
}

Result<SolidScaleRange> range_at(const Mesh& part, const Mesh& container, const RationalPoint3& at,
                                 const Progress& progress) {
  if (std::optional<Error> error = check_solids(part, container)) return *std::move(error);
  const BigRational limit = box_limit_of(part, container);
  const Result<Mesh> frame = frame_of(part, container, limit, {at.x.to_double(), at.y.to_double(), at.z.to_double()});
  if (!frame) return frame.error();
  return range_of_path(part, {at}, *frame, limit, progress);
}

Result<SolidScaleRange> range_anywhere(const Mesh& part, const Mesh& container, const Progress& progress) {
  if (std::optional<Error> error = check_solids(part, container)) return *std::move(error);
  const BigRational limit = box_limit_of(part, container);
  const Result<Mesh> frame = frame_of(part, container, limit, {});
  if (!frame) return frame.error();
  const Result<BigRational> low = proved_room(part, *frame, limit, progress);
  if (!low) return low.error();
  Result<SolidRoom> made = room_for(part, *frame, progress);
  if (!made) return made.error();
  SolidRoom room = *std::move(made);
  const Result<std::vector<ScaleEvent>> events =
      within_scales([&] { return room.sum().events(computed_scale(*low), computed_scale(limit), progress); });
  if (!events) return events.error();
  std::map<BigRational, std::vector<SolidScaleContact>> critical;
  for (const ScaleEvent& e : *events)
    if (e.topology) critical[exact::exact_value(e.parameter)];
  Result<void> seen;
  const auto fits = [&](const BigRational& s) {
    if (s <= *low) return true;
    if (seen) seen = room.look(s);
    return seen && room.fits;
  };
  SolidScaleRange range;
  if (const Result<void> done = free_intervals(critical, limit, progress, range, fits); !done) return done.error();
  for (SolidScaleInterval& i : range.free) {
    if (i.low && seen && fits(exact::exact_value(*i.low))) i.at_low = room.contacts;
    if (i.high && seen && fits(exact::exact_value(*i.high))) i.at_high = room.contacts;
  }
  if (!seen) return seen.error();
  return range;
}

double reach_of(const std::vector<Point3>& points) {
  double reach = 0;
  for (const Point3& p : points) reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return reach;
}

double extent(const Mesh& mesh) {
  const auto box = bounds(mesh);
  return std::max({box[3] - box[0], box[4] - box[1], box[5] - box[2]});
}

/// The part in its unit; nothing where that is its own, or has coordinates that are no doubles.
std::optional<Mesh> part_in_unit(const Mesh& part, int k) {
  if (k == 0) return std::nullopt;
  MeshData data = part.data();
  for (Point3& p : data.vertices)
    for (double* v : {&p.x, &p.y, &p.z}) {
      const std::optional<double> made = in_unit(*v, k);
      if (!made) return std::nullopt;
      *v = *made;
    }
  const Result<Mesh> made = Mesh::create(std::move(data));
  return made ? std::optional(*made) : std::nullopt;
}

/// Asks with the part in its unit.
template <class Query>
Result<SolidScaleRange> queried_in_unit(const Mesh& part, double part_size, double other_size, const Query& query) {
  const int k = part_unit(part_size, other_size);
  const std::optional<Mesh> changed = part_in_unit(part, k);
  if (!changed) return query(part);
  Result<SolidScaleRange> range = query(*changed);
  if (!range && range.error().code == ErrorCode::unsupported_operand)
    range = query(part);  // names the operand's own position
  if (!range) return range.error();
  return in_input_units(*std::move(range), k);
}

}  // namespace

bool SolidScaleRange::contains(const Scale& s) const {
  const BigRational v = exact::exact_value(s.exact());
  return std::any_of(free.begin(), free.end(), [&](const SolidScaleInterval& i) {
    return (!i.low || exact::exact_value(*i.low) <= v) && (!i.high || v <= exact::exact_value(*i.high));
  });
}

std::optional<Rational> SolidScaleRange::trap() const {
  if (free.empty() || free[0].low) return Rational();
  return free[0].high;
}

Result<SolidScaleRange> solid_scale_range(const Mesh& part, const std::vector<Point3>& path, const Mesh& obstacles,
                                          const Progress& progress) {
  if (path.empty()) return refused_solid("a path needs at least one waypoint");
  std::vector<RationalPoint3> way;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (!is_finite_point(path[k])) {
      Error error{ErrorCode::not_finite, "a waypoint of the path is not finite", {}};
      error.evidence.vertex = static_cast<std::int64_t>(k);
      return error;
    }
    way.push_back(exactly(path[k]));
  }
  return solid_scale_range(part, std::span<const RationalPoint3>(way), obstacles, progress);
}

Result<SolidScaleRange> solid_scale_range(const Mesh& part, std::span<const RationalPoint3> path, const Mesh& obstacles,
                                          const Progress& progress) {
  double far = reach_of(obstacles.vertices());
  for (const RationalPoint3& at : path)
    for (const Rational* c : {&at.x, &at.y, &at.z}) far = std::max(far, std::abs(c->to_double()));
  return queried_in_unit(part, reach_of(part.vertices()), far,
                         [&](const Mesh& p) { return range_along(p, path, obstacles, progress); });
}

Result<SolidScaleRange> solid_fit_range(const Mesh& part, const Mesh& container, const Point3& at,
                                        const Progress& progress) {
  if (!is_finite_point(at)) return Error{ErrorCode::not_finite, "the placement is not finite", {}};
  return solid_fit_range(part, container, exactly(at), progress);
}

template <std::same_as<RationalPoint3> Position>
Result<SolidScaleRange> solid_fit_range(const Mesh& part, const Mesh& container, const Position& at,
                                        const Progress& progress) {
  return queried_in_unit(part, reach_of(part.vertices()), extent(container),
                         [&](const Mesh& p) { return range_at(p, container, at, progress); });
}
template Result<SolidScaleRange> solid_fit_range(const Mesh&, const Mesh&, const RationalPoint3&, const Progress&);

Result<SolidScaleRange> solid_fit_range(const Mesh& part, const Mesh& container, const Progress& progress) {
  return queried_in_unit(part, extent(part), extent(container),
                         [&](const Mesh& p) { return range_anywhere(p, container, progress); });
}

}  // namespace dymsum
