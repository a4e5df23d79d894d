#include "dymsum/solid_scaling_family.h"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "base/poll.h"
#include "dymsum/convex_sum.h"
#include "exact/big.h"
#include "planar/operand/scale_value.h"
#include "spatial/events/scale_walk.h"
#include "spatial/family/solid_lifetimes.h"
#include "spatial/family/structure_cache.h"

namespace dymsum {

using exact::BigRational;
using namespace spatial;

namespace {

BigRational value_of(const Scale& s) { return exact::exact_value(s.exact()); }

SolidScaleOptions scale_search(const SolidFamilyOptions& options) {
  SolidScaleOptions walk;
  walk.moving = options.moving, walk.semantics = options.semantics;
  walk.tight = options.tight, walk.threads = options.threads;
  return walk;
}

/// The error of low > high.
std::optional<Error> empty_interval(const Scale& low, const Scale& high) {
  if (value_of(low) <= value_of(high)) return std::nullopt;
  return Error{ErrorCode::bad_scale,
               "the interval of scales is empty: " + low.exact().to_string() + " > " + high.exact().to_string(),
               {}};
}

/// The coefficients of the polynomial of degree 3 with these values at 1, 2, 3 and 4.
std::array<BigRational, 4> through(const std::array<BigRational, 4>& at) {
  // Newton's form: differences of the values over factorials, times (s - 1), (s - 1)(s - 2), (s - 1)(s - 2)(s - 3).
  const BigRational d1 = at[1] - at[0], d2 = (at[2] - 2 * at[1] + at[0]) / 2,
                    d3 = (at[3] - 3 * at[2] + 3 * at[1] - at[0]) / 6;
  return {BigRational(at[0] - d1 + 2 * d2 - 6 * d3), BigRational(d1 - 3 * d2 + 11 * d3), BigRational(d2 - 6 * d3), d3};
}

}  // namespace

class SolidScalingFamily::State {
 public:
  /// Throws Cancelled, std::invalid_argument, BeyondScales.
  State(const Mesh& p, const Mesh& q, const Scale& low, const Scale& high, const SolidFamilyOptions& options);

  /// The error of a scale outside the interval.
  std::optional<Error> outside(const Scale& s) const;
  SolidFamilyLocation locate(const BigRational& s) const;
  SpatialSum at(const Scale& s, const Progress& progress) const;
  /// The structure of a cell; made at `s`, a scale of it, where it is not kept.
  StructureCache::Kept structure(std::uint32_t cell, const Scale& s, const Progress& progress) const;
  /// A scale of a cell of a family of non-convex solids; nothing where the cell is empty.
  std::optional<Scale> scale_in(std::uint32_t cell) const;
  Rational volume_at(const StructureCache::Kept& structure, const Scale& s) const;

