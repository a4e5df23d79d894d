// Reading the operands a command line names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/fill.h"
#include "dymsum/planar_operand.h"
#include "dymsum/region.h"
#include "dymsum/region_io.h"
#include "exit_code.h"
#include "json_report.h"

namespace dymsum::cli {

struct InputOptions {
  std::string repairs;  ///< what --repair says, "all" without names; empty: nothing is repaired
  std::string nested;   ///< solids that are repaired: what shells inside of others are
  bool hull = false;    ///< solids: take the convex hull with dymsum::hulled and print its report on standard error
  bool thin = false;    ///< solids: points, segments and open surfaces are operands, too
  bool offers_thin = false;              ///< whether the verb has --thin
  bool offers_repair = false;            ///< whether it has --repair
  std::string fill;                      ///< planar: rings bound what this rule says; of solids that are repaired, too
  bool drop_z = false;                   ///< planar files: third coordinates are left out
  std::string curve_error, curve_bound;  ///< planar files: how curves become chords
  std::string join;                      ///< planar: ends of lines within this are joined
  std::string snap;                      ///< the grid that coordinates are rounded to
  std::string planes;                    ///< solids by their planes: within this, "auto" without a number; empty: not
  std::string lines;                     ///< regions by their lines: likewise
  bool quiet = false;                    ///< repairs are not printed: they were before
  std::string from;                      ///< the format of standard input; empty: told from its first characters
  bool repair() const { return !repairs.empty(); }
};

/// What was read of a file beside its shape, and what was done to it: the keys unit, curves, joined, snap, noise and
/// repair of its entry in `inputs`, where they apply.
using ReadingNotes = Json;

struct Input {
  std::string file;  ///< as it was written on the command line
  Region region;
  ReadingNotes notes = Json::object();
  std::optional<PlanarSum> result = {};  ///< of a file that holds an exact one; `region` is that set in doubles then

  PlanarOperand operand() const { return result ? PlanarOperand(*result) : PlanarOperand(region); }
};

/// The value of a Result, or a Stop with its error: kInterrupted for cancelled, kBadInput otherwise.
template <class T>
T require(Result<T> result);
/// The same for what an option says: a Stop with kUsage that names it.
template <class T>
T require_option(Result<T> result, const std::string& option);
/// The format that the name of an output requests: that there is none is wrong usage.
template <class T>
T require_format(Result<T> format);
[[noreturn]] void stop_with(const Error& error);

/// A file as messages name it: "standard input" for "-".
std::string shown_file(const std::string& file);
/// The error with the file of the operand it is about, where it names none: the one that holds the vertex it names, or
/// else the first one that is empty or has pieces without area.
Error in_operand(Error error, const std::vector<Input>& inputs);
/// The same as require, for what was computed from these operands.
template <class T>
T require_of(const std::vector<Input>& inputs, Result<T> result);

/// Whether an operand is itself a footprint, "[[x,y],...]", and names no file.
bool is_footprint(const std::string& operand);

/// A text without the mark of its byte order.
std::string_view without_mark(std::string_view text);
/// All of standard input, read once, as it is.
const std::string& standard_input();
/// Whether a file, or standard input, holds an exact result in the plane, by its first characters.
bool holds_result(const std::string& file, const InputOptions& options);
/// All shapes of FILE, FILE#NAME, "-" or a footprint.
std::vector<NamedShape> read_all(const std::string& file, const InputOptions& options);
/// The one valid region of FILE, FILE#NAME or "-".
Input read_input(const std::string& file, const InputOptions& options);
/// The same, or the exact result that the file holds.
Input read_operand(const std::string& file, const InputOptions& options);
/// The operands P and Q.
std::vector<Input> read_inputs(const std::vector<std::string>& files, const InputOptions& options);

std::vector<Input> read_operands(const std::vector<std::string>& files, const InputOptions& options);

/// A Stop when the format of standard input is given and no file is it.
void refuse_unused_format(const std::vector<std::string>& files, const InputOptions& options);

/// Validates one shape of a file, or joins, snaps, fills and repairs it where requested.
Result<Input> make_input(NamedShape shape, const std::string& file, const InputOptions& options);

/// The format whose name is given ("poly", "wkt", "geojson", "svg", "json", "dxf", "gpkg").
RegionFormat format_named(const std::string& name);
/// dxf and gpkg where the text begins like one; poly for digits, comments and signs; svg for "<"; wkt for letters; for
/// "{" json when it has "items", else geojson.
RegionFormat format_of_text(std::string_view text);

template <class T>
T require(Result<T> result) {
  if (!result) stop_with(result.error());
  return std::move(result).value();
}

template <class T>
T require_of(const std::vector<Input>& inputs, Result<T> result) {
  if (!result) stop_with(in_operand(result.error(), inputs));
  return std::move(result).value();
}

template <class T>
T require_option(Result<T> result, const std::string& option) {
  if (!result) throw Stop(kUsage, option + ": " + result.error().to_string(), result.error());
  return std::move(result).value();
}

template <class T>
T require_format(Result<T> format) {
  if (!format) throw Stop(kUsage, format.error());
  return std::move(format).value();
}

}  // namespace dymsum::cli
