// Docs: docs/design/rounded-surface.md.
#include "spatial/sum/separated_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "base/doubles.h"
#include "exact/orient.h"
#include "spatial/mesh/surface_crossings.h"
#include "spatial/mesh/vec3.h"
#include "spatial/sum/surface_edits.h"

namespace dymsum::spatial {
namespace {

using SurfacePart = SurfaceEdits::Part;
constexpr std::uint32_t kNoVertex = 0xffffffff;
constexpr int kRounds = 64;
// A tolerance is given up after so many rounds in which no fewer pairs meet than before, and after so many pairs a
// part.
constexpr std::size_t kVainRounds = 16, kMostMeetings = 2;
// A distance of two positions in doubles is off by a relative error of at most 2^-49: this is above it.
constexpr double kAbove = 1 + 0x1p-40;

/// What two parts of the surface have near each other: `a` and, where it is an edge, `b` against `c` and `d`, or the
/// part.
struct Near {
  enum Kind : std::uint8_t { vertices, vertex_edge, edges, vertex_part, none } kind = none;
  double gap = 0;  ///< how far they are apart
  double by = 0;   ///< how far anything moves, at most
  std::uint32_t a = kNoVertex, b = kNoVertex, c = kNoVertex, d = kNoVertex;
  Point3 at{};  ///< of a new vertex

  auto order() const { return std::tuple(kind, gap, a, b, c, d); }
  friend bool operator<(const Near& x, const Near& y) { return x.order() < y.order(); }
};

Vec3 as_vector(const Point3& p) { return {p.x, p.y, p.z}; }

/// The parameter of the point of the line p + t d next to x, clamped to the segment.
double foot(Vec3 p, Vec3 d, Vec3 x) {
  const double square = dot(d, d);
  return square > 0 ? std::clamp(dot(x - p, d) / square, 0.0, 1.0) : 0.0;
}

/// Pairs of parts that meet, the smaller index first, sorted.
using Meetings = std::vector<std::array<std::uint32_t, 2>>;

/// The live parts of one round, and their boxes.
struct PartTree {
  std::vector<std::uint32_t> part;  ///< of every box
  std::size_t end = 0;              ///< parts from here on were made later
  BoxTree boxes;
};

class Separation {
 public:
  Separation(const SpatialSum::Rounded& drawn, Precision precision, double size, double most)
      : drawn_(drawn),
        single_(precision == Precision::singles),
        // Half a unit in the last place in each coordinate; to singles by way of doubles: a whole one of doubles more.
        size_(size),
        slack_(size * (single_ ? 0x1p-23 : 0x1p-52)),
        limit_(4 * most + slack_),
        edits_(in_precision(drawn.mesh), drawn.face, slack_),
        from_(drawn.vertex) {}

  /// What is the same for all tolerances: equal vertices are merged, flat triangles are gone, and what meets is known.
  void prepare() {
    merge_equal();
    while (can_go_on() && !flatten()) ++round_;
    if (can_go_on()) first_ = std::make_shared<const Meetings>(meetings());
  }
  /// Whether nothing meets any more but triangles that are one, once what is nearer than the tolerance is merged.
  bool run(double tolerance) {
    tolerance_ = tolerance;
    std::size_t fewest = SIZE_MAX, last = 0, looked_at = 0;
    for (; can_go_on(); ++round_) {
      if (!flatten()) continue;
      const std::shared_ptr<const Meetings> first = std::exchange(first_, nullptr);
      const Meetings met = first ? *first : meetings();
      if (std::all_of(met.begin(), met.end(), [&](const auto& pair) { return are_one(pair[0], pair[1]); })) return true;
      // Surfaces that run into each other over and over meet in more pairs from round to round.
      if (met.size() < fewest) fewest = met.size(), last = 0;
      looked_at += met.size();
      if (++last > kVainRounds || looked_at > kMostMeetings * (edits_.parts().size() + 1024)) return false;
      resolve(met);
    }
    return false;
  }
  /// The position at which it failed.
  const Point3& position() const { return position_; }

  SpatialSum::Rounded result() const;

