// Solids by their planes: coordinates along a part's own axes, of which those that are nearly equal become one.
// docs/design/solid-by-planes.md.
#include "dymsum/solid_by_planes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <utility>

#include "exact/big.h"
#include "exact/near_values.h"
#include "exact/orient.h"
#include "spatial/boolean/solid_union.h"
#include "spatial/mesh/face_axes.h"
#include "spatial/mesh/half_edges.h"
#include "spatial/mesh/mesh_validate.h"
#include "spatial/mesh/triangulate.h"
#include "spatial/mesh/vec3.h"
#include "spatial/sum/mapped_sum.h"
#include "spatial/sum/sum_source.h"

namespace dymsum {

namespace {

using exact::BigRational;
using exact::join_values, exact::midpoint_of, exact::most_usual, exact::power_below, exact::residue_of;
using spatial::AffineMap;
using spatial::FaceAxes;
using spatial::Vec3;

constexpr FaceAxes kOwnAxes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

double largest_of(const Point3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// The box of vertices.
struct Extent {
  Point3 low, high;
  double size() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }
};

Extent extent_of(const std::vector<Point3>& vertices) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Extent e{{kInf, kInf, kInf}, {-kInf, -kInf, -kInf}};
  for (const Point3& v : vertices) {
    e.low = {std::min(e.low.x, v.x), std::min(e.low.y, v.y), std::min(e.low.z, v.z)};
    e.high = {std::max(e.high.x, v.x), std::max(e.high.y, v.y), std::max(e.high.z, v.z)};
  }
  return e;
}

using Tolerance = exact::MoveTolerance;

Tolerance tolerance_for(const std::vector<Point3>& vertices, const std::optional<double>& wanted) {
  std::vector<double> coordinates;
  for (const Point3& v : vertices) coordinates.insert(coordinates.end(), {v.x, v.y, v.z});
  return exact::move_tolerance(coordinates, extent_of(vertices).size(), wanted, false);
}

/// Axes in few digits: their entries times a radius are off by a sixteenth of the tolerance. Entries next to 0 are 0.
FaceAxes rounded_axes(const FaceAxes& axes, double radius, double tolerance) {
  const double unit = std::max(power_below(tolerance / (32 * radius)), 0x1p-52), none = tolerance / (8 * radius);
  FaceAxes result;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto entry = [&](double c) { return std::abs(c) <= none ? 0 : std::nearbyint(c / unit) * unit; };
    result[k] = {entry(axes[k].x), entry(axes[k].y), entry(axes[k].z)};
    const int zeros = (result[k].x == 0) + (result[k].y == 0) + (result[k].z == 0);
    const auto whole = [&](double c) { return c > 0 ? 1.0 : c < 0 ? -1.0 : 0.0; };
    if (zeros == 2) result[k] = {whole(result[k].x), whole(result[k].y), whole(result[k].z)};
  }
  return result;
}

PartAxes public_axes(const FaceAxes& axes) {
  PartAxes result;
  for (std::size_t k = 0; k < 3; ++k) result[k] = {axes[k].x, axes[k].y, axes[k].z};
  return result;
}

/// A part in its own coordinates, which are doubles, and the map back.
struct Part {
  MeshData data;  ///< all vertices, those of its faces in its coordinates; faces of others are single vertices
  AffineMap map;
  std::size_t merged = 0;
};

Vec3 solve(const FaceAxes& columns, Vec3 x) {
  const Vec3 &a = columns[0], &b = columns[1], &c = columns[2];
  const double det = dot(a, cross(b, c));
  return (1 / det) * Vec3{dot(x, cross(b, c)), dot(x, cross(c, a)), dot(x, cross(a, b))};
}

class PartMaker {
 public:
  PartMaker(const MeshData& data, double tolerance) : data_(data), tolerance_(tolerance) {}
  const MeshData& data() const { return data_; }
  double tolerance() const { return tolerance_; }

  /// With coordinates from so many units beside the midpoint on, where that is asked.
  Part make(const FaceAxes& columns, const std::vector<std::uint32_t>& faces, double beside = 0) const {
    Part part;
    part.data.vertices = data_.vertices;
    part.map.rows = spatial::transposed(columns);
    const std::vector<std::uint32_t> used = vertices_of(faces);
    const bool own = spatial::same_linear_part(part.map, AffineMap{});
    own ? join_own(part, used) : join_along(part, columns, used, beside);
    part.data.faces.assign(data_.faces.size(), Face{0});
    for (const std::uint32_t f : faces) part.data.faces[f] = data_.faces[f];
    return part;
  }

