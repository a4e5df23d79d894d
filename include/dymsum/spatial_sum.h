// Exact Minkowski sums of solids of any shape: P (+) Q = { p + q : p in P, q in Q }, with tunnels, cavities, several
// parts, tight features, and the provenance of every face.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dymsum/mesh.h"
#include "dymsum/planar_sum.h"
#include "dymsum/progress.h"
#include "dymsum/rational.h"
#include "dymsum/result.h"
#include "dymsum/spatial_trace.h"

namespace dymsum {

namespace spatial {
struct SpatialPositions;
struct SpatialSumInternals;
}  // namespace spatial

/// How the boundary is found. Both give the same result.
enum class SpatialEngine : std::uint8_t {
  /// Facets deep inside dropped, cells linked around edges, one collision test for every connected piece of the
  /// boundary, and for tight features only where there may be some (the default).
  fast,
  brute,  ///< all facets; every cell, edge and point tested by itself: the reference
};

struct SpatialOptions {
  SpatialEngine engine = SpatialEngine::fast;
  /// closed and open list tight features, regular does not: with area and volume all are the closure of the open sum.
  /// Of two operands with thin parts: see minkowski_sum.
  Semantics semantics = Semantics::closed;
  bool tight = true;   ///< look for tight features; false lists none
  bool trace = false;  ///< record the stages in SpatialSum::trace
  int threads = 0;     ///< 0: as many as there are cores; the result does not depend on it
  /// Bytes that the computation may hold beside its operands and the result; 0: no limit. Accounted for by stages.
  std::uint64_t memory = 0;
  Progress progress;
};

/// A feature of an operand, by indices into its mesh.
struct SolidFeature {
  enum class Kind : std::uint8_t { vertex, edge, face };
  Kind kind = Kind::vertex;
  std::uint32_t a = 0;  ///< the vertex, the edge's smaller vertex, or the smallest of the faces that lie in one plane
  std::uint32_t b = 0;  ///< the edge's larger vertex, else 0
  friend auto operator<=>(const SolidFeature&, const SolidFeature&) = default;
};

/// A feature of P and one of Q that touch.
struct SolidContact {
  SolidFeature p, q;
  friend auto operator<=>(const SolidContact&, const SolidContact&) = default;
};

/// A face of the boundary: a polygon in one plane, perhaps with holes, seen from outside.
struct SpatialFace {
  std::vector<std::vector<std::uint32_t>>
      loops;                ///< vertex indices: the outer one counter-clockwise, then holes clockwise
  SolidFeature p, q;        ///< what touches there; where several pairs do, the smallest beside its first edge's start
  std::uint32_t shell = 0;  ///< connected pieces of the boundary, in the order of their first faces
  friend bool operator==(const SpatialFace& a, const SpatialFace& b) { return a.loops == b.loops; }
};

/// An edge of the boundary.
struct SpatialEdge {
  std::uint32_t from = 0, to = 0;    ///< vertices, from < to
  std::vector<std::uint32_t> faces;  ///< that it bounds, ascending: two, or more where the boundary touches itself
  /// An edge and a vertex (or two parallel edges) that touch along it, from one of its ends on; none where two faces
  /// cross, whose own features tell then. An edge inside a face of an operand counts as that face.
  std::optional<SolidContact> contact;
};

struct SpatialStats {
  /// The bits of coordinates on the common grid; of a convex sum (is_convex) ConvexSum::tier_bits.
  int bits = 0;
  /// Facets of the reduced convolution; of a convex sum its faces, those that lie in a face of an operand as
  /// face_vertex.
  std::uint64_t face_vertex = 0, edge_edge = 0;
  std::uint64_t inner_facets = 0;             ///< of these, dropped because they lie deep inside the open sum
  std::uint64_t box_pairs = 0, contacts = 0;  ///< pairs of facets with overlapping boxes; of these, meeting
  std::uint64_t points = 0, cells = 0, patches = 0;
  std::uint64_t collision_tests = 0, tight_tests = 0;
  std::uint64_t double_pair_signs = 0;  ///< signs that doubles left open and pairs of doubles told
  std::uint64_t exact_signs = 0;        ///< signs that neither told: by integers or larger numbers
  std::uint64_t held_bytes = 0;         ///< what SpatialOptions::memory is compared with, at the end
  struct Stage {
    std::string_view name;
    double ms;
  };
  std::vector<Stage> stages;
};

/// The sum of two solids. Canonical: no two neighbouring faces in one plane, no vertex inside a straight
/// edge; vertices sorted by x, y, z, every loop from its smallest vertex on, faces sorted. Equal sets compare equal.
class SpatialSum {
 public:
  std::vector<Point3> vertices;  ///< positions within at_error
  double at_error = 0;
  std::vector<SpatialFace> faces;
  std::size_t shells = 0;
  /// The contact of every vertex: the two vertices that touch there, or an edge and a vertex; none where three faces
  /// cross.
  std::vector<std::optional<SolidContact>> vertex_contacts;