 private:
  MeshData in_precision(MeshData mesh) const {
    for (Point3& p : mesh.vertices) p = rounded(as_vector(p));
    return mesh;
  }
  Point3 rounded(Vec3 p) const {
    const auto one = [&](double c) { return (single_ ? base::in_single(c) : c) + 0.0; };
    return {one(p.x), one(p.y), one(p.z)};
  }
  const Point3& point(std::uint32_t v) const { return edits_.vertices()[v]; }
  Vec3 at(std::uint32_t v) const { return as_vector(point(v)); }
  /// An upper bound; the addend is more than what squares lose below the range of doubles.
  double distance(Vec3 a, Vec3 b) const { return length(a - b) * kAbove + size_ * 0x1p-104; }
  /// What moves to a vertex at `gap` from a computed point a + s u + t v of a part: by rounding, that is off by at most
  /// 4 units of 2^-53 of u and v and 3 of the size, in each coordinate.
  double moved(double gap, double u, double v = 0) const { return gap + (size_ + u + v) * 0x1p-50; }

  bool can_go_on() const { return round_ < kRounds && !stuck_ && edits_.moved() <= limit_; }
  /// Triangles with the same corners, which run the same way, as others cancel each other: beside them a sliver is gone
  /// around twice, or inside out.
  bool are_one(std::uint32_t s, std::uint32_t t) const {
    std::array<std::uint32_t, 3> a = edits_.parts()[s].v, b = edits_.parts()[t].v;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a == b;
  }
  void merge_equal();
  bool flatten();
  void plant();
  std::vector<std::uint32_t> near_new() const;
  Meetings meetings();
  void resolve(const Meetings& meetings);
  void apply(const Near& near);
  void consider(Near& best, const Near& next) const {
    if (next.gap <= tolerance_ && next < best) best = next;
  }
  Near nearest(const SurfacePart& s, const SurfacePart& t) const;
  void vertex_near(Near& best, std::uint32_t v, const SurfacePart& t, std::uint32_t index) const;
  /// The larger of two vertices becomes the other one.
  Near merging(std::uint32_t a, std::uint32_t b) const {
    const double gap = point(a) == point(b) ? 0 : distance(at(a), at(b));
    return {Near::vertices, gap, gap, std::max(a, b), kNoVertex, std::min(a, b), kNoVertex, {}};
  }
  Near bending(std::uint32_t a, std::uint32_t b, std::uint32_t v) const {
    const Vec3 along = at(b) - at(a);
    const double gap = distance(at(v), at(a) + foot(at(a), along, at(v)) * along);
    return {Near::vertex_edge, gap, moved(gap, length(along)), a, b, v, kNoVertex, {}};
  }
  void edges_near(Near& best, const std::array<std::uint32_t, 4>& ends) const;

