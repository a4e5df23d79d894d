// The public class: one place after the other.
#include "dymsum/planar_local_sum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "base/stopwatch.h"
#include "base/within_memory.h"
#include "planar/local/local_overlap.h"
#include "planar/local/local_part.h"
#include "planar/local/near_segments.h"
#include "planar/operand/prepared_region.h"

namespace dymsum {

using namespace planar;

namespace {

double disc_end(double middle, double radius, double towards) {
  const double rounded = middle + radius;
  if (!std::isfinite(rounded)) return std::copysign(std::numeric_limits<double>::max(), towards);
  const exact::BigRational end = exact::exact_value(middle) + exact::exact_value(radius);
  const bool inside = towards > 0 ? exact::exact_value(rounded) < end : exact::exact_value(rounded) > end;
  return inside ? std::nextafter(rounded, towards) : rounded;
}

bool is_finite_point(Point v) { return std::isfinite(v.x) && std::isfinite(v.y); }

std::optional<Error> clip_error(const PlanarBox& box) {
  if (!is_finite_point(box.low) || !is_finite_point(box.high))
    return Error{ErrorCode::not_finite, "a corner of the box is not finite", {}};
  if (!(box.low.x < box.high.x && box.low.y < box.high.y))
    return Error{ErrorCode::out_of_range, "the box has no extent along an axis", {}};
  return std::nullopt;
}

std::optional<Error> local_operand_error(const Region& region, const Operand& operand) {
  if (!region.polylines().empty() || !region.points().empty())
    return Error{ErrorCode::unsupported_operand, "an operand of a local sum has parts without area", {}};
  return too_large(operand);
}

/// Questions to the overlap test about nodes and what lies half-way between two.
class LocalAsking {
 public:
  LocalAsking(const PosedRegions& posed, LocalOverlap& overlap) : posed_(posed), overlap_(overlap) {}

  LocalQuestions about(const LocalNodes& nodes) {
    const auto at_node = [this, &nodes](std::uint32_t n) {
      const LocalNode& node = nodes.node(n);
      return overlap_.holds(posed_, {node.x, node.y, node.off, [&]() -> const BigPlace& { return nodes.exact(n); }});
    };
    const auto halfway_of = [this, &nodes](std::uint32_t m, std::uint32_t n) {
      const LocalNode &a = nodes.node(m), &b = nodes.node(n);
      return at({(a.x + b.x) / 2, (a.y + b.y) / 2}, std::max(a.off, b.off) + PosedRegions::kOff,
                [&] { return halfway(nodes.exact(m), nodes.exact(n)); });
    };
    return {at_node, halfway_of};
  }

  bool middle_inside(const PlanarBox& box, const PlanarDisc* disc) {
    const Point low = disc != nullptr ? disc->middle : box.low, high = disc != nullptr ? disc->middle : box.high;
    const BigPoint a = posed_.exact(low), b = posed_.exact(high);
    const BigPlace middle{a.x + b.x, a.y + b.y, Big::from_int64(2)};
    const Point rounded = posed_.scaled(middle);
    return at({std::clamp(rounded.x, -4.0, 4.0), std::clamp(rounded.y, -4.0, 4.0)}, PosedRegions::kOff,
              [&] { return middle; });
  }

 private:
  template <class F>
  bool at(Point place, double off, F make) {
    std::optional<BigPlace> made;
    return overlap_.holds(posed_, {place.x, place.y, off, [&]() -> const BigPlace& {
                                     if (!made) made = make();
                                     return *made;
                                   }});
  }
  const PosedRegions& posed_;
  LocalOverlap& overlap_;
};

}  // namespace

PlanarBox bounding_box(const PlanarDisc& disc) {
  constexpr double kUp = std::numeric_limits<double>::infinity();
  const Point m = disc.middle;
  const double r = disc.radius;
  return {{disc_end(m.x, -r, -kUp), disc_end(m.y, -r, -kUp)}, {disc_end(m.x, r, kUp), disc_end(m.y, r, kUp)}};
}

class PlanarLocalSum::State {
 public:
  State(std::shared_ptr<const Operand> p, std::shared_ptr<const Operand> q, PlanarLocalOptions options)
      : p_(std::move(p)), q_(std::move(q)), options_(std::move(options)), overlap_(*p_, *q_) {}

  Result<PlanarLocalPart> in(const PlanarBox& box, const PlanarDisc* disc, const PosePair& poses) {
    const Stopwatch watch;
    if (std::optional<Error> error = clip_error(box)) return *std::move(error);
    PlanarLocalPart part;
    part.box = box;
    if (p_->size() == 0 || q_->size() == 0) return part;
    for (const char* stage : {"segments", "arrangement", "boundary"})
      if (options_.progress && !options_.progress(stage, 0))
        return Error{ErrorCode::cancelled, "the computation was cancelled", {}};
    return base::within_memory(budget_, "the part of the sum", [&]() -> Result<PlanarLocalPart> {
      make(box, disc, poses, part);
      part.work.ms = watch.ms();
      return std::move(part);
    });
  }

