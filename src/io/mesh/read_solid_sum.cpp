// Reads what write_solid_sum writes: lists of positions and indices, which solid_sum_fault then compares with the solid
// that they bound.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "dymsum/solid_sum_io.h"
#include "dymsum/spatial_sum.h"
#include "io/read_file.h"
#include "io/region/json_shapes.h"
#include "spatial/boolean/solid_union.h"
#include "spatial/sum/feature_pairs.h"
#include "spatial/sum/sum_source.h"
#include "spatial/sum/vertex_signs.h"

namespace dymsum::io {
namespace {

// Whether lists that were read are those of a sum.

using exact::BigInteger;

using spatial::SpatialSumInternals;

using Loops = std::vector<std::vector<std::uint32_t>>;

Error fault(std::string message) { return {ErrorCode::malformed, std::move(message), {}}; }

Error fault_of_face(std::size_t face, const std::string& message) {
  Error error = fault(message);
  error.evidence.face = static_cast<std::int64_t>(face);
  return error;
}

class FaultSearch {
 public:
  explicit FaultSearch(const SpatialSum& sum) : sum_(sum), signs_(sum) {}

  std::optional<Error> run() {
    if (auto error = fault_of_vertices()) return error;
    if (auto error = fault_of_shells()) return error;
    if (auto error = fault_of_planes()) return error;
    if (auto error = fault_of_tight()) return error;
    if (sum_.vertices.empty()) return std::nullopt;
    if (const auto face = spatial::first_without_triangles(sum_)) return named(*face, "has loops that cross");
    return fault_of_solid();
  }

 private:
  Error fault_of_vertex(std::size_t v, const std::string& message) const {
    Error error = fault(message);
    const Point3& at = sum_.vertices[v];
    error.evidence.vertex = static_cast<std::int64_t>(v);
    error.evidence.x = at.x, error.evidence.y = at.y, error.evidence.z = at.z;
    return error;
  }
  /// Of a face, or a tight one, which are counted after the others.
  Error named(std::size_t face, const std::string& message) const {
    if (face < sum_.faces.size()) return fault_of_face(face, "the face " + message);
    return fault("tight face " + std::to_string(face - sum_.faces.size()) + " " + message);
  }

  std::optional<Error> fault_of_vertices() const {
    std::vector<bool> used(sum_.vertices.size());
    const auto use = [&](const Loops& loops) {
      for (const auto& loop : loops)
        for (const std::uint32_t v : loop) used[v] = true;
    };
    for (const SpatialFace& face : sum_.faces) use(face.loops);
    for (const Loops& loops : sum_.tight_faces) use(loops);
    for (const auto& [from, to] : sum_.tight_segments) used[from] = used[to] = true;
    for (const std::uint32_t v : sum_.tight_points) used[v] = true;
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (!used[v]) return fault_of_vertex(v, "no face and no tight feature has this vertex");
      if (v > 0 && !before(v - 1, v)) return fault_of_vertex(v, "the vertices are not in the order of x, y, z");
    }
    return std::nullopt;
  }
  bool before(std::size_t a, std::size_t b) const {
    const spatial::SpatialPositions& positions = SpatialSumInternals::positions(sum_);
    const auto p = positions.homogeneous(a), q = positions.homogeneous(b);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const int order = BigInteger(p[axis] * q[3]).compare(BigInteger(q[axis] * p[3]))) return order < 0;
    return false;
  }

  std::optional<Error> fault_of_shells() const {
    std::size_t named = 0;
    for (std::size_t f = 0; f < sum_.faces.size(); ++f) {
      if (sum_.faces[f].shell > named) return fault_of_face(f, "shells are not named in the order of their faces");
      if (sum_.faces[f].shell == named) ++named;
    }
    if (named == sum_.shells) return std::nullopt;
    return fault("the faces have " + std::to_string(named) + " shells, not " + std::to_string(sum_.shells));
  }

