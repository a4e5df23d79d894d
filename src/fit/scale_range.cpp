#include "dymsum/scale_range.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "base/poll.h"
#include "fit/blocked_scales.h"
#include "fit/free_intervals.h"
#include "fit/path_free.h"
#include "planar/frame/scaling_events.h"
#include "planar/frame/scaling_sum.h"
#include "planar/operand/operand.h"
#include "planar/region/region.h"

namespace dymsum {

using namespace planar;
using exact::BigRational;

namespace {

exact::BigInteger odd_part(exact::BigInteger v) {
  while (v > 0 && (v & 1) == 0) v >>= 1;
  return v;
}

/// The double that a number is; nothing where it is none.
std::optional<double> double_of(const BigRational& v) {
  const double nearest = exact::round_to_double(v);
  if (!std::isfinite(nearest) || exact::exact_value(nearest) != v) return std::nullopt;
  return nearest;
}

Error no_double(const char* what, const exact::BigInteger& times) {
  return {ErrorCode::unsupported_operand,
          std::string(what) + " times " + times.str() +
              ", the common denominator of what is given in fractions, is no double",
          {}};
}

/// The region with of(c) for every coordinate c; nothing where one is no double, or the region is not valid then.
template <class F>
std::optional<Region> with_coordinates(const Region& region, const F& of) {
  RegionData data = region.data();
  bool all = true;
  planar::for_each_chain(data, [&](std::vector<Point>& points) {
    for (Point& p : points)
      for (double* c : {&p.x, &p.y}) {
        const std::optional<double> v = of(*c);
        all &= v.has_value();
        *c = v.value_or(0);
      }
  });
  if (!all) return std::nullopt;
  const Result<Region> made = Region::create(std::move(data));
  return made ? std::optional(*made) : std::nullopt;
}

/// The region so many times as large.
std::optional<Region> times(const Region& region, const BigRational& factor) {
  return with_coordinates(region, [&](double c) { return double_of(exact::exact_value(c) * factor); });
}

Error unsupported(const char* text) { return {ErrorCode::unsupported_operand, text, {}}; }

std::optional<Error> check(const Region& part, const Region& other) {
  if (part.empty()) return unsupported("the part is empty");
  if (other.empty()) return unsupported("the region of obstacles, or the container, is empty");
  if (part.parts().empty() || !part.polylines().empty() || !part.points().empty())
    return unsupported("the part has to be a region without polylines and points");
  if (other.parts().empty() || !other.polylines().empty() || !other.points().empty())
    return unsupported("obstacles and containers have to be regions without polylines and points");
  return std::nullopt;
}

/// The path of a part past an engine region whose first vertex is not all there is.
Result<ScaleRange> range_of(const Region& part, const std::vector<Point>& path, const EngineRegion& obstacles,
                            const std::optional<BigRational>& limit, const Progress& progress) try {
  const std::array<std::shared_ptr<const Operand>, 2> kept{make_operand(obstacles, 0), prepared_operand(part, 1, true)};
  const auto first = static_cast<std::uint32_t>(kept[0]->points->input.size());
  const auto reference = static_cast<std::uint32_t>(kept[1]->points->input.size());
  Result<std::shared_ptr<const OperandPair>> base =
      OperandPair::create(kept, {path, std::vector<Point>{Point{0, 0}}}, 1, 0);
  if (!base) return base.error();
  // A vertex that is not the first waypoint: a lone waypoint's place needs a line to lie on.
  const std::vector<Point>& vertices = (*base)->lattice->points[0]->input;
  std::uint32_t beside = 0;
  while (vertices[beside] == path[0]) ++beside;
  const BlockedSearch search(**base);
  const PathFree walk(std::move(base).value(), first, static_cast<std::uint32_t>(path.size()), reference, beside);
  Poll poll(progress);
  poll.stage("contacts");
  ScaleRange range;
  std::uint32_t leg = 0;
  std::optional<ExactSource::Position> blocked;
  const auto free = [&](const BigRational& s) {
    blocked = walk.blocked_at(s, leg);
    return !blocked;
  };
  const auto about = [&](const BigRational& s) { return search.about(*blocked, s); };
  const Result<void> done =
      free_intervals(walk.critical([&](double fraction) { poll(fraction); }), limit, progress, range, free, about);
  if (!done) return done.error();
  return range;
} catch (const Cancelled&) {
  return cancelled();
}

// The largest scale at which the part's bounding box is no larger than the container's.
BigRational box_limit(const Region& part, const Region& container) {
  const auto a = bounds(part), b = bounds(container);
  const auto width = [](const std::array<double, 4>& box, int axis) {
    return BigRational(exact::exact_value(box[2 + axis]) - exact::exact_value(box[axis]));
  };
  return std::min<BigRational>(width(b, 0) / width(a, 0), width(b, 1) / width(a, 1));
}

Point upper(Point a, Point b) { return {std::max(a.x, b.x), std::max(a.y, b.y)}; }

/// A box about the origin of at least that reach. Error out_of_range where it is beyond what frames may be.
Result<Region> box_of_reach(double reach) {
  constexpr double kLeast = 0x1p-900,
                   kMost = 0x1p994;  // of a point, which reaches nowhere; a frame is some times as wide
  if (!(reach <= kMost))
    return Error{ErrorCode::out_of_range, "scaled as large as the container, the part reaches beyond 2^994", {}};
  const double half = std::ldexp(1.0, std::ilogb(std::max(reach, kLeast)) + 2);
  return Region::create({{{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}, {}}}, {}, {}});
}

/// A box around every scaled part that could lie in the container: what the complement's frame has to be wide for.
Result<Region> frame_tool(const Region& part, const BigRational& limit) {
  const auto box = bounds(part);
  const double s = std::nextafter(exact::round_to_double(limit), INFINITY);
  double reach = 0;
  for (const double v : box) reach = std::max(reach, std::abs(v) * s);
  return box_of_reach(reach);
}

/// A scale below `limit` at which the part's bounding box, taken a little larger than it is, has room: it is convex, so
/// every smaller part has room too.
Result<BigRational> proved_fit(const Region& part, const Region& container, const BigRational& limit,
                               const Progress& progress) {
  SumOptions options;
  options.progress = progress;
  const auto box = bounds(part);
  const auto up = [](double v) { return std::nextafter(v, INFINITY); };
  const double wide = up(box[2] - box[0]), high = up(box[3] - box[1]);
  BigRational low = limit;
  for (int k = 0; k < 60; ++k) {
    low /= 2;
    const double s = up(exact::round_to_double(low)), w = up(wide * s), h = up(high * s);
    const Region hull = Region::create({{{{{0, 0}, {w, 0}, {w, h}, {0, h}}, {}}}, {}, {}}).value();
    const Result<PlanarSum> room = erode(container, hull, options);
    if (!room) return room.error();
    if (!room->parts.empty()) return low;
  }
  return unsupported("the container is too thin for its size");
}

/// The sum of a container's framed complement and a reflected part that scales: what it leaves free are the placements.
class AnyPlacement {
 public:
  static Result<AnyPlacement> create(const Region& part, const Region& container, const BigRational& limit) {
    const Result<Region> tool = frame_tool(part, limit);
    if (!tool) return tool.error();
    EngineRegion frame = complement_of(container, *tool);
    // Positions are found by the frame's own numbers, which are unique; contacts are determined by those of the
    // container.
    ObstacleIndices indices{std::move(frame.vertex_indices), std::move(frame.edge_indices)};
    frame.vertex_indices.clear();
    frame.edge_indices.clear();
    Result<std::shared_ptr<const OperandPair>> base =
        OperandPair::create({make_operand(frame, 0), prepared_operand(part, 1, true)}, {}, 1, 0);
    if (!base) return base.error();
    return AnyPlacement(std::move(base).value(), std::move(indices));
  }

