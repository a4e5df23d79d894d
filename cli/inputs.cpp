#include "inputs.h"

#include "dymsum/names.h"
#include "dymsum/planar_boolean.h"
#include "dymsum/snap_rounding.h"
#include "dymsum/sum_io.h"
#include "numbers.h"
#include "planar/line_operands.h"
#include "planar/open_ends.h"
#include "repairs.h"
#include "snapped_operand.h"

#include <algorithm>
#include <cctype>
#include <iostream>
#include <iterator>
#include <utility>

namespace dymsum::cli {

void stop_with(const Error& error) {
  if (error.code == ErrorCode::cancelled) throw Stop(kInterrupted, "interrupted");
  throw Stop(kBadInput, error);
}

std::string shown_file(const std::string& file) { return file == "-" ? "standard input" : file; }

namespace {

bool has_vertex(const Region& region, const Point& at) {
  const auto has = [&](const std::vector<Point>& points) {
    return std::find(points.begin(), points.end(), at) != points.end();
  };
  return has(region.points()) || std::any_of(region.polylines().begin(), region.polylines().end(), has) ||
         std::any_of(region.parts().begin(), region.parts().end(), [&](const Part& part) {
           return has(part.outer) || std::any_of(part.holes.begin(), part.holes.end(), has);
         });
}

bool is_thin(const Region& r) { return !r.polylines().empty() || !r.points().empty(); }

}  // namespace

Error in_operand(Error error, const std::vector<Input>& inputs) {
  if (!error.evidence.file.empty()) return error;
  const auto name_first = [&](const auto& at_fault) {
    const auto input = std::find_if(inputs.begin(), inputs.end(), at_fault);
    if (input != inputs.end()) error.evidence.file = shown_file(input->file);
    return input != inputs.end();
  };
  if (error.evidence.x && error.evidence.y) {
    const Point at{*error.evidence.x, *error.evidence.y};
    const bool any_thin =
        std::any_of(inputs.begin(), inputs.end(), [](const Input& input) { return is_thin(input.region); });
    const auto touches = [&](const Input& input) {
      const std::vector<Point>& points = input.region.touching_points();
      return any_thin && !is_thin(input.region) && std::find(points.begin(), points.end(), at) != points.end();
    };
    const auto holds = [&](const Input& input) { return has_vertex(input.region, at); };
    // Of two operands with a vertex there the one at fault has rings that touch, beside polylines of the other one; or
    // else polylines.
    if (name_first(touches) || name_first([&](const Input& input) { return is_thin(input.region) && holds(input); }) ||
        name_first(holds))
      return error;
  }
  if (error.code != ErrorCode::unsupported_operand) return error;
  if (!name_first([](const Input& input) { return input.region.empty(); }))
    name_first([](const Input& input) { return is_thin(input.region); });
  return error;
}

RegionFormat format_named(const std::string& name) { return require(region_format("." + name)); }

RegionFormat format_of_text(std::string_view text) {
  text = without_mark(text);
  const auto first = std::find_if_not(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c) != 0; });
  if (first == text.end()) return RegionFormat::poly;
  if (begins_like_dxf(text)) return RegionFormat::dxf;
  if (text.starts_with("SQLite format 3")) return RegionFormat::gpkg;
  if (*first == '<') return RegionFormat::svg;
  if (*first == '{' || *first == '[') {
    return text.find("\"items\"") == std::string_view::npos ? RegionFormat::geojson : RegionFormat::json;
  }
  return std::isalpha(static_cast<unsigned char>(*first)) != 0 ? RegionFormat::wkt : RegionFormat::poly;
}

bool is_footprint(const std::string& operand) { return operand.starts_with("["); }

std::string_view without_mark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  return text.starts_with(kByteOrderMark) ? text.substr(kByteOrderMark.size()) : text;
}

const std::string& standard_input() {
  static const std::string text{std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>()};
  if (text.starts_with("\x1f\x8b"))
    throw Stop(kBadInput, "standard input is compressed; unpack it on the way (zcat), or name the file");
  return text;
}

