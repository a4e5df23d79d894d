#include "io/region/dxf_groups.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include "dymsum/region_io.h"
#include "io/number_text.h"

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
