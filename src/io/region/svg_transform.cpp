#include <cstddef>
#include <string>
#include <vector>

#include "io/region/svg_numbers.h"
#include "io/region/svg_path.h"

namespace dymsum::io {

namespace {

SvgTransform make_transform(const SvgNumbers& numbers, const std::string& name, const std::vector<double>& v) {
  if (name == "translate" && (v.size() == 1 || v.size() == 2)) return {1, 0, 0, 1, v[0], v.size() == 2 ? v[1] : 0};
  if (name == "scale" && (v.size() == 1 || v.size() == 2)) return {v[0], 0, 0, v.back(), 0, 0};
  if (name == "matrix" && v.size() == 6) return {v[0], v[1], v[2], v[3], v[4], v[5]};
  if (name == "translate" || name == "scale" || name == "matrix") {
    numbers.fail_before("the transform " + name + " has " + std::to_string(v.size()) + " arguments");
  }
  numbers.fail_before("the transform " + in_quotes(name) + " is none of translate, scale, matrix");
}

}  // namespace

SvgTransform SvgTransform::after(const SvgTransform& inner) const {
  if (identity()) return inner;
  if (inner.identity()) return *this;
  return {a * inner.a + c * inner.b, b * inner.a + d * inner.b,     a * inner.c + c * inner.d,
          b * inner.c + d * inner.d, a * inner.e + c * inner.f + e, b * inner.e + d * inner.f + f};
}

Point SvgTransform::apply(Point p) const {
  if (identity()) return p;
  return {a * p.x + c * p.y + e, b * p.x + d * p.y + f};
}

SvgTransform parse_transform(const Source& source, const SvgText& text) {
  SvgNumbers numbers(source, text);
  SvgTransform whole;
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
