#include "spatial/moving/dynamic_convolution.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "spatial/convolution/reduced_facets.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {
namespace {

/// A vector of size about one, whatever the size of the integers. The relative errors of components below 2^-51.
template <class T>
Vec3 scaled_doubles(const exact::Vector3<T>& v) {
  if constexpr (std::is_same_v<T, exact::Big>) {
    const int drop = bit_length(v);
    return {rounded(v.x, -drop), rounded(v.y, -drop), rounded(v.z, -drop)};
  } else {
    const Vec3 d{to_double(v.x), to_double(v.y), to_double(v.z)};
    return std::ldexp(1.0, -std::ilogb(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}))) * d;
  }
}

Vec3 unit(Vec3 v) { return (1 / length(v)) * v; }

/// Scales are between 2^-64 and 2^64.
Vec3 times(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

GaussArc arc_between(Vec3 a, Vec3 b) {
  const Vec3 sum = a + b;
  if (length(sum) < 0x1p-10) return {{0, 0, 0}, 1 + 0x1p-40};
  const Vec3 centre = unit(sum);
  return {centre, std::max(length(a - centre), length(b - centre)) + 0x1p-40};
}

}  // namespace

GaussSide::GaussSide(const SolidOperand& operand, const GridPositions& positions) : solid(operand) {
  with_coordinates(positions, [&]<class C>(C) {
    const auto direction = [&](std::uint32_t from, std::uint32_t to) {
      return positions.position<C>(to) - positions.position<C>(from);
    };
    for (const Triangle& t : solid.triangles)
      own_normals_.push_back(scaled_doubles(exact::cross(direction(t[0], t[1]), direction(t[0], t[2]))));
    convex_of.assign(solid.wedges.size(), kNone);
    for (std::uint32_t w = 0; w < solid.wedges.size(); ++w) {
      if (solid.wedges[w].bend != Wedge::Bend::convex) continue;
      convex_of[w] = static_cast<std::uint32_t>(convex.size());
      convex.push_back(w);
      own_edges_.push_back(scaled_doubles(direction(solid.wedges[w].from, solid.wedges[w].to)));
    }
    own_rays_.resize(solid.rays.size());
    for (const SupportCone& cone : solid.cones)
      for (std::uint32_t k = cone.first; k < cone.last; ++k)
        own_rays_[k] = scaled_doubles(direction(cone.vertex, solid.rays[k]));
  });
  scale({1, 1, 1});
}

void GaussSide::scale(Vec3 factors) {
  const Vec3 of_normals{factors.y * factors.z, factors.x * factors.z, factors.x * factors.y};
  const auto scaled = [](const std::vector<Vec3>& from, Vec3 by, std::vector<Vec3>& to) {
    to.resize(from.size());
    for (std::size_t k = 0; k < from.size(); ++k) to[k] = unit(times(by, from[k]));
  };
  scaled(own_normals_, of_normals, normals);
  scaled(own_edges_, factors, edges);
  scaled(own_rays_, factors, rays);
  set_arcs();
}

void GaussSide::set_arcs() {
  arcs.resize(convex.size());
  for (std::uint32_t e = 0; e < convex.size(); ++e)
    arcs[e] = arc_between(normals[wedge(e).left], normals[wedge(e).right]);
}

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

namespace {

DirectionSource::Of operand_name(int op) { return op == 0 ? DirectionSource::Of::p : DirectionSource::Of::q; }

/// Whether all directions stay what they are: nothing moves but by scalings alike along all axes.
bool same_directions(const SolidPose& a, const SolidPose& b) {
  const auto alike = [](const SolidPose& pose) {
    return pose.scale[0] == pose.scale[1] && pose.scale[1] == pose.scale[2];
  };
  return a.rotation == b.rotation && (a.scale == b.scale || (alike(a) && alike(b)));
}

int proved_sign(double v) { return v > kSignError ? 1 : v < -kSignError ? -1 : 0; }

}  // namespace

DynamicConvolution::DynamicConvolution(const SolidPair& pair, SkippedCertificate skipped)
    : pair_(pair),
      skipped_(skipped),
      sides_{GaussSide(pair.p, pair.p_positions), GaussSide(pair.q, pair.q_positions)},
      edges_(sides_[0].convex.size()) {
  for (int op = 0; op < 2; ++op) {
    reach_[op] = cells_[op].emplace(sides_[op]).reach();
    walkers_[op].due.resize(operand(op).triangles.size());
    walkers_[op].matches.resize(operand(op).triangles.size());
  }
}

