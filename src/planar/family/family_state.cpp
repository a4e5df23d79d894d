#include "planar/family/family_state.h"

#include <algorithm>
#include <string>

namespace dymsum {

using exact::BigRational;

namespace planar {

BigRational value_of(const Scale& s) { return rational(scale_value(s)); }

std::optional<Error> empty_interval(const Scale& low, const Scale& high) {
  if (value_of(low) <= value_of(high)) return std::nullopt;
  return Error{ErrorCode::bad_scale,
               "the interval of scales is empty: " + low.exact().to_string() + " > " + high.exact().to_string(),
               {}};
}

FamilyWork work_of(const ScalingCells& cells) {
  FamilyWork work;
  work.events = cells.events.size();
  work.visible = static_cast<std::uint64_t>(
      std::count_if(cells.events.begin(), cells.events.end(), [](const ScaleEvent& e) { return e.visible; }));
  work.cells = cells.structures.cell_count();
  work.kept = cells.structures.kept_count();
  work.names = cells.structures.names().size();
  work.bytes = cells.structures.bytes();
  return work;
}

}  // namespace planar

std::optional<Error> ScalingFamily::State::outside(const Scale& s) const {
  // Rounding is monotone: where doubles differ, scales do.
  if (s.approx() > low.approx() && s.approx() < high.approx()) return std::nullopt;
  const BigRational value = planar::value_of(s);
  if (value >= planar::value_of(low) && value <= planar::value_of(high)) return std::nullopt;
  return Error{ErrorCode::bad_scale,
               "the scale " + s.exact().to_string() + " is outside of the family's interval, " +
                   low.exact().to_string() + " to " + high.exact().to_string(),
               {}};
}

std::optional<Error> ScalingFamily::State::outside(const Scale& a, const Scale& b) const {
  if (std::optional<Error> error = planar::empty_interval(a, b)) return error;
  std::optional<Error> error = outside(a);
  return error ? error : outside(b);
}

std::optional<Error> ScalingFamily::State::not_all_kept(const char* what) const {
  if (work.kept == work.cells) return std::nullopt;
  return Error{ErrorCode::out_of_memory,
               "of " + std::to_string(work.cells) + " structures " + std::to_string(work.kept) + " are kept: " + what +
                   " need all of them, allow more than " + std::to_string(options.structure_bytes) + " bytes",
               {}};
}

}  // namespace dymsum