 private:
  std::vector<std::uint32_t> vertices_of(const std::vector<std::uint32_t>& faces) const {
    std::vector<bool> used(data_.vertices.size());
    for (const std::uint32_t f : faces)
      for (const std::uint32_t v : data_.faces[f]) used[v] = true;
    std::vector<std::uint32_t> list;
    for (std::uint32_t v = 0; v < used.size(); ++v)
      if (used[v]) list.push_back(v);
    return list;
  }
  double width() const { return tolerance_ / 4; }

  void join_own(Part& part, const std::vector<std::uint32_t>& used) const {
    for (double Point3::*axis : {&Point3::x, &Point3::y, &Point3::z}) {
      std::vector<double> values;
      for (const std::uint32_t v : used) values.push_back(data_.vertices[v].*axis);
      part.merged += join_values(values, width(), most_usual);
      for (std::size_t k = 0; k < used.size(); ++k) part.data.vertices[used[k]].*axis = values[k];
    }
  }

  /// Values are multiples of a unit from the midpoint between the smallest and the largest on, so that what is
  /// symmetric stays so.
  void join_along(Part& part, const FaceAxes& columns, const std::vector<std::uint32_t>& used, double beside) const {
    const double unit = power_below(tolerance_ / 16);
    const Extent box = extent_of(data_.vertices);
    const auto midpoint = [&](double a, double b) { return std::nearbyint((a / 2 + b / 2) / unit) * unit; };
    const Vec3 from{midpoint(box.low.x, box.high.x), midpoint(box.low.y, box.high.y), midpoint(box.low.z, box.high.z)};
    std::array<std::vector<double>, 3> along;
    for (const std::uint32_t v : used) {
      const Point3& p = data_.vertices[v];
      const Vec3 u = solve(columns, Vec3{p.x, p.y, p.z} - from);
      along[0].push_back(u.x), along[1].push_back(u.y), along[2].push_back(u.z);
    }
    Vec3 shift = from;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double>& values = along[axis];
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      const double center = *low / 2 + *high / 2 + beside * unit;
      for (double& v : values) v -= center;
      part.merged +=
          join_values(values, width(), [&](const std::vector<double>& run) { return midpoint_of(run, unit); });
      shift = shift + center * columns[axis];
    }
    for (std::size_t k = 0; k < used.size(); ++k) part.data.vertices[used[k]] = {along[0][k], along[1][k], along[2][k]};
    const double at[3] = {shift.x, shift.y, shift.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
      part.map.shift[axis] = exact::exact_value(std::nearbyint(at[axis] / unit) * unit);
  }

  const MeshData& data_;
  double tolerance_;
};

/// Whether all vertices of a face lie in one plane.
bool is_plane(const std::vector<Point3>& at, const Face& face) {
  const Point3& a = at[face[0]];
  std::size_t i = 1;
  while (i < face.size() && at[face[i]] == a) ++i;
  std::size_t j = i + 1;
  while (j < face.size() && exact::collinear(a, at[face[i]], at[face[j]])) ++j;
  for (std::size_t k = j + 1; k < face.size(); ++k)
    if (exact::orient3_sign(a, at[face[i]], at[face[j]], at[face[k]]) != 0) return false;
  return true;
}

/// A direction of planes.
using Direction = std::array<exact::Residue, 3>;

/// The planes through the origin that the faces' planes are parallel to; two may count as one with a chance of 2^-61.
/// The fewer, the more of what was meant.
std::vector<Direction> directions_of(const Part& part, const std::vector<std::uint32_t>& faces) {
  using exact::minus, exact::times;
  std::vector<Direction> directions;
  const auto residues = [&](std::uint32_t v) {
    const Point3& p = part.data.vertices[v];
    return std::array{residue_of(p.x), residue_of(p.y), residue_of(p.z)};
  };
  for (const std::uint32_t f : faces) {
    const Face& face = part.data.faces[f];
    const auto a = residues(face[0]);
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const auto b = residues(face[k]), c = residues(face[k + 1]);
      std::array<exact::Residue, 3> u, v;
      for (std::size_t i = 0; i < 3; ++i) u[i] = minus(b[i], a[i]), v[i] = minus(c[i], a[i]);
      Direction n{minus(times(u[1], v[2]), times(u[2], v[1])), minus(times(u[2], v[0]), times(u[0], v[2])),
                  minus(times(u[0], v[1]), times(u[1], v[0]))};
      const auto leading = std::find_if(n.begin(), n.end(), [](exact::Residue r) { return r != 0; });
      if (leading == n.end()) continue;  // no area
      const exact::Residue by = exact::inverse(*leading);
      for (exact::Residue& r : n) r = times(r, by);
      directions.push_back(n);
    }
  }
  std::sort(directions.begin(), directions.end());
  directions.erase(std::unique(directions.begin(), directions.end()), directions.end());
  return directions;
}

