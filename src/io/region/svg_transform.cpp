#include <cstddef>
#include <string>
#include <vector>

#include "io/region/dxf_arc.h"
#include "io/region/svg_numbers.h"
#include "io/region/svg_path.h"

namespace dymsum::io {

namespace {

/// A rotation about a point; exact for multiples of 90 degrees.
PlaneTransform rotation(double degrees, Point about) {
  const Point d = direction(degrees);
  const PlaneTransform rotated{d.x, d.y, -d.y, d.x, 0, 0};
  return PlaneTransform{1, 0, 0, 1, about.x, about.y}.after(rotated).after({1, 0, 0, 1, -about.x, -about.y});
}

double tangent(double degrees) {
  const Point d = direction(degrees);
  return d.y / d.x;
}

PlaneTransform make_transform(const SvgNumbers& numbers, const std::string& name, const std::vector<double>& v) {
  if (name == "translate" && (v.size() == 1 || v.size() == 2)) return {1, 0, 0, 1, v[0], v.size() == 2 ? v[1] : 0};
  if (name == "scale" && (v.size() == 1 || v.size() == 2)) return {v[0], 0, 0, v.back(), 0, 0};
  if (name == "matrix" && v.size() == 6) return {v[0], v[1], v[2], v[3], v[4], v[5]};
  if (name == "rotate" && (v.size() == 1 || v.size() == 3))
    return rotation(v[0], v.size() == 3 ? Point{v[1], v[2]} : Point{});
  if (name == "skewX" && v.size() == 1) return {1, 0, tangent(v[0]), 1, 0, 0};
  if (name == "skewY" && v.size() == 1) return {1, tangent(v[0]), 0, 1, 0, 0};
  for (const char* known : {"translate", "scale", "matrix", "rotate", "skewX", "skewY"})
    if (name == known) numbers.fail_before("the transform " + name + " has " + std::to_string(v.size()) + " arguments");
  numbers.fail_before("the transform " + in_quotes(name) +
                      " is none of translate, scale, rotate, skewX, skewY, matrix");
}

}  // namespace

PlaneTransform parse_transform(const Source& source, const SvgText& text) {
  SvgNumbers numbers(source, text);
  PlaneTransform whole;
  for (numbers.skip(); !numbers.at_end(); numbers.skip()) {
    std::string name;
    while (!numbers.at_end() && is_letter(numbers.peek())) {
      name += numbers.peek();
      numbers.advance();
    }
    numbers.skip();
    if (name.empty() || numbers.at_end() || numbers.peek() != '(')
      numbers.fail("expected a transform such as translate(x, y)");
    numbers.advance();
    std::vector<double> values;
    while (numbers.at_number()) values.push_back(numbers.read());
    if (numbers.at_end() || numbers.peek() != ')') numbers.fail("expected ')'");
    numbers.advance();
    whole = whole.after(make_transform(numbers, name, values));
  }
  return whole;
}

}  // namespace dymsum::io