  const SpatialSum::Rounded& drawn_;
  bool single_;
  double tolerance_ = 0, size_, slack_, limit_;
  SurfaceEdits edits_;
  std::vector<std::uint32_t> from_;  // of every vertex one of the sum
  int round_ = 0;
  std::shared_ptr<const Meetings> first_;  // of the first round, until they are taken
  std::shared_ptr<const PartTree> tree_;   // of an earlier round: a part keeps its corners as long as it lives
  std::size_t flat_until_ = 0;             // parts before this one are not flat
  std::size_t looked_at_ = 0;              // parts from here on are new
  Meetings known_;                         // of those before
  bool stuck_ = false;                     // parts meet that have nothing near enough
  std::size_t merged_ = 0, collapsed_ = 0, bends_ = 0;
  Point3 position_{};
};

void Separation::merge_equal() {
  std::vector<std::uint32_t> order(edits_.vertices().size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t v) { return std::tuple(point(v).x, point(v).y, point(v).z, v); };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (point(order[k - 1]) != point(order[k])) continue;
    apply(merging(order[k - 1], order[k]));
    order[k] = std::min(order[k - 1], order[k]);
  }
}

/// Triangles on a line get their corner between the others into the edge of these, and vanish. Whether there were none.
bool Separation::flatten() {
  bool none = true;
  for (; flat_until_ < edits_.parts().size(); ++flat_until_) {
    const SurfacePart part = edits_.parts()[flat_until_];
    if (!part.live || !exact::collinear(point(part.v[0]), point(part.v[1]), point(part.v[2]))) continue;
    none = false;
    std::size_t k = 0;
    for (std::size_t l = 1; l < 3; ++l) {
      const auto opposite_length = [&](std::size_t m) {
        return length(at(part.v[(m + 1) % 3]) - at(part.v[(m + 2) % 3]));
      };
      if (opposite_length(l) > opposite_length(k)) k = l;
    }
    edits_.split_edge(part.v[(k + 1) % 3], part.v[(k + 2) % 3], part.v[k], 0);
    ++bends_;
  }
  return none;
}

void Separation::vertex_near(Near& best, std::uint32_t v, const SurfacePart& t, std::uint32_t index) const {
  const Vec3 p = at(v);
  for (std::size_t k = 0; k < 3; ++k) {
    if (t.v[k] == v) return;
    consider(best, merging(v, t.v[k]));
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t a = std::min(t.v[k], t.v[(k + 1) % 3]), b = std::max(t.v[k], t.v[(k + 1) % 3]);
    consider(best, bending(a, b, v));
  }
  const Vec3 a = at(t.v[0]), u = at(t.v[1]) - a, w = at(t.v[2]) - a;
  const double uu = dot(u, u), ww = dot(w, w), uw = dot(u, w), square = uu * ww - uw * uw;
  if (!(square > 0)) return;
  const double s = (dot(p - a, u) * ww - dot(p - a, w) * uw) / square,
               r = (dot(p - a, w) * uu - dot(p - a, u) * uw) / square;
  if (!(s >= 0 && r >= 0 && s + r <= 1)) return;
  const Vec3 below = a + s * u + r * w;
  const double gap = distance(p, below);
  consider(best, {Near::vertex_part, gap, moved(gap, length(u), length(w)), v, index, kNoVertex, kNoVertex, {}});
}

void Separation::edges_near(Near& best, const std::array<std::uint32_t, 4>& ends) const {
  const auto [a, b, c, d] = ends;
  if (a == c || a == d || b == c || b == d) return;
  const Vec3 u = at(b) - at(a), v = at(d) - at(c), w = at(c) - at(a);
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), square = uu * vv - uv * uv;
  if (!(square > 0)) return;
  const double s = std::clamp((dot(w, u) * vv - dot(w, v) * uv) / square, 0.0, 1.0);
  const double t = foot(at(c), v, at(a) + s * u);
  const Vec3 x = at(a) + s * u, y = at(c) + t * v;
  const Point3 between = rounded(0.5 * (x + y));
  const Vec3 m = as_vector(between);
  if (between == point(a) || between == point(b) || between == point(c) || between == point(d)) return;
  const double gap = std::max(distance(m, x), distance(m, y));
  consider(best, {Near::edges, gap, moved(gap, length(u), length(v)), a, b, c, d, between});
}

/// What to merge where two parts meet: the first kind of which something is near enough, then the nearest.
Near Separation::nearest(const SurfacePart& s, const SurfacePart& t) const {
  Near best;
  best.by = INFINITY;
  const auto index = [&](const SurfacePart& part) { return static_cast<std::uint32_t>(&part - edits_.parts().data()); };
  for (const auto& [from, to] : {std::pair{&s, &t}, std::pair{&t, &s}, std::pair{&s, &s}, std::pair{&t, &t}}) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (from != to) {
        vertex_near(best, from->v[k], *to, index(*to));
        continue;
      }
      // A narrow triangle: its own corners, and the height on its longest edge.
      const std::uint32_t v = from->v[k], a = std::min(from->v[(k + 1) % 3], from->v[(k + 2) % 3]),
                          b = std::max(from->v[(k + 1) % 3], from->v[(k + 2) % 3]);
      consider(best, merging(a, b));
      consider(best, bending(a, b, v));
    }
  }
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t l = 0; l < 3; ++l) {
      const auto [a, b] = std::minmax(s.v[k], s.v[(k + 1) % 3]);
      const auto [c, d] = std::minmax(t.v[l], t.v[(l + 1) % 3]);
      edges_near(best, {a, b, c, d});
    }
  return best;
}

