#include "spatial/mesh/mesh_orient.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "exact/orient.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/surface_crossings.h"
#include "spatial/mesh/triangulate.h"
#include "spatial/mesh/vec3.h"

namespace dymsum::spatial {
namespace {

using exact::Big;
using exact::BigInteger;
using exact::BigRational;
using exact::Int;

// A sum of fewer than 2^32 determinants of vertices' differences: B + 1 bits each, determinants 3B + 6, sums 3B + 38.
template <class C>
struct Widths {
  using Sum = Big;
};
template <int B>
struct Widths<Int<B>> {
  using Difference = GridPoint<Int<B + 1>>;
  using Determinant = decltype(exact::determinant(Difference{}, Difference{}, Difference{}));
  static_assert(Determinant::kBits == 3 * B + 6);
  using Sum = Int<Determinant::kBits + 32>;
};
static_assert(Widths<Int<29>>::Sum::kBits == 125 && sizeof(Widths<Int<29>>::Sum) == 16);
static_assert(Widths<Int<61>>::Sum::kBits == 221 && sizeof(Widths<Int<61>>::Sum) == 32);
static_assert(Widths<Int<125>>::Sum::kBits == 413 && sizeof(Widths<Int<125>>::Sum) == 56);

Big plus(const Big& a, const Big& b) { return a + b; }
template <int S, int D>
Int<S> plus(const Int<S>& a, const Int<D>& b) {
  return Int<S>::from_raw(exact::raw_cast<S>((a + b).raw()));
}

/// f(six times the volume of shell k, on the grid) for every shell, seen from the first vertex of its first face: the
/// signed sum of the tetrahedra over the fans of its faces.
template <class C, class F>
void for_each_shell(const std::vector<GridPoint<C>>& points, const std::vector<Face>& faces, const Shells& shells,
                    F f) {
  std::vector<typename Widths<C>::Sum> sums(shells.count);
  std::vector<std::uint32_t> apex(shells.count, HalfEdges::kNone);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Face& face = faces[i];
    const std::uint32_t shell = shells.of_face[i];
    if (apex[shell] == HalfEdges::kNone) apex[shell] = face[0];
    const GridPoint<C>& from = points[apex[shell]];
    for (std::size_t k = 2; k < face.size(); ++k) {
      sums[shell] = plus(
          sums[shell], exact::determinant(points[face[0]] - from, points[face[k - 1]] - from, points[face[k]] - from));
    }
  }
  for (std::uint32_t k = 0; k < shells.count; ++k) f(k, sums[k]);
}

BigRational power_of_two(int exponent) {
  const BigInteger power = BigInteger(1) << std::abs(exponent);
  return exponent >= 0 ? BigRational(power) : BigRational(BigInteger(1), power);
}

}  // namespace

std::vector<int> shell_signs(const MeshData& data, const Shells& shells) {
  std::vector<int> signs(shells.count);
  with_grid_points(data.vertices, space_grid(data.vertices), [&](const auto& points) {
    for_each_shell(points, data.faces, shells, [&](std::uint32_t k, const auto& sum) { signs[k] = sign(sum); });
  });
  return signs;
}

BigRational exact_volume(const MeshData& data) {
  const SpaceGrid grid = space_grid(data.vertices);
  const Shells one{std::vector<std::uint32_t>(data.faces.size(), 0), data.faces.empty() ? 0u : 1u};
  Big six;
  with_grid_points(data.vertices, grid, [&](const auto& points) {
    for_each_shell(points, data.faces, one, [&](std::uint32_t, const auto& sum) { six = exact::to_big(sum); });
  });
  return BigRational(six.value()) * power_of_two(grid.x.exponent + grid.y.exponent + grid.z.exponent) / 6;
}

