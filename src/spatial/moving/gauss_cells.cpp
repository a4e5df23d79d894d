#include "spatial/moving/gauss_cells.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace dymsum::spatial {

namespace {

constexpr std::uint32_t kMostAcross = 64;

/// Face 2 k lies towards the axis k, face 2 k + 1 the other way; u and v are the other two coordinates over that one.
Vec3 direction(std::uint32_t face, double u, double v) {
  const double s = face % 2 == 0 ? 1 : -1;
  const Vec3 d = face / 2 == 0 ? Vec3{s, u, v} : face / 2 == 1 ? Vec3{u, s, v} : Vec3{u, v, s};
  return (1 / length(d)) * d;
}

GaussCells::FourArcs in_floats(const GaussSide& side, std::span<const std::uint32_t> edges) {
  const auto f = [](double v) { return static_cast<float>(v); };
  GaussCells::FourArcs four{};
  for (std::size_t k = 0; k < 4; ++k) {
    if (k >= edges.size()) {
      four.radius[k] = -100;
      continue;
    }
    const std::uint32_t e = edges[k];
    const Vec3 &d = side.edges[e], &m = side.arcs[e].centre;
    four.x[k] = f(d.x), four.y[k] = f(d.y), four.z[k] = f(d.z);
    four.centre_x[k] = f(m.x), four.centre_y[k] = f(m.y), four.centre_z[k] = f(m.z);
    four.radius[k] = f(side.arcs[e].radius), four.index[k] = e;
  }
  return four;
}

}  // namespace

GaussCells::GaussCells(const GaussSide& side) {
  // A quarter of what a cone would be wide if all shared the sphere; cells are half as wide.
  const double fraction = 4 * std::numbers::pi / static_cast<double>(side.solid.cones.size() + 1);
  reach_ = std::clamp(0.3 * std::sqrt(fraction), 0.02, 0.3);
  while (across_ < kMostAcross && 2.0 / across_ > reach_) across_ *= 2;
  std::vector<std::uint32_t> cones(side.solid.cones.size()), arcs(side.arcs.size());
  std::iota(cones.begin(), cones.end(), 0u), std::iota(arcs.begin(), arcs.end(), 0u);
  Lists lists;
  lists.arcs.resize(cell(6, 0, 0)), lists.cones.resize(cell(6, 0, 0));
  for (std::uint32_t face = 0; face < 6; ++face) split(side, {face, 0, 0, across_}, cones, arcs, lists);
  for (const std::vector<std::uint32_t>& list : lists.arcs) {
    first_arc_.push_back(static_cast<std::uint32_t>(arcs_.size()));
    for (std::size_t k = 0; k < list.size(); k += 4) arcs_.push_back(in_floats(side, std::span(list).subspan(k)));
  }
  first_arc_.push_back(static_cast<std::uint32_t>(arcs_.size()));
  for (const std::vector<std::uint32_t>& list : lists.cones) {
    first_cone_.push_back(static_cast<std::uint32_t>(cones_.size()));
    cones_.insert(cones_.end(), list.begin(), list.end());
  }
  first_cone_.push_back(static_cast<std::uint32_t>(cones_.size()));
}

void GaussCells::split(const GaussSide& side, const Square& square, std::span<const std::uint32_t> cones,
                       std::span<const std::uint32_t> arcs, Lists& lists) const {
  const auto at = [&](double u, double v) {
    return direction(square.face, 2 * (square.u + u) / across_ - 1, 2 * (square.v + v) / across_ - 1);
  };
  const double size = square.size;
  const Vec3 centre = at(size / 2, size / 2);
  double radius = 0;
  for (const double u : {0.0, size})
    for (const double v : {0.0, size}) radius = std::max(radius, length(at(u, v) - centre));
  // Scaling may turn a cone by a quarter of the reach before cells are made again, and rounding may put a direction
  // into the cell beside its own.
  const double around = radius + 0.25 * reach_ + 0x1p-30, far = radius + reach_ + 0x1p-30;
  std::vector<std::uint32_t> near_cones, near_arcs;
  for (const std::uint32_t c : cones) {
    const SupportCone& cone = side.solid.cones[c];
    const auto above = [&](const Vec3& ray) { return dot(centre, ray) > around; };
    if (std::none_of(side.rays.begin() + cone.first, side.rays.begin() + cone.last, above)) near_cones.push_back(c);
  }
  for (const std::uint32_t e : arcs)
    if (std::abs(dot(centre, side.edges[e])) <= far &&
        length(centre - side.arcs[e].centre) <= far + side.arcs[e].radius)
      near_arcs.push_back(e);
  if (square.size == 1) {
    const std::size_t here = cell(square.face, square.u, square.v);
    lists.arcs[here] = std::move(near_arcs), lists.cones[here] = std::move(near_cones);
    return;
  }
  const std::uint32_t half = square.size / 2;
  for (const std::uint32_t u : {square.u, square.u + half})
    for (const std::uint32_t v : {square.v, square.v + half})
      split(side, {square.face, u, v, half}, near_cones, near_arcs, lists);
}

GaussCells::Cell GaussCells::at(Vec3 n) const {
  const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  const std::uint32_t axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
  const double along = axis == 0 ? n.x : axis == 1 ? n.y : n.z;
  const double scale = 0.5 * across_ / std::abs(along);
  const auto index = [&](double c) {
    return static_cast<std::uint32_t>(std::clamp(c * scale + 0.5 * across_, 0.0, across_ - 1.0));
  };
  const std::size_t here =
      cell(2 * axis + (along < 0 ? 1 : 0), index(axis == 0 ? n.y : n.x), index(axis == 2 ? n.y : n.z));
  return {{arcs_.data() + first_arc_[here], arcs_.data() + first_arc_[here + 1]},
          {cones_.data() + first_cone_[here], cones_.data() + first_cone_[here + 1]}};
}

}  // namespace dymsum::spatial
