// The public classes: one pose after the other.
#include "dymsum/continuous_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>

#include "base/double_text.h"
#include "base/doubles.h"
#include "depth/boundary_distance.h"
#include "depth/continuous_tracker.h"
#include "depth/touching_pairs.h"
#include "dymsum/moving_solid_sum.h"
#include "dymsum/rotation.h"
#include "exact/big.h"
#include "spatial/boundary/collision.h"
#include "spatial/motion/posed_pair.h"

namespace dymsum::depth {
namespace {

// Whether solids, of which Q is turned, overlap at exact positions.

/// P and Q reflected, at one orientation of Q.
class PosedOverlap {
 public:
  /// The pair has to live as long. Throws std::invalid_argument where coordinates need more than 8,192 bits.
  PosedOverlap(const spatial::SolidPair& pair, const Rotation& q_turned);

  /// Whether the definition holds: the interiors of P and of Q moved to `at` meet. Exact.
  bool holds(const std::array<exact::BigRational, 3>& at);

 private:
  spatial::PosedSpace posed_;
  spatial::Collision collision_;
};

spatial::PosePair with_q_turned(const Rotation& q_turned) {
  spatial::PosePair poses;
  poses.q.rotation = q_turned;
  return poses;
}

PosedOverlap::PosedOverlap(const spatial::SolidPair& pair, const Rotation& q_turned)
    : posed_(spatial::posed_space(pair, with_q_turned(q_turned))), collision_(*posed_.space, pair.p, pair.q) {}

bool PosedOverlap::holds(const std::array<exact::BigRational, 3>& at) {
  const exact::BigInteger& scale = posed_.scale;
  const std::optional<spatial::PointSource> position =
      posed_.space->add_position({at[0] * scale, at[1] * scale, at[2] * scale});
  return position && collision_.overlaps({*position, 0, 0, 0, 0, 0});
}

}  // namespace
}  // namespace dymsum::depth

