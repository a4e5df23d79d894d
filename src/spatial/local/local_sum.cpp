// The public class: one position after the other.
#include "dymsum/local_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "base/double_text.h"
#include "base/poll.h"
#include "exact/big.h"
#include "spatial/convolution/reduced_facets.h"
#include "spatial/local/local_boundary.h"
#include "spatial/local/near_facets.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/moving/dynamic_convolution.h"
#include "spatial/moving/inner_facets.h"
#include "spatial/sum/solid_faces.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {
namespace {

// What of a part of a sum meets a ball.

using exact::BigRational;

using Loops = std::vector<std::vector<std::uint32_t>>;

using Seen = std::array<BigRational, 3>;  // from the ball's centre

BigRational product(const Seen& a, const Seen& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Seen difference(const Seen& a, const Seen& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Seen normal_of(const Seen& a, const Seen& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

class BallTest {
 public:
  BallTest(const ClipBall& ball, const SpatialSum& part) : ball_(ball), part_(part) {
    const BigRational r = exact::exact_value(ball.radius);
    square_ = r * r;
    double size = ball.radius;
    for (const Point3& v : part.vertices)
      size =
          std::max({size, std::abs(v.x - ball.centre.x), std::abs(v.y - ball.centre.y), std::abs(v.z - ball.centre.z)});
    const double far = std::max({std::abs(ball.centre.x), std::abs(ball.centre.y), std::abs(ball.centre.z)});
    // Products of four lengths have to stay doubles; else integers decide everything.
    if (size + far > 0x1p-240 && size + far < 0x1p240) slack_ = 4 * part.at_error + (size + far) * 0x1p-44;
  }

  bool meets(std::uint32_t v) { return meets_segment(v, v); }
  bool meets_segment(std::uint32_t a, std::uint32_t b) {
    const double d = rough_distance(a, b);
    if (d < ball_.radius - slack_) return true;
    if (d > ball_.radius + slack_) return false;
    return segment_square(a, b) <= square_;
  }
  bool meets(const Loops& loops) {
    if (is_beyond(loops)) return false;
    bool close = false;
    for (const auto& loop : loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const double d = rough_distance(loop[k], loop[(k + 1) % loop.size()]);
        if (d < ball_.radius - slack_) return true;
        close = close || !(d > ball_.radius + slack_);
      }
    }
    if (close)
      for (const auto& loop : loops)
        for (std::size_t k = 0; k < loop.size(); ++k)
          if (meets_segment(loop[k], loop[(k + 1) % loop.size()])) return true;
    const std::optional<bool> inside = close ? std::nullopt : rough_inside(loops);
    return inside ? *inside : meets_inside(loops);
  }

 private:
  const Seen& at(std::uint32_t v) {
    const auto [found, is_new] = at_.try_emplace(v);
    if (is_new) {
      const RationalPoint3 x = part_.exact(v);
      found->second = {exact::exact_value(x.x) - exact::exact_value(ball_.centre.x),
                       exact::exact_value(x.y) - exact::exact_value(ball_.centre.y),
                       exact::exact_value(x.z) - exact::exact_value(ball_.centre.z)};
    }
    return found->second;
  }
  Vec3 seen(std::uint32_t v) const {
    const Point3& p = part_.vertices[v];
    return {p.x - ball_.centre.x, p.y - ball_.centre.y, p.z - ball_.centre.z};
  }
  /// The distance to within the slack.
  double rough_distance(std::uint32_t a, std::uint32_t b) const {
    const Vec3 u = seen(a), d = seen(b) - u;
    const double size = dot(d, d), t = size > 0 ? std::clamp(-dot(u, d) / size, 0.0, 1.0) : 0;
    return length(u + t * d);
  }
  /// The face's box lies off the ball's.
  bool is_beyond(const Loops& loops) const {
    Box box;
    for (const std::uint32_t v : loops.front()) box.add(seen(v));
    const double r = ball_.radius + slack_;
    return !overlap(box, {{-r, -r, -r}, {r, r, r}});
  }
  BigRational segment_square(std::uint32_t a, std::uint32_t b) {
    const Seen u = at(a), d = difference(at(b), u);
    const BigRational size = product(d, d);
    BigRational t = size == 0 ? BigRational(0) : BigRational(-product(u, d) / size);
    t = t < 0 ? BigRational(0) : t > 1 ? BigRational(1) : t;
    const Seen x{u[0] + t * d[0], u[1] + t * d[1], u[2] + t * d[2]};
    return product(x, x);
  }
  /// The same in doubles of a face whose facet edges are all further away than the ball reaches: then the ball's disc
  /// in its plane lies inside or outside as a whole, and its centre away from the facet edges. Nothing where that is
  /// not proved.
  std::optional<bool> rough_inside(const Loops& loops) const {
    const std::vector<std::uint32_t>& outer = loops.front();
    const Vec3 o = seen(outer[0]);
    Vec3 n;
    double areas = 0, sides = 0;
    for (std::size_t k = 1; k + 1 < outer.size(); ++k) {
      const Vec3 u = seen(outer[k]) - o, v = seen(outer[k + 1]) - o;
      n = n + cross(u, v);
      areas += length(u) * length(v), sides += length(u) + length(v);
    }
    const double size = length(n), reach = length(o) + ball_.radius;
    const double off = (8 * slack_ * sides + 0x1p-46 * areas) / size;  // of the unit normal
    if (!(off < 0x1p-10)) return std::nullopt;
    const Vec3 unit = (1 / size) * n;
    const double d = dot(unit, o), d_off = 4 * (off * reach + slack_);
    if (std::abs(d) > ball_.radius + d_off) return false;
    const double margin = ball_.radius * ball_.radius - d * d;
    if (!(margin > 256 * d_off * reach)) return std::nullopt;
    return holds(loops, d * unit, unit);
  }
  bool holds(const Loops& loops, Vec3 foot, Vec3 n) const {
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    const int drop = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const auto flat = [&](Vec3 v) {
      return drop == 0 ? std::array{v.y, v.z} : drop == 1 ? std::array{v.z, v.x} : std::array{v.x, v.y};
    };
    const auto [fx, fy] = flat(foot);
    bool inside = false;
    for (const auto& loop : loops) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const auto [ax, ay] = flat(seen(loop[k]));
        const auto [bx, by] = flat(seen(loop[(k + 1) % loop.size()]));
        if ((ay > fy) != (by > fy)) inside ^= fx < ax + (fy - ay) / (by - ay) * (bx - ax);
      }
    }
    return inside;
  }
  /// The foot of the centre on the face's plane lies inside, no further than the radius.
  bool meets_inside(const Loops& loops) {
    Seen n{};
    const std::vector<std::uint32_t>& outer = loops.front();
    for (std::size_t k = 0; k < outer.size(); ++k) {
      const Seen c = normal_of(at(outer[k]), at(outer[(k + 1) % outer.size()]));
      for (std::size_t i = 0; i < 3; ++i) n[i] += c[i];
    }
    const BigRational d = product(n, at(outer[0])), size = product(n, n);
    if (d * d > square_ * size) return false;
    const BigRational t = d / size;
    const Seen foot{t * n[0], t * n[1], t * n[2]};
    std::size_t drop = 0;
    while (n[drop] == 0) ++drop;
    bool inside = false;
    for (const auto& loop : loops)
      for (std::size_t k = 0; k < loop.size(); ++k)
        inside ^= passes(at(loop[k]), at(loop[(k + 1) % loop.size()]), foot, (drop + 1) % 3, (drop + 2) % 3);
    return inside;
  }
  static bool passes(const Seen& a, const Seen& b, const Seen& x, std::size_t i, std::size_t j) {
    if ((a[j] > x[j]) == (b[j] > x[j])) return false;
    return x[i] < a[i] + (x[j] - a[j]) / (b[j] - a[j]) * (b[i] - a[i]);
  }

  const ClipBall& ball_;
  const SpatialSum& part_;
  BigRational square_;
  double slack_ = std::numeric_limits<double>::infinity();
  std::map<std::uint32_t, Seen> at_;
};

/// Keeps those entries of parallel lists for which keep(k) holds.
template <class F, class... List>
void keep_entries(F keep, std::size_t count, List&... lists) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (!keep(k)) continue;
    if (kept != k) ((lists[kept] = std::move(lists[k])), ...);
    ++kept;
  }
  (lists.resize(kept), ...);
}