  Result<void> move_to(const BigRational& s) {
    const Result<Scale> scale = Scale::of(exact::to_rational(s));
    if (!scale) return scale.error();
    const Result<FrameChanges> moved = state_->move_to(*scale, *scale);
    if (!moved) return moved.error();
    return {};
  }
  /// Whether the part fits, after move_to(). Free placements are holes of the sum and its tight features.
  bool fits() const {
    return state_->sum.hole_count() + state_->sum.tight_points.size() + state_->sum.tight_segments.size() > 0;
  }
  std::vector<ScaleContact> contacts(const BigRational& s) const {
    return tight_contacts(*base_, state_->sum, s, numbers_);
  }

  /// `again` throws to stop.
  std::vector<EventValue> events(const BigRational& from, const BigRational& to, const std::function<void()>& again) {
    return events_of(*state_->windows.between(from, to), forms_, from, to, again);
  }

 private:
  static MovingOptions options() {
    MovingOptions options;
    options.moving = MovingOperand::q;
    options.semantics = Semantics::open;
    options.mode = FrameMode::window;
    options.window = 1.0 / 16;
    return options;
  }
  AnyPlacement(std::shared_ptr<const OperandPair> base, ObstacleIndices indices)
      : base_(base),
        numbers_(std::move(indices)),
        forms_(*base_),
        state_(std::make_unique<planar::ScalingState>(std::move(base), options())) {}

