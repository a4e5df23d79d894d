#include "solid/solid_inputs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iostream>
#include <optional>
#include <string_view>
#include <utility>

#include "dymsum/names.h"
#include "dymsum/solid_union.h"
#include "exit_code.h"

namespace dymsum::cli {

namespace {

/// The first word of a text after comments, in small letters.
std::string first_word(std::string_view text) {
  const auto skip = [&](std::size_t length) { text.remove_prefix(std::min(length, text.size())); };
  const auto skip_blanks = [&] { skip(text.find_first_not_of(" \t\r\n\f\v")); };
  for (skip_blanks(); text.starts_with('#'); skip_blanks()) skip(text.find_first_of("\r\n"));
  constexpr std::size_t kLongest = 16;  // of those that are looked for, and more
  text = text.substr(0, kLongest);
  std::string word(text.substr(0, text.find_first_of(" \t\r\n\f\v")));
  if (word.find_first_not_of("0123456789") == 0)
    word.erase(word.find_last_not_of("0123456789") + 1);  // as in OFF8 12 18
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

/// The format of a text that begins as only solids do: OFF or ply, solid (text .stl), or a statement of .obj; of bytes:
/// glTF or the mark of a .zip.
std::optional<MeshFormat> solid_format_of(std::string_view text) {
  constexpr std::array<std::string_view, 9> kObj{"v", "vn", "vt", "mtllib", "usemtl", "o", "g", "s", "f"};
  if (text.starts_with("glTF")) return MeshFormat::glb;
  if (text.starts_with("PK\x03\x04")) return MeshFormat::three_mf;
  const std::string word = first_word(without_mark(text));
  if (word.ends_with("off")) return MeshFormat::off;
  if (word == "ply") return MeshFormat::ply;
  if (word == "solid") return MeshFormat::stl;
  if (std::find(kObj.begin(), kObj.end(), word) != kObj.end()) return MeshFormat::obj;
  return std::nullopt;
}

Result<RepairedMesh> repaired(MeshData data, const InputOptions& options) {
  return options.thin ? repair_with_thin_parts(std::move(data))
                      : repair_with_union(std::move(data), parse<Fill>(options.fill).value_or(Fill::nonzero));
}

/// What the option would do: of large surfaces that cross that takes too long for a hint.
Result<RepairedMesh> repaired_for_a_hint(const MeshData& data, const InputOptions& options) {
  constexpr std::size_t kMany = 20000;
  return options.thin || data.faces.size() <= kMany ? repaired(data, options) : repair(data);
}

/// Says which option takes the solid: which repairs it, or takes its parts without volume, or its hull.
Error with_remedy(Error error, const MeshData& data, const InputOptions& options) {
  if (error.code == ErrorCode::bad_index && !error.evidence.face && data.faces.empty()) {
    error.message = "the file holds vertices and no faces (--hull takes the convex hull of points)";
    return error;
  }
  const Result<RepairedMesh> after_repair = repaired_for_a_hint(data, options);
  if (after_repair && !after_repair->mesh.empty() && options.offers_repair) {
    error.message += remedy(after_repair->report.to_string());
    return error;
  }
  // What is left when all else is repaired.
  const ErrorCode code = after_repair ? error.code : after_repair.error().code;
  const bool thin =
      code == ErrorCode::not_closed || code == ErrorCode::not_manifold || error.code == ErrorCode::too_few_vertices;
  if (!thin || !options.offers_thin || options.thin) return error;
  if (Mesh::with_thin_parts(data)) error.message += " (--thin takes parts without volume)";
  else if (repair_with_thin_parts(data)) error.message += " (--thin with --repair takes parts without volume)";
  return error;
}

/// What repair did, also where that leaves nothing.
void announce(const MeshRepairReport& report, const Mesh& mesh, const std::string& file) {
  if (!report.changed() && !mesh.empty()) return;
  std::cerr << file << ": " << (report.changed() ? "repaired: " : "") << report.to_string()
            << (mesh.empty() ? "; it holds no face with an area, and is taken as the empty solid" : "") << "\n";
}

Result<SolidInput> hull_of(const MeshData& data, const std::string& file, bool quiet) {
  Result<HulledMesh> hull = hulled(data);
  if (!hull) return hull.error();
  if (!quiet) std::cerr << shown_file(file) << ": convex hull: " << hull->report.to_string() << "\n";
  return SolidInput{file, hull->mesh, hull->report};
}

}  // namespace

std::optional<MeshFormat> mesh_format_of_input(const InputOptions& options) {
  if (options.from.empty()) return solid_format_of(standard_input());
  const Result<MeshFormat> named = mesh_format("." + options.from);
  return named ? std::optional(*named) : std::nullopt;
}

void refuse_selection(const std::string& file) {
  const std::size_t mark = file.rfind('#');
  if (mark == std::string::npos || !mesh_format(file.substr(0, mark))) return;
  throw Stop(kUsage, file + ": the file of a solid holds one shape; name it without " + file.substr(mark));
}

void refuse_unknown_extension(const std::string& file) {
  refuse_selection(file);
  if (file == "-" || is_footprint(file) || mesh_format(file) || names_region(file)) return;
  Error error = read_shapes(file).error();
  if (error.code == ErrorCode::unsupported_format) error.message += ", .off, .obj, .stl, .ply, .glb, .3mf";
  stop_with(error);
}

bool names_solid(const std::string& file, const InputOptions& options) {
  refuse_selection(file);
  return file == "-" ? mesh_format_of_input(options).has_value() : mesh_format(file).ok();
}

Result<MeshData> read_mesh_data(const std::string& file, const InputOptions& options) {
  refuse_selection(file);
  if (options.drop_z) throw Stop(kUsage, "--drop-z is for planar operands");
  if (file != "-") return read_mesh(file);
  const std::optional<MeshFormat> format = mesh_format_of_input(options);
  if (!format)
    throw Stop(kUsage, "--from names the format of the solid on standard input: off, obj, stl, ply, glb or 3mf");
  return parse_mesh(standard_input(), *format, "standard input");
}

Result<SolidInput> make_solid(MeshData data, const std::string& file, const InputOptions& options) {
  const auto in_file = [&](Error error) {
    if (error.evidence.file.empty()) error.evidence.file = shown_file(file);
    return error;
  };
  if (options.hull) {
    Result<SolidInput> hull = hull_of(data, file, options.quiet);
    if (!hull) return in_file(hull.error());
    return hull;
  }
  if (!options.repair) {
    if (!options.fill.empty()) throw Stop(kUsage, "--fill of solids belongs to --repair");
    Result<Mesh> mesh = options.thin ? Mesh::with_thin_parts(data) : Mesh::create(data);
    if (!mesh) return in_file(with_remedy(mesh.error(), data, options));
    return SolidInput{file, std::move(mesh).value()};
  }
  Result<RepairedMesh> after_repair = repaired(std::move(data), options);
  if (!after_repair) return in_file(after_repair.error());
  if (!options.quiet) announce(after_repair->report, after_repair->mesh, shown_file(file));
  return SolidInput{file, std::move(after_repair).value().mesh};
}

SolidInput read_solid(const std::string& file, const InputOptions& options) {
  return require(make_solid(require(read_mesh_data(file, options)), file, options));
}

Json solid_inputs_json(const std::vector<SolidInput>& inputs) {
  Json list = Json::array();
  for (const SolidInput& input : inputs) {
    list.push_back({{"file", input.file},
                    {"vertices", input.mesh.vertices().size()},
                    {"faces", input.mesh.faces().size()},
                    {"shells", input.mesh.shell_count()}});
    if (!input.hull) continue;
    list.back()["hull"] = {
        {"given", input.hull->vertices}, {"inside", input.hull->inside_vertices}, {"deviation", input.hull->deviation}};
  }
  return list;
}

}  // namespace dymsum::cli
