#include "planar/family/scaling_cells.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "planar/result/part_nesting.h"
#include "planar/sum/placed_sum.h"

namespace dymsum::planar {

using exact::BigRational;

namespace {

MovingOptions moving_options(const FamilyOptions& options) {
  MovingOptions moving;
  moving.moving = options.moving;
  moving.reflect_q = options.reflect_q;
  moving.semantics = options.semantics;
  return moving;
}

/// Exact positions at a scale, placed when first requested.
class PathSource final : public ExactSource {
 public:
  PathSource(std::shared_ptr<const OperandPair> base, const Scale& t) : base_(std::move(base)), t_(t) {}
  Position position(const SumVertex& v) const override { return frame().position(v); }
  Homogeneous homogeneous(const SumVertex& v) const override { return frame().homogeneous(v); }
  std::optional<NearFrame> near_frame() const override { return frame().near_frame(); }
  NearPosition near(const SumVertex& v) const override { return frame().near(v); }
  int compare_x(const SumVertex& a, const SumVertex& b) const override { return frame().compare_x(a, b); }
  int compare_y(const SumVertex& a, const SumVertex& b) const override { return frame().compare_y(a, b); }

 private:
  const FrameSource& frame() const {
    std::call_once(made_,
                   [this] { frame_ = std::make_unique<FrameSource>(base_, base_->lattice_scale(scale_value(t_))); });
    return *frame_;
  }

  std::shared_ptr<const OperandPair> base_;
  Scale t_;
  mutable std::once_flag made_;
  mutable std::unique_ptr<const FrameSource> frame_;
};

/// Takes over events, and the structure of the sum after each.
class CellVisitor final : public EventVisitor {
 public:
  explicit CellVisitor(ScalingCells& cells) : cells_(cells) {}

  void before_events(const ScalingState& before) override { add(before); }
  bool passes(const ScaleEvent& event, const ScalingState& after) override {
    ScaleEvent own = event;
    if (!cells_.unit_is_one) {
      const BigRational s = exact::exact_value(event.parameter) / cells_.unit;
      own.parameter = exact::to_rational(s);
      own.approx = exact::round_to_double(s);
    }
    cells_.events.push_back(own);
    add(after);
    return true;
  }
  void add(const ScalingState& state) {
    cells_.add_cell(state.sum, state.ring_ids, std::max(state.scale.approx(), state.scale_y.approx()));
  }