/// Those of edges of which a face is kept.
std::vector<std::optional<SolidContact>> kept_contacts(const std::vector<std::uint32_t>& name, const SpatialSum& part) {
  std::vector<std::optional<SolidContact>> contacts;
  for (const SpatialEdge& edge : part.edges())
    if (std::any_of(edge.faces.begin(), edge.faces.end(), [&](std::uint32_t f) { return name[f] != kNoId; }))
      contacts.push_back(edge.contact);
  return contacts;
}

/// Pieces of the boundary have new indices.
void rename_shells(SpatialSum& part) {
  std::map<std::uint32_t, std::uint32_t> shell;
  for (SpatialFace& face : part.faces)
    face.shell = shell.try_emplace(face.shell, static_cast<std::uint32_t>(shell.size())).first->second;
  part.shells = shell.size();
}

void drop_unused_vertices(SpatialSum& part) {
  std::vector<std::uint32_t> name(part.vertices.size(), kNoId);
  const auto for_each = [&](auto f) {
    for (SpatialFace& face : part.faces)
      for (auto& loop : face.loops) std::for_each(loop.begin(), loop.end(), f);
    for (Loops& loops : part.tight_faces)
      for (auto& loop : loops) std::for_each(loop.begin(), loop.end(), f);
    for (auto& segment : part.tight_segments) std::for_each(segment.begin(), segment.end(), f);
    std::for_each(part.tight_points.begin(), part.tight_points.end(), f);
  };
  for_each([&](std::uint32_t v) { name[v] = 0; });
  auto positions = std::make_shared<SpatialPositions>(SpatialSumInternals::positions(part));
  std::uint32_t count = 0;
  for (std::uint32_t& n : name)
    if (n == 0) n = count++;
  keep_entries([&](std::size_t k) { return name[k] != kNoId; }, name.size(), part.vertices, part.vertex_contacts,
               positions->vertices);
  SpatialSumInternals::set_positions(part, std::move(positions));
  for_each([&](std::uint32_t& v) { v = name[v]; });
}

