#include <string>

#include "exact/root_expression.h"
#include "exact/root_node.h"

namespace dymsum::exact {

namespace {

/// How tightly a formula holds together: sums 0, products 1, what never needs brackets 2.
struct Formula {
  std::string text;
  int strength = 2;
};

std::string at_least(const Formula& f, int strength) { return f.strength < strength ? "(" + f.text + ")" : f.text; }

Formula formula_of(const RootNode& node) {
  using Kind = RootNode::Kind;
  if (node.kind == Kind::rational) {
    const std::string num = node.num.str();
    // A minus binds like a sum: brackets in all other places.
    if (node.den == 1) return {num, node.num.sign() < 0 ? 0 : 2};
    return {num + "/" + node.den.str(), node.num.sign() < 0 ? 0 : 1};
  }
  const Formula a = formula_of(*node.a);
  if (node.kind == Kind::root) return {"sqrt(" + a.text + ")", 2};
  const Formula b = formula_of(*node.b);
  switch (node.kind) {
    case Kind::sum:
      return {a.text + " + " + (b.text[0] == '-' ? "(" + b.text + ")" : b.text), 0};
    case Kind::difference:
      if (node.a->is_rational() && node.a->num.is_zero()) return {"-" + at_least(b, 1), 0};
      return {a.text + " - " + at_least(b, 1), 0};
    case Kind::product:
      return {at_least(a, 1) + " * " + at_least(b, 2), 1};
    default:
      return {at_least(a, 1) + " / " + at_least(b, 2), 1};
  }
}

}  // namespace

std::string to_text(const RootExpression& a) { return formula_of(a.node()).text; }

}  // namespace dymsum::exact
