#include "dymsum/solid_scale_events.h"

#include <algorithm>
#include <map>
#include <utility>

#include "planar/operand/scale_value.h"
#include "spatial/events/scale_values.h"
#include "spatial/events/scaled_planes.h"
#include "spatial/motion/beside_origin.h"
#include "spatial/motion/computed_scale.h"
#include "spatial/moving/posed_sum.h"
#include "spatial/moving/sum_shape.h"

namespace dymsum {

using exact::BigRational;
using namespace spatial;

namespace {

std::optional<Error> refused(const Mesh& p, const Mesh& q, const SolidScaleOptions& options) {
  if (options.threads < 0) return Error{ErrorCode::out_of_range, "the number of threads is negative", {}};
  if (p.has_thin_parts() || q.has_thin_parts())
    return Error{ErrorCode::unsupported_operand, "an operand of a scaling sum of solids has parts without volume", {}};
  return std::nullopt;
}

bool has_to_be_compared(const ScaleOfInterest& v) { return v.unknown_topology || (v.unknown && !v.changes); }

/// Beyond both ends, so that there is a scale before the first event and one after the last.
constexpr double kBeside = 0x1p-12;

}  // namespace

class SolidScaleEvents::State {
 public:
  State(const Mesh& p, const Mesh& q, const SolidScaleOptions& given)
      : options_(given), given_(p, q, given.moving == MovingOperand::p ? 0 : 1) {
    if (given_.pair.p.vertices.empty() || given_.pair.q.vertices.empty()) return;
    stages_ = stage_options({});
    stages_.semantics = options_.semantics, stages_.tight = options_.tight, stages_.threads = options_.threads;
    SpatialStats stats;
    StageWatch watch(stages_, stats);
    watch.begin("convolution");
    const std::optional<Mesh> near_p = beside_origin(p), near_q = beside_origin(q);
    if (near_p || near_q) near_.emplace(near_p.value_or(p), near_q.value_or(q), given_.moving);
    facets_.emplace(near().pair, given_.moving, watch);
    overlap_.emplace(*facets_);
  }

  std::size_t facet_count() const { return facets_ ? facets_->facets().size() : 0; }

  SpatialSum at(const Scale& s, const Progress& progress) const {
    return sum_of(given_, s, progress, options_.threads);
  }
  SumShape shape(const Scale& s, const Progress& progress) const { return shape_of_sum(given_, s, progress, 1); }

  std::vector<ScaleEvent> events(const BigRational& a, const BigRational& b, const Progress& progress,
                                 SolidEventWork& work) const;
  std::vector<BigRational> steps(const BigRational& from, const BigRational& to) const;

 private:
  struct Operands {
    Mesh p, q;
    int moving;
    SolidPair pair;
    ScaledPlanes planes;

    Operands(const Mesh& of_p, const Mesh& of_q, int which)
        : p(of_p), q(of_q), moving(which), pair(solid_pair(p, q)), planes(p, q, moving) {}
    Operands(const Operands&) = delete;  // planes refer to the meshes
    Operands& operator=(const Operands&) = delete;
  };
  /// Of which events are those of the given ones: (P + c) + s (Q + d) is P + s Q moved by c + s d.
  const Operands& near() const { return near_ ? *near_ : given_; }
  /// The convolution is that of edge vectors and normals, and refers to vertices by indices.
  SpatialSum sum_of(const Operands& operands, const Scale& s, const Progress& progress, int threads) const {
    if (!facets_) return {};
    SpatialOptions stages = stages_;
    stages.progress = progress, stages.threads = threads;
    return sum_of_facets(operands.pair, posed_space(operands.pair, facets_->poses(s)), facets_->convolution(), {},
                         stages);
  }
  SumShape shape_of_sum(const Operands& operands, const Scale& s, const Progress& progress, int threads) const {
    if (!facets_) return {};
    return shape_of(sum_of(operands, s, progress, threads),
                    [&](const SolidContact& c) { return operands.planes.name(c); });
  }
  using Shapes = std::map<BigRational, SumShape>;
  Shapes shapes_at(const std::vector<BigRational>& scales, StageWatch& watch) const;