bool equal_axes(const FaceAxes& a, const FaceAxes& b) { return spatial::same_linear_part({a, {}}, {b, {}}); }

/// A solid's data in units in which its coordinates are of about one size, where squares and products of doubles are.
struct Scaled {
  MeshData data;
  int exponent = 0;
  double radius = 0;
  Tolerance tolerance;
};

Scaled scaled_data(const MeshData& data, const std::optional<double>& wanted) {
  double largest = 0;
  for (const Point3& v : data.vertices) largest = std::max(largest, largest_of(v));
  Scaled result{data, 0, 0, {}};
  constexpr int kPlain = 100;
  if (largest > 0 && std::abs(std::ilogb(largest)) > kPlain) result.exponent = std::ilogb(largest);
  for (Point3& v : result.data.vertices)
    v = {std::ldexp(v.x, -result.exponent), std::ldexp(v.y, -result.exponent), std::ldexp(v.z, -result.exponent)};
  const Extent box = extent_of(result.data.vertices);
  result.radius = std::hypot(box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z) / 2;
  result.tolerance =
      tolerance_for(result.data.vertices, wanted ? std::optional(std::ldexp(*wanted, -result.exponent)) : std::nullopt);
  return result;
}

/// The faces of one surface, and the axes that it has.
struct ShellAxes {
  std::size_t solid = 0;
  std::vector<std::uint32_t> faces;
  std::optional<FaceAxes> found, chosen;
  /// Candidates along which its planes have the fewest directions, with these.
  std::map<std::size_t, std::vector<Direction>> good;
};

std::vector<ShellAxes> shells_of(const std::vector<Scaled>& solids) {
  std::vector<ShellAxes> all;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    const Scaled& solid = solids[k];
    const spatial::Shells shells = spatial::find_shells(spatial::half_edges(solid.data.faces));
    const std::size_t first = all.size();
    all.resize(first + shells.count);
    for (std::uint32_t f = 0; f < solid.data.faces.size(); ++f) all[first + shells.of_face[f]].faces.push_back(f);
    for (std::size_t s = first; s < all.size(); ++s) {
      all[s].solid = k;
      const auto found = spatial::face_axes(solid.data, all[s].faces, solid.tolerance.value / 4);
      if (found) all[s].found = rounded_axes(*found, solid.radius, solid.tolerance.value);
    }
  }
  return all;
}

/// Chooses the axes of every shell among the coordinates' own and those that were found of any shell, in whatever order
/// the solids are: of those along which its faces lie in planes of the fewest directions the ones that do for most
/// shells, then those along which the planes of all these have the fewest directions together, then the own ones. Of
/// candidates that have no axis in common with what was found of a shell, planes by chance do not count, which few
/// rounded vertices may lie in: those that a shift takes away, and own ones of coordinates with all digits.
class AxesChoice {
 public:
  AxesChoice(const std::vector<Scaled>& solids, std::vector<ShellAxes>& shells) : solids_(solids), shells_(shells) {}

  void run() {
    add_candidates();
    std::vector<ShellAxes*> open;
    for (ShellAxes& shell : shells_)
      if (shell.found) rate(shell), open.push_back(&shell);
    while (!open.empty()) {
      const std::size_t best = best_for(open);
      for (ShellAxes* shell : open)
        if (shell->good.contains(best)) shell->chosen = candidates_[best];
      std::erase_if(open, [](const ShellAxes* shell) { return shell->chosen.has_value(); });
    }
    for (ShellAxes& shell : shells_)  // pieces of a surface that does not close by its vertices alone
      if (!shell.found) shell.chosen = axes_of_most_faces(shell.solid);
  }

