// ScalingFamily: all sums of an interval of scales. What holds for some scales and for all is in further/.
#include "scaling_family.h"

#include "arrays.h"
#include "options.h"
#include "plain.h"

namespace dymsum::web {
namespace {

std::shared_ptr<ScalingFamily> created(const Region& p, const Region& q, const val& low, const val& high,
                                       const val& options) {
  FamilyOptions how;
  how.moving = enumerator(member(options, "moving"), how.moving);
  how.reflect_q = member_or(options, "reflectQ", false);
  how.semantics = semantics_in(member(options, "semantics"));
  how.progress = progress_in(member(options, "progress"));
  return shared(got(ScalingFamily::create(p, q, scale_in(low), scale_in(high), how)));
}

std::shared_ptr<PlanarSum> sum_at(const ScalingFamily& family, const val& s) {
  return shared(got(family.at(scale_in(s))));
}
val events_of(const ScalingFamily& family) { return list_of(family.events(), event_data); }
val changes_in(const ScalingFamily& family, const val& from, const val& to, const val& change) {
  return list_of(family.changes(scale_in(from), scale_in(to), enumerator(change, EventChange::visible)), event_data);
}
val ring_ids_at(const ScalingFamily& family, const val& s) {
  const std::vector<std::uint64_t> ids = got(family.ring_ids(scale_in(s)));
  return array_of(std::vector<double>(ids.begin(), ids.end()));
}

val lifetime_data(const Lifetime& life) {
  const bool is_hole = life.feature == FamilyFeature::hole;
  const auto corner = [](std::uint32_t vertex) { return vertex == SumVertex::kNone ? val::null() : val(vertex); };
  val v = val::object();
  v.set("feature", plain(life.feature));
  v.set("in", is_hole ? val::null() : plain(life.in));
  v.set("out", is_hole ? val::null() : plain(life.out));
  v.set("cornerP", corner(life.corner_p));
  v.set("cornerQ", corner(life.corner_q));
  v.set("hole", is_hole ? plain(life.hole) : val::null());
  v.set("firstCell", life.first_cell);
  v.set("lastCell", life.last_cell);
  return v;
}
val lifetimes_of(const ScalingFamily& family) { return list_of(got(family.lifetimes()), lifetime_data); }

}  // namespace

emscripten::class_<ScalingFamily>& scaling_family_handle() {
  static emscripten::class_<ScalingFamily> bound = handle<ScalingFamily>("ScalingFamily");
  return bound;
}

namespace {

EMSCRIPTEN_BINDINGS(scaling_family) {
  scaling_family_handle()
      .class_function("create", guarded<&created>)
      .function("at", guarded<&sum_at>)
      .function("events", guarded<&events_of>)
      .function("changes", guarded<&changes_in>)
      .function("lifetimes", guarded<&lifetimes_of>)
      .function("ringIds", guarded<&ring_ids_at>);
}

}  // namespace
}  // namespace dymsum::web