namespace dymsum {

// The public classes: one pose after the other.

using depth::ContinuousPosition;
using depth::ContinuousSurface;
using depth::ContinuousTracker;
using depth::SurfaceDistance;
using spatial::Vec3;

namespace {

bool is_finite_at(const Point3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Twice the circumradius about the origin, at least the size of all coordinates.
double extent(const Mesh& mesh) {
  double most = 0;
  for (const Point3& v : mesh.vertices()) most = std::max({most, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return 2 * most;
}

double diagonal(const Mesh& mesh) {
  const std::array<double, 6> b = bounds(mesh);
  return base::hypot3(b[3] - b[0], b[4] - b[1], b[5] - b[2]);
}

std::optional<Error> options_error(const ContinuousDepthOptions& o) {
  const double length = o.smoothing_length.value_or(0);
  if (!std::isfinite(length) || !std::isfinite(o.inflation) || !std::isfinite(o.margin))
    return Error{ErrorCode::not_finite, "an option of the depth is not finite", {}};
  if (length < 0 || o.margin < 0)
    return Error{ErrorCode::out_of_range,
                 "lengths must be at least 0, not " + base::general_text(std::min(length, o.margin), 6),
                 {}};
  if (o.inflation < 1)
    return Error{
        ErrorCode::out_of_range, "the inflation must be at least 1, not " + base::general_text(o.inflation, 6), {}};
  if (o.halvings < 0 || o.halvings > 20)
    return Error{ErrorCode::out_of_range, "halvings must be from 0 to 20, not " + std::to_string(o.halvings), {}};
  return std::nullopt;
}

/// Halfway, on the shorter way.
Rotation between(const Rotation& a, const Rotation& b) {
  std::array<double, 4> sum{};
  double product = 0, na = 0, nb = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto x = static_cast<double>(a.quaternion()[k]), y = static_cast<double>(b.quaternion()[k]);
    product += x * y, na += x * x, nb += y * y;
  }
  const double wa = 1 / std::sqrt(na), wb = (product < 0 ? -1 : 1) / std::sqrt(nb);
  for (std::size_t k = 0; k < 4; ++k)
    sum[k] = wa * static_cast<double>(a.quaternion()[k]) + wb * static_cast<double>(b.quaternion()[k]);
  Result<Rotation> midpoint = Rotation::nearest(sum[0], sum[1], sum[2], sum[3]);
  return midpoint ? *midpoint : a;
}

spatial::Mat3 matrix_of(const Rotation& r) {
  const std::array<std::int64_t, 9> n = r.matrix();
  const double s = 1 / static_cast<double>(r.norm());
  const auto row = [&](std::size_t k) {
    return Vec3{s * static_cast<double>(n[k]), s * static_cast<double>(n[k + 1]), s * static_cast<double>(n[k + 2])};
  };
  return {row(0), row(3), row(6)};
}

/// A box of short numbers that holds the one about a position.
ClipBox box_about(const Point3& at, double reach) {
  const double step = std::ldexp(1.0, std::ilogb(reach) - 5);
  const auto low = [&](double v) { return (std::floor((v - reach) / step) - 1) * step; };
  const auto high = [&](double v) { return (std::ceil((v + reach) / step) + 1) * step; };
  return {{low(at.x), low(at.y), low(at.z)}, {high(at.x), high(at.y), high(at.z)}};
}

/// The part of a sum's boundary no further than `reach` from a position, more or less: what cannot be nearest is left
/// out.
SpatialSum near_part(const SpatialSum& sum, const ContinuousSurface& s, Vec3 from, double reach) {
  SpatialSum part = sum;
  part.faces.clear(), part.tight_faces.clear();
  const auto is_near = [&](const depth::SurfaceFace& f) {
    const auto gap = [](double low, double high, double v) { return std::max({low - v, v - high, 0.0}); };
    return spatial::length({gap(f.low.x, f.high.x, from.x), gap(f.low.y, f.high.y, from.y),
                            gap(f.low.z, f.high.z, from.z)}) <= reach;
  };
  for (std::size_t k = 0; k < s.faces.size(); ++k)
    if (is_near(s.faces[k])) part.faces.push_back(sum.faces[k]);
  for (std::size_t k = 0; k < sum.tight_faces.size(); ++k)
    if (is_near(s.tight[k])) part.tight_faces.push_back(sum.tight_faces[k]);
  return part;
}

/// A quarter of the smaller solid's diagonal: parts without volume may be as small as a point, and the sum with them is
/// as large as the solid.
double default_smoothing(const Mesh& p, const Mesh& q) {
  if (p.has_thin_parts() || q.has_thin_parts()) return 0.25 * diagonal(p.has_thin_parts() ? q : p);
  return 0.25 * std::min(diagonal(p), diagonal(q));
}

/// The boundary of P + -Q about a position, for Q turned: a local sum, or, where an operand has parts without volume,
/// the whole one.
class BoundaryMaker {
 public:
  static Result<BoundaryMaker> create(const Mesh& p, const Mesh& q, const ContinuousDepthOptions& options) {
    if (p.has_thin_parts() && q.has_thin_parts())
      return Error{
          ErrorCode::unsupported_operand, "both operands have parts without volume: depth wants one solid", {}};
    BoundaryMaker made;
    if (p.has_thin_parts() || q.has_thin_parts()) {
      MovingSolidOptions whole;
      whole.tight = options.tight, whole.threads = options.threads, whole.progress = options.progress;
      Result<MovingSolidSum> sum = MovingSolidSum::create(p, negated(q), whole);
      if (!sum) return sum.error();
      made.whole_ = *std::move(sum);
      return made;
    }
    LocalOptions local;
    local.tight = options.tight, local.threads = options.threads, local.progress = options.progress;
    Result<LocalSum> sum = LocalSum::create(p, negated(q), local);
    if (!sum) return sum.error();
    made.local_ = *std::move(sum);
    return made;
  }

  struct Made {
    SpatialSum boundary;
    bool whole = false;
    bool all_inside = false;  ///< of a part without faces: it lies inside
  };
  Result<Made> about(const Point3& at, double reach, const Rotation& turned) {
    SolidPose pose;
    pose.rotation = turned;
    if (whole_) {
      const Result<SolidFrameWork> moved = whole_->set({}, pose);
      if (!moved) return moved.error();
      return Made{whole_->sum(), true, false};
    }
    Result<LocalPart> part = local_->in(box_about(at, reach), {}, pose);
    if (!part) return part.error();
    LocalPart made = *std::move(part);
    // Without faces, but with tight features: these are inside.
    return Made{std::move(made.boundary), false, made.where != LocalPart::Where::outside};
  }

 private:
  std::optional<LocalSum> local_;
  std::optional<MovingSolidSum> whole_;
};

}  // namespace

class ContinuousDepth::State {
 public:
  State(const Mesh& p, const Mesh& q, BoundaryMaker maker, const ContinuousDepthOptions& options)
      : p_(p),
        q_(q),
        maker_(std::move(maker)),
        radius_q_(std::sqrt(3.0) * extent(q) / 2),
        extent_(extent(p) + 2 * radius_q_) {
    smoothing_ = options.smoothing_length.value_or(default_smoothing(p, q));
    margin_ = options.margin > 0 ? options.margin : smoothing_ > 0 ? smoothing_ : extent_ / 16;
    ContinuousTracker::Limits limits;
    limits.scale = std::ldexp(1.0, -std::ilogb(smoothing_ > 0 ? smoothing_ : extent_));
    limits.smoothing = smoothing_ * limits.scale, limits.inflation = options.inflation;
    limits.halvings = halvings_ = options.halvings;
    tracker_ = ContinuousTracker(limits);
    solids_.p = std::make_shared<const depth::WitnessSolid>(
        depth::witness_solid(depth::continuous_surface(p, limits.scale), solids_.turn, 1));
    q_surface_ = depth::continuous_surface(q, limits.scale);
    solids_.size = extent_ * limits.scale;
  }

  bool takes_smoothing() const {
    return smoothing_ == 0 || (smoothing_ >= extent_ * 0x1p-30 && smoothing_ <= extent_ * 64);
  }
  double smoothing() const { return smoothing_; }

  Result<ContinuousContact> query(const Point3& at, const Rotation& turned) {
    answered_ = false;
    ContinuousContact result;
    if (const Result<void> done = step(at, turned, halvings_, result); !done) {
      forget();
      return done.error();
    }
    at_ = at, answered_ = true;
    return result;
  }

  Rational exact_square() {
    const std::vector<depth::RationalVector> moves = exact_moves();
    if (moves.empty()) return 0;
    const depth::RationalVector& v = moves.front();
    return exact::to_rational(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }

  std::vector<SolidWay> exact_ways() {
    std::vector<depth::RationalVector> moves = exact_moves();
    if (moves.empty()) return {};
    if (!touching_ || !(touching_turned_ == turned_)) {
      depth::TouchSide side = depth::touch_side(q_);
      side.turn(turned_);
      touching_ = std::make_unique<const depth::TouchingPairs>(depth::touch_side(p_), std::move(side));
      touching_turned_ = turned_;
    }
    return depth::ways_of(std::move(moves), position_of(at_), touching_.get());
  }

  const ContinuousTracker& tracker() const {
    require_answer();
    return tracker_;
  }
  void forget() { tracker_.drop(Discontinuity::entered), answered_ = false; }

 private:
  static depth::RationalVector position_of(const Point3& at) {
    return {exact::exact_value(at.x), exact::exact_value(at.y), exact::exact_value(at.z)};
  }

  /// All shortest ones; none where they do not overlap. Doubles determine which faces may be nearest; on which side of
  /// them the position lies is queried exactly.
  std::vector<depth::RationalVector> exact_moves() {
    require_answer();
    const ContinuousPosition& position = *tracker_.position();
    const depth::RationalVector from = position_of(at_);
    if (position.surface.faces.empty() || !overlaps(from)) return {};
    const double reach = near_.nearest.distance * (1 + 0x1p-30) + 4 * tracker_.error();
    const SpatialSum part = near_part(*position.boundary, position.surface, tracker_.scaled(at_), reach);
    return depth::nearest_by_doubles_first(part, from).all;
  }

  void require_answer() const {
    if (!answered_) throw std::logic_error("ContinuousDepth: there is no answer yet");
  }

  bool overlaps(const depth::RationalVector& at) {
    if (!pair_) pair_ = std::make_unique<const spatial::SolidPair>(spatial::solid_pair(p_, negated(q_)));
    if (!overlap_ || !(overlap_turned_ == turned_))
      overlap_ = std::make_unique<depth::PosedOverlap>(*pair_, turned_), overlap_turned_ = turned_;
    return overlap_->holds(at);
  }

  /// Moves from the last pose to this one, by halves where that is not proved to follow.
  Result<void> step(const Point3& at, const Rotation& turned, int halvings, ContinuousContact& result) {
    const bool turns = !tracker_.position() || !(turned == turned_);
    const ContinuousTracker before = tracker_;
    const Rotation turned_before = turned_;
    const Point3 from = last_;
    const double angle = turns ? (turned * turned_.inverse()).angle() : 0;
    if (const Result<void> done = prepare(at, turned, turns, result); !done) return done;
    const double turned_by = angle * radius_q_ * tracker_.limits().scale;
    const bool must = !turns || halvings == 0 || !before.is_tracking();
    if (tracker_.answer(tracker_.scaled(at), near_, turned_by, must, result)) {
      last_ = at;
      return {};
    }
    tracker_ = before, turned_ = turned_before;
    const Point3 midpoint{0.5 * (from.x + at.x), 0.5 * (from.y + at.y), 0.5 * (from.z + at.z)};
    const Rotation half = between(turned_before, turned);
    ContinuousContact between_them;
    between_them.work = result.work;
    if (const Result<void> done = step(midpoint, half, halvings - 1, between_them); !done) return done;
    result.work = between_them.work;
    if (const Result<void> done = step(at, turned, halvings - 1, result); !done) return done;
    // What jumped on the way has jumped.
    if (result.discontinuity == Discontinuity::none) result.discontinuity = between_them.discontinuity;
    return {};
  }

  /// What has to be known of the boundary about a position, and the distance there.
  Result<void> prepare(const Point3& at, const Rotation& turned, bool turns, ContinuousContact& result) {
    const Vec3 from = tracker_.scaled(at);
    if (!turns) {
      near_ = depth::nearest_on(tracker_.position()->surface, from);
      if (is_covered(from)) return {};
    }
    if (std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)}) > extent_) {
      far_away(at, turned);
      return {};
    }
    const double scale = tracker_.limits().scale;
    double reach = (near_.inside ? tracker_.wanted(near_.nearest.distance) / scale : smoothing_) + margin_;
    for (;;) {
      if (const Result<void> done = cut(at, turned, reach, result); !done) return done;
      const ContinuousPosition& position = *tracker_.position();
      near_ = depth::nearest_on(position.surface, from);
      const double wanted = near_.inside ? tracker_.wanted(near_.nearest.distance) / scale : 0;
      if (is_covered(from) && (std::isinf(position.reach) || wanted + 0.5 * margin_ <= reach)) return {};
      reach = std::max(near_.face.distance / scale <= reach ? wanted : 2 * reach, wanted) + margin_;
    }
  }