 private:
  double angle_of(const ShellAxes& shell) const {
    return solids_[shell.solid].tolerance.value / (8 * solids_[shell.solid].radius);
  }
  void add_candidates() {
    const auto numbers = [](const FaceAxes& a) {
      return std::array{a[0].x, a[0].y, a[0].z, a[1].x, a[1].y, a[1].z, a[2].x, a[2].y, a[2].z};
    };
    std::vector<const ShellAxes*> found;
    for (const ShellAxes& shell : shells_)
      if (shell.found) found.push_back(&shell);
    std::sort(found.begin(), found.end(),
              [&](const ShellAxes* a, const ShellAxes* b) { return numbers(*a->found) < numbers(*b->found); });
    candidates_ = {kOwnAxes};
    for (const ShellAxes* shell : found)
      if (std::none_of(candidates_.begin(), candidates_.end(),
                       [&](const FaceAxes& axes) { return spatial::same_axes(*shell->found, axes, angle_of(*shell)); }))
        candidates_.push_back(*shell->found);
  }
  void rate(ShellAxes& shell) {
    const Scaled& solid = solids_[shell.solid];
    const PartMaker maker(solid.data, solid.tolerance.value);
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      const bool related = spatial::have_common_axis(*shell.found, candidates_[k], angle_of(shell));
      if (k == 0 && !related && !has_few_digits(shell)) continue;
      std::vector<Direction> directions = directions_of(maker.make(candidates_[k], shell.faces), shell.faces);
      std::size_t count = directions.size();
      for (const double beside : {0.37, 0.13, 0.71})
        if (!related)
          count = std::max(count, directions_of(maker.make(candidates_[k], shell.faces, beside), shell.faces).size());
      if (count < fewest) shell.good.clear();
      fewest = std::min(fewest, count);
      if (count == fewest) shell.good.emplace(k, std::move(directions));
    }
  }
  bool has_few_digits(const ShellAxes& shell) const {
    const Scaled& solid = solids_[shell.solid];
    const double unit = power_below(solid.tolerance.value / 16);
    const auto is_multiple = [&](double c) { return std::remainder(c, unit) == 0; };
    for (const std::uint32_t f : shell.faces) {
      for (const std::uint32_t v : solid.data.faces[f]) {
        const Point3& p = solid.data.vertices[v];
        if (!is_multiple(p.x) || !is_multiple(p.y) || !is_multiple(p.z)) return false;
      }
    }
    return true;
  }
  std::size_t best_for(const std::vector<ShellAxes*>& open) const {
    std::size_t best = 0, most = 0, fewest = 0;
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      std::size_t shells = 0;
      std::vector<Direction> all;
      for (const ShellAxes* shell : open) {
        const auto good = shell->good.find(k);
        if (good == shell->good.end()) continue;
        ++shells;
        all.insert(all.end(), good->second.begin(), good->second.end());
      }
      std::sort(all.begin(), all.end());
      const auto directions = static_cast<std::size_t>(std::unique(all.begin(), all.end()) - all.begin());
      if (shells > most || (shells == most && directions < fewest)) best = k, most = shells, fewest = directions;
    }
    return best;
  }
  FaceAxes axes_of_most_faces(std::size_t solid) const {
    std::size_t most = 0;
    FaceAxes axes = kOwnAxes;
    for (const ShellAxes& shell : shells_)
      if (shell.solid == solid && shell.found && shell.faces.size() > most)
        most = shell.faces.size(), axes = *shell.chosen;
    return axes;
  }

  const std::vector<Scaled>& solids_;
  std::vector<ShellAxes>& shells_;
  std::vector<FaceAxes> candidates_;
};

/// Makes a solid of its shells, whose axes are chosen.
class SolidMaker {
 public:
  SolidMaker(const MeshData& data, const Scaled& scaled, const PlanesOptions& options)
      : data_(data), maker_(scaled.data, scaled.tolerance.value), exponent_(scaled.exponent), options_(options) {}