const ConvolutionWork& DynamicConvolution::set(const PosePair& poses, SpaceOnDemand& exact) {
  work_ = {};
  slots_.begin_move();
  const bool still = started_ && same_directions(poses_.p, poses.p) && same_directions(poses_.q, poses.q);
  poses_ = poses;
  if (still) return work_;
  exact_ = &exact;
  const double step = motion_to(poses);
  for (int op = 0; op < 2; ++op)
    if (drift_[op] > 0.25 * reach_[op]) cells_[op].emplace(sides_[op]), drift_[op] = 0;
  // Cells list what the step may have brought near.
  if (!started_ || step > longest_step()) {
    rebuild();
  } else {
    travelled_ += step;
    for (int op = 0; op < 2; ++op)
      for (std::uint32_t t = 0; t < walkers_[op].due.size(); ++t)
        if (walkers_[op].due[t] <= travelled_) look_at(op, t, step, false);
  }
  exact_ = nullptr;
  work_.added = slots_.added().size(), work_.removed = slots_.removed().size();
  return work_;
}

double DynamicConvolution::motion(const PosePair& from, const PosePair& to) const {
  return angle_of_scaling(scale_factors(from.p), scale_factors(to.p)) +
         angle_of_scaling(scale_factors(from.q), scale_factors(to.q)) +
         angle_between(relative_rotation(from.p.rotation, from.q.rotation),
                       relative_rotation(to.p.rotation, to.q.rotation));
}

/// A bound that is at least the angle by which any direction or normal of one operand moves as the other one sees it,
/// on a path on which it moves no further.
double DynamicConvolution::motion_to(const PosePair& poses) {
  double motion = 0;
  same_shapes_ = true;
  for (int op = 0; op < 2; ++op) {
    const Vec3 factors = scale_factors(op == 0 ? poses.p : poses.q);
    const double turn = angle_of_scaling(factors_[op], factors);
    if (turn > 0) sides_[op].scale(factors), same_shapes_ = false;
    factors_[op] = factors;
    drift_[op] += turn, motion += turn;
  }
  const UnitQuaternion rotation = relative_rotation(poses.p.rotation, poses.q.rotation);
  if (rotation.w != rotation_.w || length(rotation.v - rotation_.v) != 0 || !started_)
    motion += angle_between(rotation_, rotation);
  rotation_ = rotation;
  q_to_p_before_ = q_to_p_;
  q_to_p_ = matrix_of(rotation);
  return motion;
}

void DynamicConvolution::rebuild() {
  work_.rebuilt = started_ = true;
  travelled_ = 0;
  for (int op = 0; op < 2; ++op)
    for (std::uint32_t t = 0; t < walkers_[op].due.size(); ++t) look_at(op, t, 0, true);
  match_all_edges();
}

void DynamicConvolution::match_all_edges() {
  const auto box_of = [&](const GaussArc& arc, Vec3 centre) {
    Box box;
    box.add(centre);
    box.grow(arc.radius + 0x1p-30);
    return box;
  };
  std::vector<Box> boxes;
  for (const GaussArc& arc : sides_[1].arcs) boxes.push_back(box_of(arc, arc.centre));
  const BoxTree tree(std::move(boxes));
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    found_.clear();
    for (const Match& m : edges_[e]) found_.push_back(m.feature);
    const GaussArc& arc = sides_[0].arcs[e];
    tree.for_each(box_of(arc, seen_from_other(0, arc.centre)), [&](std::uint32_t g) { found_.push_back(g); });
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    for (const std::uint32_t g : found_) match_edges(e, g);
  }
}

/// A normal in the other operand's cells, after a step; at the first look all is new, and pairs of edges are left to
/// others.
void DynamicConvolution::look_at(int op, std::uint32_t triangle, double step, bool first) {
  ++work_.normals_checked;
  const int other = 1 - op;
  const Vec3 n = seen_from_other(op, sides_[op].normals[triangle]);
  const GaussCells::Cell cell = cells_[other]->at(n);
  const double drift = drift_[other] + GaussCells::kFloatError, passed = step + drift;
  double margin = cells_[other]->reach();
  const float x = static_cast<float>(n.x), y = static_cast<float>(n.y), z = static_cast<float>(n.z);
  bool any_passed = first;
  for (const GaussCells::FourArcs& four : cell.arcs) {
    // How far the normal is from the arcs, at least, but for what arcs have turned since cells were made.
    float aside[4];
    for (int k = 0; k < 4; ++k) aside[k] = std::abs(x * four.x[k] + y * four.y[k] + z * four.z[k]);
    const double near = std::max(margin, passed);
    if (std::min({aside[0], aside[1], aside[2], aside[3]}) > near) continue;
    for (int k = 0; k < 4; ++k) {
      if (aside[k] > near) continue;
      const float dx = x - four.centre_x[k], dy = y - four.centre_y[k], dz = z - four.centre_z[k];
      const double far = std::max(aside[k], std::sqrt(dx * dx + dy * dy + dz * dz) - four.radius[k]);
      if (skipped_ != SkippedCertificate::crossings) margin = std::min(margin, far);
      if (far <= passed && (first || pass(op, triangle, n, four.index[k]))) any_passed = true;
    }
  }
  if (any_passed) match_cones(op, triangle, n, cell.cones);
  walkers_[op].due[triangle] = travelled_ + std::max(0.0, margin - drift);
}

