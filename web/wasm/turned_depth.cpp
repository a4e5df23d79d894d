// TurnedDepth: the shortest way out of overlap of two solids of any shape, of which Q turns and moves.
#include "arrays.h"
#include "dymsum/continuous_depth.h"
#include "options.h"
#include "plain.h"

namespace dymsum::web {
namespace {

std::shared_ptr<ContinuousDepth> turned_depth(const Mesh& p, const Mesh& q, const val& options) {
  ContinuousDepthOptions how;
  how.smoothing_length = 0;  // the exact depth, with its jumps
  how.progress = progress_in(member(options, "progress"));
  return shared(got(ContinuousDepth::create(p, q, how)));
}

val depth_at(ContinuousDepth& depth, const val& at, const val& turned) {
  const ContinuousContact contact = got(depth.query(point3_in(at), is_none(turned) ? Rotation{} : rotation_in(turned)));
  val v = val::object();
  v.set("inside", contact.meeting == Meeting::overlapping);
  v.set("depth", contact.euclidean_depth);
  v.set("depthSquared", depth.euclidean_squared().to_string());
  v.set("direction", plain(contact.euclidean_normal));
  v.set("p", plain(contact.contact.p));
  v.set("q", plain(contact.contact.q));
  return v;
}

EMSCRIPTEN_BINDINGS(turned_depth) {
  handle<ContinuousDepth>("TurnedDepth")
      .class_function("create", guarded<&turned_depth>)
      .function("at", guarded<&depth_at>);
}

}  // namespace
}  // namespace dymsum::web
