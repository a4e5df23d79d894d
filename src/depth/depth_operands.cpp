#include "depth/depth_operands.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/poll.h"
#include "depth/exact_frame.h"
#include "dymsum/convex_solid.h"
#include "spatial/mesh/vec3.h"
#include "spatial/sum/exact_set.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::depth {

using exact::BigInteger;
using exact::BigRational;
using spatial::SumFacet;
using spatial::Vec3;

namespace {

BigRational over_power(BigRational v, int exponent) {
  const BigInteger power = BigInteger(1) << static_cast<unsigned>(std::abs(exponent));
  return exponent >= 0 ? BigRational(v / power) : BigRational(v * power);
}

void set_scaled_positions(DepthOperands& o) {
  const spatial::SumSpace& space = *o.space;
  // Every axis has a grid of its own: the largest coordinate of all decides.
  int top = std::numeric_limits<int>::min();
  for (const std::vector<Vec3>* positions : {&space.p(), &space.q()}) {
    Vec3 most;
    for (const Vec3& v : *positions)
      most = {std::max(most.x, std::abs(v.x)), std::max(most.y, std::abs(v.y)), std::max(most.z, std::abs(v.z))};
    const double sizes[3] = {most.x, most.y, most.z};
    for (int axis = 0; axis < 3; ++axis)
      if (sizes[axis] > 0) top = std::max(top, space.line(axis).unit + std::ilogb(sizes[axis]) + 1);
  }
  o.scale = top + 1;
  const auto factor = [&](int axis) { return std::ldexp(1.0, space.line(axis).unit - o.scale); };
  const Vec3 f{factor(0), factor(1), factor(2)};
  for (const Vec3& v : space.p()) o.p_at.push_back({f.x * v.x, f.y * v.y, f.z * v.z});
  for (const Vec3& v : space.q()) o.q_at.push_back({f.x * v.x, f.y * v.y, f.z * v.z});
}

/// Sets the normals by doubles where the sides span a good angle, else rounded from integers.
void set_normals(DepthOperands& o) {
  const ExactFrame frame(o.p.vertices, o.q.vertices, o.exponent, {});
  o.normals.reserve(o.facets.size());
  for (const SumFacet& f : o.facets) {
    const Vec3 a = o.corner(f.corner[0]), u = o.corner(f.corner[1]) - a, v = o.corner(f.corner[2]) - a;
    const Vec3 n = spatial::cross(u, v);
    const double size = spatial::length(n), sides = spatial::length(u) * spatial::length(v);
    const double perimeter = spatial::length(u) + spatial::length(v);
    const bool good = size > sides * 0x1p-6 && (o.space->sum_radius() == 0 || size > perimeter * 0x1p-10);
    o.normals.push_back(good ? (1 / size) * n : spatial::unit(frame.plane(f).n));
  }
}

spatial::BoxTree tree_of(const DepthOperands& o) {
  std::vector<spatial::Box> boxes;
  boxes.reserve(o.facets.size());
  for (const SumFacet& f : o.facets) {
    spatial::Box box;
    for (int k = 0; k < f.corners; ++k) box.add(o.corner(f.corner[static_cast<std::size_t>(k)]));
    box.grow(DepthOperands::kOff);
    boxes.push_back(box);
  }
  return spatial::BoxTree(std::move(boxes));
}

std::optional<Error> operand_error(const spatial::OperandSet& p, const spatial::OperandSet& q) {
  const auto is_empty = [](const spatial::OperandSet& set) {
    return set.mesh() ? set.mesh()->empty() : set.set().at.empty();
  };
  if (is_empty(p) || is_empty(q)) return Error{ErrorCode::no_area, "an operand is empty: it has no depth", {}};
  if (p.has_thin() && q.has_thin())
    return Error{ErrorCode::unsupported_operand, "both operands have parts without volume: depth wants one solid", {}};
  return std::nullopt;
}

/// Few boxes are many times faster than the facets that they save.
int cells_across(std::size_t facets) { return facets < 500 ? 16 : facets < 20000 ? 62 : 126; }

void find_facets(DepthOperands& o, const DepthOptions& options) {
  SpatialStats stats;
  SpatialOptions sum_options;
  sum_options.threads = options.threads, sum_options.progress = options.progress;
  spatial::StageWatch watch(sum_options, stats);
  watch.begin("convolution");
  o.facets = spatial::reduced_convolution(*o.space, o.p, o.q, watch).facets;
  o.inner = std::make_unique<spatial::InnerCells>(*o.space, o.p, o.q, cells_across(o.facets.size()), watch);
  std::erase_if(o.facets, [&](const SumFacet& f) { return o.inner->hold(f); });
}

}  // namespace

