// ScalingSum and RotatingSum.
#include "arrays.h"
#include "dymsum/rotating_sum.h"
#include "dymsum/scaling_sum.h"
#include "options.h"
#include "plain.h"
#include "planar_shape.h"

namespace dymsum::web {
namespace {

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
  return plain(moving.work());
}

val scale_to(ScalingSum& sum, const val& s, const val& sy) {
  return plain(got(is_none(sy) ? sum.set(scale_in(s)) : sum.set(scale_in(s), scale_in(sy))));
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
  const auto event = got(sum.next_event(scale_in(after), scale_in(limit), enumerator(change, EventChange::visible),
                                        progress_in(progress)));
  return event ? event_data(*event) : val::null();
}
std::string hash_of(const ScalingSum& sum) {
  static constexpr char kDigits[] = "0123456789abcdef";
  std::string text(16, '0');
  std::uint64_t hash = sum.combinatorial_hash();
  for (std::size_t k = 16; k-- > 0; hash >>= 4) text[k] = kDigits[hash & 15];
  return text;
}

val turn_to(RotatingSum& sum, const val& angle) { return plain(got(sum.set(orientation_in(angle)))); }
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
