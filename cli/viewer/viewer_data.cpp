#include "viewer/viewer_data.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "solid/solid_outputs.h"
#include "solid/solid_results.h"

namespace dymsum::cli {
namespace {

namespace fs = std::filesystem;

/// Options about outputs, reports and this program's own work, or done to the inputs already: nothing of it changes
/// what is shown.
constexpr std::array<std::string_view, 16> kNotShown{
    "o",    "json",    "repeat", "exact", "memory", "threads",  "help",         "port",
    "page", "no-open", "repair", "hull",  "margin", "obstacle", "round-repair", "round"};

/// Formats of standard input and output, but of a path its ends.
bool is_format(const std::string& option, const CLI::App& verb) {
  return (option == "from" || option == "to") && verb.get_name() != "path";
}

std::string bytes_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) throw Stop(kBadInput, file + ": cannot be read");
  return bytes;
}

bool is_map(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension == ".yaml" || extension == ".yml" || extension == ".map";
}

/// The extension of the format that standard input is in.
std::string extension_of_input(const InputOptions& options) {
  constexpr std::array kPlanar{".poly", ".wkt", ".geojson", ".svg",
                               ".json", ".dxf", ".gpkg"};                       // as RegionFormat has them
  constexpr std::array kSolid{".off", ".obj", ".stl", ".ply", ".glb", ".3mf"};  // as MeshFormat has them
  if (!options.from.empty()) return "." + options.from;
  if (const std::optional<MeshFormat> solid = mesh_format_of_input(options)) return kSolid.at(std::size_t(*solid));
  return kPlanar.at(std::size_t(format_of_text(standard_input())));
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

bool is_utf8(const std::string& bytes) {
  try {
    Json(bytes).dump();
    return true;
  } catch (const Json::type_error&) {
    return false;
  }
}

Json input_json(const ViewerInput& input) {
  if (is_utf8(input.bytes)) return {{"name", input.name}, {"text", input.bytes}};
  return {{"name", input.name}, {"base64", base64(input.bytes)}};
}

/// Whether an operand is not all that its file holds, or not as it stands there.
bool is_made(const std::string& operand, const InputOptions& options) {
  const auto ends = [&](const char* with) { return file_of_shape(operand).ends_with(with); };
  if (ends(".gz") || ends(".3mf") || ends(".glb") || ends(".gpkg")) return true;  // formats that the page does not take
  return holds_solid_result(operand, options) || holds_result(operand, options) || options.repair() ||
         !options.fill.empty() || !options.join.empty() || !options.snap.empty() || !options.curve_error.empty() ||
         !options.curve_bound.empty() || options.hull || is_map(operand) || file_of_shape(operand) != operand;
}

ViewerInput made_input(const std::string& operand, InputOptions options) {
  options.quiet = true;
  if (holds_solid_result(operand, options))
    return {shape_name(operand) + ".off", solid_output(read_solid_result(operand, options), operand + ".off")};
  if (names_solid(operand, options))
    return {shape_name(operand) + ".off", format_mesh(read_solid(operand, options).mesh, MeshFormat::off)};
  if (holds_result(operand, options))
    return {shape_name(operand) + ".wkt", format_region(read_operand(operand, options).region, RegionFormat::wkt)};
  std::string text;
  for (NamedShape& shape : read_all(operand, options))
    text += format_region(require(make_input(std::move(shape), operand, options)).region, RegionFormat::wkt);
  return {shape_name(operand) + ".wkt", text};
}

}  // namespace

std::string shape_name(const std::string& operand) {
  if (operand == "-") return "input";
  if (is_footprint(operand)) return "footprint";
  const std::string file = file_of_shape(operand), stem = fs::path(file).stem().string();
  return file == operand ? stem : stem + " " + operand.substr(file.size() + 1);
}

ViewerInput viewer_input(const std::string& operand, const InputOptions& options) {
  if (is_made(operand, options)) {
    try {
      return made_input(operand, options);
    } catch (const Stop&) {  // the page shows where the file is bad
    }
  }
  if (operand == "-") return {shape_name(operand) + extension_of_input(options), standard_input()};
  if (is_footprint(operand)) return {shape_name(operand) + ".json", operand};
  const std::string file = file_of_shape(operand);
  return {fs::path(file).filename().string(), bytes_of(file)};
}

Json viewer_parameters(const CLI::App& verb) {
  Json parameters{{"verb", verb.get_name()}};
  for (const CLI::Option* option : verb.get_options()) {
    const std::string name = option->get_single_name();
    if (option->count() == 0 || option->get_positional() || is_format(name, verb) ||
        std::find(kNotShown.begin(), kNotShown.end(), name) != kNotShown.end())
      continue;
    const std::vector<std::string>& given = option->results();
    if (option->get_items_expected_max() == 0) parameters[name] = true;
    else if (given.size() == 1) parameters[name] = given.front();
    else parameters[name] = given;
  }
  return parameters;
}

std::string viewer_json(const ViewerData& data) {
  Json json{{"format", 1}, {"page", data.page}, {"live", data.live}, {"revision", data.revision}};
  json["inputs"] = Json::array();
  for (const ViewerInput& input : data.inputs) json["inputs"].push_back(input_json(input));
  json["parameters"] = data.parameters;
  std::string text;
  for (const char c : json.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') text += "\\u003c";
    else text += c;
  }
  return text;
}

}  // namespace dymsum::cli
