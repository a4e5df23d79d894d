#include "options.h"
#include "plain.h"

#include <algorithm>
#include <stdexcept>

#include <array>

namespace dymsum::web {

Progress progress_in(const val& callback) {
  if (is_none(callback)) return {};
  return [callback](std::string_view stage, double fraction) {
    const val answer = callback(std::string(stage), fraction);
    return !answer.isFalse();
  };
}

val event_data(const ScaleEvent& event) {
  val v = val::object();
  v.set("s", event.parameter.to_string());
  v.set("approx", event.approx);
  v.set("kind", plain(event.kind));
  v.set("visible", event.visible);
  v.set("topology", event.topology);
  return v;
}

SumOptions sum_options(const val& v) {
  SumOptions options;
  options.engine = enumerator(member(v, "engine"), Engine::fast);
  options.semantics = semantics_in(member(v, "semantics"));
  options.trace = member_or(v, "trace", false);
  options.progress = progress_in(member(v, "progress"));
  return options;
}

SpatialOptions spatial_options(const val& v) {
  SpatialOptions options;
  options.engine = enumerator(member(v, "engine"), SpatialEngine::fast);
  options.semantics = semantics_in(member(v, "semantics"));
  options.tight = member_or(v, "tight", true);
  options.threads = 1;
  const double memory = member_or(v, "memory", 0.0);
  if (!(memory >= 0)) throw std::invalid_argument("a limit of memory is not negative");
  options.memory = static_cast<std::uint64_t>(std::min(memory, 0x1p60));
  options.progress = progress_in(member(v, "progress"));
  return options;
}

MovingOptions moving_options(const val& v) {
  MovingOptions options;
  options.moving = enumerator(member(v, "moving"), MovingOperand::p);
  options.reflect_q = member_or(v, "reflectQ", false);
  options.semantics = semantics_in(member(v, "semantics"));
  options.mode = enumerator(member(v, "mode"), FrameMode::automatic);
  options.window = member_or(v, "window", 0.0);
  options.kept_window_bytes =
      static_cast<std::uint64_t>(member_or(v, "keptWindowBytes", static_cast<double>(options.kept_window_bytes)));
  options.progress = progress_in(member(v, "progress"));
  return options;
}

namespace {

/// Integers of any size and texts, as what they say.
std::optional<std::string> text_in(const val& v) {
  const auto type = v.typeOf().as<std::string>();
  if (type == "string") return v.as<std::string>();
  if (type == "bigint") return v.call<std::string>("toString");
  return std::nullopt;
}

}  // namespace

Rational rational_in(const val& v) {
  const auto text = text_in(v);
  return got(text ? Rational::parse(*text) : Rational::of(v.as<double>()));
}

std::optional<Rational> optional_rational(const val& v) {
  if (is_none(v)) return std::nullopt;
  return rational_in(v);
}

Scale scale_in(const val& v) {
  const auto text = text_in(v);
  return got(text ? Scale::parse(*text) : Scale::of(v.as<double>()));
}

Orientation orientation_in(const val& v) {
  if (v.isNumber()) return got(Orientation::nearest(v.as<double>()));
  const val tan_half = v["tanHalf"];
  if (const auto text = text_in(tan_half)) return got(Orientation::parse(*text));
  return got(Orientation::of(rational_in(tan_half)));
}

namespace {

bool is_small_integer(double v) {
  return v >= -0x1p30 && v <= 0x1p30 && v == static_cast<double>(static_cast<std::int64_t>(v));
}

Rotation quaternion_in(const val& v) {
  std::array<double, 4> q{};
  bool integers = true;
  for (std::size_t k = 0; k < 4; ++k) {
    q[k] = v[k].as<double>();
    integers = integers && is_small_integer(q[k]);
  }
  if (!integers) return got(Rotation::nearest(q[0], q[1], q[2], q[3]));
  const auto whole = [&](std::size_t k) { return static_cast<std::int64_t>(q[k]); };
  return got(Rotation::of(whole(0), whole(1), whole(2), whole(3)));
}

}  // namespace

Rotation rotation_in(const val& v) {
  if (is_none(v)) return {};
  if (const val q = v["quaternion"]; !is_none(q)) return quaternion_in(q);
  const val axis = v["axis"];
  return got(
      Rotation::about({axis[0].as<double>(), axis[1].as<double>(), axis[2].as<double>()}, v["angle"].as<double>()));
}

SolidPose pose_in(const val& v) {
  SolidPose pose;
  if (is_none(v)) return pose;
  pose.rotation = rotation_in(v["rotation"]);
  const val scale = v["scale"];
  if (is_none(scale)) return pose;
  for (std::size_t k = 0; k < 3; ++k) pose.scale[k] = scale_in(scale.isArray() ? scale[k] : scale);
  return pose;
}

std::string tan_half_text(const Orientation& theta) {
  return theta.is_half_turn() ? "inf" : theta.tan_half().to_string();
}

}  // namespace dymsum::web
