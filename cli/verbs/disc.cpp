// dymsum disc P --radius R
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "dymsum/growing_disc.h"
#include "inputs.h"
#include "memory_limit.h"
#include "options.h"
#include "outputs.h"
#include "progress_bar.h"
#include "report.h"
#include "timing.h"
#include "verbs/commands.h"
#include "viewer/viewer_pages.h"

namespace dymsum::cli {
namespace {

struct DiscCommand {
  const CLI::App* parser = nullptr;
  std::string p, radius, set = "sum", semantics = "closed";
  std::optional<std::string> bound;
  std::optional<double> error;
  bool events = false;
  double memory_mb = 0;  ///< 0: no limit
  ReportOptions report;
  InputOptions input;
  OutputOptions output;
};

DiscRadius read_radius(const std::string& text) {
  if (!text.starts_with("event:")) return require_option(Rational::parse(text), "--radius");
  const std::string digits = text.substr(6);
  if (digits.empty() || digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos)
    throw Stop(kUsage, "--radius wants a number, or event:K with the index of an event, not '" + text + "'");
  return DiscRadius::at_event(static_cast<std::uint32_t>(std::stoul(digits)));
}

bool writes_polygons(const std::string& file, const OutputOptions& options) {
  const RegionFormat format = output_format(file, options);
  return format != RegionFormat::json && format != RegionFormat::svg;
}

void check(const DiscCommand& command) {
  check_outputs(command.output);
  if (!writes_to_stdout(command.output.files)) refuse_options(*command.parser, {"--to"}, "is the format of -o -");
  const auto& files = command.output.files;
  if (std::none_of(files.begin(), files.end(), [&](const auto& f) { return writes_polygons(f, command.output); }))
    refuse_options(*command.parser, {"--error", "--bound"},
                   "is of polygons: -o FILE.wkt, .poly, .geojson, .dxf or .gpkg");
}

using DiscMaker = std::function<Result<DiscSet>(const DiscRadius&)>;

DiscMaker maker(const GrowingDisc& disc, const DiscCommand& command, const Progress& progress) {
  const Semantics semantics = named<Semantics>(command.semantics);
  if (command.set == "erosion") return [=](const DiscRadius& r) { return disc.eroded_at(r, semantics, progress); };
  if (command.set == "opening") return [=](const DiscRadius& r) { return disc.opened_at(r, semantics, progress); };
  if (command.set == "closing") return [=](const DiscRadius& r) { return disc.closed_at(r, semantics, progress); };
  return [=](const DiscRadius& r) { return disc.sum_at(r, semantics, progress); };
}

DiscSide side_of(const std::string& set) {
  return set == "erosion" || set == "opening" ? DiscSide::inside : DiscSide::outside;
}

/// An event that there is not is wrong usage; what the region has is bad input.
/// A negative radius and an event that there is not are wrong usage; one that is too large or too small for this
/// library is data that it does not take.
DiscSet made_at(const DiscMaker& make, const DiscRadius& r, std::size_t event_count, const std::vector<Input>& inputs) {
  Result<DiscSet> set = make(r);
  if (!set && set.error().code == ErrorCode::out_of_range && set.error().evidence == Evidence{}) {
    const bool misused = r.event ? *r.event >= event_count : r.value.sign() < 0;
    throw Stop(misused ? kUsage : kBadInput, "--radius: " + set.error().message, set.error());
  }
  return require_of(inputs, std::move(set));
}

/// The area with its error: as text where doubles do not hold it.
std::pair<Measure, Measure> any_area(const DiscSet& set) {
  const Measured made = area(set);
  if (set.parts.empty() || (std::isnormal(made.value) && std::isfinite(made.error))) return {made.value, made.error};
  MeasuredText text = area_text(set);
  return {std::move(text.value), std::move(text.error)};
}

/// Polygons that stand for the set, and how they lie to it.
struct MadePolygons {
  DiscPolygons polygons;
  std::string bound;
  bool instead = false;  ///< of those inside, which are no valid region
};

/// A 1000th of the radius, or the least that to_region takes where positions are coarser than that.
double default_error(const DiscSet& set) { return set.radius > 0 ? std::max(set.radius / 1000, 8 * set.at_error) : 1; }

/// The polygons of a set: inside it where nothing is said; nearest to it where those inside cross each other.
MadePolygons made_polygons(const DiscCommand& command, const DiscSet& set) {
  const double error = command.error.value_or(default_error(set));
  const std::string bound = command.bound.value_or("inside");
  Result<DiscPolygons> made = to_region(set, error, named<DiscBound>(bound));
  if (made && (command.bound || made->collapsed == 0)) return {*std::move(made), bound};
  const auto crossed = [](const Result<DiscPolygons>& polygons) {
    return !polygons && polygons.error().code == ErrorCode::rounding_changed_topology;
  };
  // Nearest to it, and where parts of the boundary are closer than the error, within less than that.
  for (double within = error; !command.bound && (made || crossed(made)); within /= 16) {
    Result<DiscPolygons> nearest = to_region(set, within, DiscBound::nearest);
    if (nearest) return {*std::move(nearest), "nearest", true};
    if (!crossed(nearest)) break;
  }
  if (made) return {*std::move(made), bound};
  Error refused = made.error();
  if (crossed(made))
    refused.message += std::string("; ") + (bound == "nearest" || !command.bound ? "" : "--bound nearest or ") +
                       "a smaller --error may do, and -o FILE.json or FILE.svg keeps the arcs";
  if (refused.code == ErrorCode::out_of_range) refused.message = "--error: " + refused.message;
  stop_with(refused);
}

std::optional<MadePolygons> write_outputs(const DiscCommand& command, const Region& p, const DiscSet& set) {
  std::optional<MadePolygons> polygons;
  std::vector<std::string> texts;
  for (const std::string& file : command.output.files) {
    const RegionFormat format = output_format(file, command.output);
    if (format == RegionFormat::json) {
      texts.push_back(disc_set_to_json(set));
    } else if (format == RegionFormat::svg) {
      texts.push_back(draw_disc_set(p, set));
    } else {
      if (!polygons) polygons = made_polygons(command, set);
      texts.push_back(format_region(polygons->polygons.region, format));
    }
  }
  throw_if_interrupted();
  for (std::size_t i = 0; i < texts.size(); ++i) write_text(command.output.files[i], texts[i]);
  return polygons;
}

Json polygons_json(const std::optional<MadePolygons>& made) {
  if (!made) return nullptr;
  return {{"bound", made->bound},
          {"error", made->polygons.error},
          {"chords", made->polygons.chords},
          {"collapsed", made->polygons.collapsed}};
}

Json events_json(const std::vector<DiscEvent>& events) {
  Json list = Json::array();
  for (const DiscEvent& e : events) list.push_back({{"radius", e.radius}, {"nodes", e.nodes}});
  return list;
}

Json disc_json(const DiscCommand& command, const std::vector<Input>& inputs, const DiscSet& set, const Timing& first,
               const Timing& again, const std::vector<DiscEvent>& events, const std::optional<MadePolygons>& polygons) {
  Json json = report_head("disc", inputs_json(inputs), 0, again, {{"complex", first.median_ms}});
  json["set"] = command.set;
  json["semantics"] = command.semantics;
  json["radius"] = set.radius;
  json["radius_exact"] = set.radius_exact;
  json["outer"] = set.parts.size();
  json["holes"] = set.hole_count();
  json["pieces"] = set.piece_count();
  const Measured around = perimeter(set);
  const auto [inside, inside_error] = any_area(set);
  json["area"] = measure_json(inside);
  json["area_error"] = measure_json(inside_error);
  json["perimeter"] = around.value;
  json["perimeter_error"] = around.error;
  json["bounds"] = bounds(set);
  json["at_error"] = set.at_error;
  json["tight"] = {{"points", set.tight_points.size()}, {"segments", set.tight_segments.size()}};
  json["event_count"] = events.size();
  json["events"] = command.events ? events_json(events) : Json(nullptr);
  json["polygons"] = polygons_json(polygons);
  return json;
}

/// The area, with its error where that is more than a billionth of it.
std::string area_shown(const DiscSet& set) {
  const auto [value, error] = any_area(set);
  const Measured rough = area(set);
  constexpr double kNegligible = 1e-9;
  if (set.parts.empty() || rough.error <= kNegligible * rough.value) return shown(value);
  return shown(value) + " within " + shown(error);
}

void print_disc(std::ostream& out, const DiscCommand& command, const DiscSet& set, const Timing& timing,
                const std::vector<DiscEvent>& events, const std::optional<MadePolygons>& polygons) {
  std::ostringstream text;
  text.precision(17);
  text << command.set << " with a disc of radius " << set.radius << ": " << counted(set.parts.size(), "part") << ", "
       << counted(set.hole_count(), "hole") << ", " << counted(set.piece_count(), "piece") << ", area "
       << area_shown(set) << "\n";
  if (!set.tight_points.empty() || !set.tight_segments.empty())
    text << "tight: " << counted(set.tight_points.size(), "point") << ", "
         << counted(set.tight_segments.size(), "segment") << "\n";
  if (command.events)
    for (std::size_t i = 0; i < events.size(); ++i)
      text << "event:" << i << " " << events[i].radius << (events[i].nodes > 1 ? "  " : "")
           << (events[i].nodes > 1 ? counted(events[i].nodes, "node") : "") << "\n";
  if (polygons && polygons->polygons.collapsed > 0 && polygons->bound == "inside")
    text << "polygons: what is no wider than " << 2 * polygons->polygons.error
         << " may be left out (-o FILE.json keeps the arcs)\n";
  else if (polygons && polygons->polygons.collapsed > 0)
    text << "polygons: " << counted(polygons->polygons.collapsed, "place", "places")
         << " no wider than positions are known: points, lines, or closed (-o FILE.json keeps the arcs)\n";
  if (polygons && (polygons->instead || (!command.error && polygons->polygons.error > set.radius / 1000)))
    text << "polygons: " << polygons->bound << ", within " << polygons->polygons.error
         << (polygons->instead ? "; those inside the set cross each other (--bound, --error)\n" : " (--error)\n");
  out << text.str();
  print_times(out, timing);
}

ExitCode run_disc(const DiscCommand& command) {
  limit_memory(command.memory_mb);
  std::ostream& out = report_stream(command.output.files, command.report.json);
  check(command);
  const DiscRadius radius = read_radius(command.radius);
  refuse_unused_format({command.p}, command.input);
  std::vector<Input> inputs{read_input(command.p, command.input)};
  const InterruptGuard guard;
  const GrowingDisc disc(inputs[0].region);
  std::optional<ProgressBar> bar(std::in_place);
  const DiscMaker make = maker(disc, command, bar->callback());
  const auto make_set = [&] {
    const std::size_t events =
        radius.event ? require_of(inputs, disc.events(side_of(command.set), bar->callback())).size() : 0;
    return made_at(make, radius, events, inputs);
  };
  const auto [set_once, first] = timed(1, make_set);
  const auto [set, again] = timed(command.report.repeat, [&] {
    throw_if_interrupted();
    return make_set();
  });
  const std::vector<DiscEvent> events = require(disc.events(side_of(command.set)));
  bar.reset();
  const std::optional<MadePolygons> polygons = write_outputs(command, inputs[0].region, set);
  if (command.report.json) print_report(disc_json(command, inputs, set, first, again, events, polygons));
  else print_disc(out, command, set, again, events, polygons);
  const bool empty = set.parts.empty() && set.segments.empty() && set.points.empty() && set.tight_segments.empty() &&
                     set.tight_points.empty();
  return empty && side_of(command.set) == DiscSide::inside ? kNo : kDone;
}

void add_disc_outputs(CLI::App& verb, DiscCommand& command) {
  verb.add_option(
          "-o", command.output.files,
          "Write the result; repeatable; by extension .json (exact, pieces by name), .svg (true arcs), .poly .wkt "
          ".geojson .dxf .gpkg (polygons), .html (the viewer); - is standard output")
      ->type_name("FILE")
      ->allow_extra_args(false);
  one_of<RegionFormat>(verb.add_option("--to", command.output.to, "Format of -o -"))->capture_default_str();
  within(verb.add_option("--error", command.error, "Of polygons: how far they may be from the arcs; a 1000th of R"), 0)
      ->type_name("E");
  one_of<DiscBound>(verb.add_option(
      "--bound", command.bound,
      "Of polygons: inside the set (what is made if not given; nearest where that is no valid region), outside "
      "around it, or nearest, with vertices on its boundary"));
}

}  // namespace

void add_disc(CLI::App& app, Action& action) {
  auto command = std::make_shared<DiscCommand>();
  CLI::App& verb = *app.add_subcommand(
      "disc", "A planar region grown, shrunk, opened or closed by an exact disc: boundaries of segments and arcs");
  command->parser = &verb;
  verb.add_option("P", command->p, "The region: a file, FILE#NAME, or - for standard input")->required()->type_name("");
  verb.add_option("--radius", command->radius,
                  "Radius of the disc, exact: 3/2, 0.1, 1e-3; or event:K, exactly the radius of event K")
      ->required()
      ->type_name("R");
  verb.add_option(
          "--set", command->set,
          "sum: P with all that is R away at most; erosion: where discs fit inside P; opening: what discs inside "
          "P cover; closing: what discs outside P do not")
      ->check(CLI::IsMember({"sum", "erosion", "opening", "closing"}))
      ->capture_default_str();
  one_of<Semantics>(
      verb.add_option(
          "--semantics", command->semantics,
          "closed; open: touching is allowed, and tight features are listed; regular: exact fits do not count"))
      ->capture_default_str();
  verb.add_flag("--events", command->events, "List the radii at which the boundary's pieces change");
  add_memory_limit(verb, command->memory_mb);
  add_disc_outputs(verb, *command);
  add_report_options(verb, command->report, "Compute N times and report the median and minimum time of a radius");
  add_input_options(verb, command->input);
  verb.footer(
      "Ends with 4 where no disc fits (erosion, opening).\n"
      "Example: dymsum disc part.wkt --radius 3/2 --set opening -o opened.svg -o opened.json");
  verb.callback([command, &action] {
    action = [command] {
      return run_with_pages({command->parser, "discs", ""}, {command->p}, command->input, command->output.files,
                            [command] { return run_disc(*command); });
    };
  });
}

}  // namespace dymsum::cli
