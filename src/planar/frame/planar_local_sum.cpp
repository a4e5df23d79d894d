// The public class: one position after the other.
#include "planar/frame/planar_local_sum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "base/double_text.h"
#include "base/memory_budget.h"
#include "base/poll.h"
#include "dymsum/planar_local_sum.h"
#include "planar/frame/local_edges.h"
#include "planar/frame/near_segments.h"
#include "planar/operand/operand.h"

namespace dymsum {

using namespace planar;

namespace {

double disc_end(double centre, double radius, double towards) {
  const double rounded = centre + radius;
  if (!std::isfinite(rounded)) return std::copysign(std::numeric_limits<double>::max(), towards);
  const exact::BigRational end = exact::exact_value(centre) + exact::exact_value(radius);
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

}  // namespace

PlanarBox bounding_box(const PlanarDisc& disc) {
  constexpr double kUp = std::numeric_limits<double>::infinity();
  const Point m = disc.centre;
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
      if (options_.progress && !options_.progress(stage, 0)) return cancelled();
    return base::within_memory(budget_, "the part of the sum", [&]() -> Result<PlanarLocalPart> {
      make(box, disc, poses, part);
      part.work.ms = watch.ms();
      return std::move(part);
    });
  }

 private:
  void make(const PlanarBox& box, const PlanarDisc* disc, const PosePair& poses, PlanarLocalPart& part) {
    std::vector<Point> positions{box.low, box.high};
    if (disc != nullptr) positions.push_back(disc->centre);
    const double extent = std::ldexp(1.0, PosedRegions(*p_, *q_, poses, {}).scale());
    const PlanarBox reach = larger_box(box, extent);
    positions.push_back(reach.low), positions.push_back(reach.high);
    const PosedRegions posed(*p_, *q_, poses, positions);
    prepare(poses);
    const LocalWalls walls(posed, box, reach);
    const LocalNodes nodes(posed, walls, segments(posed, poses, walls, part.work));
    part.work.segments = nodes.segment_count();
    overlap_.clear_counts();
    const Linking linking = options_.engine == LocalEngine::brute ? Linking::none : Linking::patches;
    part.positions_ = assemble_part(nodes, local_edges(nodes, overlap_, linking), disc, part);
    if (!part.vertices.empty()) part.where = PlanarLocalPart::Where::crossed;
    else if (centre_inside(posed, box, disc)) part.where = PlanarLocalPart::Where::inside;
    part.work.collision_tests = overlap_.tests(), part.work.exact_tests = overlap_.exact_tests();
  }

  bool centre_inside(const PosedRegions& posed, const PlanarBox& box, const PlanarDisc* disc) {
    const BigPoint a = posed.exact(disc != nullptr ? disc->centre : box.low),
                   b = posed.exact(disc != nullptr ? disc->centre : box.high);
    const BigPosition centre{a.x + b.x, a.y + b.y, Big::from_int64(2)};
    const Point rounded = posed.scaled(centre);
    return overlap_.holds(posed, {std::clamp(rounded.x, -4.0, 4.0), std::clamp(rounded.y, -4.0, 4.0),
                                  PosedRegions::kOff, [&] { return centre; }});
  }

  /// Directions depend on the ratios of scales.
  void prepare(const PosePair& poses) {
    const auto ratio = [](const PlanarPose& pose) { return pose.scale[0].exact() / pose.scale[1].exact(); };
    const std::array<Rational, 2> ratios{ratio(poses[0]), ratio(poses[1])};
    if (near_ && ratios == ratios_) return;
    near_.emplace(*p_, *q_, std::array<Point, 2>{factor_of(poses[0]), factor_of(poses[1])});
    ratios_ = ratios;
  }

  /// The order of the segments does not depend on how they were found.
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
  if (options.progress && !options.progress("operands", 0)) return cancelled();
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
  if (!is_finite_point(disc.centre) || !std::isfinite(disc.radius))
    return Error{ErrorCode::not_finite, "the disc is not finite", {}};
  if (!(disc.radius > 0))
    return Error{ErrorCode::out_of_range, "the radius must be positive, not " + base::general_text(disc.radius, 6), {}};
  return state_->in(bounding_box(disc), &disc, {p, q});
}

}  // namespace dymsum

