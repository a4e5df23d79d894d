#include "dymsum/placement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "dymsum/orientation_sum.h"
#include "placement/open_sets.h"
#include "planar/position/exact_source.h"
#include "planar/shapes/disc_polygon.h"

namespace dymsum {
namespace {

using placement::HomogeneousPoint;
using placement::OpenSet;
using placement::OpenSets;

constexpr std::uint32_t kContainerId = 0;

/// A shape as it is given, unless it is turned; grown by the spacing where there is one.
struct Shape {
  Region region;
  std::optional<PlanarSum> turned, grown;
  PlanarOperand own() const { return turned ? PlanarOperand(*turned) : PlanarOperand(region); }
  PlanarOperand kept_clear() const { return grown ? PlanarOperand(*grown) : own(); }
};

struct Standing {
  std::uint32_t shape = 0;
  RationalPoint at;
  std::uint32_t id = 0;  // of its open sets: another one after each move
};

HomogeneousPoint homogeneous_of(const RationalPoint& p) {
  return exact::in_lowest_terms(planar::homogeneous({exact::exact_value(p.x), exact::exact_value(p.y)}));
}

Error no_index(const char* what, std::uint32_t index, std::size_t count) {
  return {ErrorCode::bad_index,
          std::string("there is no ") + what + " " + std::to_string(index) + " of " + std::to_string(count),
          {}};
}

}  // namespace

struct Placement::State {
  Region container;
  std::optional<PlanarSum> inner;  // the container less its margin
  std::optional<Region> spacing;
  std::vector<std::shared_ptr<const Shape>> shapes;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::shared_ptr<const OpenSet>> no_fits;  // placed, moving shape
  std::map<std::uint32_t, OpenSets> sets;                                                     // by the moving shape
  std::map<std::uint32_t, Standing> parts;                                                    // by their indices
  std::map<std::uint32_t, std::uint32_t> part_of;                                             // id -> index
  std::uint32_t next_part = 0, next_id = kContainerId + 1;

  Result<std::shared_ptr<const OpenSet>> no_fit(std::uint32_t placed, std::uint32_t moving) {
    auto& known = no_fits[{placed, moving}];
    if (known) return known;
    SumOptions open;
    open.semantics = Semantics::open;  // polylines that cross polylines do not overlap
    const Result<PlanarSum> sum = nfp(shapes[placed]->kept_clear(), shapes[moving]->own(), open);
    if (!sum) return sum.error();
    return known = OpenSet::inside(*sum);
  }

  Result<void> begin(OpenSets& own, std::uint32_t shape) {
    const Result<PlanarSum> fit = erode(inner ? PlanarOperand(*inner) : PlanarOperand(container), shapes[shape]->own());
    if (!fit) return fit.error();
    own.add(kContainerId, OpenSet::outside(*fit), {0, 0, 1});
    return {};
  }

  /// The open sets of a shape, with all that changed since they were used.
  Result<OpenSets*> current(std::uint32_t shape) {
    if (shape >= shapes.size()) return no_index("shape", shape, shapes.size());
    OpenSets& own = sets[shape];
    if (!own.contains(kContainerId))
      if (const Result<void> begun = begin(own, shape); !begun) return begun.error();
    for (const std::uint32_t id : own.ids())
      if (id != kContainerId && !part_of.contains(id)) own.remove(id);
    for (const auto& [index, part] : parts) {
      if (own.contains(part.id)) continue;
      const Result<std::shared_ptr<const OpenSet>> set = no_fit(part.shape, shape);
      if (!set) return set.error();
      own.add(part.id, *set, homogeneous_of(part.at));
    }
    return &own;
  }

  std::vector<std::uint32_t> parts_of(const std::vector<std::uint32_t>& ids) const {
    std::vector<std::uint32_t> indices;
    for (const std::uint32_t id : ids)
      indices.push_back(id == kContainerId ? CandidatePosition::kContainer : part_of.at(id));
    std::sort(indices.begin(), indices.end());
    return indices;
  }