  /// Positions at which the operands touch without overlapping and that nothing outside comes near: passages exactly as
  /// wide as the part. Of two operands with thin parts, closed: positions of the sum that no interior of it comes near.
  std::vector<std::vector<std::vector<std::uint32_t>>> tight_faces;  ///< loops as of a face
  std::vector<std::array<std::uint32_t, 2>> tight_segments;          ///< that bound no tight face; from < to
  std::vector<std::uint32_t> tight_points;                           ///< that end no tight segment
  /// What touches there: on the two sides of a tight face, seen from its front and from its back; all pairs of a face
  /// and a vertex or of two edges along a tight segment, at its `from`, and at a tight point.
  std::vector<std::array<SolidContact, 2>> tight_face_contacts;
  std::vector<std::vector<SolidContact>> tight_segment_contacts, tight_point_contacts;
  SpatialStats stats;
  std::optional<SpatialTrace> trace;

  /// Whether it was made of convex solids by the short way for them: it is convex then, has one shell, faces without
  /// holes and nothing tight, and a contact at every vertex and along every edge.
  bool is_convex() const;

  /// The edges of the faces, sorted by from and to, made from these at every call. O(n log n).
  std::vector<SpatialEdge> edges() const;
  /// The tight faces as triangles of their own vertices, in the faces' order. Exact. O(n log n).
  std::vector<std::array<std::uint32_t, 3>> tight_triangles() const;
  /// The exact position of a vertex.
  RationalPoint3 exact(std::size_t vertex) const;
  /// The nearest doubles to the exact volume and area of the surface; zero and infinite past the range of doubles
  /// (volume_text.h has them as text then). O(n), from positions of 100 bits with a proved error; from more where these
  /// do not decide; of a convex sum in exact arithmetic.
  double volume() const;
  double area() const;
  /// The volume as one fraction. Its denominator is about the product of those of all vertices, 150 bits each where
  /// three planes cross: for thousands of them this costs as much as the sum. O(M(b) log b) for b bits in that product.
  /// Those of a convex sum have one common denominator: O(n).
  Rational volume_exact() const;
  /// The same where the denominator, before it is reduced, has at most `bits` bits; found out before anything is
  /// multiplied.
  std::optional<Rational> volume_exact_within(std::size_t bits) const;