namespace dymsum::planar {

namespace {

using exact::BigRational;

struct RationalVertex {
  BigRational x, y;
};

RationalVertex value_of(const LocalNodes& nodes, std::uint32_t n) {
  const LocalUnit& unit = nodes.posed().unit();
  const BigPosition& at = nodes.exact(n);
  return {unit.value(at.x, at.w), unit.value(at.y, at.w)};
}

/// Whether the closed disc meets the segment between two nodes, or the one node.
bool meets(const PlanarDisc& disc, const LocalNodes& nodes, std::uint32_t from, std::uint32_t to) {
  const RationalVertex m{exact::exact_value(disc.centre.x), exact::exact_value(disc.centre.y)};
  const RationalVertex a = value_of(nodes, from), b = value_of(nodes, to);
  const BigRational dx = b.x - a.x, dy = b.y - a.y, size = dx * dx + dy * dy;
  BigRational t = 0;
  if (size > 0) t = ((m.x - a.x) * dx + (m.y - a.y) * dy) / size;
  if (t < 0) t = 0;
  if (t > 1) t = 1;
  const BigRational x = a.x + t * dx - m.x, y = a.y + t * dy - m.y, r = exact::exact_value(disc.radius);
  return x * x + y * y <= r * r;
}

void keep_in_disc(const PlanarDisc& disc, const LocalNodes& nodes, LocalEdges& edges) {
  const auto off = [&](const LocalEdge& e) { return !meets(disc, nodes, e.from, e.to); };
  std::erase_if(edges.boundary, off), std::erase_if(edges.tight, off);
  std::erase_if(edges.tight_points, [&](std::uint32_t n) { return !meets(disc, nodes, n, n); });
}

/// Those that occur, by x, then y.
std::vector<std::uint32_t> sorted_nodes(const LocalNodes& nodes, const LocalEdges& edges) {
  std::vector<std::uint32_t> used = edges.tight_points;
  for (const std::vector<LocalEdge>* list : {&edges.boundary, &edges.tight})
    for (const LocalEdge& e : *list) used.push_back(e.from), used.push_back(e.to);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::sort(used.begin(), used.end(), [&](std::uint32_t m, std::uint32_t n) {
    const int x = compare(nodes.exact(m), nodes.exact(n), 0);
    return x != 0 ? x < 0 : compare(nodes.exact(m), nodes.exact(n), 1) < 0;
  });
  return used;
}

std::vector<PlanarLocalPart::Edge> named(const LocalNodes& nodes, const std::vector<LocalEdge>& edges,
                                         const std::map<std::uint32_t, std::uint32_t>& index) {
  std::vector<PlanarLocalPart::Edge> list;
  const PosedRegions& posed = nodes.posed();
  for (const LocalEdge& e : edges)
    list.push_back(
        {index.at(e.from), index.at(e.to), contact_of(nodes.segment(e.segment), posed.operand(0), posed.operand(1))});
  std::sort(list.begin(), list.end(),
            [](const auto& a, const auto& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
  return list;
}

}  // namespace

std::shared_ptr<const PlanarLocalPart::Positions> assemble_part(const LocalNodes& nodes, LocalEdges edges,
                                                                const PlanarDisc* disc, PlanarLocalPart& part) {
  edges.boundary = joined(nodes, std::move(edges.boundary));
  edges.tight = joined(nodes, std::move(edges.tight));
  if (disc != nullptr) keep_in_disc(*disc, nodes, edges);
  auto positions = std::make_shared<PlanarLocalPart::Positions>();
  positions->unit = nodes.posed().unit();
  std::map<std::uint32_t, std::uint32_t> index;
  for (const std::uint32_t n : sorted_nodes(nodes, edges)) {
    index[n] = static_cast<std::uint32_t>(part.vertices.size());
    const BigPosition& at = nodes.exact(n);
    part.vertices.push_back({positions->unit.rounded(at.x, at.w), positions->unit.rounded(at.y, at.w)});
    positions->at.push_back(at);
  }
  part.edges = named(nodes, edges.boundary, index);
  part.tight_segments = named(nodes, edges.tight, index);
  for (const std::uint32_t n : edges.tight_points) part.tight_points.push_back(index.at(n));
  std::sort(part.tight_points.begin(), part.tight_points.end());
  return positions;
}

}  // namespace dymsum::planar

namespace dymsum {

RationalPoint PlanarLocalPart::exact(std::uint32_t vertex) const {
  if (vertex >= vertices.size()) throw std::out_of_range("PlanarLocalPart::exact: no vertex has this index");
  return positions_->unit.point(positions_->at[vertex]);
}

bool operator==(const PlanarLocalPart& a, const PlanarLocalPart& b) {
  const auto same_edge = [](const PlanarLocalPart::Edge& e, const PlanarLocalPart::Edge& f) {
    return e.from == f.from && e.to == f.to;
  };
  if (a.where != b.where || a.vertices != b.vertices || a.tight_points != b.tight_points ||
      !std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end(), same_edge) ||
      !std::equal(a.tight_segments.begin(), a.tight_segments.end(), b.tight_segments.begin(), b.tight_segments.end(),
                  same_edge))
    return false;
  for (std::uint32_t k = 0; k < a.vertices.size(); ++k)
    if (!(a.exact(k) == b.exact(k))) return false;
  return true;
}

}  // namespace dymsum