namespace {

/// The side of the directed line ab on which p + (e, e^2) lies, for all small e > 0: never 0, so that a ray through p
/// passes no vertex and no edge. Requires: a and b differ.
int perturbed_side(const Point& a, const Point& b, const Point& p) {
  if (const int side = exact::orient_sign(a, b, p)) return side;
  if (a.y != b.y) return a.y < b.y ? -1 : 1;
  return a.x < b.x ? 1 : -1;
}

/// How the ray from p towards smaller x passes a triangle, p's y and z being perturbed: 1 where it leaves through its
/// front, -1 where it enters, 0 where it passes by. Requires: p is not in the triangle.
int passage(const Point3& a, const Point3& b, const Point3& c, const Point3& p) {
  const exact::Axis axis = exact::Axis::x;
  const int facing = exact::normal_sign(a, b, c, axis);
  if (facing == 0) return 0;  // seen from its edge
  const Point a2 = dropped(a, axis), b2 = dropped(b, axis), c2 = dropped(c, axis), p2 = dropped(p, axis);
  if (perturbed_side(a2, b2, p2) != facing || perturbed_side(b2, c2, p2) != facing ||
      perturbed_side(c2, a2, p2) != facing) {
    return 0;
  }
  // The face, whose normal has the sign `facing` along x, counts if p is in front of it: then it lies after p along the
  // ray.
  return exact::orient3_sign(a, b, c, p) * facing > 0 ? facing : 0;
}

/// The same for the centre of a triangle, on the grid with all coordinates times three.
class PassageOfCentres {
 public:
  explicit PassageOfCentres(const MeshData& data)
      : points_(grid_points<exact::Big>(data.vertices, space_grid(data.vertices))) {}

  int passage(const Triangle& t, const Triangle& from) const {
    const Point3Big p = plus(plus(points_[from[0]], points_[from[1]]), points_[from[2]]);
    const Point3Big a = tripled(points_[t[0]]) - p, b = tripled(points_[t[1]]) - p, c = tripled(points_[t[2]]) - p;
    const int facing = sign((b - a).y * (c - a).z - (b - a).z * (c - a).y);
    if (facing == 0 || side(a, b) != facing || side(b, c) != facing || side(c, a) != facing) return 0;
    // The sign is that of det(b - a, c - a, p - a), p being the origin.
    return -sign(exact::determinant(a, b, c)) * facing > 0 ? facing : 0;
  }

 private:
  using Point3Big = GridPoint<exact::Big>;