  struct Rounded {
    MeshData mesh;
    std::vector<std::uint32_t> face;    ///< of every triangle: the face that it is a part of
    std::vector<std::uint32_t> vertex;  ///< of every vertex: which one of the sum it is, or that it is next to
    bool nearest = true;                ///< nothing happened but rounding to the nearest; the counts are 0
    std::size_t merged_vertices = 0;    ///< vertices that became another one, not joined to it by an edge
    std::size_t collapsed_edges = 0;    ///< edges whose ends became one
    std::size_t bends = 0;              ///< edges and triangles that got a vertex that was near
    std::size_t lost_faces = 0;         ///< faces of the sum of which no triangle is left
    /// Where merging was needed: every point of the mesh is at most this far from the exact boundary, and every point
    /// in one of the two solids but not in the other. Proved. 0 where `nearest`.
    double distance = 0;
    /// Where merging was needed: the volumes of the mesh and of the exact solid differ by at most this.
    double volume_change = 0;
    /// Whether the surface has as many pieces as the exact one, and the same Euler characteristic.
    bool topology_kept = true;
    /// "2 vertices merged, 1 edge collapsed, ...; within 3e-16"; "nearest coordinates".
    std::string to_string() const;
  };
  /// The boundary as triangles: closed and oriented, and valid as a mesh. Every vertex is rounded to the nearest
  /// doubles (or to single precision) where that is such a surface; else what is nearer than some units in the last
  /// place is merged, where surfaces meet, and more up to `tolerance`, a fraction of the largest coordinate (0: 2^-40,
  /// in single precision 2^-20). `distance` is at most four times the tolerance, beyond rounding. Tight features are no
  /// part of it. Errors: rounding_changed_topology with the position where the tolerance does not do; cannot_write
  /// past the range of single precision. O(n log n) beyond the triangles; a few times that where something is merged.
  Result<Rounded> rounded(Precision precision = Precision::doubles, double tolerance = 0) const;
  /// The same for a picture: whatever rounding does, triangles may have become lines, and cross.
  Rounded drawn() const;
  /// A valid mesh for further use: what rounded() gives, and of a convex sum a convex solid with whole faces, the hull
  /// of all vertices, every coordinate rounded once; faces that are no longer plane become triangles. Errors: as
  /// rounded(); of a convex sum not_finite past the range, rounding_changed_topology where two vertices round to one
  /// position or one is no longer a corner, with these vertices.
  Result<Mesh> rounded_mesh(Precision precision = Precision::doubles) const;
  /// The hull of a convex sum, the same of what is left where rounding changes the topology. The report's deviation is
  /// the largest distance of a vertex from its exact position; no point of the two solids is further from the other
  /// one. Errors: not_convex for other sums; not_finite; no_area when everything collapses into a plane.
  Result<HulledMesh> rounded_hull(Precision precision = Precision::doubles) const;

  /// The same set with the same tight features, exactly. Provenance and stats are not compared.
  friend bool operator==(const SpatialSum& a, const SpatialSum& b);

