// Options that several verbs share.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/names.h"
#include "inputs.h"
#include "numbers.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace dymsum::cli {

/// How a verb reports what it found.
struct ReportOptions {
  bool json = false;
  std::size_t repeat = 1;
  bool exact = false;  ///< the area as a fraction, whatever that costs
};

/// A positional argument: its name in help and usage, and what it is.
struct Operand {
  std::string name, what;
};

/// The operands that a verb has, or an option is for.
enum class OperandKind { planar, solid, either };

/// Declares two required operands. Requires: `operands` holds two.
void add_operands(CLI::App& verb, const Operand& first, const Operand& second, std::vector<std::string>& operands,
                  OperandKind kind = OperandKind::either);

/// ROBOT and OBSTACLE, in the order of all verbs for robots that turn.
inline const Operand kRobot{"ROBOT", "The shape that turns about the origin of its coordinates, and moves"};
inline const Operand kObstacle{"OBSTACLE", "The shape that stays"};

/// Declares --json and --repeat.
void add_report_options(CLI::App& verb, ReportOptions& options, const std::string& repeated);

/// Declares --repair.
void add_repair_option(CLI::App& verb, InputOptions& options, OperandKind kind);
/// Declares --exact, for verbs whose reports hold `area_exact` of regions or `volume_exact` of solids.
void add_exact_option(CLI::App& verb, ReportOptions& options, OperandKind kind);
/// The formats of files of such operands, as extensions name them.
std::vector<std::string_view> file_formats(OperandKind kind);
/// Declares --from.
void add_from_option(CLI::App& verb, InputOptions& options, OperandKind kind);

/// Declares --repair and --from of planar operands.
void add_input_options(CLI::App& verb, InputOptions& options);
/// What --hull takes the hull of.
enum class Hulls { of_operands, of_results_too };
/// Declares --repair, --from and --hull, for verbs that take solids.
void add_solid_input_options(CLI::App& verb, InputOptions& options, OperandKind kind = OperandKind::either,
                             Hulls hulls = Hulls::of_operands);
void add_thin_option(CLI::App& verb, InputOptions& options);
/// Declares --lines, for verbs that take exact results.
void add_lines_option(CLI::App& verb, InputOptions& options);

/// --angle or --degrees, as they were written.
struct AngleOptions {
  std::string angle, degrees;
  bool given() const { return !angle.empty() || !degrees.empty(); }
};

/// Declares --angle RAD and --degrees DEG, of which one may be given.
void add_angle_options(CLI::App& verb, AngleOptions& options, const std::string& what);
/// The angle given. Stops with wrong usage for what is none, and where both are. Requires: given().
Angle read_angle(const AngleOptions& options);

/// Takes numbers from `least` to `most` alone, and refuses others as wrong usage: "--margin wants a number of at least
/// 0, not '-1'".
CLI::Option* within(CLI::Option* option, double least, double most = std::numeric_limits<double>::infinity());
/// The same of whole numbers.
CLI::Option* whole_within(CLI::Option* option, std::size_t least, std::size_t most);
/// Takes one of these names.
CLI::Option* one_of(CLI::Option* option, std::span<const std::string_view> names);
/// Takes the name of an enumerator.
template <names::Enumeration E>
CLI::Option* one_of(CLI::Option* option) {
  return one_of(option, names_of<E>());
}
/// What a name that one_of took stands for.
template <names::Enumeration E>
E named(const std::string& name) {
  return parse<E>(name).value();
}
/// Takes the largest error of an angle: at least Orientation::kAngularError.
CLI::Option* add_error_option(CLI::App& verb, std::optional<double>& error, const std::string& what);

/// Declares --threads of planar sums that move.
void add_threads_option(CLI::App& verb, std::size_t& threads);

/// Stops with wrong usage when one of these options is given: "--axis is for solid operands".
void refuse_options(const CLI::App& verb, const std::vector<std::string>& options, const std::string& why);

}  // namespace dymsum::cli