 private:
  void make(const PlanarBox& box, const PlanarDisc* disc, const PosePair& poses, PlanarLocalPart& part) {
    std::vector<Point> places{box.low, box.high};
    if (disc != nullptr) places.push_back(disc->middle);
    const double extent = std::ldexp(1.0, PosedRegions(*p_, *q_, poses, {}).scale());
    const PlanarBox reach = larger_box(box, extent);
    places.push_back(reach.low), places.push_back(reach.high);
    const PosedRegions posed(*p_, *q_, poses, places);
    prepare(poses);
    const LocalWalls walls(posed, box, reach);
    const LocalNodes nodes(posed, walls, segments(posed, poses, walls, part.work));
    part.work.segments = nodes.segment_count();
    overlap_.clear_counts();
    LocalAsking asking(posed, overlap_);
    const Linking linking = options_.engine == LocalEngine::brute ? Linking::none : Linking::patches;
    part.positions_ = assemble_part(nodes, local_edges(nodes, asking.about(nodes), linking), disc, part);
    if (!part.vertices.empty()) part.where = PlanarLocalPart::Where::crossed;
    else if (asking.middle_inside(box, disc)) part.where = PlanarLocalPart::Where::inside;
    part.work.collision_tests = overlap_.tests(), part.work.exact_tests = overlap_.exact_tests();
  }

  /// Directions depend on the ratios of scales.
  void prepare(const PosePair& poses) {
    const auto ratio = [](const PlanarPose& pose) { return pose.scale[0].exact() / pose.scale[1].exact(); };
    const std::array<Rational, 2> ratios{ratio(poses[0]), ratio(poses[1])};
    if (near_ && ratios == ratios_) return;
    near_.emplace(*p_, *q_, std::array<Point, 2>{stretch_of(poses[0]), stretch_of(poses[1])});
    ratios_ = ratios;
  }

  /// In an order that does not depend on how they were found.
  base::CountedArray<WalkSegment> segments(const PosedRegions& posed, const PosePair& poses, const LocalWalls& walls,
                                           PlanarLocalPart::Work& work) {
    work.rebuilt = true;
    base::CountedArray<WalkSegment> found;
    if (options_.engine == LocalEngine::brute) {
      found = near_->all(posed);
      work.pairs = p_->size() * q_->size();
    } else {
      found = options_.engine == LocalEngine::updated ? near_->update(posed, poses, walls.reach())
                                                      : near_->find(posed, walls.reach());
      work.rebuilt = near_->rebuilt(), work.pairs = near_->pairs();
    }
    std::sort(found.begin(), found.end(), [](const WalkSegment& a, const WalkSegment& b) {
      return std::tie(a.side, a.edge, a.vertex) < std::tie(b.side, b.edge, b.vertex);
    });
    return found;
  }

  std::shared_ptr<const Operand> p_, q_;
  PlanarLocalOptions options_;
  const std::shared_ptr<base::MemoryBudget> budget_ = base::budget_of(options_.memory);
  std::optional<NearSegments> near_;
  std::array<Rational, 2> ratios_;
  LocalOverlap overlap_;
};

Result<PlanarLocalSum> PlanarLocalSum::create(const Region& p, const Region& q, const PlanarLocalOptions& options) {
  auto p_operand = prepared_operand(p, 0), q_operand = prepared_operand(q, 1);
  if (std::optional<Error> error = local_operand_error(p, *p_operand)) return *std::move(error);
  if (std::optional<Error> error = local_operand_error(q, *q_operand)) return *std::move(error);
  if (options.progress && !options.progress("operands", 0))
    return Error{ErrorCode::cancelled, "the computation was cancelled", {}};
  return PlanarLocalSum(std::make_unique<State>(std::move(p_operand), std::move(q_operand), options));
}

PlanarLocalSum::PlanarLocalSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
PlanarLocalSum::PlanarLocalSum(PlanarLocalSum&&) noexcept = default;
PlanarLocalSum& PlanarLocalSum::operator=(PlanarLocalSum&&) noexcept = default;
PlanarLocalSum::~PlanarLocalSum() = default;

Result<PlanarLocalPart> PlanarLocalSum::in(const PlanarBox& box, const PlanarPose& p, const PlanarPose& q) {
  return state_->in(box, nullptr, {p, q});
}

Result<PlanarLocalPart> PlanarLocalSum::in(const PlanarDisc& disc, const PlanarPose& p, const PlanarPose& q) {
  if (!is_finite_point(disc.middle) || !std::isfinite(disc.radius))
    return Error{ErrorCode::not_finite, "the disc is not finite", {}};
  if (!(disc.radius > 0)) return Error{ErrorCode::out_of_range, "the radius has to be positive", {}};
  return state_->in(bounding_box(disc), &disc, {p, q});
}

}  // namespace dymsum
