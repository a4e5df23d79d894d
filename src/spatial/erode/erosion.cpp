// A (-) B is what the sum of the complement of A and -B leaves free. The complement is cut off by a frame so wide that
// positions outside of it form a part of their own, whose surface is all of the frame's features.
#include "spatial/erode/erosion.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "spatial/erode/frame.h"
#include "spatial/sum/canonical_loop.h"
#include "spatial/sum/sum_edges.h"
#include "spatial/sum/sum_of_solids.h"
#include "spatial/sum/sum_source.h"

namespace dymsum::spatial {

namespace {

using Loops = std::vector<std::vector<std::uint32_t>>;

MeshData reflected(const MeshData& mesh) {
  MeshData result;
  for (const Point3& v : mesh.vertices) result.vertices.push_back({-v.x, -v.y, -v.z});
  for (const Face& face : mesh.faces) result.faces.emplace_back(face.rbegin(), face.rend());
  return result;
}

/// The sum's free space as a result of its own.
class Inside {
 public:
  Inside(const SpatialSum& sum, const MeshData& a) : sum_(sum), a_(a) {}

  SpatialSum run() {
    drop_frame();
    name_vertices();
    add_faces();
    add_tight();
    result_.at_error = sum_.at_error;
    result_.stats = sum_.stats;
    result_.trace = sum_.trace;
    return std::move(result_);
  }

 private:
  bool of_frame(const SolidFeature& f) const {
    return f.a >= (f.kind == SolidFeature::Kind::face ? a_.faces.size() : a_.vertices.size());
  }
  void drop_frame() {
    outside_.resize(sum_.shells);
    for (const SpatialFace& face : sum_.faces)
      if (of_frame(face.p)) outside_[face.shell] = true;
  }

  void name_vertices() {
    std::vector<bool> used(sum_.vertices.size());
    const auto use = [&](const Loops& loops) {
      for (const auto& loop : loops)
        for (const std::uint32_t v : loop) used[v] = true;
    };
    for (const SpatialFace& face : sum_.faces)
      if (!outside_[face.shell]) use(face.loops);
    for (const Loops& loops : sum_.tight_faces) use(loops);
    for (const auto& [from, to] : sum_.tight_segments) used[from] = used[to] = true;
    for (const std::uint32_t v : sum_.tight_points) used[v] = true;

    const SpatialPositions& old = SpatialSumInternals::positions(sum_);
    auto positions = std::make_shared<SpatialPositions>();
    positions->space = old.space;
    positions->scale = old.scale, positions->shift = old.shift;
    name_.resize(used.size());
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (!used[v]) continue;
      name_[v] = static_cast<std::uint32_t>(result_.vertices.size());
      result_.vertices.push_back(sum_.vertices[v]);
      result_.vertex_contacts.push_back(sum_.vertex_contacts[v]);
      positions->vertices.push_back(old.vertices[v]);
    }
    SpatialSumInternals::set_positions(result_, std::move(positions));
  }

  std::vector<std::uint32_t> named(const std::vector<std::uint32_t>& loop) const {
    std::vector<std::uint32_t> names;
    for (const std::uint32_t v : loop) names.push_back(name_[v]);
    return names;
  }

  /// Seen from the other side.
  void add_faces() {
    for (const SpatialFace& face : sum_.faces) {
      if (outside_[face.shell]) continue;
      SpatialFace turned = face;
      for (auto& loop : turned.loops) {
        loop = named(loop);
        std::reverse(loop.begin(), loop.end());
        start_at_smallest(loop);
      }
      std::sort(turned.loops.begin() + 1, turned.loops.end());
      result_.faces.push_back(std::move(turned));
    }
    std::sort(result_.faces.begin(), result_.faces.end(),
              [](const SpatialFace& x, const SpatialFace& y) { return x.loops < y.loops; });
    std::vector<std::uint32_t> shell(sum_.shells, 0xffffffff);
    for (SpatialFace& face : result_.faces) {
      std::uint32_t& s = shell[face.shell];
      if (s == 0xffffffff) s = static_cast<std::uint32_t>(result_.shells++);
      face.shell = s;
    }
    std::vector<std::optional<SolidContact>> contacts;  // in the order of edges: names keep that of vertices
    for (const SpatialEdge& edge : sum_.edges())
      if (!outside_[sum_.faces[edge.faces[0]].shell]) contacts.push_back(edge.contact);
    SpatialSumInternals::set_edge_contacts(result_, std::move(contacts));
  }

  void add_tight() {
    for (const Loops& loops : sum_.tight_faces) {
      Loops& to = result_.tight_faces.emplace_back();
      for (const auto& loop : loops) to.push_back(named(loop));
    }
    for (const auto& [from, to] : sum_.tight_segments) result_.tight_segments.push_back({name_[from], name_[to]});
    result_.tight_points = named(sum_.tight_points);
    result_.tight_face_contacts = sum_.tight_face_contacts;
    result_.tight_segment_contacts = sum_.tight_segment_contacts;
    result_.tight_point_contacts = sum_.tight_point_contacts;
  }

  const SpatialSum& sum_;
  const MeshData& a_;
  std::vector<bool> outside_;        // shells of the frame
  std::vector<std::uint32_t> name_;  // per vertex
  SpatialSum result_;
};

/// A vertex of -B that an error tells is one of B.
Error of_operands(Error error, const MeshData& b) {
  Evidence& e = error.evidence;
  if (!e.vertex || !e.x || static_cast<std::size_t>(*e.vertex) >= b.vertices.size()) return error;
  const Point3& v = b.vertices[static_cast<std::size_t>(*e.vertex)];
  if (Point3{-*e.x, -*e.y, -*e.z} == v) e.x = v.x, e.y = v.y, e.z = v.z;
  return error;
}

/// `sum_with` adds the reflected b to the complement of a.
template <class F>
Result<SpatialSum> inside_of(const MeshData& a, const MeshData& b, F sum_with) {
  if (b.faces.empty()) return Error{ErrorCode::unsupported_operand, "every position holds the empty solid", {}};
  if (a.faces.empty() || !fits_lengthwise(a, b)) return SpatialSum();
  Result<MeshData> complement = framed_complement(a, b);
  if (!complement) return complement.error();
  const Result<SpatialSum> sum = sum_with(*std::move(complement), reflected(b));
  if (!sum) return of_operands(sum.error(), b);
  return Inside(*sum, a).run();
}

}  // namespace

Result<SpatialSum> erosion(const MeshData& a, const MeshData& b, const SpatialOptions& options) {
  return inside_of(a, b, [&](const MeshData& complement, const MeshData& reflection) {
    return sum_of_solids(complement, reflection, options);
  });
}

Result<SpatialSum> erosion(const ExactSet& a, const ExactSet& b, const SpatialOptions& options) {
  return inside_of(a.set, b.set, [&](MeshData complement, MeshData reflection) {
    ExactSet outside = exact_set(std::move(complement));  // of which the frame comes after a
    std::copy(a.at.begin(), a.at.end(), outside.at.begin());
    ExactSet inverse = exact_set(std::move(reflection));
    for (std::size_t v = 0; v < b.at.size(); ++v)
      for (std::size_t axis = 0; axis < 3; ++axis) inverse.at[v][axis] = -b.at[v][axis];
    return sum_of_exact_sets(outside, inverse, options);
  });
}

Result<SpatialSum> erosion(const ExactSet& a, const MeshData& b, const SpatialOptions& options) {
  return erosion(a, exact_set(b), options);
}

}  // namespace dymsum::spatial