namespace {

CurveOptions curves_of(const InputOptions& options) {
  CurveOptions curves;
  if (!options.curve_error.empty()) curves.error = finite_number(options.curve_error);
  if (options.curve_bound == "inside") curves.bound = CurveBound::inside;
  if (options.curve_bound == "outside") curves.bound = CurveBound::outside;
  return curves;
}

/// What `read` makes of files, with third coordinates as the options say; where it is these that are refused, the
/// option that leaves them out is named.
template <class Read>
auto read_planar(const InputOptions& options, Read read) {
  ReadOptions how{options.drop_z ? ThirdCoordinates::dropped : ThirdCoordinates::refused, curves_of(options)};
  auto result = read(how);
  if (result) return std::move(result).value();
  Error error = result.error();
  how.third = ThirdCoordinates::dropped;
  if (!options.drop_z && error.code == ErrorCode::malformed && read(how))
    error.message += " (--drop-z leaves third coordinates out)";
  stop_with(error);
}

}  // namespace

namespace {

void refuse_options_of_solids(const InputOptions& options) {
  if (options.hull) throw Stop(kUsage, "--hull is for solids");
  if (!options.planes.empty()) throw Stop(kUsage, "--planes is for solids");
}

}  // namespace

std::vector<NamedShape> read_all(const std::string& file, const InputOptions& options) {
  refuse_options_of_solids(options);
  if (is_footprint(file)) return require(parse_shapes(file, RegionFormat::json, "footprint"));
  if (file != "-") return read_planar(options, [&](const ReadOptions& how) { return read_shapes(file, how); });
  const std::string& text = standard_input();
  const RegionFormat format = options.from.empty() ? format_of_text(text) : format_named(options.from);
  return read_planar(options,
                     [&](const ReadOptions& how) { return parse_shapes(text, format, "standard input", how); });
}

namespace {

constexpr const char* kFillHint = " (--fill RULE takes what the rings bound: nonzero, positive or even_odd)";

/// What filling rings would repair.
bool is_about_rings(ErrorCode code) {
  return code == ErrorCode::self_crossing || code == ErrorCode::rings_cross || code == ErrorCode::hole_outside ||
         code == ErrorCode::parts_overlap || code == ErrorCode::no_area;
}

}  // namespace

namespace {

/// The steps of make_input.
class RegionMaker {
 public:
  RegionMaker(NamedShape shape, const std::string& file, const InputOptions& options)
      : shape_(std::move(shape)), file_(file), options_(options) {}

  Result<Input> run() {
    if (!shape_.unit.empty()) notes_["unit"] = shape_.unit;
    if (shape_.curves > 0) notes_["curves"] = shape_.curves;
    std::optional<Error> error = join();
    if (!error) error = snap_operand(shape_.data, file_, options_, notes_);
    if (error) return in_file(*std::move(error));
    Result<Region> region = !options_.fill.empty() ? filled() : options_.repair() ? repaired() : as_it_is();
    if (!region) return in_file(region.error());
    return Input{file_, std::move(region).value(), std::move(notes_)};
  }

 private:
  Error in_file(Error error) const {
    if (error.evidence.file.empty()) error.evidence.file = shown_file(file_);
    return error;
  }
  void say(const std::string& what) const {
    if (!options_.quiet) std::cerr << file_ << ": " << what << "\n";
  }

  std::optional<Error> join() {
    if (options_.join.empty()) {
      if (!options_.quiet) report_open_ends(shape_.data, file_);
      return std::nullopt;
    }
    Result<JoinedChains> joined = joined_chains(std::move(shape_.data), *finite_number(options_.join));
    if (!joined) return joined.error();
    if (joined->report.changed()) say(joined->report.to_string());
    if (joined->report.changed())
      notes_["joined"] = {{"gaps", joined->report.joints},
                          {"largest_gap", joined->report.largest_gap},
                          {"rings", joined->report.rings}};
    shape_.data = std::move(joined).value().data;
    return std::nullopt;
  }

  Result<Region> filled() {
    Result<FilledRegion> made = repair_with_fill(shape_.data, parse<Fill>(options_.fill).value());
    if (!made) return made.error();
    if (made->report.changed()) say(made->report.to_string());
    return std::move(made).value().region;
  }

