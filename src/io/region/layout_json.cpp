// Layouts as JSON: what jagua-rs and sparrow write, an instance with its solution, and our own, which is the same with
// exact orientations and positions.
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "dymsum/layout_check.h"
#include "dymsum/nesting.h"
#include "dymsum/region_io.h"
#include "io/read_file.h"
#include "io/region/drawn_layouts.h"
#include "io/region/json_shapes.h"
#include "io/region/read_shapes.h"
#include "io/source.h"

namespace dymsum {

namespace {

using io::JsonKind;
using io::JsonValue;

class LayoutReader {
 public:
  LayoutReader(const io::Source& source, bool repair) : source_(source), repair_(repair) {}

  std::vector<Layout> read(const JsonValue& root) {
    const JsonValue instance = root.find("instance").value_or(root);
    const JsonValue solution = root.find("solution").value_or(root);
    io::visit_array(source_, io::require_member(source_, instance, "items"), "items",
                    [&](const JsonValue& item) { add_shape(item, item_ids_, shapes_, "item"); });
    if (const auto bins = instance.find("bins"))
      io::visit_array(source_, *bins, "bins",
                      [&](const JsonValue& bin) { add_shape(bin, bin_ids_, containers_, "bin"); });
    std::vector<Layout> layouts;
    if (const auto one = solution.find("layout")) layouts.push_back(layout(*one, strip(instance, solution)));
    else
      io::visit_array(source_, io::require_member(source_, solution, "layouts"), "layouts",
                      [&](const JsonValue& json) { layouts.push_back(layout(json, bin_of(json))); });
    return layouts;
  }

 private:
  using Ids = std::map<std::string, std::uint32_t>;

  [[noreturn]] void fail(const std::string& what, const JsonValue& at) const {
    source_.fail_on_line(ErrorCode::malformed, what, at.line());
  }

  void add_shape(const JsonValue& json, Ids& ids, std::vector<Region>& to, const std::string& what) {
    NamedShape shape = io::read_nesting_shape(source_, json);
    if (shape.name.empty()) shape.name = std::to_string(to.size());
    Result<Region> region = region_of(std::move(shape.data), what + " " + io::in_quotes(shape.name));
    if (!region)
      throw io::ReadFailure{{region.error().code,
                             what + " " + io::in_quotes(shape.name) + ": " + region.error().message,
                             region.error().evidence}};
    if (!ids.try_emplace(shape.name, static_cast<std::uint32_t>(to.size())).second)
      fail("two " + what + "s are named " + io::in_quotes(shape.name), json);
    to.push_back(*std::move(region));
  }

  Result<Region> region_of(RegionData data, const std::string& name) {
    if (!repair_) return Region::create(std::move(data));
    Result<Repaired> repaired = dymsum::repair(std::move(data));
    if (!repaired) return repaired.error();
    if (repaired->report.changed()) notes_.push_back(name + ": " + repaired->report.to_string());
    return std::move(repaired).value().region;
  }

  double number(const JsonValue& object, std::string_view key) const {
    const JsonValue value = io::require_member(source_, object, key);
    if (value.kind() != JsonKind::number) fail("expected a number as '" + std::string(key) + "'", value);
    return value.number();
  }

  std::optional<Region> strip(const JsonValue& instance, const JsonValue& solution) const {
    if (!instance.find("strip_height")) return std::nullopt;
    const double height = number(instance, "strip_height"), width = number(solution, "strip_width");
    if (!(height > 0 && width > 0)) fail("the strip has to have a positive height and width", solution);
    return Region::create({{{{{0, 0}, {width, 0}, {width, height}, {0, height}}, {}}}, {}, {}}).value();
  }

  std::optional<Region> bin_of(const JsonValue& layout) const {
    return containers_[index(layout, "container_id", bin_ids_, "bin")];
  }

  std::uint32_t index(const JsonValue& object, std::string_view key, const Ids& ids, const std::string& what) const {
    const JsonValue value = io::require_member(source_, object, key);
    const auto it = ids.find(io::name_of(value).value_or(""));
    if (it == ids.end()) fail("there is no " + what + " with this '" + std::string(key) + "'", value);
    return it->second;
  }

  Layout layout(const JsonValue& json, std::optional<Region> container) const {
    Layout layout;
    layout.shapes = shapes_;
    layout.container = std::move(container);
    layout.notes = notes_;
    io::visit_array(source_, io::require_member(source_, json, "placed_items"), "placed items",
                    [&](const JsonValue& item) { layout.parts.push_back(part(item)); });
    return layout;
  }

  LayoutPart part(const JsonValue& item) const {
    LayoutPart part;
    part.shape = index(item, "item_id", item_ids_, "item");
    part.name = io::name_of(item.find("name").value_or(io::require_member(source_, item, "item_id"))).value_or("");
    const JsonValue move = io::require_member(source_, item, "transformation");
    part.orientation = orientation(move);
    part.at = position(io::require_member(source_, move, "translation"));
    return part;
  }