  Result<SolidByPlanes> run(const std::vector<const ShellAxes*>& shells) {
    make_parts(shells);
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      result_.merged += parts_[k].merged;
      for (const std::uint32_t f : faces_[k]) result_.bent_faces += !is_plane(parts_[k].data.vertices, data_.faces[f]);
    }
    Result<SpatialSum> solid = parts_.size() == 1 ? united_part(parts_[0]) : united_parts();
    if (!solid) return solid.error();
    result_.solid = *std::move(solid);
    result_.tolerance = std::ldexp(maker_.tolerance(), exponent_), result_.faces = data_.faces.size();
    for (std::size_t k = 0; k < parts_.size(); ++k) measure_moves(parts_[k], faces_[k]);
    if (result_.solid.faces.empty()) return nothing_left();
    return std::move(result_);
  }

 private:
  /// Shells with equal axes are one part, unless each by itself has planes of fewer directions: what is symmetric about
  /// its own midpoint need not be so about that of all.
  void make_parts(const std::vector<const ShellAxes*>& shells) {
    std::vector<bool> taken(shells.size());
    for (std::size_t k = 0; k < shells.size(); ++k) {
      if (taken[k]) continue;
      const FaceAxes& axes = *shells[k]->chosen;
      if (!equal_axes(axes, kOwnAxes)) result_.axes.push_back(public_axes(axes));
      std::vector<std::vector<std::uint32_t>> alone;
      std::vector<std::uint32_t> together;
      for (std::size_t j = k; j < shells.size(); ++j) {
        if (taken[j] || !equal_axes(*shells[j]->chosen, axes)) continue;
        taken[j] = true;
        alone.push_back(shells[j]->faces);
        together.insert(together.end(), shells[j]->faces.begin(), shells[j]->faces.end());
      }
      const Part joint = maker_.make(axes, together);
      if (alone.size() == 1 || directions_of(joint, together).size() <= directions_alone(axes, alone))
        add(joint, together);
      else
        for (const std::vector<std::uint32_t>& faces : alone) add(maker_.make(axes, faces), faces);
    }
  }
  std::size_t directions_alone(const FaceAxes& axes, const std::vector<std::vector<std::uint32_t>>& shells) const {
    std::vector<Direction> all;
    for (const std::vector<std::uint32_t>& faces : shells) {
      const std::vector<Direction> own = directions_of(maker_.make(axes, faces), faces);
      all.insert(all.end(), own.begin(), own.end());
    }
    std::sort(all.begin(), all.end());
    return static_cast<std::size_t>(std::unique(all.begin(), all.end()) - all.begin());
  }
  void add(Part part, std::vector<std::uint32_t> faces) {
    if (exponent_ != 0) {
      for (Vec3& row : part.map.rows)
        row = {std::ldexp(row.x, exponent_), std::ldexp(row.y, exponent_), std::ldexp(row.z, exponent_)};
      const exact::BigInteger power = exact::BigInteger(1) << std::abs(exponent_);
      for (BigRational& c : part.map.shift) exponent_ > 0 ? c *= power : c /= power;
    }
    parts_.push_back(std::move(part));
    faces_.push_back(std::move(faces));
  }

  Result<SpatialSum> united_part(const Part& part) const {
    Result<SpatialSum> base = spatial::solid_inside(part.data, {}, options_.sums);
    if (!base) return base;
    const bool own = spatial::same_linear_part(part.map, AffineMap{});
    return own ? std::move(base) : spatial::mapped_sum(*std::move(base), part.map);
  }

  /// Parts with axes of their own meet as exact sets.
  Result<SpatialSum> united_parts() const {
    spatial::ExactSet all;
    std::vector<std::uint32_t> face;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      const auto first = static_cast<std::uint32_t>(all.at.size());
      for (const Point3& v : parts_[k].data.vertices) {
        all.at.push_back(image(parts_[k].map, v));
        const auto c = [&](std::size_t axis) { return exact::round_to_double(all.at.back()[axis]); };
        all.set.vertices.push_back({c(0), c(1), c(2)});
      }
      for (const std::uint32_t f : faces_[k]) {
        const std::vector<Point3>& at = parts_[k].data.vertices;
        for (const auto& [a, b, c] :
             spatial::triangulated(at, data_.faces[f], spatial::average_view(at, data_.faces[f]))) {
          if (exact::collinear(at[a], at[b], at[c])) continue;
          all.set.faces.push_back({first + a, first + b, first + c});
          face.push_back(f);
        }
      }
    }
    Result<SpatialSum> solid = spatial::solid_inside(all, {}, options_.sums);
    if (!solid) return solid;
    SpatialSum named = *std::move(solid);
    name_faces(named, face);
    return named;
  }
  /// Of triangles the faces that they are of.
  static void name_faces(SpatialSum& solid, const std::vector<std::uint32_t>& face) {
    for (SpatialFace& f : solid.faces)
      if (f.p.kind == SolidFeature::Kind::face) f.p.a = face[f.p.a];
  }

  static spatial::ExactPosition image(const AffineMap& map, const Point3& u) {
    const BigRational x = exact::exact_value(u.x), y = exact::exact_value(u.y), z = exact::exact_value(u.z);
    spatial::ExactPosition at;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vec3& row = map.rows[axis];
      at[axis] = exact::exact_value(row.x) * x + exact::exact_value(row.y) * y + exact::exact_value(row.z) * z +
                 map.shift[axis];
    }
    return at;
  }

  void measure_moves(const Part& part, const std::vector<std::uint32_t>& faces) {
    std::vector<bool> seen(data_.vertices.size());
    for (const std::uint32_t f : faces) {
      for (const std::uint32_t v : data_.faces[f]) {
        if (seen[v]) continue;
        seen[v] = true;
        const spatial::ExactPosition at = image(part.map, part.data.vertices[v]);
        const Point3& from = data_.vertices[v];
        const auto off = [&](std::size_t axis, double c) {
          return exact::round_to_double(BigRational(at[axis] - exact::exact_value(c)));
        };
        const double moved = std::hypot(off(0, from.x), off(1, from.y), off(2, from.z));
        // Above what was rounded, also where that is subnormal.
        if (moved > 0) result_.largest_move = std::max(result_.largest_move, moved * (1 + 0x1p-48) + 0x1p-1071);
      }
    }
  }

  Error nothing_left() const {
    char text[96];
    std::snprintf(text, sizeof text, "nothing is left of the solid: it is thinner than the tolerance, %.3g",
                  result_.tolerance);
    return {ErrorCode::no_area, text, {}};
  }

  const MeshData& data_;
  const PartMaker maker_;
  int exponent_;
  const PlanesOptions& options_;
  std::vector<Part> parts_;
  std::vector<std::vector<std::uint32_t>> faces_;
  SolidByPlanes result_;
};