/// Drops the faces, tight faces, tight segments and tight points that do not meet the closed ball, and vertices that
/// then belong to nothing. Exact. O(n) in doubles, and exact distances where the ball's surface comes near.
void keep_in_ball(const ClipBall& ball, SpatialSum& part) {
  if (part.vertices.empty()) return;
  BallTest test(ball, part);
  std::vector<std::uint32_t> name(part.faces.size(), kNoId);
  std::uint32_t kept = 0;
  for (std::size_t k = 0; k < part.faces.size(); ++k)
    if (test.meets(part.faces[k].loops)) name[k] = kept++;
  SpatialSumInternals::set_edge_contacts(part, kept_contacts(name, part));
  keep_entries([&](std::size_t k) { return name[k] != kNoId; }, name.size(), part.faces);
  keep_entries([&](std::size_t k) { return test.meets(part.tight_faces[k]); }, part.tight_faces.size(),
               part.tight_faces, part.tight_face_contacts);
  keep_entries([&](std::size_t k) { return test.meets_segment(part.tight_segments[k][0], part.tight_segments[k][1]); },
               part.tight_segments.size(), part.tight_segments, part.tight_segment_contacts);
  keep_entries([&](std::size_t k) { return test.meets(part.tight_points[k]); }, part.tight_points.size(),
               part.tight_points, part.tight_point_contacts);
  rename_shells(part);
  drop_unused_vertices(part);
}

}  // namespace
}  // namespace dymsum::spatial

