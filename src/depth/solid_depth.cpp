// Depth and distance of two solids of any shape.
#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "base/poll.h"
#include "depth/boundary_distance.h"
#include "depth/depth_operands.h"
#include "depth/facet_lines.h"
#include "dymsum/penetration_depth.h"
#include "exact/big.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::depth {
namespace {

// The first free position on a ray from a position in the open sum.

using spatial::Box;

using spatial::Vec3;

/// Whether a ray from the origin may meet a box that is grown by `room`.
bool may_meet(const Box& box, Vec3 from, Vec3 way, double room) {
  double first = 0, last = 1e300;
  const auto cut = [&](double low, double high, double at, double v) {
    low -= at + room, high -= at - room;
    if (std::abs(v) < 0x1p-40) {  // over the few units that matter this does not count
      if (low > 0 || high < 0) last = -1;
      return;
    }
    const double a = low / v, b = high / v;
    first = std::max(first, std::min(a, b) * (1 - 0x1p-40)), last = std::min(last, std::max(a, b) * (1 + 0x1p-40));
  };
  cut(box.low.x, box.high.x, from.x, way.x);
  cut(box.low.y, box.high.y, from.y, way.y);
  cut(box.low.z, box.high.z, from.z, way.z);
  return first <= last;
}

class RayExit {
 public:
  RayExit(const FacetView& view, const ExactFrame& frame, const RationalVector& direction)
      : view_(view), frame_(frame) {
    exact::BigInteger all = 1;
    for (const BigRational& c : direction) all = lcm(all, denominator(c));
    const auto whole = [&](std::size_t k) {
      return Big(exact::BigInteger(numerator(direction[k]) * (all / denominator(direction[k]))));
    };
    way_ = {whole(0), whole(1), whole(2)};
    multiple_ = all;
  }

  /// Sorted, different, positive; multiples of the direction's multiple by `multiple()`.
  std::vector<BigRational> crossings() {
    const Vec3 way = spatial::unit(way_);
    for (std::uint32_t f = 0; f < view_.o.facets.size(); ++f) {
      if (!may_meet(view_.o.tree.box(f), view_.from, way, 4 * view_.slack)) continue;
      const spatial::SumFacet& facet = view_.o.facets[f];
      if (add(frame_.plane(facet))) continue;
      for (int k = 0; k < facet.corners; ++k) add(frame_.facet_edge(facet, k)), add_corner(facet, k);
    }
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    return std::move(found_);
  }

 private:
  /// False where the ray runs along the plane.
  bool add(const ExactPlane& plane) {
    const Big rise = exact::dot(plane.n, way_);
    if (sign(rise) == 0) return false;
    add_length(plane.d, rise);
    return true;
  }
  /// The foot of a corner on the ray's line: the corner itself where it lies on it.
  void add_corner(const spatial::SumFacet& facet, int k) {
    add_length(exact::dot(frame_.corner(facet.corner[static_cast<std::size_t>(k)]), way_), exact::dot(way_, way_));
  }
  /// Adds a length in units of the frame over way_: of the operands' units over the direction.
  void add_length(const Big& num, const Big& den) {
    BigRational s = exact::ratio(num, den);
    if (s <= 0) return;
    found_.push_back(frame_.in_operand_units(s) * multiple_);
  }

  const FacetView& view_;
  const ExactFrame& frame_;
  BigVector way_;
  exact::BigInteger multiple_;
  std::vector<BigRational> found_;
};

/// The least s with from + s direction free. Candidates are where the ray crosses planes of facets near it, and facet
/// edges of those in whose planes it runs (docs/design/penetration-depth.md, "Along a direction").
BigRational exit_along(const FacetView& view, const ExactFrame& frame, DepthProbe& probe,
                       const RationalVector& direction, const RationalVector& from) {
  for (const BigRational& s : RayExit(view, frame, direction).crossings()) {
    const RationalVector x{from[0] + s * direction[0], from[1] + s * direction[1], from[2] + s * direction[2]};
    const Vec3 at = view.o.scaled(x);
    if (!probe.provably_overlaps(at, view.slack) && !probe.overlaps(x)) return s;
  }
  throw std::logic_error("exit_along: the sum is bounded, and no way leads out of it");
}

// The search for the nearest positions: free ones from a position in the open sum, ones of the sum from a position
// outside.

struct NearestPositions {
  std::vector<ExactPosition> all;    ///< equally near and different; none where the time was over
  double at_most = 0, at_least = 0;  ///< scaled: bounds of the distance where the time was over
  SolidDistance::Work work;
};

using spatial::length;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Positions that are off by more are queried in integers only.
constexpr double kVague = 0x1p-16;

/// A node of the tree, or a facet.
struct SearchItem {
  double lower = 0;
  std::uint32_t id = 0;
  bool is_facet = false;
  bool operator>(const SearchItem& other) const {
    return std::tie(lower, is_facet, id) > std::tie(other.lower, other.is_facet, other.id);
  }
};

class PositionSearch {
 public:
  PositionSearch(const FacetView& view, const ExactFrame& frame, DepthProbe& probe, bool inside)
      : view_(view), frame_(frame), probe_(probe), inside_(inside) {}

