// Places the parts of a nesting instance in a strip, largest first, each as far to the left as it fits beside those
// that are placed, at exact positions; then proves the layout.
#include <dymsum/dymsum.h>
#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace dymsum;
const char* const kParts = R"({"strip_height": 6, "items": [
  {"demand": 4, "allowed_orientations": [0, 90, 180, 270], "shape":
    {"type": "simple_polygon", "data": [[0,0],[4,0],[4,2],[2,2],[2,4],[0,4]]}},
  {"demand": 5, "allowed_orientations": [0],
   "shape": {"type": "rectangle", "data": {"x_min": 0, "y_min": 0, "width": 2, "height": 2}}}]})";

int main(int count, char** arguments) {
  const NestingInstance instance =
      (count > 1 ? read_nesting_instance(arguments[1]) : parse_nesting_instance(kParts, "parts")).value();
  Layout layout;
  std::vector<LayoutPart> oriented;                                   // a shape in an orientation
  std::vector<double> right;                                          // of it: its right end beside its origin
  std::vector<std::pair<double, std::vector<std::uint32_t>>> copies;  // the area of a part, and what it may be of these
  double length = 0;
  for (const NestingItem& item : instance.items) {
    const Region shape = repair(item.shape).value().region;
    std::vector<std::uint32_t> turned;
    for (const Rational& degrees : item.degrees.value()) {
      const Orientation by = Orientation::nearest(reduced_degrees(degrees)).value();
      turned.push_back(static_cast<std::uint32_t>(oriented.size()));
      oriented.push_back({item.name, static_cast<std::uint32_t>(layout.shapes.size()), by, {}});
      right.push_back(-INFINITY);
      for (const Point& p : shape.parts()[0].outer)
        right.back() = std::max(right.back(), std::cos(by.radians()) * p.x - std::sin(by.radians()) * p.y);
    }
    copies.insert(copies.end(), item.demand, {area(shape), turned});
    const auto box = bounds(shape);
    length += static_cast<double>(item.demand) * std::hypot(box[2] - box[0], box[3] - box[1]);
    layout.shapes.push_back(shape);
  }
  std::stable_sort(copies.begin(), copies.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  Placement placement = Placement::create(shapes::rectangle(0, 0, length, *instance.strip_height)).value();
  for (const LayoutPart& part : oriented) placement.add_shape(layout.shapes[part.shape], part.orientation).value();
  double used = 0;
  for (const auto& [size, turned] : copies) {
    LayoutPart best;
    double end = INFINITY;
    for (const std::uint32_t shape : turned)
      for (const FeasiblePositions all = *placement.feasible(shape); const CandidatePosition& c : all.candidates)
        if (c.vertex.at.x + right[shape] < end) {
          end = c.vertex.at.x + right[shape];
          best = {oriented[shape].name, shape, oriented[shape].orientation, all.set.exact(c.vertex)};
        }
    placement.add_part(best.shape, best.at).value();
    layout.parts.push_back({best.name, oriented[best.shape].shape, best.orientation, best.at});
    used = std::max(used, end * (1 + 1e-12));
  }
  layout.container = shapes::rectangle(0, 0, used, *instance.strip_height);
  const LayoutCheck check = check_layout(layout).value();
  const char* verdict = check.valid() ? "proved" : "wrong";
  std::printf("%zu parts, length %.5g, density %.4f: %s\n", layout.parts.size(), used, check.density, verdict);
}