  void stand(std::uint32_t index, std::uint32_t shape, const RationalPoint& at) {
    parts[index] = {shape, at, next_id};
    part_of[next_id++] = index;
  }
};

Placement::Placement(std::unique_ptr<State> state) : state_(std::move(state)) {}
Placement::Placement(const Placement& other) : state_(std::make_unique<State>(*other.state_)) {}
Placement& Placement::operator=(const Placement& other) {
  state_ = std::make_unique<State>(*other.state_);
  return *this;
}
Placement::Placement(Placement&&) noexcept = default;
Placement& Placement::operator=(Placement&&) noexcept = default;
Placement::~Placement() = default;

Result<Placement> Placement::create(const Region& container, const PlacementOptions& options) {
  auto state = std::make_unique<State>();
  state->container = container;
  Result<std::optional<Region>> spacing = planar::polygon_of_distance(options.spacing, "spacing");
  if (!spacing) return spacing.error();
  state->spacing = *std::move(spacing);
  const Result<std::optional<Region>> margin = planar::polygon_of_distance(options.margin, "margin");
  if (!margin) return margin.error();
  if (container.empty()) return Error{ErrorCode::unsupported_operand, "the container is empty", {}};
  if (!container.polylines().empty() || !container.points().empty())
    return Error{ErrorCode::unsupported_operand, "a container has no polylines and points", {}};
  if (*margin) {
    Result<PlanarSum> inner = erode(container, **margin);
    if (!inner) return inner.error();
    state->inner = *std::move(inner);
  }
  return Placement(std::move(state));
}

Result<std::uint32_t> Placement::add_shape(const Region& shape, const Orientation& orientation) {
  if (shape.empty()) return Error{ErrorCode::unsupported_operand, "a shape to be placed is empty", {}};
  auto made = std::make_shared<Shape>();
  made->region = shape;
  if (!(orientation == Orientation())) {
    const Result<Region> origin = Region::create({{}, {}, {Point{0, 0}}});
    Result<PlanarSum> turned = rotated_sum(shape, *origin, orientation);
    if (!turned) return turned.error();
    made->turned = *std::move(turned);
  }
  if (state_->spacing) {
    Result<PlanarSum> grown = minkowski_sum(made->own(), *state_->spacing);
    if (!grown) return grown.error();
    made->grown = *std::move(grown);
  }
  state_->shapes.push_back(std::move(made));
  return static_cast<std::uint32_t>(state_->shapes.size() - 1);
}

std::size_t Placement::shape_count() const { return state_->shapes.size(); }

Result<FeasiblePositions> Placement::feasible(std::uint32_t shape) {
  const Result<OpenSets*> sets = state_->current(shape);
  if (!sets) return sets.error();
  placement::FreeSet free = (*sets)->free();
  FeasiblePositions out;
  for (placement::SetVertex& v : free.vertices)
    out.candidates.push_back({static_cast<CandidatePosition::Kind>(v.of), v.vertex, state_->parts_of(v.touches)});
  out.set = std::move(free.set);
  return out;
}

Result<bool> Placement::is_free(std::uint32_t shape, const RationalPoint& at) {
  const Result<OpenSets*> sets = state_->current(shape);
  if (!sets) return sets.error();
  return (*sets)->holding(homogeneous_of(at)).empty();
}

Result<std::optional<Point>> Placement::free_beside(std::uint32_t shape, const RationalPoint& at, double grid) {
  if (!(grid > 0 && std::isfinite(grid) && std::ldexp(1.0, std::ilogb(grid)) == grid))
    return Error{ErrorCode::out_of_range, "the grid must be a power of two", {}};
  const Result<OpenSets*> sets = state_->current(shape);
  if (!sets) return sets.error();
  const double x = std::floor(at.x.to_double() / grid), y = std::floor(at.y.to_double() / grid);
  // The corners of the grid's square first, then those around it.
  constexpr int kOffsets[] = {0, 1, -1, 2, -2, 3};
  for (int reach = 2; reach <= 6; reach += 2)
    for (int i = 0; i < reach; ++i)
      for (int j = 0; j < reach; ++j) {
        if (std::max(i, j) < reach - 2) continue;
        const Point p{grid * (x + kOffsets[i]), grid * (y + kOffsets[j])};
        if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
        if ((*sets)->holding(exact::homogeneous(p.x, p.y)).empty()) return std::optional(p);
      }
  return std::optional<Point>();
}

Result<std::uint32_t> Placement::add_part(std::uint32_t shape, const RationalPoint& at) {
  if (shape >= state_->shapes.size()) return no_index("shape", shape, state_->shapes.size());
  state_->stand(state_->next_part, shape, at);
  return state_->next_part++;
}

Result<void> Placement::move_part(std::uint32_t part, const RationalPoint& at) {
  const auto it = state_->parts.find(part);
  if (it == state_->parts.end()) return no_index("part", part, state_->next_part);
  if (it->second.at == at) return {};
  state_->part_of.erase(it->second.id);
  state_->stand(part, it->second.shape, at);
  return {};
}

Result<void> Placement::remove_part(std::uint32_t part) {
  const auto it = state_->parts.find(part);
  if (it == state_->parts.end()) return no_index("part", part, state_->next_part);
  state_->part_of.erase(it->second.id);
  state_->parts.erase(it);
  return {};
}

std::vector<PlacedPart> Placement::parts() const {
  std::vector<PlacedPart> parts;
  for (const auto& [index, part] : state_->parts) parts.push_back({index, part.shape, part.at});
  return parts;
}

}  // namespace dymsum