  NearestPositions run(double time_limit);

 private:
  void open(std::uint32_t node);
  void look_at(std::uint32_t facet);
  void look_for_free(std::uint32_t facet);
  enum class Known : std::uint8_t { nothing, free };
  void offer(const ExactPosition& x, std::uint32_t facet = DepthProbe::kNoFacet, Known known = Known::nothing);
  bool is_free(const ExactPosition& x, std::uint32_t facet);
  void offer_known();
  void remember();
  bool is_covered(Vec3 x, double off);
  double lower_bound(double distance) const { return distance > view_.slack ? distance - view_.slack : 0; }

  const FacetView& view_;
  const ExactFrame& frame_;
  DepthProbe& probe_;
  const bool inside_;
  std::priority_queue<SearchItem, std::vector<SearchItem>, std::greater<>> queue_;
  double bound_ = kInfinity;           // not less than the distance of result_.all
  std::vector<Vec3> found_;            // these, in doubles
  std::vector<std::uint32_t> facets_;  // on which they lie
  NearestPositions result_;
};

NearestPositions PositionSearch::run(double time_limit) {
  Stopwatch watch;
  if (inside_) offer_known();
  if (!view_.o.tree.empty()) queue_.push({0, 0, false});
  while (!queue_.empty() && !(queue_.top().lower > bound_)) {
    const SearchItem item = queue_.top();
    queue_.pop();
    if (!item.is_facet) {
      open(item.id);
      continue;
    }
    if (time_limit > 0 && watch.ms() > time_limit * 1000) {
      result_.at_most = bound_, result_.at_least = std::max(0.0, item.lower - view_.slack);
      result_.all.clear();
      return std::move(result_);
    }
    look_at(item.id);
  }
  if (inside_) remember();
  return std::move(result_);
}

/// Positions that were the nearest free ones to another position are free.
void PositionSearch::offer_known() {
  const std::array<BigRational, 3> from = frame_.origin();
  for (const auto& [x, facet] : probe_.free())
    offer(frame_.position({x[0] - from[0], x[1] - from[1], x[2] - from[2]}), facet, Known::free);
}

void PositionSearch::remember() {
  std::vector<DepthProbe::Free> free;
  for (std::size_t k = 0; k < result_.all.size(); ++k) free.push_back({frame_.absolute(result_.all[k]), facets_[k]});
  if (!free.empty()) probe_.remember({view_.from, bound_ - 4 * view_.slack}, std::move(free));
}

/// Determined by doubles: a "no" says nothing. What may be one of the positions found, as their facets list them too,
/// is not queried in vain.
bool PositionSearch::is_covered(Vec3 x, double off) {
  if (view_.cover(x, x, off, length(x) + off)) return true;
  const auto may_be = [&](Vec3 found) { return length(x - found) <= 2 * (off + view_.slack); };
  return !std::any_of(found_.begin(), found_.end(), may_be) && probe_.provably_overlaps(view_.from + x, off);
}

void PositionSearch::open(std::uint32_t id) {
  const spatial::BoxTree& tree = view_.o.tree;
  const spatial::BoxTree::Node& node = tree.node(id);
  const auto push = [&](const SearchItem& item) {
    if (!(item.lower > bound_)) queue_.push(item);
  };
  if (!node.leaf()) {
    for (const std::uint32_t child : {node.left, node.right})
      if (!inside_ || !view_.cover(tree.node(child).box, bound_))
        push({lower_bound(distance(tree.node(child).box, view_.from)), child, false});
    return;
  }
  for (std::uint32_t k = node.first; k < node.last; ++k) {
    const std::uint32_t f = tree.item(k);
    if (!inside_ || !view_.cover(tree.box(f), bound_)) push({lower_bound(length(view_.nearest(f))), f, true});
  }
}

void PositionSearch::look_at(std::uint32_t f) {
  if (inside_ && view_.cover(view_.o.tree.box(f), bound_)) return;  // the bound is better than when it was listed
  ++result_.work.facets;
  const Vec3 at = view_.nearest(f);
  ++result_.work.candidates;
  if (!inside_ || !is_covered(at, view_.slack)) {
    const ExactPosition x = frame_.nearest(view_.o.facets[f]);
    offer(x, f);
    // Nothing else of the facet is as near as that.
    if (!result_.all.empty() && compare_lengths(x, result_.all.front()) >= 0) return;
  }
  if (inside_) look_for_free(f);
}

void PositionSearch::look_for_free(std::uint32_t f) {
  const FacetCandidates candidates(view_, frame_, f, bound_ + view_.slack);
  for (const FacetCandidate& c : candidates.all()) {
    if (c.lower > bound_) return;
    ++result_.work.candidates;
    if (c.off < kVague && is_covered(c.at, c.off)) continue;
    if (const std::optional<ExactPosition> x = candidates.exact(c)) offer(*x);
  }
}

/// Whether a position is free. Where it is in the same cell as one that was free, no collision test is needed.
bool PositionSearch::is_free(const ExactPosition& x, std::uint32_t facet) {
  const std::array<BigRational, 3> at = frame_.absolute(x);
  if (facet != DepthProbe::kNoFacet) {
    const Vec3 seen = view_.o.scaled(at) - view_.from;
    for (const auto& [other, of] : probe_.free())
      if (of != DepthProbe::kNoFacet && in_one_plane(view_, frame_, facet, of) &&
          same_cell(view_, frame_, facet, view_.o.scaled(other) - view_.from, seen))
        return true;
  }
  ++result_.work.collision_tests;
  return !probe_.overlaps(at);
}

/// Takes a position that is as near as any, and free or of the sum.
void PositionSearch::offer(const ExactPosition& x, std::uint32_t facet, Known known) {
  ++result_.work.exact_tests;
  std::vector<ExactPosition>& all = result_.all;
  const int order = all.empty() ? -1 : compare_lengths(x, all.front());
  if (order > 0) return;
  if (order == 0 && std::any_of(all.begin(), all.end(), [&](const auto& y) { return same_position(x, y); })) return;
  if (inside_ && known == Known::nothing && !is_free(x, facet)) return;
  if (order < 0) all.clear(), found_.clear(), facets_.clear();
  all.push_back(x), facets_.push_back(facet);
  found_.push_back(view_.o.scaled(frame_.absolute(x)) - view_.from);
  bound_ = length(found_.front()) + view_.slack;
}

/// docs/design/penetration-depth.md, "The search". `inside`: whether the position lies in the open sum.
NearestPositions nearest_positions(const FacetView& view, const ExactFrame& frame, DepthProbe& probe, bool inside,
                                   double time_limit) {
  return PositionSearch(view, frame, probe, inside).run(time_limit);
}

}  // namespace
}  // namespace dymsum::depth