Error no_tolerance(const Tolerance& tolerance) {
  char text[160];
  std::snprintf(
      text, sizeof text,
      "a tolerance of %.3g moves no vertex to its planes: it must be at least %.3g, 64 units in the last place "
      "of the largest coordinate",
      tolerance.value, tolerance.least);
  return {ErrorCode::out_of_range, text, {}};
}

}  // namespace

std::string SolidByPlanes::to_string() const {
  char moved[96];
  std::snprintf(moved, sizeof moved, "; no vertex moved by more than %.2g (allowed: %.2g)", largest_move, tolerance);
  const auto counted = [](std::size_t n, const std::string& noun) {
    return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
  };
  return counted(faces, "face") + " became " + std::to_string(solid.faces.size()) +
         (axes.empty()
              ? ""
              : ", along axes of " + (axes.size() == 1 ? "their own" : std::to_string(axes.size()) + " parts")) +
         (bent_faces == 0 ? "" : "; " + counted(bent_faces, "polygon") + " in no plane split into triangles") + moved;
}

namespace {

std::optional<Error> fault_of(const MeshData& data) {
  if (auto error = spatial::check_finite(data.vertices)) return error;
  if (auto error = spatial::check_indices(data)) return error;
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    if (data.faces[f].size() >= 3) continue;
    Error error{ErrorCode::too_few_vertices, "a face has fewer than three vertices", {}};
    error.evidence.face = static_cast<std::int64_t>(f);
    return error;
  }
  return std::nullopt;
}

}  // namespace

Result<std::vector<SolidByPlanes>> by_planes(std::span<const MeshData> solids, const PlanesOptions& options) {
  std::vector<Scaled> scaled;
  for (const MeshData& data : solids) {
    if (auto error = fault_of(data)) return *std::move(error);
    scaled.push_back(scaled_data(data, options.tolerance));
    const Tolerance& tolerance = scaled.back().tolerance;
    if (data.faces.empty() ||
        (tolerance.value >= tolerance.least && tolerance.value > 0 && std::isfinite(tolerance.value)))
      continue;
    const int e = scaled.back().exponent;
    return no_tolerance({std::ldexp(tolerance.least, e), options.tolerance.value_or(0)});
  }
  std::vector<ShellAxes> shells = shells_of(scaled);
  AxesChoice(scaled, shells).run();
  std::vector<SolidByPlanes> made;
  for (std::size_t k = 0; k < solids.size(); ++k) {
    std::vector<const ShellAxes*> own;
    for (const ShellAxes& shell : shells)
      if (shell.solid == k) own.push_back(&shell);
    Result<SolidByPlanes> solid = own.empty() ? SolidByPlanes{} : SolidMaker(solids[k], scaled[k], options).run(own);
    if (!solid) return solid.error();
    made.push_back(*std::move(solid));
  }
  return made;
}

Result<SolidByPlanes> by_planes(const MeshData& data, const PlanesOptions& options) {
  Result<std::vector<SolidByPlanes>> made = by_planes(std::span(&data, 1), options);
  if (!made) return made.error();
  return std::move(std::move(made).value()[0]);
}

}  // namespace dymsum