void Separation::apply(const Near& near) {
  const auto has = [&](std::uint32_t a, std::uint32_t b) { return edits_.has_edge(a, b); };
  switch (near.kind) {
    case Near::vertices:
      ++(has(near.a, near.c) ? collapsed_ : merged_);
      return edits_.merge(near.a, near.c, near.by);
    case Near::vertex_edge:
      if (!has(near.a, near.b)) return;
      ++bends_;
      return edits_.split_edge(near.a, near.b, near.c, near.by);
    case Near::edges: {
      if (!has(near.a, near.b) || !has(near.c, near.d)) return;
      const std::uint32_t p = edits_.add_vertex(near.at);
      from_.push_back(from_[near.a]);
      bends_ += 2;
      edits_.split_edge(near.a, near.b, p, near.by);
      return edits_.split_edge(near.c, near.d, p, near.by);
    }
    case Near::vertex_part: {
      const SurfacePart& part = edits_.parts()[near.b];
      if (!part.live || std::find(part.v.begin(), part.v.end(), near.a) != part.v.end()) return;
      ++bends_;
      return edits_.split_part(near.b, near.a, near.by);
    }
    case Near::none:
      return;
  }
}

/// The tree of all parts that live.
void Separation::plant() {
  auto tree = std::make_shared<PartTree>();
  std::vector<Triangle> triangles;
  for (std::uint32_t t = 0; t < edits_.parts().size(); ++t) {
    if (!edits_.parts()[t].live) continue;
    tree->part.push_back(t);
    triangles.push_back(edits_.parts()[t].v);
  }
  tree->end = edits_.parts().size();
  tree->boxes = boxes_of(edits_.vertices(), triangles);
  tree_ = std::move(tree);
}