Vec3 DepthOperands::scaled(const std::array<BigRational, 3>& world) const {
  const auto coordinate = [&](int axis) {
    const spatial::SumSpace::Line line = space->line(axis);
    return exact::round_to_double(over_power(
        world[static_cast<std::size_t>(axis)] - exact::exact_value(line.p_offset) - exact::exact_value(line.q_offset),
        scale));
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

namespace {

Result<std::shared_ptr<const DepthOperands>> operands_of_results(const SpatialOperand& p, const SpatialOperand& q,
                                                                 const SpatialOptions& options) {
  Result<SpatialSum> sum = sum_with_reflected(p, q, options);
  if (!sum) return sum.error();
  auto o = std::make_shared<DepthOperands>();
  o->results.emplace(*std::move(sum));
  return std::shared_ptr<const DepthOperands>(std::move(o));
}

Result<std::shared_ptr<const DepthOperands>> operands_of_meshes(const Mesh& p, const Mesh& q,
                                                                const DepthOptions& options,
                                                                const SpatialOptions& sum_options) {
  if (std::optional<Error> error = spatial::grid_error(p.vertices(), q.vertices())) return *std::move(error);
  auto o = std::make_shared<DepthOperands>();
  o->engine = options.engine;
  o->convex = !convexity_error(p) && !convexity_error(q);
  const Mesh reflected = negated(q);
  o->p = spatial::solid_operand(p.data(), p.thin_faces());
  o->q = spatial::solid_operand(reflected.data(), reflected.thin_faces());
  try {
    o->space = spatial::make_sum_space(o->p.vertices, o->q.vertices);
    o->exponent = common_exponent(o->p.vertices, o->q.vertices);
    find_facets(*o, options);
  } catch (const std::invalid_argument& e) {
    return Error{ErrorCode::unsupported_operand, e.what(), {}};
  } catch (const Cancelled&) {
    return cancelled();
  }
  set_scaled_positions(*o);
  set_normals(*o);
  o->tree = tree_of(*o);
  if (options.contacts) o->touching = std::make_unique<const TouchingPairs>(touch_side(p), touch_side(q));
  if (options.engine == DepthEngine::boundary) {
    Result<SpatialSum> sum = minkowski_sum(p, reflected, sum_options);
    if (!sum) return sum.error();
    o->sum = *std::move(sum);
  }
  return std::shared_ptr<const DepthOperands>(std::move(o));
}

}  // namespace

Result<std::shared_ptr<const DepthOperands>> depth_operands(const SpatialOperand& p, const SpatialOperand& q,
                                                            const DepthOptions& options) {
  const spatial::OperandSet a(p, Semantics::closed), b(q, Semantics::closed);
  if (std::optional<Error> error = operand_error(a, b)) return *std::move(error);
  SpatialOptions sum_options;
  sum_options.threads = options.threads, sum_options.progress = options.progress;
  if (a.mesh() && b.mesh()) return operands_of_meshes(*a.mesh(), *b.mesh(), options, sum_options);
  return operands_of_results(p, q, sum_options);
}

using spatial::Box;
using spatial::Triangle;

namespace {

constexpr std::size_t kWitnesses = 8, kInner = 96;
constexpr int kPairs = 600;

/// How far along a ray a triangle lies, about; 8 where it misses.
double distance_along(Vec3 from, Vec3 way, const std::vector<Vec3>& at, const Triangle& t) {
  const Vec3 a = at[t[0]] - from, b = at[t[1]] - from, c = at[t[2]] - from;
  const double u = spatial::dot(spatial::cross(a, b), way), v = spatial::dot(spatial::cross(b, c), way),
               w = spatial::dot(spatial::cross(c, a), way);
  if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) return 8;
  const Vec3 n = spatial::cross(b - a, c - a);
  const double s = spatial::dot(n, a) / spatial::dot(n, way);
  return s > 0 ? s : 8;
}

/// The segment from e to f against the triangle a, b, c: all five volumes are proved, and say that it goes through.
bool goes_through(Vec3 e, Vec3 f, const std::array<Vec3, 3>& t, double off) {
  const Vec3 u = t[1] - t[0], v = t[2] - t[0];
  const int s = proved_sign(u, v, e - t[0], off);
  if (s == 0 || proved_sign(u, v, f - t[0], off) != -s) return false;
  const Vec3 d = f - e;
  const int side = proved_sign(t[0] - e, t[1] - e, d, off);
  return side != 0 && proved_sign(t[1] - e, t[2] - e, d, off) == side &&
         proved_sign(t[2] - e, t[0] - e, d, off) == side;
}

}  // namespace

/// Positions half-way from the centre of some triangles to what lies behind them.
ProvedOverlap::Solid::Solid(const spatial::SolidOperand& operand, const std::vector<Vec3>& positions)
    : solid(operand), at(positions), tree(spatial::boxes_of(positions, operand.triangles, 0)) {
  const std::size_t count = solid.triangles.size(), step = count / kInner + 1;
  for (std::size_t k = 0; k < count; k += step) {
    const Triangle& t = solid.triangles[k];
    const Vec3 centre = (1.0 / 3) * (at[t[0]] + at[t[1]] + at[t[2]]);
    const Vec3 n = spatial::cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]);
    const Vec3 inward = (-1 / spatial::length(n)) * n;
    double behind = 8;
    for (std::size_t j = 0; j < count; ++j)
      if (j != k) behind = std::min(behind, distance_along(centre, inward, at, solid.triangles[j]));
    const Vec3 position = centre + (0.5 * behind) * inward;
    if (behind < 8 && contains(position, 0x1p-30)) inner.push_back(position);
  }
}