  /// By the tangent of half the angle where that is there, else degrees.
  Orientation orientation(const JsonValue& move) const {
    const auto tangent = move.find("tan_half");
    if (!tangent) return Orientation::nearest(reduced_degrees(Rational::of(number(move, "rotation")).value())).value();
    Result<Orientation> exact = Orientation::parse(io::require_text(source_, *tangent, "'tan_half' as a text"));
    if (!exact) fail("'tan_half': " + exact.error().message, *tangent);
    return *std::move(exact);
  }

  // Numbers, or texts that are fractions.
  RationalPoint position(const JsonValue& value) const {
    if (value.kind() == JsonKind::pair)
      return {Rational::of(value.pair().x).value(), Rational::of(value.pair().y).value()};
    std::vector<Rational> both;
    io::visit_array(source_, value, "two coordinates", [&](const JsonValue& one) {
      if (one.kind() == JsonKind::number) return both.push_back(Rational::of(one.number()).value());
      Result<Rational> r = Rational::parse(io::require_text(source_, one, "a coordinate as a number or a fraction"));
      if (!r) fail(r.error().message, one);
      both.push_back(*std::move(r));
    });
    if (both.size() != 2) fail("expected two coordinates", value);
    return {both[0], both[1]};
  }

  const io::Source& source_;
  bool repair_;
  std::vector<std::string> notes_;
  std::vector<Region> shapes_, containers_;
  Ids item_ids_, bin_ids_;
};

}  // namespace

Result<std::vector<Layout>> parse_layouts(std::string_view text, std::string_view name_for_errors,
                                          const LayoutReadOptions& options, LayoutFormat format) {
  const io::PlainText plain(text);
  const io::Source source{plain.view(), name_for_errors};
  try {
    if (format == LayoutFormat::dxf) return io::dxf_layouts(source, options);
    if (format == LayoutFormat::svg) return io::svg_layouts(source, options);
    if (!options.container.empty())
      return io::file_error(ErrorCode::unsupported_operand,
                            "a container is chosen in drawings (.dxf, .svg), not in JSON", name_for_errors);
    const io::JsonTape tape(source);
    return LayoutReader(source, options.repair).read(tape.root());
  } catch (io::ReadFailure& failure) {
    return std::move(failure.error);
  }
}

Result<std::vector<Layout>> read_layouts(const std::string& path, const LayoutReadOptions& options) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return text.error();
  const std::string extension = io::extension(path);
  const bool dxf = path == "-" ? begins_like_dxf(*text) : extension == ".dxf";
  const bool svg = path == "-" ? text->find_first_not_of(" \t\r\n") == text->find('<') && !dxf : extension == ".svg";
  return parse_layouts(*text, path == "-" ? "standard input" : path, options,
                       dxf   ? LayoutFormat::dxf
                       : svg ? LayoutFormat::svg
                             : LayoutFormat::json);
}

namespace {

using Json = nlohmann::ordered_json;

/// A double as a number, any other one as a text.
void append_exact(std::string& out, const Rational& v) {
  const double near = v.to_double();
  if (const Result<Rational> same = Rational::of(near); same && *same == v) io::append_number(out, near);
  else out += '"' + v.to_string() + '"';
}

void append_part(std::string& out, const LayoutPart& part) {
  const Orientation& o = part.orientation;
  out += R"({"item_id":)" + std::to_string(part.shape) + R"(,"name":)" +
         Json(part.name).dump(-1, ' ', false, Json::error_handler_t::replace) + R"(,"transformation":{"rotation":)";
  io::append_number(out, o.radians() * (180 / 3.141592653589793));
  out += R"(,"tan_half":")" + (o.is_half_turn() ? "inf" : o.tan_half().to_string()) + R"(","translation":[)";
  append_exact(out, part.at.x);
  out += ',';
  append_exact(out, part.at.y);
  out += "]}}";
}

}  // namespace

std::string layout_to_json(const Layout& layout) {
  std::string out = R"({"name":"dymsum","items":[)";
  for (std::size_t k = 0; k < layout.shapes.size(); ++k) {
    out += (k == 0 ? "\n" : ",\n") + (R"({"id":)" + std::to_string(k)) + R"(,"shape":)";
    io::append_shape(out, layout.shapes[k].data());
    out += '}';
  }
  out += "],\n";
  if (layout.container) {
    out += R"("bins":[{"id":0,"shape":)";
    io::append_shape(out, layout.container->data());
    out += "}],\n\"solution\":{\"layouts\":[{\"container_id\":0,\"placed_items\":[";
  } else {
    out += "\"solution\":{\"layout\":{\"placed_items\":[";
  }
  for (std::size_t k = 0; k < layout.parts.size(); ++k) {
    out += k == 0 ? "\n" : ",\n";
    append_part(out, layout.parts[k]);
  }
  return out + (layout.container ? "]}]}}\n" : "]}}}\n");
}

}  // namespace dymsum
