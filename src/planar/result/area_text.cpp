#include "dymsum/area_text.h"

#include "exact/decimal_text.h"
#include "planar/position/exact_area.h"
#include "planar/position/nearest_area.h"

namespace dymsum {
namespace {

constexpr int kDigits = 17;  // enough to distinguish any two doubles

}  // namespace

std::string area_text(const PlanarSum& sum) {
  std::string text;
  planar::narrow_area(sum, [&](const planar::AreaRange& range) {
    text = exact::decimal_text(range.first, kDigits);
    return exact::decimal_text(range.second, kDigits) == text;
  });
  return text;
}

std::string area_text(const Region& region) {
  std::vector<std::vector<planar::Position>> rings;
  const auto add = [&](const Ring& ring) {
    std::vector<planar::Position>& to = rings.emplace_back();
    for (const Point p : ring) to.push_back({exact::exact_value(p.x), exact::exact_value(p.y)});
  };
  for (const Part& part : region.parts()) {
    add(part.outer);
    for (const Ring& hole : part.holes) add(hole);
  }
  const planar::ExactArea area = planar::exact_area(rings);
  return exact::decimal_text(exact::BigRational(area.numerator, area.denominator), kDigits);
}

}  // namespace dymsum