bool ProvedOverlap::Solid::contains(Vec3 position, double margin) const {
  Box ray;
  ray.add(position);
  ray.grow(2 * margin);
  ray.high.z = 8;
  bool inside = false, known = true;
  tree.for_each(ray, [&](std::uint32_t j) {
    if (!known) return;
    const Triangle& t = solid.triangles[j];
    const int pass = spatial::passes_upward(position, at[t[0]], at[t[1]], at[t[2]], margin);
    known = pass >= 0;
    inside ^= pass == 1;
  });
  return known && inside;
}

ProvedOverlap::ProvedOverlap(const DepthOperands& o) : o_(o), p_(o.p, o.p_at), q_(o.q, o.q_at) {}

bool ProvedOverlap::some_inside(Solid& of, const Solid& other, Vec3 at, double margin) {
  const std::size_t count = of.inner.size();
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = (of.last + k) % count;
    if (!other.contains(at - of.inner[i], margin)) continue;
    of.last = i;
    return true;
  }
  return false;
}

bool ProvedOverlap::crosses(std::uint32_t i, std::uint32_t j, Vec3 at, double radius) const {
  std::array<Vec3, 3> a, c;
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] = o_.p_at[o_.p.triangles[i][k]];
    c[k] = at - o_.q_at[o_.q.triangles[j][k]];
  }
  const double off = 2 * (radius + 4 * DepthOperands::kOff * (1 + largest(at)));
  for (std::size_t k = 0; k < 3; ++k) {
    if (goes_through(a[k], a[(k + 1) % 3], c, off)) return true;
    if (goes_through(c[k], c[(k + 1) % 3], a, off)) return true;
  }
  return false;
}

bool ProvedOverlap::holds(Vec3 at, double radius) {
  for (std::size_t k = 0; k < witnesses_.size(); ++k) {
    if (!crosses(witnesses_[k][0], witnesses_[k][1], at, radius)) continue;
    std::rotate(witnesses_.begin(), witnesses_.begin() + static_cast<std::ptrdiff_t>(k),
                witnesses_.begin() + static_cast<std::ptrdiff_t>(k) + 1);
    return true;
  }
  Box box;
  box.add(at);
  bool found = false;
  int left = kPairs;
  p_.tree.any_reflected_pair(q_.tree, box, [&](std::uint32_t i, std::uint32_t j) {
    found = crosses(i, j, at, radius);
    if (found) witnesses_.insert(witnesses_.begin(), {i, j});
    return found || --left == 0;
  });
  if (witnesses_.size() > kWitnesses) witnesses_.pop_back();
  const double margin = radius + 8 * DepthOperands::kOff * (1 + largest(at));
  return found || some_inside(p_, q_, at, margin) || some_inside(q_, p_, at, margin);
}

namespace {

/// A space keeps the positions that it was queried: it is made anew before they are many.
constexpr std::size_t kPositions = 1 << 16;
constexpr std::size_t kBalls = 4;

}  // namespace

DepthProbe::DepthProbe(const DepthOperands& o) : o_(o), proved_(o) { renew(); }

void DepthProbe::renew() {
  collision_.reset();
  space_ = spatial::make_sum_space(o_.p.vertices, o_.q.vertices);
  collision_ = std::make_unique<const spatial::Collision>(*space_, o_.p, o_.q, o_.inner.get());
  positions_ = 0;
}

bool DepthProbe::overlaps(const std::array<BigRational, 3>& position) {
  if (++positions_ > kPositions) renew();
  const std::optional<spatial::PointSource> at = space_->add_position(position);
  return at && collision_->overlaps({*at, 0, 0, 0, 0, 0});
}

void DepthProbe::remember(const CoveredBall& ball, std::vector<Free> free) {
  balls_.insert(balls_.begin(), ball);
  if (balls_.size() > kBalls) balls_.pop_back();
  free_ = std::move(free);
}

bool DepthProbe::provably_overlaps(spatial::Vec3 at, double radius) { return proved_.holds(at, radius); }

}  // namespace dymsum::depth
