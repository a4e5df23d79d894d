#include "spatial/local/ball_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "exact/big.h"
#include "spatial/mesh/box_tree.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

namespace {

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

}  // namespace

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

}  // namespace dymsum::spatial
