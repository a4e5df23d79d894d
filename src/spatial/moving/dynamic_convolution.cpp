#include "spatial/moving/dynamic_convolution.h"

#include <algorithm>
#include <cmath>

#include "spatial/convolution/facet_rule.h"
#include "spatial/mesh/box_tree.h"

namespace dymsum::spatial {

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