namespace dymsum {

// Depth and distance of two solids of any shape.

namespace {

using depth::DepthOperands;
using depth::DepthProbe;
using depth::ExactFrame;
using depth::FacetView;
using depth::RationalVector;
using exact::BigRational;
using spatial::Vec3;

RationalVector exact_vector(const RationalPoint3& v) {
  return {exact::exact_value(v.x), exact::exact_value(v.y), exact::exact_value(v.z)};
}
/// Requires finite coordinates.
RationalPoint3 fractions_of(const Point3& v) { return {*Rational::of(v.x), *Rational::of(v.y), *Rational::of(v.z)}; }

bool is_finite_vector(const Point3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

FacetView view_from(const DepthOperands& o, const RationalVector& at) {
  const Vec3 from = o.scaled(at);
  const double size = std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z), 1.0});
  return {o, from, size * 0x1p-32};
}

SolidDistance distance_with(const DepthOperands& o, std::vector<RationalVector> moves, const RationalVector& from,
                            bool overlapping) {
  SolidDistance result;
  const RationalVector& v = moves.front();
  const BigRational square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  // On what is tight inside of the sum they only touch.
  const bool touching = square == 0 && (!overlapping || o.results);
  result.meeting = touching ? Meeting::touching : overlapping ? Meeting::overlapping : Meeting::apart;
  result.squared = exact::to_rational(square);
  result.distance = exact::root_to_double(square);
  result.at_least = result.distance;
  result.ways = depth::ways_of(std::move(moves), from, o.touching.get());
  return result;
}

}  // namespace