  std::optional<Error> fault_of_planes() {
    for (std::size_t f = 0; f < sum_.faces.size() + sum_.tight_faces.size(); ++f) {
      const Loops& loops = f < sum_.faces.size() ? sum_.faces[f].loops : sum_.tight_faces[f - sum_.faces.size()];
      const std::array<std::uint32_t, 3> corner{loops[0].back(), loops[0][0], loops[0][1]};
      if (is_straight(corner)) return named(f, "has no corner at its first vertex");
      for (const auto& loop : loops)
        for (const std::uint32_t v : loop)
          if (signs_.side(corner[0], corner[1], corner[2], v) != 0) return named(f, "is not plane");
    }
    return std::nullopt;
  }
  bool is_straight(const std::array<std::uint32_t, 3>& corner) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (signs_.turn(corner[0], corner[1], corner[2], axis) != 0) return false;
    return true;
  }

  std::optional<Error> fault_of_tight() const {
    const auto ascending = [](const auto& list) {
      return std::adjacent_find(list.begin(), list.end(), [](const auto& a, const auto& b) { return !(a < b); }) ==
             list.end();
    };
    for (const auto& [from, to] : sum_.tight_segments)
      if (from >= to) return fault("a tight segment does not run from its smaller end to the larger one");
    if (!ascending(sum_.tight_faces)) return fault("the tight faces are not in their order");
    if (!ascending(sum_.tight_segments)) return fault("the tight segments are not in their order");
    if (!ascending(sum_.tight_points)) return fault("the tight points are not in their order");
    return std::nullopt;
  }

  /// Compares the boundary with that of the solid that it bounds.
  std::optional<Error> fault_of_solid() const {
    const Result<SpatialSum> solid = spatial::solid_inside(spatial::exact_set(sum_), {}, {});
    if (!solid) {
      Error error = solid.error();
      if (error.code == ErrorCode::not_closed) error.code = ErrorCode::malformed;
      return error;
    }
    std::vector<std::uint32_t> name(sum_.vertices.size());
    if (std::optional<Error> error = name_vertices(*solid, name)) return error;
    for (std::size_t f = 0; f < std::max(sum_.faces.size(), solid->faces.size()); ++f) {
      if (f >= sum_.faces.size()) return fault("the solid that the faces bound has more of them");
      if (f < solid->faces.size() && solid->faces[f].loops == renamed(sum_.faces[f].loops, name)) continue;
      return fault_of_face(f,
                           "the faces are none of a result: this one is not what bounds the solid of all of them, or "
                           "not in its order");
    }
    return fault_of_shells(*solid);
  }
  /// Shells are numbered in the order of their first faces, and hold what edges of two faces join. Where four faces
  /// meet along an edge, results have one shell or two, as bodies that touch there were made.
  std::optional<Error> fault_of_shells(const SpatialSum& solid) const {
    const auto wrong = [&](std::size_t f) { return fault_of_face(f, "its shell is none of the solid's"); };
    std::vector<std::uint32_t> whole;  // of every shell the solid's
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> at_edge;
    for (std::size_t f = 0; f < sum_.faces.size(); ++f) {
      const std::uint32_t shell = sum_.faces[f].shell;
      if (shell > whole.size()) return wrong(f);
      if (shell == whole.size()) whole.push_back(solid.faces[f].shell);
      if (whole[shell] != solid.faces[f].shell) return wrong(f);
      for (const auto& loop : sum_.faces[f].loops)
        for (std::size_t k = 0; k < loop.size(); ++k)
          at_edge[std::minmax(loop[k], loop[(k + 1) % loop.size()])].push_back(f);
    }
    for (const auto& [ends, faces] : at_edge)
      if (faces.size() == 2 && sum_.faces[faces[0]].shell != sum_.faces[faces[1]].shell) return wrong(faces[1]);
    return std::nullopt;
  }
  /// Of every vertex of a face: which one of the solid it is.
  std::optional<Error> name_vertices(const SpatialSum& solid, std::vector<std::uint32_t>& name) const {
    std::vector<bool> of_face(sum_.vertices.size());
    for (const SpatialFace& face : sum_.faces)
      for (const auto& loop : face.loops)
        for (const std::uint32_t v : loop) of_face[v] = true;
    std::uint32_t next = 0;
    for (std::size_t v = 0; v < of_face.size(); ++v) {
      if (!of_face[v]) continue;
      if (next >= solid.vertices.size() ||
          SpatialSumInternals::positions(solid).at(next) != SpatialSumInternals::positions(sum_).at(v))
        return fault_of_vertex(v,
                               "the faces are none of a result: the solid that they bound has other vertices than this "
                               "one");
      name[v] = next++;
    }
    if (next == solid.vertices.size()) return std::nullopt;
    return fault("the faces are none of a result: the solid that they bound has more vertices");
  }
  static Loops renamed(Loops loops, const std::vector<std::uint32_t>& name) {
    for (auto& loop : loops)
      for (std::uint32_t& v : loop) v = name[v];
    return loops;
  }

  const SpatialSum& sum_;
  spatial::VertexSigns signs_;
};

/// Why the lists are none of a sum, or nothing: vertices in the order of positions, each of some face or tight feature;
/// plane faces with area whose loops do not cross; and together the canonical boundary of a solid, shells named in
/// order: that of all positions whose winding number is positive is the same. Tight features are compared with nothing
/// else: they are plane, and in their order. Requires indices that are there, and loops of three vertices at least.
/// Exact. Errors: malformed, with a vertex or a face; out_of_range as parse_solid_sum.
std::optional<Error> solid_sum_fault(const SpatialSum& sum) { return FaultSearch(sum).run(); }

}  // namespace
}  // namespace dymsum::io