 private:
  ScalingCells& cells_;
};

/// diag(x, y) with y = ratio x, as the path that windows can serve.
Result<ScalingCells> cells_along(std::shared_ptr<const OperandPair> base, const Scale& ratio,
                                 const FamilyOptions& options) {
  ScalingCells cells{{base, base, {}}, 1, true, {}, SumStructures(options.structure_bytes), {}, nullptr};
  const BigRational r = rational(scale_value(ratio));
  if (r != 1) {
    const Factors factors = factors_of({}, scale_value(r));
    RatioSweeps sweeps;
    const RatioSweep* sweep = sweeps.make(*base, factors);
    if (sweep == nullptr)
      return Error{
          ErrorCode::bad_scale, "the ratio " + ratio.exact().to_string() + " is not between 2^-32 and 2^32", {}};
    cells.path.swept = sweep->base;
    cells.path.factors = factors;
    cells.unit_is_one = r < 1;
    if (r > 1) cells.unit = r;
  }
  cells.positions = std::make_unique<ScaledPositions>(cells.path.swept);
  return cells;
}

}  // namespace

Result<ScalingCells> empty_cells(const Region& p, const Region& q, const Scale& ratio, const FamilyOptions& options) {
  Result<std::shared_ptr<const OperandPair>> base = pair_of_regions(p, q, moving_options(options));
  if (!base) return base.error();
  if (std::optional<Error> error = without_events(**base)) return *std::move(error);
  return cells_along(*base, ratio, options);
}

Result<ScalingCells> scaling_cells(const Region& p, const Region& q, const Scale& low, const Scale& high,
                                   const Scale& ratio, const FamilyOptions& options) {
  const MovingOptions moving = moving_options(options);
  Result<ScalingCells> made = empty_cells(p, q, ratio, options);
  if (!made) return made;
  ScalingCells cells = *std::move(made);
  const BigRational from = rational(scale_value(low)) * cells.unit, to = rational(scale_value(high)) * cells.unit;
  const Result<std::array<Scale, 2>> first = cells.scales(from), last = cells.scales(to);
  if (!first) return first.error();
  if (!last) return last.error();
  CellVisitor visitor(cells);
  const Result<void> done = walk_events(cells.path, moving, from, to, options.progress, visitor);
  if (!done) return done.error();
  if (cells.events.empty()) {
    ScalingState state(cells.path.given, moving);
    const Result<FrameChanges> moved = state.begin([&] { return state.move_to((*first)[0], (*first)[1]); });
    if (!moved) return moved.error();
    visitor.add(state);
  }
  return cells;
}

void ScalingCells::add_cell(const PlanarSum& sum, std::span<const std::uint64_t> rings, double at) {
  const std::uint32_t first = structures.add(sum, rings);
  positions->add(std::span(structures.names()).subspan(first), at);
  named_at.push_back(at);
}

void ScalingCells::add_dropped_cell() {
  structures.add_dropped();
  named_at.push_back(0);
}

Result<std::array<Scale, 2>> ScalingCells::scales(const BigRational& t) const {
  const auto times = [&](const ScaleValue& factor) {
    return Scale::of(exact::to_rational(BigRational(t * rational(factor))));
  };
  const Result<Scale> x = times(path.factors.x), y = times(path.factors.y);
  if (!x) return x.error();
  if (!y) return y.error();
  return std::array<Scale, 2>{*x, *y};
}

// Rounding is monotone: doubles that differ are in the order of the scales.
ScalingCells::Location ScalingCells::locate(const Scale& s) const {
  const auto before = [&](const ScaleEvent& e, double at) { return e.approx < at; };
  auto at = std::lower_bound(events.begin(), events.end(), s.approx(), before);
  for (; at != events.end() && at->approx == s.approx(); ++at) {
    if (at->parameter == s.exact()) return {static_cast<std::uint32_t>(at - events.begin()), true};
    if (exact::exact_value(at->parameter) > rational(scale_value(s))) break;
  }
  return {static_cast<std::uint32_t>(at - events.begin()), false};
}

Scale ScalingCells::of_path(const Scale& s) const {
  return unit_is_one ? s : Scale::of(exact::to_rational(BigRational(rational(scale_value(s)) * unit))).value();
}

Result<PlanarSum> ScalingCells::at(const Scale& s, Semantics semantics) const {
  const Location location = locate(s);
  if (location.event || !structures.kept(location.index)) return from_scratch(s, semantics);
  return in_cell(location.index, s);
}

Result<PlanarSum> ScalingCells::from_scratch(const Scale& s, Semantics semantics) const {
  const BigRational t = rational(scale_value(of_path(s)));
  SumOptions options;
  options.semantics = semantics;
  const Result<std::array<Scale, 2>> at = scales(t);
  if (!at) return at.error();
  const LatticeScale scale = path.given->lattice_scale(scale_value((*at)[0]), scale_value((*at)[1]));
  return placed_sum(path.given->placed(scale), options);
}

PlanarSum ScalingCells::in_cell(std::uint32_t cell, const Scale& s) const {
  const Scale along = of_path(s);
  const double t = along.approx();
  PlanarSum sum;
  const auto source = std::make_shared<PathSource>(path.swept, along);
  exact_source(sum) = source;
  const auto put = [&](std::uint32_t name, SumVertex& to) {
    to = structures.names()[name];
    const double error = positions->put(name, t, to);
    if (error < INFINITY) return error;
    const ExactSource::Position at = source->position(to);
    to.at = {exact::round_to_double(at.x), exact::round_to_double(at.y)};
    return exact::kRoundoff * std::max(std::abs(to.at.x), std::abs(to.at.y)) + exact::kSubnormal;
  };
  structures.write(cell, put, sum);
  canonicalize(sum.parts, *source, sum.at_error);
  canonicalize(sum.segments, *source, sum.at_error);
  canonicalize(sum.points, *source, sum.at_error);
  canonicalize(sum.tight_segments, *source, sum.at_error);
  canonicalize(sum.tight_points, *source, sum.at_error);
  sum.stats.tier_bits = path.swept->lattice->tier_bits;
  return sum;
}

}  // namespace dymsum::planar