  Result<Region> as_it_is() const {
    Result<Region> region = Region::create(shape_.data);
    if (region || !options_.offers_repair) return region;
    Error error = region.error();
    if (const auto after_repair = repair(shape_.data, RegionRepairOptions{}))
      error.message += remedy(after_repair->log);
    else if (is_about_rings(error.code)) error.message += kFillHint;
    return error;
  }

  Result<Region> repaired() {
    Result<LoggedRegion> made = repair(shape_.data, RegionRepairOptions{named_repairs(options_.repairs).planar});
    if (made) {
      if (made->log.changed()) {
        say("repaired: " + made->log.to_string());
        say("repaired: " + positions_text(made->log));
        notes_["repair"] = repair_json(made->log);
      }
      return std::move(made).value().region;
    }
    Error error = made.error();
    if (const auto with_all = repair(shape_.data, RegionRepairOptions{})) error.message += remedy(with_all->log);
    else if (is_about_rings(error.code)) error.message += kFillHint;
    return error;
  }

  NamedShape shape_;
  const std::string& file_;
  const InputOptions& options_;
  ReadingNotes notes_ = Json::object();
};

}  // namespace

Result<Input> make_input(NamedShape shape, const std::string& file, const InputOptions& options) {
  if (!options.nested.empty()) throw Stop(kUsage, "--nested is for solids");
  if (options.repair() && named_repairs(options.repairs).planar.empty())
    throw Stop(kUsage, "--repair=" + options.repairs + " names repairs of solids alone");
  return RegionMaker(std::move(shape), file, options).run();
}

bool holds_result(const std::string& file, const InputOptions& options) {
  if (is_footprint(file)) return false;
  if (file != "-") return names_sum(file);
  return (options.from.empty() || options.from == "json") && begins_like_sum(without_mark(standard_input()));
}

Input read_input(const std::string& file, const InputOptions& options) {
  if (holds_result(file, options))
    throw Stop(kBadInput, shown_file(file) +
                              ": sums, fits and Boolean operations take an exact result, and so do contains, info and "
                              "convert; others take it in doubles, as dymsum convert FILE.json FILE.wkt writes it");
  refuse_options_of_solids(options);
  if (!options.lines.empty())
    throw Stop(kUsage,
               "--lines makes exact results, which only sums, fits, Boolean operations, contains, info and "
               "convert take");
  if (file != "-" && !is_footprint(file)) {
    const auto read = [&](const ReadOptions& how) { return read_shape(file, how); };
    return require(make_input(read_planar(options, read), file, options));
  }
  std::vector<NamedShape> shapes = read_all(file, options);
  if (shapes.size() != 1) {
    throw Stop(kBadInput, "standard input: holds " + std::to_string(shapes.size()) +
                              " shapes, and one is needed: of a file it can be selected, as FILE#NAME");
  }
  return require(make_input(std::move(shapes.front()), file, options));
}

Input read_operand(const std::string& file, const InputOptions& options) {
  if (!options.lines.empty()) return std::move(read_by_lines({file}, options)[0]);
  if (!holds_result(file, options)) return read_input(file, options);
  if (!options.snap.empty())
    throw Stop(kUsage, "--snap is for coordinates in doubles, and " + shown_file(file) +
                           " holds an exact result; written as .wkt it is in doubles");
  PlanarSum result = require(file == "-" ? parse_sum(standard_input(), "standard input") : read_sum(file));
  Region region = require(snap_rounded(result)).region;
  return {file, std::move(region), Json::object(), std::move(result)};
}

void refuse_unused_format(const std::vector<std::string>& files, const InputOptions& options) {
  if (!options.from.empty() && std::count(files.begin(), files.end(), "-") == 0)
    throw Stop(kUsage, "--from is the format of standard input, and no operand is -");
}

std::vector<Input> read_inputs(const std::vector<std::string>& files, const InputOptions& options) {
  refuse_unused_format(files, options);
  std::vector<Input> inputs;
  for (const std::string& file : files) inputs.push_back(read_input(file, options));
  return inputs;
}

std::vector<Input> read_operands(const std::vector<std::string>& files, const InputOptions& options) {
  refuse_unused_format(files, options);
  if (!options.lines.empty()) return read_by_lines(files, options);
  std::vector<Input> inputs;
  for (const std::string& file : files) inputs.push_back(read_operand(file, options));
  return inputs;
}

}  // namespace dymsum::cli
