#include "pictures/fit_picture.h"

#include <array>

#include "exit_code.h"
#include "pictures/marked_drawing.h"

namespace dymsum::cli {
namespace {

Point rounded_position(const RationalPoint& at) { return {at.x.to_double(), at.y.to_double()}; }

MarkedDrawing drawing_of(const Region& p, const Region& q, Point at) {
  const Drawn first = drawn(p), second = drawn(q, 1, at);
  Box seen;
  for (const Drawn* set : {&first, &second}) seen.see(set->box);
  MarkedDrawing drawing(seen);
  drawing.add(first, "fill=\"#c9d6e3\" stroke=\"#2f5d8a\"");
  drawing.add(second, "fill=\"#e8a33d\" fill-opacity=\"0.6\" stroke=\"#a8650a\"");
  return drawing;
}

/// Both ends of the edge that starts at a vertex of a ring, or that vertex twice.
std::array<Point, 2> ends_of(const Region& region, const PlanarFeature& feature) {
  std::uint32_t first = 0;
  std::array<Point, 2> ends{};
  const auto look = [&](const Ring& ring) {
    const auto count = static_cast<std::uint32_t>(ring.size());
    if (feature.index >= first && feature.index - first < count) {
      const std::uint32_t k = feature.index - first;
      const bool edge = feature.kind == PlanarFeature::Kind::edge;
      ends = {ring[k], ring[edge ? (k + 1) % count : k]};
    }
    first += count;
  };
  for (const Part& part : region.parts()) {
    look(part.outer);
    for (const Ring& hole : part.holes) look(hole);
  }
  return ends;
}

void mark_feature(MarkedDrawing& drawing, const Region& region, const PlanarFeature& feature, Point moved) {
  auto [a, b] = ends_of(region, feature);
  a = {a.x + moved.x, a.y + moved.y}, b = {b.x + moved.x, b.y + moved.y};
  if (feature.kind == PlanarFeature::Kind::edge) drawing.join(a, b);
  else drawing.mark(a, false);
}

}  // namespace

void check_fit_pictures(const std::vector<std::string>& files) {
  for (const std::string& file : files)
    if (!file.ends_with(".svg")) throw Stop(kUsage, "-o " + file + " is none of the formats of this verb: see --help");
}

std::string robustness_picture(const Region& p, const Region& q, const RationalPoint& at,
                               const Robustness& robustness) {
  MarkedDrawing drawing = drawing_of(p, q, rounded_position(at));
  for (const PlanarWay& one : robustness.ways)
    for (const PlanarTouch& touch : one.contacts) {
      const Point to = rounded_position(touch.at), move = rounded_position(one.move);
      const Point from{to.x - move.x, to.y - move.y};
      if (!(from == to)) drawing.join(from, to);
      drawing.mark(to, touch.dimension > 0);
    }
  return drawing.text();
}

std::string stack_picture(const Region& container, const Region& part, const RationalPoint& at, const FitStack& stack) {
  const Point moved = rounded_position(at);
  MarkedDrawing drawing = drawing_of(container, part, moved);
  if (!stack.rows.empty()) {
    mark_feature(drawing, container, stack.rows.front().container, {});
    mark_feature(drawing, part, stack.rows.front().part, moved);
  }
  return drawing.text();
}

}  // namespace dymsum::cli