namespace dymsum {

// The public class: one position after the other.

using spatial::ClipWalls;
using spatial::PosedSpace;
using spatial::PosePair;
using spatial::ReducedConvolution;

namespace {

double exact_end(double centre, double radius, double towards) {
  const exact::BigRational end = exact::exact_value(centre) + exact::exact_value(radius);
  const double rounded = centre + radius;
  if (!std::isfinite(rounded)) return std::copysign(std::numeric_limits<double>::max(), towards);
  const bool inside = towards > 0 ? exact::exact_value(rounded) < end : exact::exact_value(rounded) > end;
  return inside ? std::nextafter(rounded, towards) : rounded;
}

spatial::Centre centre_of(const ClipBox& box, const ClipBall* ball) {
  const auto centre = [](double low, double high) {
    return exact::BigRational((exact::exact_value(low) + exact::exact_value(high)) / 2);
  };
  const Point3 &a = ball != nullptr ? ball->centre : box.low, &b = ball != nullptr ? ball->centre : box.high;
  return {{centre(a.x, b.x), centre(a.y, b.y), centre(a.z, b.z)}, ball != nullptr};
}

bool is_finite_position(const Point3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::optional<Error> box_error(const ClipBox& box) {
  if (!is_finite_position(box.low) || !is_finite_position(box.high))
    return Error{ErrorCode::not_finite, "a corner of the box is not finite", {}};
  if (!(box.low.x < box.high.x && box.low.y < box.high.y && box.low.z < box.high.z))
    return Error{ErrorCode::out_of_range, "the box has no extent along an axis", {}};
  return std::nullopt;
}

}  // namespace

ClipBox bounding_box(const ClipBall& ball) {
  constexpr double kUp = std::numeric_limits<double>::infinity();
  const Point3& m = ball.centre;
  const double r = ball.radius;
  return {{exact_end(m.x, -r, -kUp), exact_end(m.y, -r, -kUp), exact_end(m.z, -r, -kUp)},
          {exact_end(m.x, r, kUp), exact_end(m.y, r, kUp), exact_end(m.z, r, kUp)}};
}

class LocalSum::State {
 public:
  State(const Mesh& p, const Mesh& q, const LocalOptions& given) : options_(given), pair_(spatial::solid_pair(p, q)) {
    stages_.tight = options_.tight, stages_.threads = options_.threads, stages_.progress = options_.progress;
    if (options_.engine == LocalEngine::brute) stages_.engine = SpatialEngine::brute;
    if (is_empty()) return;
    if (options_.engine != LocalEngine::brute) inner_.emplace(pair_);
    if (options_.engine == LocalEngine::updated) convolution_.emplace(pair_);
    if (options_.engine == LocalEngine::hierarchy) near_.emplace(pair_);
  }

  Result<LocalPart> in(const ClipBox& box, const ClipBall* ball, const PosePair& poses) {
    const Stopwatch watch;
    if (std::optional<Error> error = box_error(box)) return *std::move(error);
    Result<LocalPart> part = spatial::guarded([&] { return part_of(box, ball, poses); });
    if (!part) return part.error();
    LocalPart result = *std::move(part);
    result.work.ms = watch.ms();
    return result;
  }

  std::size_t facet_count() const { return convolution_ && moved_ ? convolution_->slots().facets() : all_facets_; }

 private:
  bool is_empty() const { return pair_.p.vertices.empty() || pair_.q.vertices.empty(); }

  LocalPart part_of(const ClipBox& box, const ClipBall* ball, const PosePair& poses) {
    LocalPart part;
    part.box = box;
    SpatialStats& stats = part.boundary.stats;
    spatial::StageWatch watch(stages_, stats);
    watch.begin("convolution");
    if (is_empty()) return part;
    ClipWalls walls(box, spatial::sum_bounds(pair_, poses), options_.engine != LocalEngine::brute);
    if (walls.misses()) return part;
    PosedSpace space = spatial::posed_space(pair_, poses, walls.levels());
    const exact::BigInteger scale = space.scale;
    ReducedConvolution near = facets(space, walls, poses, watch, part.work);
    part.work.facets = near.facets.size();
    stats.face_vertex = near.counts.face_vertex, stats.edge_edge = near.counts.edge_edge;
    spatial::LocalBoundary local =
        spatial::local_boundary(space, std::move(near), pair_, walls, centre_of(box, ball), stages_, stats, watch);
    watch.begin("faces");
    spatial::assemble(local.boundary, pair_.p, pair_.q, part.boundary, watch);
    watch.begin("");
    spatial::unscale(part.boundary, scale);
    if (ball != nullptr) spatial::keep_in_ball(*ball, part.boundary);
    part.work.contacts = stats.contacts, part.work.collision_tests = stats.collision_tests;
    part.work.tight_tests = stats.tight_tests, part.work.exact_signs = stats.exact_signs;
    part.where = !part.boundary.vertices.empty() ? LocalPart::Where::crossed
                 : local.centre_inside           ? LocalPart::Where::inside
                                                 : LocalPart::Where::outside;
    return part;
  }