 private:
  friend struct spatial::SpatialSumInternals;
  std::shared_ptr<const spatial::SpatialPositions> positions_;  // what the exact positions are made from
  std::vector<std::optional<SolidContact>> edge_contacts_;      // of edges(); of convex sums vertex_contacts have them
};

/// P (+) Q, the closed sum of closed solids; its boundary is that of the closure of the open sum's complement. Either
/// operand may be empty (then the sum is), have several parts, cavities, and tunnels. Exact: every decision is the sign
/// of an integer expression.
/// Convex operands of any size take a short way (with the fast engine, docs/design/convex-motion.md), and faces name
/// the features that are extreme there: O(m + n + k log k) for m and n faces and k facets. Hold a ConvexSum to follow a
/// motion.
/// All others: O(N log N + K + T log T) for N facets, K of their pairs that meet and T points where three of them do.
/// Thin parts (Mesh::with_thin_parts) of one operand: the open sum is int P + Q, Q having the thin parts; all else is
/// the same, tight features included. Of both: closed is all of P + Q, the closure of its interior as faces, and the
/// faces, segments and points that the sums of thin parts add outside of that as what is tight; regular is that closure
/// alone; the open sum is int P + Q and P + int Q together, and all else is the same, where no two thin parts can
/// cross: no plate and what is not parallel to it. Errors: cancelled; out_of_memory where options.memory does not
/// suffice (the message names the need that is known or predicted by then) or the machine's memory does not;
/// unsupported_operand for operands that are not both convex and whose coordinates need more than 8,192 bits on their
/// common grid (doubles of any sizes have 2,099); for thin parts of both where nothing is left of what is requested,
/// and for the open sum of such that can cross, with the first two: `face` of P and `other_face` of Q. Source: Behar
/// 2016, sections 2.3 to 2.6, corrected (docs/design/solid-sum.md).
Result<SpatialSum> minkowski_sum(const Mesh& p, const Mesh& q, const SpatialOptions& options = {});

/// { -x : x in S }, exactly, with what is tight. O(n log n).
SpatialSum negated(const SpatialSum& sum);

/// The regular part of a sum as an operand of further sums: the same set exactly, without what is tight. Errors:
/// unsupported_operand with the position of a vertex that no doubles hold.
Result<Mesh> as_mesh(const SpatialSum& sum);

/// The sum of results, as closed sets, and solids: nothing is rounded, whatever fractions the vertices are
/// (spatial_operand.h).
Result<SpatialSum> minkowski_sum(const SpatialSum& p, const Mesh& q, const SpatialOptions& options = {});
Result<SpatialSum> minkowski_sum(const Mesh& p, const SpatialSum& q, const SpatialOptions& options = {});
Result<SpatialSum> minkowski_sum(const SpatialSum& p, const SpatialSum& q, const SpatialOptions& options = {});

/// The sum of several operands, at least one. Convex solids alone are added from the first one on, exactly whatever
/// their coordinates (with the fast engine). Others are added two at a time: convex solids first, then other solids,
/// then those with thin parts. Sums in between are operands, as closed sets: what is tight in them lies within, and the
/// open sum of three takes nothing from that. Two whose sum doubles hold, in units of a common denominator of at most
/// 2^52, are added first; where there are none, vertices in between are fractions, as above. Faces name features of the
/// last two. Errors: as minkowski_sum, with the number of operands that were added in the message. Cost: that of all
/// sums in between, and of those that are tried.
Result<SpatialSum> minkowski_sum(std::span<const Mesh> operands, const SpatialOptions& options = {});

/// True when z lies in the sum: P and z - Q meet (closed, regular), or their interiors do (open; of thin parts: they
/// meet the other one's interior). By that definition, not by the sum's boundary. Nothing that is not finite does.
/// Exact. O((m + n) log(m + n)) beyond the pairs of triangles with overlapping boxes. Errors: unsupported_operand where
/// both have thin parts (open: only where they can cross, as for minkowski_sum; closed: never), and for operands whose
/// coordinates need more than 8,192 bits on their common grid.
Result<bool> contains(const Mesh& p, const Mesh& q, const Point3& z, Semantics semantics = Semantics::closed);
/// The same for many positions, which may be any fractions. Exact. The operands are prepared once. Errors too:
/// cancelled, which progress is asked for before each position.
Result<std::vector<bool>> contains_each(const Mesh& p, const Mesh& q, std::span<const RationalPoint3> positions,
                                        Semantics semantics = Semantics::closed, const Progress& progress = {});

/// What a sum will take, before it is computed: expected numbers of facets of the reduced convolution, if each operand
/// were turned at random against the other one, and the memory that so many facets need.
struct SpatialCost {
  double face_vertex = 0, edge_edge = 0;
  std::uint64_t full_face_vertex = 0, full_edge_edge = 0;  ///< all pairs, which a convolution by brute force looks at
  std::uint64_t bytes = 0;
};
/// Crofton's formula and its like: edge + edge L_P L_Q / (2 pi^2), L being the sum of the exterior dihedral angles of
/// convex edges; face + vertex c_P n_Q + c_Q n_P, n being triangles and c how often the cones of normals that vertices
/// support cover the sphere. Right in the mean over all turns; parallel faces and edges have more or fewer. O(m + n).
SpatialCost predict_cost(const Mesh& p, const Mesh& q);

}  // namespace dymsum