  const depth::WitnessSolids& solids_turned(const Rotation& turned) {
    if (!solids_.q || !(turned == solids_turned_)) {
      solids_.turn = matrix_of(turned), solids_turned_ = turned;
      solids_.q = std::make_shared<const depth::WitnessSolid>(depth::witness_solid(q_surface_, solids_.turn, -1));
    }
    return solids_;
  }

  /// The pose is one at which no point of Q can meet P.
  void far_away(const Point3& at, const Rotation& turned) {
    auto position = std::make_shared<ContinuousPosition>();
    position->boundary = std::make_shared<const SpatialSum>();
    position->centre = tracker_.scaled(at);
    near_ = {};
    near_.face.distance = near_.nearest.distance = std::numeric_limits<double>::infinity();
    turned_ = turned;
    tracker_.move_to(std::move(position));
  }

  bool is_covered(Vec3 from) const {
    const ContinuousPosition& position = *tracker_.position();
    if (std::isinf(position.reach)) return true;
    if (near_.face.face == depth::kNoEdge) return !position.all_inside && spatial::length(from - position.centre) == 0;
    if (near_.inside) return tracker_.covers(from, near_.nearest.distance);
    return near_.face.distance <= position.reach - spatial::length(from - position.centre);
  }

  Result<void> cut(const Point3& at, const Rotation& turned, double reach, ContinuousContact& result) {
    ++result.work.local_sums;
    Result<BoundaryMaker::Made> part = maker_.about(at, reach, turned);
    if (!part) return part.error();
    BoundaryMaker::Made made = *std::move(part);
    const double scale = tracker_.limits().scale;
    auto position = std::make_shared<ContinuousPosition>();
    position->surface = depth::continuous_surface(made.boundary, scale);
    position->solids = solids_turned(turned);
    position->centre = tracker_.scaled(at);
    const double furthest = std::max({std::abs(at.x), std::abs(at.y), std::abs(at.z)});
    position->size = (furthest + extent_) * scale;
    position->reach =
        made.whole || reach >= furthest + extent_ ? std::numeric_limits<double>::infinity() : reach * scale;
    position->all_inside = made.all_inside;
    position->boundary = std::make_shared<const SpatialSum>(std::move(made.boundary));
    turned_ = turned;
    tracker_.move_to(std::move(position));
    return {};
  }