namespace dymsum {

// Reads what write_solid_sum writes: lists of positions and indices, which solid_sum_fault then compares with the solid
// that they bound.

namespace {

using exact::BigInteger;
using io::JsonKind;
using io::JsonValue;
using io::Source;
using spatial::SpatialSumInternals;

class SolidSumReader {
 public:
  explicit SolidSumReader(const Source& source) : source_(source) {}

  SpatialSum read(const JsonValue& root) {
    io::visit_array(source_, member(root, "vertex_list"), "vertices", [&](const JsonValue& v) { add_vertex(v); });
    sum_.at_error = largest_ * 0x1p-53 + 0x1p-1074;  // nearest doubles: half an ulp of the largest
    sum_.shells = whole(member(root, "shells"), "a number of shells", kNoLimit);
    io::visit_array(source_, member(root, "face_list"), "faces", [&](const JsonValue& f) { add_face(f); });
    read_tight(member(root, "tight_list"));
    if (!listed_.empty()) {
      auto positions = std::make_shared<spatial::SpatialPositions>();
      positions->listed = std::move(listed_);
      SpatialSumInternals::set_positions(sum_, std::move(positions));
    }
    read_edges(member(root, "edge_list"));
    if (const auto sizes = root.find("convolution")) {
      sum_.stats.face_vertex = whole(member(*sizes, "fv"), "a count", kNoLimit);
      sum_.stats.edge_edge = whole(member(*sizes, "ee"), "a count", kNoLimit);
    }
    return std::move(sum_);
  }

 private:
  static constexpr double kNoLimit = 0x1p32;

  JsonValue member(const JsonValue& object, std::string_view key) { return io::require_member(source_, object, key); }
  [[noreturn]] void fail(const std::string& message, const JsonValue& at) {
    source_.fail_on_line(ErrorCode::malformed, message, at.line());
  }

  // Numbers.

  std::uint32_t checked(double value, const std::string& what, double limit, const JsonValue& at) {
    if (!(value >= 0 && value < limit) || value != std::floor(value)) fail("expected " + what, at);
    return static_cast<std::uint32_t>(value);
  }
  std::uint32_t whole(const JsonValue& value, const std::string& what, double limit) {
    if (value.kind() != JsonKind::number) fail("expected " + what, value);
    return checked(value.number(), what, limit, value);
  }
  /// Indices below `limit`: two of them are one token.
  std::vector<std::uint32_t> indices(const JsonValue& list, const std::string& what, double limit) {
    const std::string one = what + " below " + std::to_string(static_cast<std::uint64_t>(limit));
    if (list.kind() == JsonKind::pair)
      return {checked(list.pair().x, one, limit, list), checked(list.pair().y, one, limit, list)};
    if (list.kind() != JsonKind::array) fail("expected a list of " + what, list);
    std::vector<std::uint32_t> all;
    list.each([&](const JsonValue& value) { all.push_back(whole(value, one, limit)); });
    return all;
  }
  double vertices() const { return static_cast<double>(sum_.vertices.size()); }

  // Vertices.

  void add_vertex(const JsonValue& value) {
    std::vector<Rational> at;
    const JsonValue list = member(value, "exact");
    io::visit_array(source_, list, "exact coordinates",
                    [&](const JsonValue& c) { at.push_back(io::require_exact_coordinate(source_, c)); });
    if (at.size() != 3) fail("a vertex has " + std::to_string(at.size()) + " exact coordinates, not 3", list);
    BigInteger w = 1;
    for (const Rational& c : at) w = lcm(w, exact::denominator_of(c));
    const auto over = [&](const Rational& c) {
      return BigInteger(exact::numerator_of(c) * (w / exact::denominator_of(c)));
    };
    listed_.push_back({over(at[0]), over(at[1]), over(at[2]), w});
    sum_.vertices.push_back({at[0].to_double(), at[1].to_double(), at[2].to_double()});
    for (const Rational& c : at) largest_ = std::max(largest_, std::abs(c.to_double()));
    sum_.vertex_contacts.push_back(contact(value));
  }

  // What touches.