  /// Those near the larger box of the walls; of the reference all.
  ReducedConvolution facets(const PosedSpace& space, const ClipWalls& walls, const PosePair& poses,
                            spatial::StageWatch& watch, LocalPart::Work& work) {
    const spatial::Box reach = walls.reach(*space.space, static_cast<std::uint32_t>(pair_.p.vertices.size()));
    if (inner_) inner_->move(space, poses);
    if (near_) {
      ReducedConvolution found = near_->find(*space.space, reach);
      work.rebuilt = true, work.pairs = near_->pairs();
      return outer_facets(found);
    }
    if (convolution_) return updated_facets(*space.space, reach, poses, work);
    ReducedConvolution all = spatial::reduced_convolution(*space.space, pair_.p, pair_.q, watch);
    work.rebuilt = true, all_facets_ = all.facets.size();
    return all;
  }

  /// Those that are not known to lie deep inside the open sum.
  ReducedConvolution outer_facets(const ReducedConvolution& all) {
    ReducedConvolution outer;
    outer.counts = all.counts;
    for (std::uint32_t f = 0; f < all.facets.size(); ++f) {
      inner_->forget(f);
      if (inner_->hold(f, all.facets[f])) continue;
      outer.facets.push_back(all.facets[f]), outer.planes.push_back(all.planes[f]);
    }
    return outer;
  }

  ReducedConvolution updated_facets(const spatial::SumSpace& space, const spatial::Box& reach, const PosePair& poses,
                                    LocalPart::Work& work) {
    if (!moved_ || !(poses_ == poses)) {
      spatial::SpaceOnDemand exact(pair_, poses);
      work.rebuilt = convolution_->set(poses, exact).rebuilt;
      poses_ = poses, moved_ = true;
      for (const std::uint32_t slot : convolution_->slots().added()) inner_->forget(slot);
    }
    ReducedConvolution near;
    const spatial::FacetSlots& slots = convolution_->slots();
    for (std::uint32_t slot = 0; slot < slots.count(); ++slot) {
      if (!slots.exists(slot)) continue;
      const spatial::SumFacet& facet = slots[slot];
      ++(facet.kind == spatial::SumFacet::Kind::edge_edge ? near.counts.edge_edge : near.counts.face_vertex);
      if (!spatial::comes_near(space, facet, reach) || inner_->hold(slot, facet)) continue;
      near.facets.push_back(facet);
      near.planes.push_back(spatial::plane_of(facet));
    }
    return near;
  }

  LocalOptions options_;
  SpatialOptions stages_;
  spatial::SolidPair pair_;
  std::optional<spatial::DynamicConvolution> convolution_;
  std::optional<spatial::NearFacets> near_;
  std::optional<spatial::InnerFacets> inner_;
  PosePair poses_;
  bool moved_ = false;
  std::size_t all_facets_ = 0;
};

Result<LocalSum> LocalSum::create(const Mesh& p, const Mesh& q, const LocalOptions& options) {
  if (options.threads < 0)
    return Error{ErrorCode::out_of_range, "threads must be at least 0, not " + std::to_string(options.threads), {}};
  if (p.has_thin_parts() || q.has_thin_parts())
    return Error{ErrorCode::unsupported_operand, "an operand of a local sum has parts without volume", {}};
  if (options.progress && !options.progress("operands", 0)) return cancelled();
  return LocalSum(std::make_unique<State>(p, q, options));
}

LocalSum::LocalSum(std::unique_ptr<State> state) : state_(std::move(state)) {}
LocalSum::LocalSum(LocalSum&&) noexcept = default;
LocalSum& LocalSum::operator=(LocalSum&&) noexcept = default;
LocalSum::~LocalSum() = default;

Result<LocalPart> LocalSum::in(const ClipBox& box, const SolidPose& p, const SolidPose& q) {
  return state_->in(box, nullptr, {p, q});
}

Result<LocalPart> LocalSum::in(const ClipBall& ball, const SolidPose& p, const SolidPose& q) {
  if (!is_finite_position(ball.centre) || !std::isfinite(ball.radius))
    return Error{ErrorCode::not_finite, "the ball is not finite", {}};
  if (!(ball.radius > 0))
    return Error{ErrorCode::out_of_range, "the radius must be positive, not " + base::general_text(ball.radius, 6), {}};
  return state_->in(bounding_box(ball), &ball, {p, q});
}

std::size_t LocalSum::facet_count() const { return state_->facet_count(); }

}  // namespace dymsum
