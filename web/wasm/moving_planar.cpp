// ScalingSum and RotatingSum.
#include "arrays.h"
#include "dymsum/rotating_sum.h"
#include "dymsum/scaling_sum.h"
#include "options.h"
#include "planar_shape.h"

namespace dymsum::web {
namespace {

std::string change_name(RingChange::Kind kind) {
  switch (kind) {
    case RingChange::Kind::appeared:
      return "appeared";
    case RingChange::Kind::disappeared:
      return "disappeared";
    case RingChange::Kind::reshaped:
      return "reshaped";
    case RingChange::Kind::moved:
      return "moved";
  }
  throw std::logic_error("a change of no kind");
}

val changes_data(const FrameChanges& changes) {
  val v = val::object();
  v.set("rings", list_of(changes.rings, [](const RingChange& change) {
          val one = val::object();
          one.set("kind", change_name(change.kind));
          one.set("ring", static_cast<double>(change.ring));
          one.set("verticesAppeared", change.vertices_appeared);
          one.set("verticesDisappeared", change.vertices_disappeared);
          return one;
        }));
  v.set("tightPoints", static_cast<double>(changes.tight_points));
  v.set("tightSegments", static_cast<double>(changes.tight_segments));
  v.set("topology", changes.topology);
  return v;
}

val work_data(const FrameWork& work) {
  val v = val::object();
  v.set("rebuilt", work.rebuilt);
  v.set("newWindow", work.new_window);
  v.set("degenerate", work.degenerate);
  const auto set = [&](const char* name, auto value) { v.set(name, static_cast<double>(value)); };
  set("pieces", work.pieces);
  set("candidates", work.candidates);
  set("piecesRepaired", work.pieces_repaired);
  set("listsChanged", work.lists_changed);
  set("crossingsChanged", work.crossings_changed);
  set("loopsTraced", work.loops_traced);
  set("loopsKept", work.loops_kept);
  set("witnessed", work.witnessed);
  set("witnessesLost", work.witnesses_lost);
  set("collisionTests", work.collision_tests);
  set("exactSigns", work.exact_signs);
  set("windowLow", work.window_low);
  set("windowHigh", work.window_high);
  set("ms", work.ms);
  set("peakBytes", work.peak_bytes);
  return v;
}

template <class Sum>
std::shared_ptr<Sum> created(const Region& p, const Region& q, const val& options) {
  return shared(got(Sum::create(p, q, moving_options(options))));
}
template <class Sum>
val shape_of(const Sum& moving) {
  return sum_shape(moving.sum());
}
template <class Sum>
std::shared_ptr<PlanarSum> sum_of(const Sum& moving) {
  return shared(moving.sum());
}
template <class Sum>
val ids_of(const Sum& moving) {
  const std::vector<std::uint64_t> ids = moving.ring_ids();
  return array_of(std::vector<double>(ids.begin(), ids.end()));
}
template <class Sum>
val work_of(const Sum& moving) {
  return work_data(moving.work());
}

val scale_to(ScalingSum& sum, const val& s, const val& sy) {
  return changes_data(got(is_none(sy) ? sum.set(scale_in(s)) : sum.set(scale_in(s), scale_in(sy))));
}
val scale_of(const ScalingSum& sum) {
  val v = val::object();
  v.set("approx", sum.scale().approx());
  v.set("exact", sum.scale().exact().to_string());
  return v;
}

val events_of(const ScalingSum& sum, const val& from, const val& to, const val& progress) {
  return list_of(got(sum.events(scale_in(from), scale_in(to), progress_in(progress))), event_data);
}
val next_event_of(const ScalingSum& sum, const val& after, const val& limit, const val& change, const val& progress) {
  const auto event = got(sum.next_event(scale_in(after), scale_in(limit), change_in(change), progress_in(progress)));
  return event ? event_data(*event) : val::null();
}
std::string hash_of(const ScalingSum& sum) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text(16, '0');
  std::uint64_t hash = sum.combinatorial_hash();
  for (std::size_t k = 16; k-- > 0; hash >>= 4) text[k] = kDigits[hash & 15];
  return text;
}

val turn_to(RotatingSum& sum, const val& angle) { return changes_data(got(sum.set(orientation_in(angle)))); }
val orientation_of(const RotatingSum& sum) {
  val v = val::object();
  v.set("radians", sum.orientation().radians());
  v.set("tanHalf", tan_half_text(sum.orientation()));
  return v;
}

template <class Sum>
emscripten::class_<Sum> moving_handle(const char* name) {
  emscripten::class_<Sum> bound = handle<Sum>(name);
  bound.class_function("create", guarded<&created<Sum>>)
      .function("shape", guarded<&shape_of<Sum>>)
      .function("sum", guarded<&sum_of<Sum>>)
      .function("ringIds", guarded<&ids_of<Sum>>)
      .function("work", guarded<&work_of<Sum>>);
  return bound;
}

EMSCRIPTEN_BINDINGS(moving_planar) {
  moving_handle<ScalingSum>("ScalingSum")
      .function("set", guarded<&scale_to>)
      .function("scale", guarded<&scale_of>)
      .function("events", guarded<&events_of>)
      .function("nextEvent", guarded<&next_event_of>)
      .function("combinatorialHash", guarded<&hash_of>);
  moving_handle<RotatingSum>("RotatingSum")
      .function("set", guarded<&turn_to>)
      .function("orientation", guarded<&orientation_of>);
}

}  // namespace
}  // namespace dymsum::web
