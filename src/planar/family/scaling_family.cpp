#include "dymsum/scaling_family.h"

#include <algorithm>
#include <utility>

#include "base/stopwatch.h"
#include "base/within_memory.h"
#include "dymsum/planar_operand.h"
#include "planar/family/family_state.h"
#include "planar/family/swept_sets.h"

namespace dymsum {

using namespace planar;
using exact::BigRational;

ScalingFamily::ScalingFamily(std::unique_ptr<const State> state) : state_(std::move(state)) {}
ScalingFamily::ScalingFamily(ScalingFamily&&) noexcept = default;
ScalingFamily& ScalingFamily::operator=(ScalingFamily&&) noexcept = default;
ScalingFamily::~ScalingFamily() = default;

namespace {

/// The options that queries need: a progress is of the making alone.
FamilyOptions at_rest(FamilyOptions options) {
  options.progress = {};
  return options;
}

}  // namespace

Result<ScalingFamily> ScalingFamily::create(const Region& p, const Region& q, const Scale& low, const Scale& high,
                                            const FamilyOptions& options) {
  return create(p, q, low, high, Scale(), options);
}

Result<ScalingFamily> ScalingFamily::create(const Region& p, const Region& q, const Scale& low, const Scale& high,
                                            const Scale& ratio, const FamilyOptions& options) {
  const Stopwatch watch;
  if (std::optional<Error> error = empty_interval(low, high)) return *std::move(error);
  Result<ScalingCells> cells = base::within_memory(options.memory, "the family of sums",
                                                   [&] { return scaling_cells(p, q, low, high, ratio, options); });
  if (!cells) return cells.error();
  FamilyWork work = work_of(*cells);
  work.ms = watch.ms();
  return ScalingFamily(
      std::make_unique<State>(State{p, q, low, high, ratio, at_rest(options), *std::move(cells), work}));
}

const Region& ScalingFamily::p() const { return state_->p; }
const Region& ScalingFamily::q() const { return state_->q; }
const FamilyOptions& ScalingFamily::options() const { return state_->options; }
const Scale& ScalingFamily::low() const { return state_->low; }
const Scale& ScalingFamily::high() const { return state_->high; }
const Scale& ScalingFamily::ratio() const { return state_->ratio; }
const std::vector<ScaleEvent>& ScalingFamily::events() const { return state_->cells.events; }
const FamilyWork& ScalingFamily::work() const { return state_->work; }

ScalingFamily::Location ScalingFamily::locate(const Scale& s) const {
  const auto [index, event] = state_->cells.locate(s);
  return {index, event};
}

Result<PlanarSum> ScalingFamily::at(const Scale& s) const {
  if (std::optional<Error> error = state_->outside(s)) return *std::move(error);
  return state_->cells.at(s, state_->options.semantics);
}

std::vector<ScaleEvent> ScalingFamily::changes(const Scale& a, const Scale& b, EventChange change) const {
  const BigRational low = value_of(a), high = value_of(b);
  std::vector<ScaleEvent> found;
  for (const ScaleEvent& e : events()) {
    if (!(change == EventChange::topology ? e.topology : e.visible)) continue;
    if (const BigRational at = exact::exact_value(e.parameter); at >= low && at <= high) found.push_back(e);
  }
  return found;
}

std::optional<ScaleEvent> ScalingFamily::next(const Scale& s, EventChange change) const {
  const auto [index, event] = state_->cells.locate(s);
  for (std::size_t k = event ? index + std::size_t{1} : index; k < events().size(); ++k)
    if (change == EventChange::topology ? events()[k].topology : events()[k].visible) return events()[k];
  return std::nullopt;
}

Result<std::vector<Lifetime>> ScalingFamily::lifetimes() const {
  if (std::optional<Error> error = state_->not_all_kept("lifetimes")) return *std::move(error);
  return lifetimes_of(state_->cells.structures);
}

Result<PlanarSum> ScalingFamily::outer(const Scale& a, const Scale& b) const {
  if (std::optional<Error> error = state_->outside(a, b)) return *std::move(error);
  const FamilyOptions& options = state_->options;
  const bool p_moves = options.moving == MovingOperand::p;
  const Result<PlanarSum> swept =
      swept_region(p_moves ? state_->p : state_->q, {{}, scale_value(state_->ratio)}, value_of(a), value_of(b));
  if (!swept) return swept;
  SumOptions sum;
  sum.semantics = options.semantics;
  const PlanarOperand p = p_moves ? PlanarOperand(*swept) : PlanarOperand(state_->p),
                      q = p_moves ? PlanarOperand(state_->q) : PlanarOperand(*swept);
  return options.reflect_q ? nfp(p, q, sum) : minkowski_sum(p, q, sum);
}

Result<PlanarSum> ScalingFamily::inner(const Scale& a, const Scale& b) const {
  if (std::optional<Error> error = state_->outside(a, b)) return *std::move(error);
  if (std::optional<Error> error = state_->not_all_kept("common sets")) return *std::move(error);
  const Result<PlanarSum> first = at(a);
  if (!first) return first;
  const BigRational unit = state_->cells.unit;
  return common_set(state_->cells, *first, value_of(a) * unit, value_of(b) * unit);
}

}  // namespace dymsum
