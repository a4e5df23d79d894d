#include "inputs.h"

#include "dymsum/names.h"
#include "dymsum/planar_boolean.h"
#include "planar/open_ends.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <system_error>
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
  if (*first == '<') return RegionFormat::svg;
  if (*first == '{' || *first == '[') {
    return text.find("\"items\"") == std::string_view::npos ? RegionFormat::geojson : RegionFormat::json;
  }
  return std::isalpha(static_cast<unsigned char>(*first)) != 0 ? RegionFormat::wkt : RegionFormat::poly;
}

bool is_footprint(const std::string& operand) { return operand.starts_with("["); }

std::string file_of_operand(const std::string& operand) {
  std::error_code unknown;
  return std::filesystem::exists(operand, unknown) ? operand : operand.substr(0, operand.rfind('#'));
}

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

/// What `read` makes of files, with third coordinates as the options say; where it is these that are refused, the
/// option that leaves them out is named.
template <class Read>
auto read_planar(const InputOptions& options, Read read) {
  auto result = read(options.drop_z ? ThirdCoordinates::dropped : ThirdCoordinates::refused);
  if (result) return std::move(result).value();
  Error error = result.error();
  if (!options.drop_z && error.code == ErrorCode::malformed && read(ThirdCoordinates::dropped))
    error.message += " (--drop-z leaves third coordinates out)";
  stop_with(error);
}

}  // namespace

std::vector<NamedShape> read_all(const std::string& file, const InputOptions& options) {
  if (options.hull) throw Stop(kUsage, "--hull is for solids");
  if (is_footprint(file)) return require(parse_shapes(file, RegionFormat::json, "footprint"));
  if (file != "-") return read_planar(options, [&](ThirdCoordinates third) { return read_shapes(file, third); });
  const std::string& text = standard_input();
  const RegionFormat format = options.from.empty() ? format_of_text(text) : format_named(options.from);
  return read_planar(options,
                     [&](ThirdCoordinates third) { return parse_shapes(text, format, "standard input", third); });
}

std::string remedy(const std::string& changes) { return " (--repair mends it: " + changes + ")"; }

namespace {

constexpr const char* kFillHint = " (--fill RULE takes what the rings bound: nonzero, positive or even_odd)";

/// What filling rings would repair.
bool is_about_rings(ErrorCode code) {
  return code == ErrorCode::self_crossing || code == ErrorCode::rings_cross || code == ErrorCode::hole_outside ||
         code == ErrorCode::parts_overlap || code == ErrorCode::no_area;
}

}  // namespace

Result<Region> make_region(RegionData data, const std::string& file, const InputOptions& options) {
  const auto in_file = [&](Error error) {
    if (error.evidence.file.empty()) error.evidence.file = shown_file(file);
    return error;
  };
  if (!options.quiet) report_open_ends(data, file);
  if (!options.fill.empty()) {
    Result<FilledRegion> made = repair_with_fill(data, parse<Fill>(options.fill).value());
    if (!made) return in_file(made.error());
    if (!options.quiet && made->report.changed()) std::cerr << file << ": " << made->report.to_string() << "\n";
    return std::move(made).value().region;
  }
  if (!options.repair) {
    Result<Region> region = Region::create(data);
    if (region) return region;
    Error error = region.error();
    if (const Result<Repaired> after_repair = repair(std::move(data)); after_repair && options.offers_repair)
      error.message += remedy(after_repair->report.to_string());
    else if (options.offers_repair && is_about_rings(error.code)) error.message += kFillHint;
    return in_file(std::move(error));
  }
  Result<Repaired> repaired = repair(std::move(data));
  if (!repaired) {
    Error error = repaired.error();
    if (is_about_rings(error.code)) error.message += kFillHint;
    return in_file(std::move(error));
  }
  if (repaired->report.changed() && !options.quiet)
    std::cerr << file << ": repaired: " << repaired->report.to_string() << "\n";
  return std::move(repaired).value().region;
}

Input read_input(const std::string& file, const InputOptions& options) {
  if (options.hull) throw Stop(kUsage, "--hull is for solids");
  if (file != "-" && !is_footprint(file))
    return {file, require(make_region(
                      read_planar(options, [&](ThirdCoordinates third) { return read_region_data(file, third); }), file,
                      options))};
  std::vector<NamedShape> shapes = read_all(file, options);
  if (shapes.size() != 1) {
    throw Stop(kBadInput, "standard input: holds " + std::to_string(shapes.size()) +
                              " shapes, and one is needed: of a file it can be selected, as FILE#NAME");
  }
  return {file, require(make_region(std::move(shapes.front().data), file, options))};
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

}  // namespace dymsum::cli