  SolidFeature feature(const JsonValue& value) {
    constexpr double kAny = 0x1p32;
    if (const auto v = value.find("vertex"))
      return {SolidFeature::Kind::vertex, whole(*v, "the index of a vertex", kAny), 0};
    if (const auto f = value.find("face")) return {SolidFeature::Kind::face, whole(*f, "the index of a face", kAny), 0};
    const auto edge = value.find("edge");
    if (!edge || edge->kind() != JsonKind::pair) fail("expected a vertex, an edge of two vertices, or a face", value);
    const std::vector<std::uint32_t> ends = indices(*edge, "vertices of an edge", kAny);
    return {SolidFeature::Kind::edge, ends[0], ends[1]};
  }
  /// Nothing where both are null.
  std::optional<SolidContact> contact(const JsonValue& value) {
    const JsonValue p = member(value, "p"), q = member(value, "q");
    if (p.kind() == JsonKind::null && q.kind() == JsonKind::null) return std::nullopt;
    return SolidContact{feature(p), feature(q)};
  }
  SolidContact required_contact(const JsonValue& value) {
    const std::optional<SolidContact> found = contact(value);
    if (!found) fail("expected features that touch", value);
    return *found;
  }
  std::vector<SolidContact> contacts(const JsonValue& value) {
    std::vector<SolidContact> all;
    io::visit_array(source_, member(value, "contacts"), "contacts",
                    [&](const JsonValue& item) { all.push_back(required_contact(item)); });
    return all;
  }

  // Faces, edges and what is tight.

  std::vector<std::vector<std::uint32_t>> loops(const JsonValue& value) {
    std::vector<std::vector<std::uint32_t>> all;
    const JsonValue list = member(value, "loops");
    io::visit_array(source_, list, "loops", [&](const JsonValue& loop) {
      all.push_back(indices(loop, "vertices", vertices()));
      if (all.back().size() < 3) fail("a loop has fewer than three vertices", loop);
    });
    if (all.empty()) fail("a face has no loop", list);
    return all;
  }
  void add_face(const JsonValue& value) {
    const SolidContact touching = required_contact(value);
    const std::uint32_t shell = whole(member(value, "shell"), "the index of a shell", static_cast<double>(sum_.shells));
    sum_.faces.push_back({loops(value), touching.p, touching.q, shell});
  }
  void read_edges(const JsonValue& list) {
    const std::vector<SpatialEdge> edges = spatial::edges_of(sum_.faces);
    std::vector<std::optional<SolidContact>> found;
    io::visit_array(source_, list, "edges", [&](const JsonValue& value) {
      const auto ends = indices(member(value, "vertices"), "vertices", vertices());
      const auto faces = indices(member(value, "faces"), "faces", static_cast<double>(sum_.faces.size()));
      const std::size_t k = found.size();
      if (k >= edges.size() || ends != std::vector{edges[k].from, edges[k].to} || faces != edges[k].faces)
        fail("the edges are not those of the faces, in their order", value);
      found.push_back(contact(value));
    });
    if (found.size() != edges.size()) fail("the edges are not those of the faces, in their order", list);
    SpatialSumInternals::set_edge_contacts(sum_, std::move(found));
  }
  void read_tight(const JsonValue& tight) {
    io::visit_array(source_, member(tight, "faces"), "tight faces", [&](const JsonValue& value) {
      sum_.tight_faces.push_back(loops(value));
      sum_.tight_face_contacts.push_back(
          {required_contact(member(value, "front")), required_contact(member(value, "back"))});
    });
    io::visit_array(source_, member(tight, "segments"), "tight segments", [&](const JsonValue& value) {
      const auto ends = indices(member(value, "vertices"), "vertices", vertices());
      if (ends.size() != 2) fail("a segment has two vertices", value);
      sum_.tight_segments.push_back({ends[0], ends[1]});
      sum_.tight_segment_contacts.push_back(contacts(value));
    });
    io::visit_array(source_, member(tight, "points"), "tight points", [&](const JsonValue& value) {
      sum_.tight_points.push_back(whole(member(value, "vertex"), "the index of a vertex", vertices()));
      sum_.tight_point_contacts.push_back(contacts(value));
    });
  }

  const Source& source_;
  SpatialSum sum_;
  std::vector<std::array<BigInteger, 4>> listed_;
  double largest_ = 0;
};

}  // namespace

bool begins_like_solid_sum(std::string_view text) { return io::begins_with_key(text, "shells"); }

bool names_solid_sum(const std::string& path) { return io::names_json_with(path, "shells"); }

Result<SpatialSum> parse_solid_sum(std::string_view text, std::string_view name_for_errors) {
  try {
    const io::PlainText plain(text);
    const Source source{plain.view(), name_for_errors};
    const io::JsonTape tape(source);
    SpatialSum sum = SolidSumReader(source).read(tape.root());
    if (std::optional<Error> fault = io::solid_sum_fault(sum)) {
      fault->evidence.file = name_for_errors;
      return *std::move(fault);
    }
    return sum;
  } catch (io::ReadFailure& failure) {
    return std::move(failure.error);
  }
}

Result<SpatialSum> read_solid_sum(const std::string& path) {
  const Result<std::string> text = io::read_file(path);
  if (!text) return text.error();
  return parse_solid_sum(*text, path == "-" ? "standard input" : path);
}

}  // namespace dymsum
