#include "dymsum/solid_scale_range.h"

#include <algorithm>
#include <cmath>

#include "dymsum/solid_scale_events.h"
#include "fit/free_intervals.h"
#include "fit/part_unit.h"
#include "fit/solid_path.h"
#include "spatial/erode/frame.h"
#include "spatial/motion/computed_scale.h"
#include "spatial/moving/posed_sum.h"

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
