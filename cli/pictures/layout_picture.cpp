#include "pictures/layout_picture.h"

#include <cmath>
#include <set>

#include "pictures/marked_drawing.h"

namespace dymsum::cli {
namespace {

/// A shape as it stands, in doubles.
Drawn standing(const Layout& layout, const LayoutPart& part) {
  Drawn set = drawn(layout.shapes[part.shape]);
  const double theta = part.orientation.radians(), c = std::cos(theta), s = std::sin(theta);
  const Point at{part.at.x.to_double(), part.at.y.to_double()};
  set.box = {};
  for (Chain& chain : set.chains)
    for (Point& p : chain.points) {  // y downwards
      p = {c * p.x + s * p.y + at.x, c * p.y - s * p.x - at.y};
      set.box.see(p);
    }
  return set;
}

}  // namespace

std::string layout_picture(const Layout& layout, const LayoutCheck& check) {
  std::set<std::uint32_t> wrong;
  for (const LayoutFault& f : check.faults) wrong.insert({f.part, f.other});
  std::vector<Drawn> parts;
  Box seen;
  for (const LayoutPart& part : layout.parts) seen.see(parts.emplace_back(standing(layout, part)).box);
  const Drawn container = layout.container ? drawn(*layout.container) : Drawn{};
  seen.see(container.box);
  MarkedDrawing drawing(seen);
  drawing.add(container, "fill=\"#f4f4f4\" stroke=\"#333333\"");
  for (std::uint32_t k = 0; k < parts.size(); ++k)
    drawing.add(parts[k], wrong.contains(k) ? "fill=\"#e8a33d\" fill-opacity=\"0.7\" stroke=\"#a8650a\""
                                            : "fill=\"#9ecae1\" fill-opacity=\"0.7\" stroke=\"#08519c\"");
  for (std::size_t k = check.faults.size(); k-- > 0;) drawing.mark(check.faults[k].at, k == 0);
  return drawing.text();
}

}  // namespace dymsum::cli
