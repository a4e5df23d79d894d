#include "depth/depth_operands.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/poll.h"
#include "depth/exact_frame.h"
#include "dymsum/convex_solid.h"
#include "spatial/mesh/rounded_vector.h"
#include "spatial/sum/grid_error.h"

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

std::optional<Error> operand_error(const Mesh& p, const Mesh& q) {
  if (p.empty() || q.empty()) return Error{ErrorCode::no_area, "an operand is empty: it has no depth", {}};
  if (p.has_thin_parts() && q.has_thin_parts())
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

Result<std::shared_ptr<const DepthOperands>> depth_operands(const Mesh& p, const Mesh& q, const DepthOptions& options) {
  if (std::optional<Error> error = operand_error(p, q)) return *std::move(error);
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
    SpatialOptions sum_options;
    sum_options.threads = options.threads, sum_options.progress = options.progress;
    Result<SpatialSum> sum = minkowski_sum(p, reflected, sum_options);
    if (!sum) return sum.error();
    o->sum = *std::move(sum);
  }
  return std::shared_ptr<const DepthOperands>(std::move(o));
}

}  // namespace dymsum::depth
