#include "io/region/dxf_groups.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>
#include <utility>

#include "dymsum/region_io.h"
#include "io/region/curves.h"
#include "io/source.h"

namespace dymsum::io {
namespace {

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::vector<DxfGroup> dxf_groups(const Source& source) {
  if (source.text.starts_with("AutoCAD Binary DXF"))
    source.fail(ErrorCode::malformed, "this is a binary DXF file: only text can be read", 0);
  std::vector<DxfGroup> groups;
  std::size_t at = 0;
  const auto take_line = [&] {
    const std::size_t start = at, end = std::min(source.text.find('\n', at), source.text.size());
    at = std::min(end + 1, source.text.size());
    return std::pair{source.text.substr(start, end - start), start};
  };
  while (at < source.text.size()) {
    const auto [code_line, code_at] = take_line();
    if (without_blanks(code_line).empty() && without_blanks(source.text.substr(at)).empty()) break;
    const std::optional<int> code = whole_number(without_blanks(code_line));
    if (!code)
      source.fail(ErrorCode::malformed,
                  "expected the code of a group instead of " + in_quotes(without_blanks(code_line)), code_at);
    if (at >= source.text.size()) break;
    const auto [value, value_at] = take_line();
    groups.push_back({*code, without_blanks(value), value_at});
    if (*code == 0 && groups.back().value == "EOF") return groups;
  }
  source.fail(ErrorCode::truncated, "the file ends before its EOF", source.text.size());
}

const DxfGroup* DxfEntity::find(int code) const {
  const DxfGroup* const found = std::find_if(first, last, [code](const DxfGroup& g) { return g.code == code; });
  return found == last ? nullptr : found;
}

std::vector<DxfEntity> dxf_entities(const Source& source, const std::vector<DxfGroup>& groups, std::string_view name) {
  std::vector<DxfEntity> entities;
  const DxfGroup* const end = groups.data() + groups.size();
  const DxfGroup* section = nullptr;
  bool wanted = false;
  for (const DxfGroup* at = groups.data(); at != end;) {
    const DxfGroup* const next = std::find_if(at + 1, end, [](const DxfGroup& g) { return g.code == 0; });
    if (at->code == 0 && at->value == "SECTION") {
      if (section != nullptr) source.fail(ErrorCode::malformed, "a section inside another one", at->offset);
      section = at;
      wanted = at + 1 != end && (at + 1)->code == 2 && (at + 1)->value == name;
    } else if (at->code == 0 && at->value == "ENDSEC") {
      section = nullptr;
      wanted = false;
    } else if (at->code == 0 && at->value == "EOF") {
      if (section != nullptr) source.fail(ErrorCode::malformed, "the section is not ended", section->offset);
    } else if (wanted && at->code == 0) {
      entities.push_back({at->value, at->offset, at + 1, next});
    }
    at = next;
  }
  return entities;
}

const DxfGroup* dxf_variable(const std::vector<DxfGroup>& groups, std::string_view name) {
  for (std::size_t k = 0; k + 1 < groups.size(); ++k)
    if (groups[k].code == 9 && groups[k].value == name) return &groups[k + 1];
  return nullptr;
}

double dxf_number(const Source& source, const DxfGroup& group) {
  const ScannedNumber number = scan_number(group.value);
  if (number.length == 0 || number.length != group.value.size())
    source.fail(ErrorCode::malformed, "expected a number instead of " + in_quotes(group.value), group.offset);
  if (!std::isfinite(number.value))
    source.fail(ErrorCode::not_finite, in_quotes(group.value) + " is not a finite double", group.offset);
  return number.value;
}

int dxf_flags(const Source& source, const DxfGroup& group) {
  const std::optional<int> value = whole_number(group.value);
  if (!value || *value < 0)
    source.fail(ErrorCode::malformed, "expected a whole number instead of " + in_quotes(group.value), group.offset);
  return *value;
}

}  // namespace dymsum::io

bool dymsum::begins_like_dxf(std::string_view text) {
  const auto take_word = [&text] {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n\xEF\xBB\xBF"), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
    text.remove_prefix(word.size());
    return word;
  };
  const std::string_view code = take_word(), value = take_word();
  if (code == "0") return value == "SECTION";
  return code == "999" && !value.empty() && !io::is_digit(value[0]) && value[0] != '#';
}

namespace dymsum::io {
namespace {

/// No bulge, nothing hidden, rings closed and lines open.
bool is_own_polyline(const Source& source, const DxfEntity& entity) {
  const std::string_view layer = dxf_layer(entity);
  const bool line = layer == kDxfLine;
  const DxfGroup* const flags = entity.find(70);
  return (line || layer == kDxfOuter || layer == kDxfHole) && flags != nullptr &&
         dxf_flags(source, *flags) == (line ? 0 : 1) && entity.find(10) != nullptr && entity.find(42) == nullptr;
}

bool is_own_entity(const Source& source, const DxfEntity& entity) {
  if (entity.find(60) != nullptr || entity.find(67) != nullptr) return false;
  if (entity.kind == "POINT") return dxf_layer(entity) == kDxfPoint;
  return entity.kind == "LWPOLYLINE" && is_own_polyline(source, entity);
}

}  // namespace

std::string without_case(std::string_view name) {
  std::string text(name);
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::string_view dxf_layer(const DxfEntity& entity) {
  const DxfGroup* const layer = entity.find(8);
  return layer == nullptr ? "0" : layer->value;
}

DxfHiddenLayers::DxfHiddenLayers(const Source& source, const std::vector<DxfGroup>& groups) {
  for (const DxfEntity& layer : dxf_entities(source, groups, "TABLES")) {
    const DxfGroup* const name = layer.find(2);
    if (layer.kind != "LAYER" || name == nullptr) continue;
    const DxfGroup *const colour = layer.find(62), *const flags = layer.find(70);
    const bool off = colour != nullptr && dxf_number(source, *colour) < 0;
    const bool frozen = flags != nullptr && (dxf_flags(source, *flags) & 1) != 0;
    if (off || frozen) names_.insert(without_case(name->value));
  }
}

bool DxfHiddenLayers::contains(std::string_view layer) const {
  return !names_.empty() && names_.count(without_case(layer)) > 0;
}

bool is_own_dxf(const Source& source, const std::vector<DxfGroup>& groups, const std::vector<DxfEntity>& entities) {
  if (groups.empty() || groups.front().code != 999 || groups.front().value != kDxfOwn) return false;
  bool outer = false;
  for (const DxfEntity& entity : entities) {
    outer = outer || dxf_layer(entity) == kDxfOuter;
    if (!is_own_entity(source, entity) || (!outer && dxf_layer(entity) == kDxfHole)) return false;
  }
  return dxf_entities(source, groups, "TABLES").empty();
}

namespace {

constexpr int kMostCopies = 10000;  // of one INSERT

double number_or(const Source& source, const DxfEntity& entity, int code, double otherwise) {
  const DxfGroup* const group = entity.find(code);
  return group == nullptr ? otherwise : dxf_number(source, *group);
}

int count_or_one(const Source& source, const DxfEntity& insert, int code) {
  const DxfGroup* const group = insert.find(code);
  const int count = group == nullptr ? 1 : dxf_flags(source, *group);
  if (count > kMostCopies) source.fail(ErrorCode::malformed, "INSERT draws too many copies", group->offset);
  return std::max(count, 1);
}

}  // namespace

std::map<std::string, DxfBlock> dxf_blocks(const Source& source, const std::vector<DxfGroup>& groups) {
  std::map<std::string, DxfBlock> blocks;
  DxfBlock* open = nullptr;
  for (const DxfEntity& entity : dxf_entities(source, groups, "BLOCKS")) {
    if (entity.kind == "BLOCK") {
      const DxfGroup* const name = entity.find(2);
      if (name == nullptr) source.fail(ErrorCode::malformed, "a block without a name", entity.offset);
      open = &blocks[without_case(name->value)];
      *open = {{number_or(source, entity, 10, 0), number_or(source, entity, 20, 0)}, {}};
    } else if (entity.kind == "ENDBLK") {
      open = nullptr;
    } else if (open != nullptr) {
      open->entities.push_back(entity);
    }
  }
  return blocks;
}

// The base comes to the origin, is scaled, moved to its row and column, rotated, and moved to its position.
std::vector<PlaneTransform> dxf_placements(const Source& source, const DxfEntity& insert, const DxfBlock& block) {
  const auto number = [&](int code, double otherwise) { return number_or(source, insert, code, otherwise); };
  const Point x_axis = direction(number(50, 0));
  const PlaneTransform rotation{x_axis.x, x_axis.y, -x_axis.y, x_axis.x, number(10, 0), number(20, 0)};
  const PlaneTransform scaling{number(41, 1), 0, 0, number(42, 1), 0, 0},
      moved{1, 0, 0, 1, -block.base.x, -block.base.y};
  if (scaling.a == 0 || scaling.d == 0)
    source.fail(ErrorCode::malformed, "INSERT scales its block to nothing", insert.offset);
  const int columns = count_or_one(source, insert, 70), rows = count_or_one(source, insert, 71);
  if (columns * rows > kMostCopies) source.fail(ErrorCode::malformed, "INSERT draws too many copies", insert.offset);
  std::vector<PlaneTransform> placements;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const PlaneTransform step{1, 0, 0, 1, column * number(44, 0), row * number(45, 0)};
      placements.push_back(rotation.after(step).after(scaling).after(moved));
    }
  return placements;
}

}  // namespace dymsum::io