  std::shared_ptr<const OperandPair> base_;
  ObstacleIndices numbers_;
  ExactForms forms_;
  std::unique_ptr<planar::ScalingState> state_;
};

Result<PathFree::Critical> critical_of(AnyPlacement& placement, const BigRational& low, const BigRational& limit,
                                       const Progress& progress) try {
  PathFree::Critical critical;
  Poll poll(progress);
  poll.stage("events");
  for (BigRational from = low; from < limit;) {
    const double done = exact::round_to_double(BigRational((from - low) / (limit - low)));
    const auto query = [&] { poll(done); };
    query();
    const BigRational to = std::min<BigRational>(BigRational(from * BigRational(17, 16)), limit);
    for (const EventValue& e : placement.events(from, to, query)) critical[e.s];
    from = to;
  }
  return critical;
} catch (const Cancelled&) {
  return cancelled();
}

Result<ScaleRange> range_along(const Region& part, const std::vector<Point>& path, const Region& obstacles,
                               const Progress& progress) {
  if (path.empty()) return unsupported("a path needs at least one waypoint");
  for (std::size_t i = 0; i < path.size(); ++i)
    if (!std::isfinite(path[i].x) || !std::isfinite(path[i].y)) {
      Error error{ErrorCode::not_finite, "a waypoint of the path is not finite", {}};
      error.evidence.vertex = static_cast<std::int64_t>(i);
      return error;
    }
  if (std::optional<Error> error = check(part, obstacles)) return *std::move(error);
  // Repeated waypoints are one.
  std::vector<Point> way;
  for (const Point& p : path)
    if (way.empty() || !(way.back() == p)) way.push_back(p);
  return range_of(part, way, separate_touching(obstacles.data(), obstacles.touching_points()), std::nullopt, progress);
}

Result<ScaleRange> range_at(const Region& part, const Region& container, Point at, const Progress& progress) {
  if (!std::isfinite(at.x) || !std::isfinite(at.y))
    return Error{ErrorCode::not_finite, "the placement is not finite", {}};
  if (std::optional<Error> error = check(part, container)) return *std::move(error);
  if (std::optional<Error> error = too_large_to_frame(container, part)) return *std::move(error);
  const BigRational limit = box_limit(part, container);
  // The part lies inside the frame also at the placement.
  const Result<Region> tool = frame_tool(part, limit);
  if (!tool) return tool.error();
  const auto b = bounds(*tool);
  const Point far = upper({std::abs(at.x), std::abs(at.y)}, {b[2], b[3]});
  const Result<Region> wide = box_of_reach(far.x + far.y);
  if (!wide) return wide.error();
  return range_of(part, {at}, complement_of(container, *wide), limit, progress);
}

Result<ScaleRange> range_anywhere(const Region& part, const Region& container, const Progress& progress) {
  if (std::optional<Error> error = check(part, container)) return *std::move(error);
  if (std::optional<Error> error = too_large_to_frame(container, part)) return *std::move(error);
  const BigRational limit = box_limit(part, container);
  Result<AnyPlacement> made = AnyPlacement::create(part, container, limit);
  if (!made) return made.error();
  AnyPlacement placement = std::move(made).value();
  const Result<BigRational> low = proved_fit(part, container, limit, progress);
  if (!low) return low.error();
  const Result<PathFree::Critical> critical = critical_of(placement, *low, limit, progress);
  if (!critical) return critical.error();
  Result<void> moved;
  const auto fits_at = [&](const BigRational& s) {
    if (moved) moved = placement.move_to(s);
    return moved && placement.fits();
  };
  ScaleRange range;
  const Result<void> done =
      free_intervals(*critical, limit, progress, range, [&](const BigRational& s) { return s <= *low || fits_at(s); });
  if (!done) return done.error();
  const auto name = [&](const std::optional<Rational>& end, std::vector<ScaleContact>& contacts) {
    if (!end || !fits_at(exact::exact_value(*end))) return;
    contacts = placement.contacts(exact::exact_value(*end));
  };
  for (ScaleInterval& i : range.free) {
    name(i.low, i.at_low);
    name(i.high, i.at_high);
  }
  if (!moved) return moved.error();
  return range;
}

double extent(const Region& region) {
  const auto box = bounds(region);
  return std::max(box[2] - box[0], box[3] - box[1]);
}

/// How far a region reaches from the origin, or points do.
double reach_of(const Region& region) {
  double reach = 0;
  for (const double v : bounds(region)) reach = std::max(reach, std::abs(v));
  return reach;
}
double reach_of(const std::vector<Point>& points) {
  double reach = 0;
  for (const Point& p : points) reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
  return reach;
}

/// The part in its unit; nothing where that is its own, or has coordinates that are no doubles.
std::optional<Region> part_in_unit(const Region& part, int k) {
  if (k == 0) return std::nullopt;
  return with_coordinates(part, [k](double c) { return in_unit(c, k); });
}

/// Asks with the part in its unit.
template <class Query>
Result<ScaleRange> queried_in_unit(const Region& part, double part_size, double other_size, const Query& query) {
  const int k = part_unit(part_size, other_size);
  const std::optional<Region> changed = part_in_unit(part, k);
  if (!changed) return query(part);
  Result<ScaleRange> range = query(*changed);
  if (!range && range.error().code == ErrorCode::unsupported_operand)
    range = query(part);  // names the operand's own position
  if (!range) return range.error();
  return in_input_units(*std::move(range), k);
}

}  // namespace