  static Point3Big plus(const Point3Big& a, const Point3Big& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  static Point3Big tripled(const Point3Big& a) { return plus(plus(a, a), a); }
  /// The value of perturbed_side for the origin.
  static int side(const Point3Big& a, const Point3Big& b) {
    if (const int s = sign(a.y * b.z - a.z * b.y)) return s;
    if (a.z != b.z) return a.z < b.z ? -1 : 1;
    return a.y < b.y ? 1 : -1;
  }

  std::vector<Point3Big> points_;
};

/// The position from which the ray of a shell starts: a vertex of its own, or, where it shares all of them, the centre
/// of a triangle.
struct RayStart {
  std::optional<std::uint32_t> vertex;
  std::uint32_t triangle = 0;
};

std::vector<RayStart> ray_starts(const MeshData& data, const Shells& shells, const Triangles& triangles) {
  constexpr std::uint32_t kShared = HalfEdges::kNone - 1;
  std::vector<std::uint32_t> owner(data.vertices.size(), HalfEdges::kNone);
  for (std::uint32_t f = 0; f < data.faces.size(); ++f) {
    for (const std::uint32_t v : data.faces[f]) {
      if (owner[v] == HalfEdges::kNone) owner[v] = shells.of_face[f];
      else if (owner[v] != shells.of_face[f]) owner[v] = kShared;
    }
  }
  std::vector<RayStart> starts(shells.count);
  for (std::uint32_t t = 0; t < triangles.triangles.size(); ++t) {
    RayStart& start = starts[shells.of_face[triangles.face[t]]];
    start.triangle = t;
    for (const std::uint32_t v : triangles.triangles[t])
      if (!start.vertex && owner[v] != kShared) start.vertex = v;
  }
  return starts;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> shells_around(const MeshData& data, const Shells& shells,
                                                      const Triangles& triangles, const BoxTree& boxes) {
  std::vector<std::vector<std::uint32_t>> around(shells.count);
  if (shells.count < 2) return around;
  std::optional<PassageOfCentres> centres;
  const std::vector<RayStart> starts = ray_starts(data, shells, triangles);
  for (std::uint32_t shell = 0; shell < shells.count; ++shell) {
    const RayStart& start = starts[shell];
    if (!start.vertex && !centres) centres.emplace(data);
    Box ray;
    if (start.vertex) {
      const Point3& p = data.vertices[*start.vertex];
      ray.add(Vec3{p.x, p.y, p.z});
    } else {
      ray = boxes.box(start.triangle);
    }
    ray.low.x = -std::numeric_limits<double>::infinity();
    std::map<std::uint32_t, int> winding;
    boxes.for_each(ray, [&](std::uint32_t t) {
      const std::uint32_t other = shells.of_face[triangles.face[t]];
      if (other == shell) return;
      const Triangle& v = triangles.triangles[t];
      winding[other] += start.vertex ? passage(data.vertices[v[0]], data.vertices[v[1]], data.vertices[v[2]],
                                               data.vertices[*start.vertex])
                                     : centres->passage(v, triangles.triangles[start.triangle]);
    });
    for (const auto& [other, turns] : winding)
      if (turns != 0) around[shell].push_back(other);
  }
  return around;
}

std::vector<std::uint32_t> shell_depths(const MeshData& data, const Shells& shells, const Triangles& triangles,
                                        const BoxTree& boxes) {
  std::vector<std::uint32_t> depths;
  for (const std::vector<std::uint32_t>& others : shells_around(data, shells, triangles, boxes))
    depths.push_back(static_cast<std::uint32_t>(others.size()));
  return depths;
}

namespace {

void turn_over(Face& face) { std::reverse(face.begin() + 1, face.end()); }

/// A face and the one across an edge; `agree` when they run through it in opposite directions.
struct Neighbour {
  std::uint32_t face;
  bool agree;
};

std::vector<std::vector<Neighbour>> neighbours(const std::vector<Face>& faces) {
  std::vector<std::vector<Neighbour>> found(faces.size());
  const HalfEdges edges = half_edges_without_twins(faces);
  const std::vector<EdgeSide> sides = edge_sides(edges);
  for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
    if (last - first != 2) return;
    const std::uint32_t g = first[0].half_edge, h = first[1].half_edge;
    const bool agree = edges.origin[g] != edges.origin[h];
    found[edges.face[g]].push_back({edges.face[h], agree});
    found[edges.face[h]].push_back({edges.face[g], agree});
  });
  return found;
}

std::vector<bool> disagreeing_faces(const std::vector<Face>& faces) {
  const std::vector<std::vector<Neighbour>> beside = neighbours(faces);
  std::vector<bool> turned(beside.size()), reached(beside.size());
  for (std::uint32_t start = 0; start < beside.size(); ++start) {
    if (reached[start]) continue;
    reached[start] = true;
    std::vector<std::uint32_t> shell{start};
    for (std::size_t i = 0; i < shell.size(); ++i) {
      for (const Neighbour& n : beside[shell[i]]) {
        if (reached[n.face]) continue;
        reached[n.face] = true;
        turned[n.face] = turned[shell[i]] == n.agree;
        shell.push_back(n.face);
      }
    }
    const auto count = std::count_if(shell.begin(), shell.end(), [&](std::uint32_t f) { return turned[f]; });
    if (2 * static_cast<std::size_t>(count) <= shell.size()) continue;
    for (const std::uint32_t f : shell) turned[f] = !turned[f];
  }
  return turned;
}

/// Joins all edges; false where the surface is not closed, or not valid for other reasons.
bool is_closed(HalfEdges& edges, const MeshData& data) {
  const std::vector<EdgeSide> sides = edge_sides(edges);
  bool even = true, several = false;
  for_each_edge(sides, [&](const EdgeSide* first, const EdgeSide* last) {
    const auto along = std::count_if(
        first, last, [&](const EdgeSide& s) { return edges.origin[s.half_edge] == edges.origin[first->half_edge]; });
    even &= 2 * along == last - first;
    several |= last - first > 2;
  });
  return even && (!several || all_faces_valid(data)) && !join_around(edges, sides, data);
}

/// None where a face is not valid by itself, so that Mesh::create refuses it.
std::vector<std::vector<std::uint32_t>> shells_around(const MeshData& data, const Shells& shells) {
  if (shells.count < 2 || !all_faces_valid(data)) return std::vector<std::vector<std::uint32_t>>(shells.count);
  const Triangles triangles = triangulated(data);
  return shells_around(data, shells, triangles, boxes_of(data.vertices, triangles.triangles));
}

}  // namespace

bool all_faces_valid(const MeshData& data) {
  return std::all_of(data.faces.begin(), data.faces.end(), [&](const Face& face) {
    Face sorted = face;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end() && !face_error(data.vertices, face);
  });
}

std::vector<std::uint32_t> turn_faces(MeshData& data) {
  const std::vector<bool> turned = disagreeing_faces(data.faces);
  std::vector<std::uint32_t> faces;
  for (std::uint32_t f = 0; f < turned.size(); ++f) {
    if (!turned[f]) continue;
    turn_over(data.faces[f]);
    faces.push_back(f);
  }
  return faces;
}

namespace {

/// What every shell is to become.
struct ShellFates {
  std::vector<bool> turned, cavity, dropped;
};

/// Inward exactly where an odd number of others lie around.
ShellFates as_cavities(const std::vector<int>& signs, const std::vector<std::vector<std::uint32_t>>& around,
                       const ShellRepairs& repairs) {
  ShellFates fates{std::vector<bool>(signs.size()), std::vector<bool>(signs.size()), std::vector<bool>(signs.size())};
  for (std::size_t s = 0; s < signs.size(); ++s) {
    const bool inner = around[s].size() % 2 == 1, wrong = signs[s] == (inner ? 1 : -1);
    for (const std::uint32_t next : around[s])  // the innermost one of them
      if (inner && around[next].size() + 1 == around[s].size() && signs[next] == signs[s]) fates.cavity[s] = true;
    fates.turned[s] = wrong && (fates.cavity[s] ? repairs.nested.has_value() : repairs.reverse);
    fates.cavity[s] = fates.cavity[s] && repairs.nested;
  }
  return fates;
}

/// The shells of which a face meets one of another shell: no one side of them is inside of that.
std::vector<bool> shells_that_meet(const MeshData& data, const Shells& shells) {
  std::vector<bool> found(shells.count);
  if (shells.count < 2 || !all_faces_valid(data)) return found;
  const Triangles triangles = triangulated(data);
  const std::vector<bool> all(triangles.triangles.size(), true);
  for (const auto& [a, b] : find_meetings(data, triangles, boxes_of(data.vertices, triangles.triangles), all)) {
    const std::uint32_t s = shells.of_face[triangles.face[a]], t = shells.of_face[triangles.face[b]];
    if (s != t) found[s] = found[t] = true;
  }
  return found;
}

/// The fates of shells by the winding number on both sides of every shell. Those that meet others have none here.
ShellFates as_bodies(std::vector<int> signs, const std::vector<bool>& meets,
                     const std::vector<std::vector<std::uint32_t>>& around, const ShellRepairs& repairs) {
  ShellFates fates{std::vector<bool>(signs.size()), std::vector<bool>(signs.size()), std::vector<bool>(signs.size())};
  for (std::size_t s = 0; s < signs.size(); ++s) {
    if (meets[s] || !around[s].empty() || signs[s] > 0 || !repairs.reverse) continue;
    fates.turned[s] = true;
    signs[s] = 1;
  }
  for (std::size_t s = 0; s < signs.size(); ++s) {
    if (meets[s]) continue;
    int outside = 0;
    for (const std::uint32_t t : around[s]) outside += signs[t];
    const int inside = outside + signs[s];
    fates.dropped[s] = (outside != 0) == (inside != 0);
    if (!fates.dropped[s] && (inside != 0) != (signs[s] > 0)) fates.turned[s] = repairs.reverse;
  }
  return fates;
}

}  // namespace

TurnedShells turn_shells(MeshData& data, const ShellRepairs& repairs) {
  HalfEdges edges = half_edges_without_twins(data.faces);
  if (!is_closed(edges, data)) return {};
  const Shells shells = find_shells(edges);
  const std::vector<int> signs = shell_signs(data, shells);
  const bool bodies = repairs.nested == NestedShells::solid;
  const std::vector<std::vector<std::uint32_t>> around = shells_around(data, shells);
  const ShellFates fates =
      bodies ? as_bodies(signs, shells_that_meet(data, shells), around, repairs) : as_cavities(signs, around, repairs);
  TurnedShells result;
  if (std::find(fates.dropped.begin(), fates.dropped.end(), true) != fates.dropped.end())
    result.dropped.resize(data.faces.size());
  std::vector<bool> seen(shells.count);
  for (std::uint32_t f = 0; f < data.faces.size(); ++f) {
    const std::uint32_t s = shells.of_face[f];
    const bool first = !seen[s];
    seen[s] = true;
    if (fates.turned[s]) turn_over(data.faces[f]);
    if (first && fates.turned[s]) result.turned.push_back(f);
    if (first && fates.cavity[s]) result.cavities.push_back(f);
    if (first && fates.dropped[s]) result.bodies.push_back(f);
    if (fates.dropped[s]) result.dropped[f] = true;
  }
  return result;
}

}  // namespace dymsum::spatial