/// The live parts whose boxes overlap that of a new one, and perhaps more, sorted.
std::vector<std::uint32_t> Separation::near_new() const {
  std::vector<std::uint32_t> found;
  for (std::size_t t = looked_at_; t < edits_.parts().size(); ++t) {
    if (!edits_.parts()[t].live) continue;
    Box box;
    for (const std::uint32_t v : edits_.parts()[t].v) box.add(at(v));
    tree_->boxes.for_each(box, [&](std::uint32_t i) {
      if (edits_.parts()[tree_->part[i]].live) found.push_back(tree_->part[i]);
    });
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  for (std::size_t t = tree_->end; t < edits_.parts().size(); ++t)
    if (edits_.parts()[t].live) found.push_back(static_cast<std::uint32_t>(t));
  return found;
}

/// What meets now: a pair of parts that were there before does so if it did, and whatever else meets has a new one.
/// Only what is near these is looked at, so a round costs what it changed.
Meetings Separation::meetings() {
  const bool all = !tree_ || edits_.parts().size() - tree_->end > tree_->part.size() / 4;
  if (all) plant();
  const std::vector<std::uint32_t> part = all ? tree_->part : near_new();
  std::vector<Triangle> triangles;
  std::vector<bool> queried;
  for (const std::uint32_t t : part) {
    triangles.push_back(edits_.parts()[t].v);
    queried.push_back(t >= looked_at_);
  }
  Meetings found =
      find_meetings(edits_.vertices(), triangles, all ? tree_->boxes : boxes_of(edits_.vertices(), triangles), queried);
  for (auto& pair : found) pair = {part[pair[0]], part[pair[1]]};
  for (const auto& pair : known_)
    if (edits_.parts()[pair[0]].live && edits_.parts()[pair[1]].live) found.push_back(pair);
  std::sort(found.begin(), found.end());
  return found;
}

/// Moves apart what is near where two parts meet: the nearest goes first; nothing is touched twice.
void Separation::resolve(const Meetings& meetings) {
  std::set<Near> found;
  known_ = meetings;
  looked_at_ = edits_.parts().size();
  for (const auto& [i, j] : meetings) {
    const SurfacePart &s = edits_.parts()[i], &t = edits_.parts()[j];
    position_ = point(s.v[0]);
    const Near near = nearest(s, t);
    if (near.kind != Near::none) found.insert(near);
  }
  std::set<std::uint32_t> touched;
  for (const Near& near : found) {
    std::vector<std::uint32_t> names{near.a, near.c};
    if (near.kind != Near::vertices && near.kind != Near::vertex_part) names.push_back(near.b);
    if (near.kind == Near::edges) names.push_back(near.d);
    names.erase(std::remove(names.begin(), names.end(), kNoVertex), names.end());
    if (std::any_of(names.begin(), names.end(), [&](std::uint32_t v) { return touched.contains(v); })) continue;
    touched.insert(names.begin(), names.end());
    apply(near);
  }
  if (found.empty()) stuck_ = true;
}

SpatialSum::Rounded Separation::result() const {
  SpatialSum::Rounded made;
  std::vector<std::uint32_t> name(edits_.vertices().size(), kNoVertex);
  std::vector<const SurfacePart*> parts;
  for (const SurfacePart& part : edits_.parts())
    if (part.live) parts.push_back(&part);
  std::stable_sort(parts.begin(), parts.end(),
                   [](const SurfacePart* a, const SurfacePart* b) { return a->face < b->face; });
  for (const SurfacePart* part : parts) {
    Face face;
    for (const std::uint32_t v : part->v) {
      if (name[v] == kNoVertex) {
        name[v] = static_cast<std::uint32_t>(made.mesh.vertices.size());
        made.mesh.vertices.push_back(point(v));
        made.vertex.push_back(from_[v]);
      }
      face.push_back(name[v]);
    }
    made.mesh.faces.push_back(std::move(face));
    made.face.push_back(part->face);
  }
  made.nearest = merged_ + collapsed_ + bends_ == 0;
  made.merged_vertices = merged_;
  made.collapsed_edges = collapsed_;
  made.bends = bends_;
  made.lost_faces = lost_faces(drawn_.face, made.face);
  if (!made.nearest) made.distance = edits_.moved();
  return made;
}

double largest_coordinate(const std::vector<Point3>& vertices) {
  double largest = 0;
  for (const Point3& p : vertices) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

}  // namespace

std::size_t lost_faces(const std::vector<std::uint32_t>& before, const std::vector<std::uint32_t>& after) {
  return std::set(before.begin(), before.end()).size() - std::set(after.begin(), after.end()).size();
}

Result<SpatialSum::Rounded> separated_surface(
    const SpatialSum::Rounded& drawn, Precision precision, double tolerance,
    std::optional<SpatialSum::Rounded> (*untangle)(const SpatialSum::Rounded&)) {
  const double size = largest_coordinate(drawn.mesh.vertices);
  const bool single = precision == Precision::singles;
  if (single && !std::isfinite(static_cast<float>(size)))
    return Error{ErrorCode::cannot_write, "a coordinate is past the range of single precision", {}};
  const double most = size * tolerance;
  if (size != 0 && !(0x1p-300 < size && size < 0x1p300))
    return Error{ErrorCode::rounding_changed_topology, "coordinates this large or small are not merged", {}};
  Error error{ErrorCode::rounding_changed_topology, "two faces cross or touch once they are rounded", {}};
  Separation prepared(drawn, precision, size, most);
  prepared.prepare();
  for (double within = size * (single ? 0x1p-22 : 0x1p-51);; within *= 2) {
    within = std::min(within, most);
    Separation separation = prepared;
    if (separation.run(within)) {
      SpatialSum::Rounded made = separation.result();
      const Result<Mesh> checked = Mesh::create(made.mesh);
      if (checked) return made;
      if (std::optional<SpatialSum::Rounded> other = untangle(made); other && Mesh::create(other->mesh)) {
        other->lost_faces = lost_faces(drawn.face, other->face);
        return *std::move(other);
      }
      error.message = "what is left is no solid: " + checked.error().message;
      error.evidence.x = checked.error().evidence.x, error.evidence.y = checked.error().evidence.y,
      error.evidence.z = checked.error().evidence.z;
    } else {
      error.evidence.x = separation.position().x, error.evidence.y = separation.position().y,
      error.evidence.z = separation.position().z;
    }
    if (!(within < most)) break;
  }
  char fraction[32];
  std::snprintf(fraction, sizeof fraction, "%.3g", tolerance);
  error.message += std::string(", with features merged that are nearer than ") + fraction + " of the size";
  return error;
}

}  // namespace dymsum::spatial