  Mesh p, q;
  Scale low, high;
  SolidFamilyOptions options;  ///< with no progress
  std::optional<ConvexSum> convex;
  std::optional<ScaleWalk> walk;  ///< of other operands
  std::vector<ScaleEvent> events;
  SolidFamilyWork work;
  mutable StructureCache cache;
};

SolidScalingFamily::State::State(const Mesh& p, const Mesh& q, const Scale& low, const Scale& high,
                                 const SolidFamilyOptions& given)
    : p(p), q(q), low(low), high(high), options(given), cache(given.structure_bytes) {
  const Stopwatch watch;
  options.progress = {};
  if (Result<ConvexSum> sum = ConvexSum::create(p, q)) {
    convex = *std::move(sum);
  } else {
    walk.emplace(p, q, scale_search(given));
    SolidEventWork search;
    events = walk->events(value_of(low), value_of(high), ListedScales::all, given.progress, search);
  }
  work.events = events.size(), work.cells = events.size() + 1;
  work.visible = static_cast<std::uint64_t>(
      std::count_if(events.begin(), events.end(), [](const ScaleEvent& e) { return e.visible; }));
  work.ms = watch.ms();
}

std::optional<Error> SolidScalingFamily::State::outside(const Scale& s) const {
  const BigRational at = value_of(s);
  if (at >= value_of(low) && at <= value_of(high)) return std::nullopt;
  return Error{ErrorCode::bad_scale,
               "the scale " + s.exact().to_string() + " is outside of the family's interval, " +
                   low.exact().to_string() + " to " + high.exact().to_string(),
               {}};
}

SolidFamilyLocation SolidScalingFamily::State::locate(const BigRational& s) const {
  const double near = exact::round_to_double(s);
  // Rounding is monotone: where doubles differ, scales do.
  const auto at = std::lower_bound(events.begin(), events.end(), s, [&](const ScaleEvent& e, const BigRational& value) {
    return e.approx != near ? e.approx < near : exact::exact_value(e.parameter) < value;
  });
  const bool event = at != events.end() && at->approx == near && exact::exact_value(at->parameter) == s;
  return {static_cast<std::uint32_t>(at - events.begin()), event};
}

SpatialSum SolidScalingFamily::State::at(const Scale& s, const Progress& progress) const {
  if (convex) {
    ConvexSum sum = *convex;
    const SolidPose pose{{}, {s, s, s}};
    if (options.moving == MovingOperand::p) sum.set(pose);
    else sum.set({}, pose);
    return sum.sum();
  }
  const SolidFamilyLocation location = locate(value_of(s));
  if (location.event) return walk->at(s, progress);
  if (const StructureCache::Kept kept = cache.find(location.index)) {
    const ScalingPair& pair = walk->given();
    if (std::optional<SpatialSum> sum = placed(*kept, posed_space(pair.pair(), pair.poses(s)))) return *std::move(sum);
  }
  CornerContacts corners;
  SpatialSum sum = walk->at(s, progress, &corners);
  cache.keep(location.index, structure_of(sum, std::move(corners)));
  return sum;
}

StructureCache::Kept SolidScalingFamily::State::structure(std::uint32_t cell, const Scale& s,
                                                          const Progress& progress) const {
  if (StructureCache::Kept kept = cache.find(cell)) return kept;
  CornerContacts corners;
  const SpatialSum sum = walk->at(s, progress, &corners);
  return cache.keep(cell, structure_of(sum, std::move(corners)));
}

std::optional<Scale> SolidScalingFamily::State::scale_in(std::uint32_t cell) const {
  const BigRational from = cell == 0 ? value_of(low) : exact::exact_value(events[cell - 1].parameter),
                    to = cell == events.size() ? value_of(high) : exact::exact_value(events[cell].parameter);
  if (from < to) return computed_scale(planar::simple_between(from, to));
  // An interval of one scale, or an event at one of its ends.
  if (events.empty()) return low;
  return std::nullopt;
}

Rational SolidScalingFamily::State::volume_at(const StructureCache::Kept& structure, const Scale& s) const {
  const ScalingPair& pair = walk->given();
  return placed(*structure, posed_space(pair.pair(), pair.poses(s)))->volume_exact();
}

SolidScalingFamily::SolidScalingFamily(std::unique_ptr<const State> state) : state_(std::move(state)) {}
SolidScalingFamily::SolidScalingFamily(SolidScalingFamily&&) noexcept = default;
SolidScalingFamily& SolidScalingFamily::operator=(SolidScalingFamily&&) noexcept = default;
SolidScalingFamily::~SolidScalingFamily() = default;

Result<SolidScalingFamily> SolidScalingFamily::create(const Mesh& p, const Mesh& q, const Scale& low, const Scale& high,
                                                      const SolidFamilyOptions& options) {
  if (std::optional<Error> error = scaling_refusal(p, q, options.threads)) return *std::move(error);
  if (std::optional<Error> error = empty_interval(low, high)) return *std::move(error);
  return within_scales([&] {
    return guarded([&] { return SolidScalingFamily(std::make_unique<const State>(p, q, low, high, options)); });
  });
}

const Mesh& SolidScalingFamily::p() const { return state_->p; }
const Mesh& SolidScalingFamily::q() const { return state_->q; }
const SolidFamilyOptions& SolidScalingFamily::options() const { return state_->options; }
const Scale& SolidScalingFamily::low() const { return state_->low; }
const Scale& SolidScalingFamily::high() const { return state_->high; }
const std::vector<ScaleEvent>& SolidScalingFamily::events() const { return state_->events; }
SolidFamilyWork SolidScalingFamily::work() const {
  SolidFamilyWork work = state_->work;
  state_->cache.report(work);
  return work;
}

Result<SpatialSum> SolidScalingFamily::at(const Scale& s, const Progress& progress) const {
  if (std::optional<Error> error = state_->outside(s)) return *std::move(error);
  return guarded([&] { return state_->at(s, progress); });
}

std::vector<ScaleEvent> SolidScalingFamily::changes(const Scale& a, const Scale& b, EventChange change) const {
  const BigRational low = value_of(a), high = value_of(b);
  std::vector<ScaleEvent> found;
  for (const ScaleEvent& e : events()) {
    if (!(change == EventChange::topology ? e.topology : e.visible)) continue;
    if (const BigRational at = exact::exact_value(e.parameter); at >= low && at <= high) found.push_back(e);
  }
  return found;
}

std::optional<ScaleEvent> SolidScalingFamily::next(const Scale& s, EventChange change) const {
  const auto [index, event] = locate(s);
  for (std::size_t k = event ? index + std::size_t{1} : index; k < events().size(); ++k)
    if (change == EventChange::topology ? events()[k].topology : events()[k].visible) return events()[k];
  return std::nullopt;
}

SolidFamilyLocation SolidScalingFamily::locate(const Scale& s) const { return state_->locate(value_of(s)); }

Result<std::array<Rational, 4>> SolidScalingFamily::volume_polynomial(const Scale& s, const Progress& progress) const {
  if (std::optional<Error> error = state_->outside(s)) return *std::move(error);
  return within_scales([&] {
    return guarded([&] {
      std::array<BigRational, 4> values;
      const auto scale = [](std::size_t k) { return Scale::of(Rational(static_cast<std::int64_t>(k + 1))).value(); };
      const auto [cell, event] = locate(s);
      StructureCache::Kept structure;
      if (!state_->convex) {
        // Both cells beside an event have its volume; one of them may be empty.
        const std::optional<Scale> before = event ? state_->scale_in(cell) : s,
                                   after = event && !before ? state_->scale_in(cell + 1) : std::nullopt;
        if (before) structure = state_->structure(cell, *before, progress);
        else if (after) structure = state_->structure(cell + 1, *after, progress);
      }
      for (std::size_t k = 0; k < 4; ++k) {
        if (structure) values[k] = exact::exact_value(state_->volume_at(structure, scale(k)));
        else if (state_->convex) values[k] = exact::exact_value(state_->at(scale(k), progress).volume_exact());
        else values[k] = exact::exact_value(state_->at(s, progress).volume_exact());
      }
      const std::array<BigRational, 4> c = through(values);
      return std::array<Rational, 4>{exact::to_rational(c[0]), exact::to_rational(c[1]), exact::to_rational(c[2]),
                                     exact::to_rational(c[3])};
    });
  });
}

Result<std::vector<SolidLifetime>> SolidScalingFamily::lifetimes(const Progress& progress) const {
  return within_scales([&] {
    return guarded([&] {
      SolidLifetimes lives;
      if (state_->convex) {
        lives.add(0, contacts_of(state_->at(low(), progress)));
        return std::move(lives).all();
      }
      const auto cells = static_cast<std::uint32_t>(state_->work.cells);
      for (std::uint32_t cell = 0; cell < cells; ++cell) {
        if (progress && !progress("cells", static_cast<double>(cell) / cells)) throw Cancelled{};
        const std::optional<Scale> s = state_->scale_in(cell);
        if (s) lives.add(cell, contacts_of(*state_->structure(cell, *s, progress)));
      }
      return std::move(lives).all();
    });
  });
}

}  // namespace dymsum