  Mesh p_, q_;
  BoundaryMaker maker_;
  depth::WitnessSolids solids_;  // Q at the last orientation that a local sum was made for
  Rotation solids_turned_;
  ContinuousSurface q_surface_;
  double radius_q_, extent_, smoothing_ = 0, margin_ = 0;
  int halvings_ = 0;
  ContinuousTracker tracker_;
  SurfaceDistance near_;
  Rotation turned_;
  Point3 at_, last_;
  bool answered_ = false;
  // Made when the exact square is requested.
  std::unique_ptr<const spatial::SolidPair> pair_;
  std::unique_ptr<depth::PosedOverlap> overlap_;
  Rotation overlap_turned_;
  // Made when the ways are requested.
  std::unique_ptr<const depth::TouchingPairs> touching_;
  Rotation touching_turned_;
};

Result<ContinuousDepth> ContinuousDepth::create(const Mesh& p, const Mesh& q, const ContinuousDepthOptions& options) {
  if (std::optional<Error> error = options_error(options)) return *std::move(error);
  if (p.faces().empty() || q.faces().empty()) return Error{ErrorCode::no_area, "an operand is empty", {}};
  Result<BoundaryMaker> maker = BoundaryMaker::create(p, q, options);
  if (!maker) return maker.error();
  auto state = std::make_unique<State>(p, q, *std::move(maker), options);
  if (!state->takes_smoothing())
    return Error{
        ErrorCode::out_of_range, "the smoothing length is not between 2^-30 and 64 times the solids' size", {}};
  return ContinuousDepth(std::move(state));
}

ContinuousDepth::ContinuousDepth(std::unique_ptr<State> state) : state_(std::move(state)) {}
ContinuousDepth::ContinuousDepth(ContinuousDepth&&) noexcept = default;
ContinuousDepth& ContinuousDepth::operator=(ContinuousDepth&&) noexcept = default;
ContinuousDepth::~ContinuousDepth() = default;

Result<ContinuousContact> ContinuousDepth::query(Point3 q_moved_by, const Rotation& q_turned) {
  if (!is_finite_at(q_moved_by)) {
    state_->forget();
    return Error{ErrorCode::not_finite, "the translation is not finite", {}};
  }
  return state_->query(q_moved_by, q_turned);
}

Rational ContinuousDepth::euclidean_squared() const { return state_->exact_square(); }
std::vector<SolidWay> ContinuousDepth::euclidean_ways() const { return state_->exact_ways(); }
DepthPatch ContinuousDepth::patch() const { return DepthPatch(state_->tracker()); }
void ContinuousDepth::forget() { state_->forget(); }
double ContinuousDepth::smoothing_length() const { return state_->smoothing(); }

DepthPatch::DepthPatch(const ContinuousTracker& tracker) : tracker_(std::make_unique<ContinuousTracker>(tracker)) {}
DepthPatch::DepthPatch(const DepthPatch& other) : DepthPatch(*other.tracker_) {}
DepthPatch& DepthPatch::operator=(const DepthPatch& other) { return *this = DepthPatch(other); }
DepthPatch::DepthPatch(DepthPatch&&) noexcept = default;
DepthPatch& DepthPatch::operator=(DepthPatch&&) noexcept = default;
DepthPatch::~DepthPatch() = default;

bool DepthPatch::covers(Point3 q_moved_by) const {
  const Vec3 from = tracker_->scaled(q_moved_by);
  const SurfaceDistance near = depth::nearest_on(tracker_->position()->surface, from);
  return near.inside && tracker_->covers(from, near.nearest.distance);
}

ContinuousContact DepthPatch::at(Point3 q_moved_by) {
  if (!is_finite_at(q_moved_by)) throw std::invalid_argument("DepthPatch::at: the translation is not finite");
  const Vec3 from = tracker_->scaled(q_moved_by);
  ContinuousContact result;
  tracker_->answer(from, depth::nearest_on(tracker_->position()->surface, from), 0, true, result);
  return result;
}

}  // namespace dymsum
