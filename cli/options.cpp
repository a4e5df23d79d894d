#include "options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <functional>
#include <sstream>
#include <system_error>

#include "dymsum/orientation.h"
#include "repairs.h"

namespace dymsum::cli {
namespace {

using Takes = std::function<bool(const std::string& text)>;

/// Refuses texts that an option does not take, in one sentence for all options.
CLI::Option* takes(CLI::Option* option, const std::string& wanted, const Takes& accepted) {
  const auto check = [name = option->get_name(), wanted, accepted](std::string& text) -> std::string {
    if (accepted(text)) return "";
    throw Stop(kUsage, name + " wants " + wanted + ", not '" + text + "'");
  };
  return option->check(CLI::Validator(check, ""));
}

std::string digits(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

}  // namespace

CLI::Option* within(CLI::Option* option, double least, double most) {
  const std::string bounds =
      std::isinf(most) ? "of at least " + digits(least) : "from " + digits(least) + " to " + digits(most);
  return takes(option, "a number " + bounds, [least, most](const std::string& text) {
    const std::optional<double> value = finite_number(text);
    return value && *value >= least && *value <= most;
  });
}

CLI::Option* whole_within(CLI::Option* option, std::size_t least, std::size_t most) {
  const std::string wanted = "a whole number from " + std::to_string(least) + " to " + std::to_string(most);
  return takes(option, wanted, [least, most](const std::string& text) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() && value >= least && value <= most;
  });
}

CLI::Option* one_of(CLI::Option* option, std::span<const std::string_view> names) {
  return option->check(CLI::IsMember(std::vector<std::string>(names.begin(), names.end())));
}

CLI::Option* add_error_option(CLI::App& verb, std::optional<double>& error, const std::string& what) {
  return takes(verb.add_option("--error", error, what)->type_name("E"), "a number of at least 8.9e-16, 2^-50",
               [](const std::string& text) { return finite_number(text).value_or(0) >= Orientation::kAngularError; });
}

void add_operands(CLI::App& verb, const Operand& first, const Operand& second, std::vector<std::string>& operands,
                  OperandKind kind) {
  // Files of solids hold one shape.
  const char* const file = kind == OperandKind::solid
                               ? ": a file, or - for standard input"
                               : ": a file, FILE#NAME for one shape of several, or - for standard input";
  verb.add_option(first.name, operands[0], first.what + file)->required()->type_name("");
  verb.add_option(second.name, operands[1], second.what + file)->required()->type_name("");
}

void add_angle_options(CLI::App& verb, AngleOptions& options, const std::string& what) {
  verb.add_option("--angle", options.angle, what + " in radians, or with deg behind it in degrees: 90deg")
      ->type_name("RAD");
  verb.add_option("--degrees", options.degrees, what + " in degrees")->type_name("DEG");
}

Angle read_angle(const AngleOptions& options) {
  if (!options.angle.empty() && !options.degrees.empty()) throw Stop(kUsage, "give one of --angle and --degrees");
  const bool radians = !options.angle.empty();
  const std::optional<Angle> angle = angle_in(radians ? options.angle : options.degrees + "deg");
  if (angle) return *angle;
  throw Stop(kUsage, radians ? "--angle wants a number of radians, or of degrees as 90deg, not '" + options.angle + "'"
                             : "--degrees wants a number of degrees, not '" + options.degrees + "'");
}

void add_threads_option(CLI::App& verb, std::size_t& threads) {
  whole_within(verb.add_option("--threads", threads,
                               "Planar: with 2 or more the next window of frames is made ahead on a thread of its own, "
                               "and no frame waits for it; the sums are the same"),
               1, 1024)
      ->type_name("N")
      ->capture_default_str();
}

void refuse_options(const CLI::App& verb, const std::vector<std::string>& options, const std::string& why) {
  for (const std::string& name : options)
    if (const CLI::Option* option = verb.get_option_no_throw(name); option && option->count() > 0)
      throw Stop(kUsage, name + " " + why);
}

void add_report_options(CLI::App& verb, ReportOptions& options, const std::string& repeated) {
  verb.add_flag("--json", options.json, "Print one JSON object with the result's summary");
  whole_within(verb.add_option("--repeat", options.repeat, repeated), 1, 1000000000)
      ->type_name("N")
      ->capture_default_str();
}

namespace {

void add_snap_option(CLI::App& verb, InputOptions& options) {
  verb.add_option("--snap", options.snap,
                  "Round coordinates to multiples of a grid, 2^-20 or a power of ten such as 1e-6, and say on standard "
                  "error what that moved")
      ->type_name("GRID");
}

void add_curve_options(CLI::App& verb, InputOptions& options, const std::string& planar) {
  const auto length = [](const std::string& text) { return finite_number(text).value_or(0) > 0; };
  takes(verb.add_option("--curve-error", options.curve_error,
                        planar + "how far chords may be from the curves of a file that they stand for, in its units. "
                                 "If not given, a thousandth of an arc's radius or a curve's size")
            ->type_name("E"),
        "a number above 0", length);
  verb.add_option("--curve-bound", options.curve_bound,
                  planar + "on which side of the curves that bound a region chords lie; nearest if not given")
      ->check(CLI::IsMember({"inside", "outside", "nearest"}));
  takes(verb.add_option("--join", options.join,
                        planar + "join lines whose ends are no further apart than this, and take closed ones as rings")
            ->type_name("TOLERANCE"),
        "a number of at least 0", [](const std::string& text) { return finite_number(text).value_or(-1) >= 0; });
}

}  // namespace

void add_repair_option(CLI::App& verb, InputOptions& options, OperandKind kind) {
  const std::string planar = "merge duplicate and collinear vertices, drop rings that are there twice, fix orientation",
                    solid =
                        "merge duplicate vertices, drop unused ones, faces without area and walls inside, split edges "
                        "at vertices of neighbours on them and faces that are not plane, turn over faces and shells",
                    what = kind == OperandKind::planar  ? planar
                           : kind == OperandKind::solid ? solid
                                                        : planar + "; of solids: " + solid;
  options.offers_repair = true;
  const std::string some = kind == OperandKind::planar ? "reversed-rings,empty-rings" : "needles,t-junctions";
  verb.add_flag("--repair{all}", options.repairs,
                "Repair operands, and say on standard error what changed and where: " + what +
                    ". With names only those: --repair=" + some)
      ->check(CLI::Validator([](std::string& names) { return named_repairs(names), std::string(); }, ""));
  one_of<Fill>(verb.add_option(
      "--fill", options.fill,
      kind == OperandKind::solid
          ? "With --repair: what surfaces that cross bound, by winding number"
          : "Take what rings bound that cross, lie on each other or run the wrong way, by winding number, "
            "and say on standard error what changed" +
                std::string(kind == OperandKind::planar ? "" : "; solids: with --repair, what surfaces bound")));
  add_snap_option(verb, options);
  if (kind != OperandKind::planar)
    verb.add_option("--nested", options.nested,
                    "With --repair: what a shell inside of another one is that runs the same way: the boundary of a "
                    "cavity (the default), or of a body that adds nothing")
        ->check(CLI::IsMember({"cavity", "solid"}));
  if (kind == OperandKind::solid) return;
  add_curve_options(verb, options, kind == OperandKind::planar ? "" : "Planar: ");
  verb.add_flag("--drop-z", options.drop_z,
                std::string(kind == OperandKind::planar ? "Leave" : "Planar: leave") +
                    " out third coordinates and measures (Z, M) that files hold, instead of refusing them");
}

void add_exact_option(CLI::App& verb, ReportOptions& options, OperandKind kind) {
  const std::string key = kind == OperandKind::planar  ? "area_exact"
                          : kind == OperandKind::solid ? "volume_exact"
                                                       : "area_exact (of solids volume_exact)";
  const std::string length = kind == OperandKind::solid ? "" : "for regions of more than 10000 vertices, and ";
  verb.add_flag("--exact", options.exact,
                "With --json: " + key + " as a fraction of any length. Else it is null " + length +
                    "where the denominators of the vertices, powers of two apart, have more than 16384 bits together: "
                    "thousands of crossings take minutes. Areas and volumes are correctly rounded always")
      ->needs("--json");
}

std::vector<std::string_view> file_formats(OperandKind kind) {
  std::vector<std::string_view> formats;
  if (kind != OperandKind::solid) formats.assign(names_of<RegionFormat>().begin(), names_of<RegionFormat>().end());
  if (kind != OperandKind::planar) formats.insert(formats.end(), {"off", "obj", "stl", "ply", "glb", "3mf"});
  return formats;
}

void add_from_option(CLI::App& verb, InputOptions& options, OperandKind kind) {
  const std::vector<std::string_view> formats = file_formats(kind);
  const std::string but = kind == OperandKind::planar ? "" : " (not of binary .stl)";
  one_of(verb.add_option("--from", options.from,
                         "Format of standard input; otherwise told from its first characters" + but),
         formats);
}

void add_input_options(CLI::App& verb, InputOptions& options) {
  add_repair_option(verb, options, OperandKind::planar);
  add_from_option(verb, options, OperandKind::planar);
}

namespace {

/// Of an option that may be given without a number.
void takes_tolerance(CLI::Option* option) {
  takes(option, "a positive number", [](const std::string& text) {
    return text == "auto" || text == "false" || finite_number(text).value_or(-1) > 0;
  });
}

}  // namespace

void add_solid_input_options(CLI::App& verb, InputOptions& options, OperandKind kind, Hulls hulls) {
  add_repair_option(verb, options, kind);
  const std::string of = kind == OperandKind::either ? "Solids: take" : "Take",
                    results = hulls == Hulls::of_results_too ? "; of rounded results that are convex too" : "";
  verb.add_flag("--hull", options.hull,
                of +
                    " the exact convex hull of each operand, for those that are convex but for rounding, and say on "
                    "standard error how far the surface was from it" +
                    results)
      ->excludes("--repair");
  takes_tolerance(verb.add_flag("--planes{auto}", options.planes,
                                of + " the faces of each operand as they were meant: plane, and parallel, where they "
                                     "are so to within --planes=TOLERANCE or rounding, and say how far vertices moved")
                      ->excludes("--repair")
                      ->excludes("--hull"));
  add_from_option(verb, options, kind);
}

void add_lines_option(CLI::App& verb, InputOptions& options) {
  takes_tolerance(verb.add_flag("--lines{auto}", options.lines,
                                "Regions: take the edges of each operand as they were meant: on common lines, parallel "
                                "and at right angles, where they are so to within --lines=TOLERANCE or rounding, and "
                                "say how far vertices moved"));
}

void add_thin_option(CLI::App& verb, InputOptions& options) {
  options.offers_thin = true;
  verb.add_flag(
          "--thin", options.thin,
          "Solids: take points, segments and open surfaces in the files as parts without volume; of a solid with a "
          "gap only its surface is left")
      ->excludes("--hull");
}

}  // namespace dymsum::cli