bool operator==(const SolidDistance& a, const SolidDistance& b) {
  const auto same_sense = [](const SolidWay& x, const SolidWay& y) {
    return x.move == y.move && x.direction == y.direction && x.contacts == y.contacts;
  };
  return a.meeting == b.meeting && a.squared == b.squared && a.distance == b.distance && a.complete == b.complete &&
         a.at_least == b.at_least && std::equal(a.ways.begin(), a.ways.end(), b.ways.begin(), b.ways.end(), same_sense);
}

Result<SolidDepth> SolidDepth::create(const SpatialOperand& p, const SpatialOperand& q, const DepthOptions& options) {
  if (options.threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(options.threads), {}};
  Result<std::shared_ptr<const DepthOperands>> operands = depth::depth_operands(p, q, options);
  if (!operands) return operands.error();
  return SolidDepth(*std::move(operands));
}

SolidDepth::SolidDepth(std::shared_ptr<const DepthOperands> operands)
    : operands_(std::move(operands)), probe_(operands_->results ? nullptr : std::make_unique<DepthProbe>(*operands_)) {}
SolidDepth::SolidDepth(const SolidDepth& other) : SolidDepth(other.operands_) {}
SolidDepth& SolidDepth::operator=(const SolidDepth& other) { return *this = SolidDepth(other); }
SolidDepth::SolidDepth(SolidDepth&&) noexcept = default;
SolidDepth& SolidDepth::operator=(SolidDepth&&) noexcept = default;
SolidDepth::~SolidDepth() = default;

std::size_t SolidDepth::facet_count() const {
  return operands_->results ? operands_->results->faces() : operands_->facets.size();
}

SolidDistance SolidDepth::at(Point3 q_moved_by, double time_limit) {
  if (!is_finite_vector(q_moved_by)) throw std::invalid_argument("SolidDepth::at: the translation is not finite");
  return at(fractions_of(q_moved_by), time_limit);
}

template <std::same_as<RationalPoint3> Move>
SolidDistance SolidDepth::at(const Move& q_moved_by, double time_limit) {
  if (!(time_limit >= 0)) throw std::invalid_argument("SolidDepth::at: the time limit is below 0");
  const DepthOperands& o = *operands_;
  const RationalVector from = exact_vector(q_moved_by);
  if (o.results) return distance_with(o, o.results->nearest(from), from, o.results->overlaps(from));
  FacetView view = view_from(o, from);
  view.balls = probe_->balls();
  const bool overlapping = probe_->provably_overlaps(view.from, view.slack) || probe_->overlaps(from);
  if (o.engine == DepthEngine::boundary)
    return distance_with(o, depth::nearest_on_boundary(*o.sum, from), from, overlapping);
  const ExactFrame frame(o.p.vertices, o.q.vertices, o.exponent, from);
  // Of convex solids the nearest facet is the answer on both sides of it.
  const bool covers = overlapping && !o.convex;
  const depth::NearestPositions found = depth::nearest_positions(view, frame, *probe_, covers, time_limit);
  if (found.all.empty()) {
    SolidDistance result;
    result.meeting = overlapping ? Meeting::overlapping : Meeting::apart;
    result.complete = false;
    result.distance = std::ldexp(found.at_most, o.scale), result.at_least = std::ldexp(found.at_least, o.scale);
    result.work = found.work;
    return result;
  }
  std::vector<RationalVector> moves;
  for (const depth::ExactPosition& x : found.all) moves.push_back(frame.relative(x));
  SolidDistance result = distance_with(o, std::move(moves), from, overlapping);
  result.work = found.work;
  return result;
}

template SolidDistance SolidDepth::at(const RationalPoint3&, double);

Rational SolidDepth::along(Point3 q_moved_by, Point3 direction) {
  if (!is_finite_vector(q_moved_by) || !is_finite_vector(direction))
    throw std::invalid_argument("SolidDepth::along: wants finite vectors");
  return along(fractions_of(q_moved_by), fractions_of(direction));
}

template <std::same_as<RationalPoint3> Move>
Rational SolidDepth::along(const Move& q_moved_by, const Move& direction) {
  if (direction == RationalPoint3{}) throw std::invalid_argument("SolidDepth::along: wants a direction");
  const DepthOperands& o = *operands_;
  const RationalVector from = exact_vector(q_moved_by);
  if (o.results) return exact::to_rational(o.results->exit_along(from, exact_vector(direction)));
  if (!probe_->overlaps(from)) return 0;
  const ExactFrame frame(o.p.vertices, o.q.vertices, o.exponent, from);
  return exact::to_rational(depth::exit_along(view_from(o, from), frame, *probe_, exact_vector(direction), from));
}
template Rational SolidDepth::along(const RationalPoint3&, const RationalPoint3&);

}  // namespace dymsum
