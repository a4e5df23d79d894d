// What readers of planar files make of what a region does not hold: third coordinates and curves.
#pragma once

#include <cstdint>
#include <optional>

namespace dymsum {

/// What becomes of third coordinates and measures (Z and M) in files that hold them: they are errors, or left out, so
/// that what lies above one another coincides.
enum class ThirdCoordinates : std::uint8_t { refused, dropped };

/// The side of a curve on which the chords lie that stand for it: with their ends on the curve, or inside or outside of
/// the region that it bounds with others, but for the rounding of coordinates.
enum class CurveBound : std::uint8_t { nearest, inside, outside };

/// How curves of files become chords: every point of a curve has one of its chords within `error`, and every point of
/// these the curve, but for the rounding of coordinates. Curves that bound nothing are `nearest` always.
struct CurveOptions {
  std::optional<double> error;  ///< in the file's units; nothing: a thousandth of an arc's radius or a curve's size
  CurveBound bound = CurveBound::nearest;
};

struct ReadOptions {
  ThirdCoordinates third = ThirdCoordinates::refused;
  CurveOptions curves;
};

}  // namespace dymsum
