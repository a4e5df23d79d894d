#include "pictures/set_picture.h"

#include <cmath>

#include "pictures/marked_drawing.h"

namespace dymsum::cli {
namespace {

constexpr const char *kRightSet = "fill=\"#dddddd\" stroke=\"#888888\"", *kMadeSet = "fill=\"none\" stroke=\"#08519c\"",
                     *kMissingStyle = "fill=\"#d81e3a\" fill-opacity=\"0.6\" stroke=\"#d81e3a\"",
                     *kSurplusStyle = "fill=\"#e8a33d\" fill-opacity=\"0.6\" stroke=\"#a8650a\"";

Drawn drawn_operand(const PlanarOperand& operand) {
  return std::visit([](const auto* set) { return drawn(*set); }, operand.set());
}

Point near(const RationalPoint& p) { return {p.x.to_double(), p.y.to_double()}; }

void mark_excess(MarkedDrawing& drawing, const PlanarExcess& excess, bool worst) {
  if (!(excess.distance > 0)) return;
  drawing.mark(near(excess.at), worst);
  if (std::isfinite(excess.distance)) drawing.join(near(excess.at), near(excess.nearest));
}

MarkedDrawing drawing_of(const PlanarOperand& right, const PlanarOperand& made, const PlanarExcess& missing,
                         const PlanarExcess& surplus) {
  const Drawn sets[]{drawn_operand(right), drawn_operand(made), drawn(missing.set), drawn(surplus.set)};
  Box seen;
  for (const Drawn& set : sets) seen.see(set.box);
  MarkedDrawing drawing(seen);
  drawing.add(sets[0], kRightSet);
  drawing.add(sets[2], kMissingStyle);
  drawing.add(sets[3], kSurplusStyle);
  drawing.add(sets[1], kMadeSet);
  return drawing;
}

}  // namespace

std::string set_picture(const PlanarOperand& right, const PlanarOperand& made, const PlanarSetCheck& check) {
  MarkedDrawing drawing = drawing_of(right, made, check.missing, check.surplus);
  mark_excess(drawing, check.missing, check.missing.distance >= check.surplus.distance);
  mark_excess(drawing, check.surplus, check.missing.distance < check.surplus.distance);
  return drawing.text();
}

std::string offset_picture(const PlanarOperand& a, const PlanarOperand& made, const PlanarOffsetCheck& check) {
  MarkedDrawing drawing = drawing_of(a, made, check.beyond, check.between);
  mark_excess(drawing, check.beyond, true);
  mark_excess(drawing, check.between, false);
  if (check.least > 0 && std::isfinite(check.least)) {
    drawing.mark(near(check.least_at), true);
    drawing.join(near(check.least_at), near(check.least_from));
  }
  return drawing.text();
}

}  // namespace dymsum::cli
