#include "shrink.h"

#include <cmath>

#include "vertices_by.h"

namespace dymsum::oracles {
namespace {

/// All regions that are one step simpler.
std::vector<RegionData> simpler(const RegionData& region) {
  std::vector<RegionData> out;
  const auto change = [&](const auto& edit) {
    out.push_back(region);
    edit(out.back());
  };
  const auto index = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
  for (std::size_t i = 0; i < region.parts.size(); ++i) {
    change([&](RegionData& r) { r.parts.erase(r.parts.begin() + index(i)); });
    for (std::size_t k = 0; k < region.parts[i].holes.size(); ++k)
      change([&](RegionData& r) { r.parts[i].holes.erase(r.parts[i].holes.begin() + index(k)); });
    for (std::size_t v = 0; v < region.parts[i].outer.size(); ++v)
      change([&](RegionData& r) { r.parts[i].outer.erase(r.parts[i].outer.begin() + index(v)); });
    for (std::size_t k = 0; k < region.parts[i].holes.size(); ++k)
      for (std::size_t v = 0; v < region.parts[i].holes[k].size(); ++v)
        change([&](RegionData& r) { r.parts[i].holes[k].erase(r.parts[i].holes[k].begin() + index(v)); });
  }
  for (std::size_t i = 0; i < region.polylines.size(); ++i) {
    change([&](RegionData& r) { r.polylines.erase(r.polylines.begin() + index(i)); });
    for (std::size_t v = 0; v < region.polylines[i].size(); ++v)
      change([&](RegionData& r) { r.polylines[i].erase(r.polylines[i].begin() + index(v)); });
  }
  for (std::size_t i = 0; i < region.points.size(); ++i)
    change([&](RegionData& r) { r.points.erase(r.points.begin() + index(i)); });
  return out;
}

std::vector<Point*> vertices(RegionData& region) {
  std::vector<Point*> out;
  for_each_vertex(region, [&](Point& v) { out.push_back(&v); });
  return out;
}

/// All regions with one coordinate closer to zero.
std::vector<RegionData> nearer(const RegionData& region) {
  std::vector<RegionData> out;
  RegionData copy = region;
  const std::size_t count = vertices(copy).size();
  for (std::size_t i = 0; i < count; ++i)
    for (double Point::*axis : {&Point::x, &Point::y}) {
      const double value = vertices(copy)[i]->*axis;
      for (const double next : {0.0, std::trunc(value / 2), value - std::copysign(1.0, value)}) {
        if (value == 0 || std::fabs(next) >= std::fabs(value)) continue;
        out.push_back(region);
        vertices(out.back())[i]->*axis = next + 0.0;
      }
    }
  return out;
}

}  // namespace

Pair shrink(Pair pair, const std::function<bool(const RegionData&, const RegionData&)>& fails, int budget) {
  const auto step = [&](auto generate) {
    for (RegionData* operand : {&pair.p, &pair.q})
      for (RegionData& candidate : generate(*operand)) {
        if (budget-- <= 0) return false;
        std::swap(*operand, candidate);
        if (fails(pair.p, pair.q)) return true;
        std::swap(*operand, candidate);
      }
    return false;
  };
  while (step(simpler) || step(nearer)) {
  }
  return pair;
}

}  // namespace dymsum::oracles
