// Options and exact numbers as JavaScript gives them.
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bind.h"
#include "dymsum/event.h"
#include "dymsum/frames.h"
#include "dymsum/names.h"
#include "dymsum/orientation.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/rotation.h"
#include "dymsum/scale.h"
#include "dymsum/spatial_sum.h"

namespace dymsum::web {

inline bool is_none(const val& v) { return v.isUndefined() || v.isNull(); }
/// The member, or undefined of nothing.
inline val member(const val& options, const char* name) { return is_none(options) ? val::undefined() : options[name]; }
template <class T>
T member_or(const val& options, const char* name, T otherwise) {
  const val v = member(options, name);
  return is_none(v) ? otherwise : v.as<T>();
}

/// The enumerator of a name, of those that are offered; malformed for others.
template <class E>
E enumerator(const val& v, E otherwise, std::span<const std::string_view> offered = names_of<E>()) {
  if (is_none(v)) return otherwise;
  const auto text = v.as<std::string>();
  if (std::find(offered.begin(), offered.end(), text) != offered.end()) return *parse<E>(text);
  std::string all;
  for (const std::string_view one : offered) all.append(all.empty() ? "" : ", ").append(one);
  throw Thrown{{ErrorCode::malformed, "\"" + text + "\" is none of " + all, {}}};
}

Progress progress_in(const val& callback);
inline Semantics semantics_in(const val& v) { return enumerator(v, Semantics::closed); }
SumOptions sum_options(const val& v);
SpatialOptions spatial_options(const val& v);
MovingOptions moving_options(const val& v);
val event_data(const ScaleEvent& event);

/// A number at face value, or the text of one.
Rational rational_in(const val& v);
std::optional<Rational> optional_rational(const val& v);
Scale scale_in(const val& v);
/// Radians, or {tanHalf}.
Orientation orientation_in(const val& v);
Rotation rotation_in(const val& v);
SolidPose pose_in(const val& v);

std::string tan_half_text(const Orientation& theta);

}  // namespace dymsum::web