bool ScaleRange::contains(const Scale& s) const {
  const BigRational v = rational(scale_value(s));
  for (const ScaleInterval& i : free)
    if ((!i.low || exact::exact_value(*i.low) <= v) && (!i.high || v <= exact::exact_value(*i.high))) return true;
  return false;
}

std::optional<Rational> ScaleRange::trap() const {
  if (free.empty() || free[0].low) return Rational();
  return free[0].high;
}

Result<ScaleRange> scale_range(const Region& part, const std::vector<Point>& path, const Region& obstacles,
                               const Progress& progress) {
  return queried_in_unit(part, reach_of(part), std::max(reach_of(path), reach_of(obstacles)),
                         [&](const Region& p) { return range_along(p, path, obstacles, progress); });
}

namespace {

/// Asks at positions and a region that are all so many times as large that the positions are doubles: so is the part,
/// at scales that are. `named`: what a position and the region are.
template <class Query>
Result<ScaleRange> queried_in_whole_numbers(std::span<const RationalPoint> positions, const Region& region,
                                            const std::array<const char*, 2>& named, const Query& query) {
  exact::BigInteger common = 1;
  for (const RationalPoint& at : positions)
    for (const Rational* c : {&at.x, &at.y}) common = lcm(common, odd_part(exact::denominator_of(*c)));
  const BigRational factor(common);
  std::vector<Point> way;
  for (const RationalPoint& at : positions) {
    const std::optional<double> x = double_of(exact::exact_value(at.x) * factor),
                                y = double_of(exact::exact_value(at.y) * factor);
    if (!x || !y) return no_double(named[0], common);
    way.push_back({*x, *y});
  }
  if (common == 1) return query(way, region);
  const std::optional<Region> larger = times(region, factor);
  if (!larger) return no_double(named[1], common);
  Result<ScaleRange> made = query(way, *larger);
  if (!made) return made;
  ScaleRange range = std::move(made).value();
  const Rational divisor = exact::to_rational(factor);
  for (ScaleInterval& i : range.free) {
    for (std::optional<Rational>* end : {&i.low, &i.high})
      if (*end) *end = **end / divisor;
    for (std::vector<ScaleContact>* contacts : {&i.at_low, &i.at_high})
      for (ScaleContact& c : *contacts) c.at = {c.at.x / divisor, c.at.y / divisor};
  }
  return range;
}

}  // namespace

Result<ScaleRange> scale_range(const Region& part, std::span<const RationalPoint> path, const Region& obstacles,
                               const Progress& progress) {
  return queried_in_whole_numbers(
      path, obstacles, {"a waypoint", "a coordinate of the obstacles"},
      [&](const std::vector<Point>& way, const Region& larger) { return scale_range(part, way, larger, progress); });
}

template <std::same_as<RationalPoint> Position>
Result<ScaleRange> fit_range(const Region& part, const Region& container, const Position& at,
                             const Progress& progress) {
  return queried_in_whole_numbers(std::span(&at, 1), container, {"the place", "a coordinate of the container"},
                                  [&](const std::vector<Point>& positions, const Region& larger) {
                                    return fit_range(part, larger, positions.front(), progress);
                                  });
}
template Result<ScaleRange> fit_range(const Region&, const Region&, const RationalPoint&, const Progress&);

Result<ScaleRange> fit_range(const Region& part, const Region& container, Point at, const Progress& progress) {
  return queried_in_unit(part, reach_of(part), extent(container),
                         [&](const Region& p) { return range_at(p, container, at, progress); });
}

Result<ScaleRange> fit_range(const Region& part, const Region& container, const Progress& progress) {
  return queried_in_unit(part, extent(part), extent(container),
                         [&](const Region& p) { return range_anywhere(p, container, progress); });
}

}  // namespace dymsum