/// Looks at the pairs of a normal's edges with an arc that it may have passed; false where it has not: it is on the
/// side of the arc's circle on which it was before the move, a turn.
bool DynamicConvolution::pass(int op, std::uint32_t triangle, Vec3 n, std::uint32_t arc) {
  if (same_shapes_) {
    const Vec3 &own = sides_[op].normals[triangle], edge = sides_[1 - op].edges[arc];
    const Vec3 before = op == 0 ? row_times(own, q_to_p_before_) : q_to_p_before_ * own;
    if (proved_sign(dot(before, edge)) * proved_sign(dot(n, edge)) > 0) return false;
  }
  sides_[op].for_each_edge(triangle,
                           [&](std::uint32_t edge) { op == 0 ? match_edges(edge, arc) : match_edges(arc, edge); });
  return true;
}

void DynamicConvolution::match_cones(int op, std::uint32_t triangle, Vec3 n, std::span<const std::uint32_t> cones) {
  const GaussSide& side = sides_[1 - op];
  found_.clear();
  for (const std::uint32_t c : cones) {
    const SupportCone& cone = side.solid.cones[c];
    double most = -2;
    for (std::uint32_t k = cone.first; k < cone.last && most <= kSignError; ++k)
      most = std::max(most, dot(n, side.rays[k]));
    const int sign = proved_sign(most);
    if (sign < 0 || (sign == 0 && exactly_supported(op, triangle, c))) found_.push_back(c);
  }
  keep_found(op, triangle);
}

/// Brings a triangle's matches up to date with `found_`.
void DynamicConvolution::keep_found(int op, std::uint32_t triangle) {
  Matches& matches = walkers_[op].matches[triangle];
  const std::size_t lost = std::erase_if(matches, [&](const Match& m) {
    const bool gone = std::find(found_.begin(), found_.end(), m.feature) == found_.end();
    if (gone) slots_.remove(m.slot);
    return gone;
  });
  if (skipped_ == SkippedCertificate::births && lost == 0 && !work_.rebuilt) return;
  for (const std::uint32_t c : found_) {
    if (std::any_of(matches.begin(), matches.end(), [&](const Match& m) { return m.feature == c; })) continue;
    const std::uint32_t vertex = operand(1 - op).cones[c].vertex;
    matches.push_back({c, 0, slots_.add(face_vertex_facet(operand_name(op), operand(op), triangle, vertex))});
  }
}

bool DynamicConvolution::exactly_supported(int op, std::uint32_t triangle, std::uint32_t cone) {
  ++work_.exact_checks;
  const SolidOperand& vertices = operand(1 - op);
  return makes_facet((*exact_)(), operand_name(op), operand(op), triangle, vertices, vertices.cones[cone]);
}

void DynamicConvolution::match_edges(std::uint32_t e, std::uint32_t g) {
  ++work_.pairs_checked;
  const int side = edge_side(e, g);
  Matches& matches = edges_[e];
  const auto at = std::find_if(matches.begin(), matches.end(), [&](const Match& m) { return m.feature == g; });
  if (at != matches.end()) {
    if (at->side == side) return;
    slots_.remove(at->slot);
    *at = matches.back();
    matches.pop_back();
  }
  if (side != 0)
    matches.push_back(
        {g, side, slots_.add(edge_edge_facet(pair_.p, pair_.q, sides_[0].convex[e], sides_[1].convex[g], side))});
}

int DynamicConvolution::edge_side(std::uint32_t e, std::uint32_t g) {
  const GaussSide &p = sides_[0], &q = sides_[1];
  const Vec3 e_there = seen_from_other(0, p.edges[e]), g_here = seen_from_other(1, q.edges[g]);
  const EdgePairSigns at{
      proved_sign(dot(p.normals[p.wedge(e).left], g_here)), proved_sign(dot(p.normals[p.wedge(e).right], g_here)),
      proved_sign(dot(q.normals[q.wedge(g).left], e_there)), proved_sign(dot(q.normals[q.wedge(g).right], e_there))};
  if (!at.any_zero()) return edge_pair_side(at);
  ++work_.exact_checks;
  return facet_side((*exact_)(), pair_.p, pair_.q, p.convex[e], q.convex[g]);
}

std::vector<std::uint32_t> DynamicConvolution::in_order() const {
  std::vector<std::uint32_t> slots;
  slots.reserve(slots_.facets());
  Matches sorted;
  const auto list = [&](const Matches& matches) {
    sorted = matches;
    std::sort(sorted.begin(), sorted.end(), [](const Match& a, const Match& b) { return a.feature < b.feature; });
    for (const Match& m : sorted) slots.push_back(m.slot);
  };
  for (const Walkers& walkers : walkers_)
    for (const Matches& matches : walkers.matches) list(matches);
  for (const Matches& matches : edges_) list(matches);
  return slots;
}

}  // namespace dymsum::spatial
