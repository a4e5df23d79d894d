// What a command says about its result: one JSON object, or a few lines for a person.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/orientation.h"
#include "dymsum/planar_sum.h"
#include "dymsum/snap_rounding.h"
#include "dymsum/spatial_sum.h"
#include "inputs.h"
#include "json_report.h"
#include "timing.h"

namespace dymsum::cli {

struct SumReport {
  std::string verb;
  std::vector<Input> inputs;
  const PlanarSum* sum = nullptr;
  std::optional<ConvolutionSizes> convolution;  ///< none of Boolean operations
  Timing timing;
  std::string engine, semantics;           ///< no engine of Boolean operations
  std::optional<Orientation> orientation;  ///< where an operand is turned
  bool exact = false;                      ///< area_exact of any length
  std::optional<Rounding> rounding;        ///< of what was written where nearest doubles would not do
};

/// outer, holes, vertices, area, area_exact and tight of a sum. area is a number, or text where it is outside the range
/// of doubles; area_exact is null for more than 10000 vertices, and where its denominators have more than 16384 bits
/// together, unless it is wanted `exact`.
Json size_json(const PlanarSum& sum, bool exact);
/// An area or a volume where it is 0 or a normal double; as text where it was rounded to neither.
using Measure = std::variant<double, std::string>;
Measure volume_of(const Mesh& mesh);
Measure volume_of(const SpatialSum& sum);
Measure surface_of(const Mesh& mesh);
Measure surface_of(const SpatialSum& sum);
Json measure_json(const Measure& measure);
/// A measure with 17 digits.
std::string shown(const Measure& measure);

/// The area as a number, or text where it is outside the range of normal doubles.
Json area_json(const Region& region);

Json inputs_json(const std::vector<Input>& inputs);
/// Prints what was read beside a shape: the unit of its coordinates, and the curves in it; each on a line of its own
/// that begins with the end of the one before.
void print_notes(std::ostream& out, const ReadingNotes& notes);
/// {"tan_half": "1/2", "theta": 0.927...}.
Json orientation_json(const Orientation& orientation);
Json sum_json(const SumReport& report);
void print_sum(std::ostream& out, const SumReport& report);

/// "0.12 ms (median of 3, minimum 0.1 ms)".
std::string shown(const Timing& timing);
/// That on a line, where a computation was repeated.
void print_times(std::ostream& out, const Timing& timing);

/// Bits of the integers that hold solid operands of that many bits; 0 for integers of any size.
int solid_tier(int bits);
/// "29-bit", "61-bit", "512-bit" or "arbitrary precision" for 0.
std::string tier_name(int bits);
/// An area with 17 digits, whatever its size.
std::string shown_area(const PlanarSum& sum);
std::string shown_area(const Region& region);
/// A rational for a person: "3/2", and "2" for a whole number.
std::string shown(const Rational& value);
/// "1 hole", "2 holes"; `many` where the plural is not regular.
std::string counted(std::size_t n, const std::string& one, const std::string& many = "");

}  // namespace dymsum::cli
