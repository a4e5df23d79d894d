// What happens to sums of solids while one of them scales or rotates.
#include "arrays.h"
#include "dymsum/solid_rotation_events.h"
#include "dymsum/solid_scale_events.h"
#include "options.h"
#include "plain.h"

namespace dymsum::web {
namespace {

using SharedSum = std::shared_ptr<SpatialSum>;

std::shared_ptr<SolidScaleEvents> scaling(const Mesh& p, const Mesh& q, const val& options) {
  SolidScaleOptions how;
  how.moving = enumerator(member(options, "moving"), how.moving);
  how.semantics = semantics_in(member(options, "semantics"));
  how.tight = member_or(options, "tight", true);
  return shared(got(SolidScaleEvents::create(p, q, how)));
}
SharedSum scaled_to(const SolidScaleEvents& sum, const val& s, const val& progress) {
  return shared(got(sum.at(scale_in(s), progress_in(progress))));
}
val scale_events(const SolidScaleEvents& sum, const val& from, const val& to, const val& progress) {
  return list_of(got(sum.events(scale_in(from), scale_in(to), progress_in(progress))), event_data);
}
val next_scale_event(const SolidScaleEvents& sum, const val& after, const val& limit, const val& change,
                     const val& progress) {
  const auto event = got(sum.next_event(scale_in(after), scale_in(limit), enumerator(change, EventChange::visible),
                                        progress_in(progress)));
  return event ? event_data(*event) : val::null();
}

val turn_contact_data(const SolidRotationContact& contact) {
  val v = val::object();
  v.set("kind", plain(contact.kind));
  v.set("at", plain(contact.at));
  v.set("features", plain(contact.features));
  return v;
}
val turn_event_data(const SolidRotationEvent& event) {
  val v = val::object();
  const std::optional<AxisTurn>& exact = event.parameter.exact;
  v.set("radians", event.approx);
  v.set("exactT", !exact ? val::null() : exact->is_half_turn() ? val(std::string("inf")) : val(exact->t().to_string()));
  v.set("polynomial", plain(event.parameter.polynomial));
  v.set("contacts", list_of(event.contacts, turn_contact_data));
  v.set("visible", event.visible);
  v.set("topology", event.topology);
  return v;
}
std::shared_ptr<SolidRotationEvents> turning(const Mesh& p, const Mesh& q, const val& axis, const val& options) {
  SolidRotationOptions how;
  how.moving = enumerator(member(options, "moving"), how.moving);
  how.changes = member_or(options, "changes", true);
  how.window = member_or(options, "window", 0.0);
  how.tight = member_or(options, "tight", true);
  TurnAxis direction{};
  for (std::size_t k = 0; k < 3; ++k) direction[k] = axis[k].as<std::int32_t>();
  return shared(got(SolidRotationEvents::create(p, q, direction, how)));
}
AxisTurn turn_in(const SolidRotationEvents& sum, double radians) { return got(AxisTurn::nearest(sum.axis(), radians)); }
SharedSum turned_to(const SolidRotationEvents& sum, double radians, const val& progress) {
  return shared(got(sum.at(turn_in(sum, radians), progress_in(progress))));
}
val rotation_events(const SolidRotationEvents& sum, double from, double to, const val& progress) {
  return list_of(got(sum.events(turn_in(sum, from), turn_in(sum, to), progress_in(progress))), turn_event_data);
}

EMSCRIPTEN_BINDINGS(solid_events) {
  handle<SolidScaleEvents>("SolidScaleEvents")
      .class_function("create", guarded<&scaling>)
      .function("at", guarded<&scaled_to>)
      .function("events", guarded<&scale_events>)
      .function("nextEvent", guarded<&next_scale_event>);
  handle<SolidRotationEvents>("SolidRotationEvents")
      .class_function("create", guarded<&turning>)
      .function("at", guarded<&turned_to>)
      .function("events", guarded<&rotation_events>);
}

}  // namespace
}  // namespace dymsum::web