  SolidScaleOptions options_;
  Operands given_;
  std::optional<Operands> near_;
  SpatialOptions stages_;
  std::optional<MovingFacets> facets_;  // of the near ones
  std::optional<ScaledOverlap> overlap_;
};

SolidScaleEvents::State::Shapes SolidScaleEvents::State::shapes_at(const std::vector<BigRational>& scales,
                                                                   StageWatch& watch) const {
  std::vector<SumShape> found(scales.size());
  watch.run(scales.size(), [&](std::size_t k) {
    found[k] = shape_of_sum(
        near(), computed_scale(scales[k]),
        [&](std::string_view, double) {
          watch.ask_within_part(static_cast<double>(k) / static_cast<double>(scales.size()));
          return true;
        },
        1);
  });
  Shapes shapes;
  for (std::size_t k = 0; k < scales.size(); ++k) shapes.emplace(scales[k], std::move(found[k]));
  return shapes;
}

std::vector<ScaleEvent> SolidScaleEvents::State::events(const BigRational& a, const BigRational& b,
                                                        const Progress& progress, SolidEventWork& work) const {
  if (!facets_) return {};
  SpatialStats stats;
  SpatialOptions asked = stages_;
  asked.progress = progress;
  StageWatch watch(asked, stats);
  watch.begin("events");
  const double low = exact::round_to_double(a) * (1 - kBeside), high = exact::round_to_double(b) * (1 + kBeside);
  const std::vector<ScaleOfInterest> values = scales_of_interest(*facets_, *overlap_, low, high, work, watch);
  // One scale between each two of them, and one beyond both ends.
  std::vector<BigRational> between;
  for (std::size_t k = 0; k <= values.size(); ++k) {
    const BigRational before = k == 0 ? exact::exact_value(low) : values[k - 1].s,
                      after = k == values.size() ? exact::exact_value(high) : values[k].s;
    between.push_back(before < after ? planar::simple_between(before, after) : before);
  }
  watch.begin("sums");
  std::vector<BigRational> wanted;
  const auto is_asked = [&](const ScaleOfInterest& v) { return v.s >= a && v.s <= b; };
  for (std::size_t k = 0; k < values.size(); ++k)
    if (has_to_be_compared(values[k]) && is_asked(values[k]))
      for (const BigRational& s : {between[k], values[k].s, between[k + 1]})
        if (wanted.empty() || wanted.back() < s) wanted.push_back(s);
  const Shapes shapes = shapes_at(wanted, watch);
  work.sums += wanted.size();
  std::vector<ScaleEvent> events;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const ScaleOfInterest& v = values[k];
    if (!is_asked(v)) continue;
    ShapeChange change{v.changes, false};
    if (has_to_be_compared(v)) {
      change = change_of(shapes.at(between[k]), shapes.at(v.s), shapes.at(between[k + 1]));
      change.visible = change.visible || v.changes;
    }
    if (change.visible)
      events.push_back({exact::to_rational(v.s), exact::round_to_double(v.s), v.kind, true, change.topology});
  }
  watch.begin("");
  return events;
}

/// Ends of ranges in which facets move by about their own size.
std::vector<BigRational> SolidScaleEvents::State::steps(const BigRational& from, const BigRational& to) const {
  if (!facets_) return {from, to};
  std::vector<BigRational> ends{from};
  const std::vector<double> windows = window_ends(*facets_, exact::round_to_double(from), exact::round_to_double(to));
  for (const double end : windows)
    if (const BigRational e = exact::exact_value(end); e > ends.back() && e < to) ends.push_back(e);
  ends.push_back(to);
  return ends;
}

Result<SolidScaleEvents> SolidScaleEvents::create(const Mesh& p, const Mesh& q, const SolidScaleOptions& options) {
  if (std::optional<Error> error = refused(p, q, options)) return *std::move(error);
  return guarded([&] { return SolidScaleEvents(std::make_unique<State>(p, q, options)); });
}

SolidScaleEvents::SolidScaleEvents(std::unique_ptr<State> state) : state_(std::move(state)) {}
SolidScaleEvents::SolidScaleEvents(SolidScaleEvents&&) noexcept = default;
SolidScaleEvents& SolidScaleEvents::operator=(SolidScaleEvents&&) noexcept = default;
SolidScaleEvents::~SolidScaleEvents() = default;

std::size_t SolidScaleEvents::facet_count() const { return state_->facet_count(); }

Result<SpatialSum> SolidScaleEvents::at(const Scale& s, const Progress& progress) const {
  return guarded([&] { return state_->at(s, progress); });
}

Result<std::vector<ScaleEvent>> SolidScaleEvents::events(const Scale& a, const Scale& b, const Progress& progress,
                                                         SolidEventWork* work) const {
  const BigRational from = exact::exact_value(a.exact()), to = exact::exact_value(b.exact());
  if (from > to) return Error{ErrorCode::bad_scale, "the range of scales begins after its end", {}};
  SolidEventWork counted;
  return within_scales([&] {
    return guarded([&] {
      std::vector<ScaleEvent> events = state_->events(from, to, progress, counted);
      if (work != nullptr) *work = counted;
      return events;
    });
  });
}

Result<std::optional<ScaleEvent>> SolidScaleEvents::next_event(const Scale& s, const Scale& limit, EventChange change,
                                                               const Progress& progress) const {
  const BigRational from = exact::exact_value(s.exact()), to = exact::exact_value(limit.exact());
  if (from > to) return Error{ErrorCode::bad_scale, "the range of scales begins after its end", {}};
  const auto first_event = [&]() -> std::optional<ScaleEvent> {
    SolidEventWork work;
    const std::vector<BigRational> ends = state_->steps(from, to);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k)
      for (const ScaleEvent& event : state_->events(ends[k], ends[k + 1], progress, work))
        if (exact::exact_value(event.parameter) > from && (change == EventChange::visible || event.topology))
          return event;
    return std::nullopt;
  };
  return within_scales([&] { return guarded(first_event); });
}

Result<std::uint64_t> SolidScaleEvents::combinatorial_hash(const Scale& s, const Progress& progress) const {
  return guarded([&] { return state_->shape(s, progress).hash; });
}

}  // namespace dymsum
