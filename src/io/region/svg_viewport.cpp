// Nested svg elements: where their content goes; and whether an element is drawn at all.
#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

#include "io/region/svg_numbers.h"
#include "io/region/svg_path.h"

namespace dymsum::io {

namespace {

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Names of properties may be in capitals.
bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// The fraction of the free space that lies before the content: 0, 1/2 or 1.
double fraction(std::string_view align, std::string_view axis) {
  if (align.find(std::string(axis) + "Min") != std::string_view::npos) return 0;
  return align.find(std::string(axis) + "Max") != std::string_view::npos ? 1 : 0.5;
}

}  // namespace

PlaneTransform parse_view_box(const Source& source, const SvgText& text, const SvgViewport& viewport,
                              std::string_view preserve_aspect_ratio) {
  SvgNumbers numbers(source, text);
  std::array<double, 4> box{};
  for (double& v : box) {
    if (!numbers.at_number()) numbers.fail("expected four numbers");
    v = numbers.read();
  }
  numbers.skip();
  if (!numbers.at_end()) numbers.fail("expected four numbers");
  const auto [x, y, width, height] = box;
  if (!(width > 0 && height > 0 && viewport.width > 0 && viewport.height > 0))
    numbers.fail_before("a viewBox and its element need a positive width and height");
  if (preserve_aspect_ratio.find("slice") != std::string_view::npos)
    numbers.fail_before("preserveAspectRatio with slice cuts off what is drawn, and that cannot be read");
  double sx = viewport.width / width, sy = viewport.height / height;
  if (preserve_aspect_ratio.find("none") == std::string_view::npos) sx = sy = std::min(sx, sy);
  const double left = viewport.x + fraction(preserve_aspect_ratio, "x") * (viewport.width - sx * width);
  const double top = viewport.y + fraction(preserve_aspect_ratio, "Y") * (viewport.height - sy * height);
  return {sx, 0, 0, sy, left - sx * x, top - sy * y};
}

std::string_view svg_property(std::string_view style, std::string_view name, std::string_view attribute) {
  std::string_view value = trimmed(attribute);
  // The last of several declarations counts.
  while (!style.empty()) {
    const std::size_t end = std::min(style.find(';'), style.size());
    const std::string_view declaration = style.substr(0, end);
    const std::size_t colon = declaration.find(':');
    if (colon != std::string_view::npos && same_name(trimmed(declaration.substr(0, colon)), name)) {
      value = trimmed(declaration.substr(colon + 1));
      if (const std::size_t important = value.find('!'); important != std::string_view::npos)
        value = trimmed(value.substr(0, important));
    }
    style.remove_prefix(std::min(end + 1, style.size()));
  }
  return value;
}

}  // namespace dymsum::io
