#include "planar_shape.h"

#include <cstdint>
#include <vector>

#include "arrays.h"

namespace dymsum::web {
namespace {

using Indices = std::vector<std::uint32_t>;

/// Vertices one after the other, with their provenance.
class Vertices {
 public:
  explicit Vertices(std::size_t count) {
    at_.reserve(2 * count);
    contacts_.reserve(6 * count);
    corners_.reserve(2 * count);
  }
  std::uint32_t take(const SumVertex& vertex) {
    add(at_, vertex.at);
    for (const Contact& c : {vertex.in, vertex.out})
      contacts_.insert(contacts_.end(), {c.kind == Contact::Kind::edge_of_q ? 1u : 0u, c.p, c.q});
    corners_.insert(corners_.end(), {vertex.corner_p, vertex.corner_q});
    return count() - 1;
  }
  std::uint32_t count() const { return static_cast<std::uint32_t>(at_.size() / 2); }
  void put(val& shape) const {
    shape.set("vertices", array_of(at_));
    shape.set("contacts", array_of(contacts_));
    shape.set("corners", array_of(corners_));
  }

 private:
  std::vector<double> at_;
  Indices contacts_, corners_;
};

void put_rings(val& shape, Vertices& vertices, const std::vector<SumPart>& parts) {
  Indices rings{0}, starts{0};
  const auto take = [&](const SumRing& ring) {
    for (const SumVertex& vertex : ring.vertices) vertices.take(vertex);
    rings.push_back(vertices.count());
  };
  for (const SumPart& part : parts) {
    take(part.outer);
    for (const SumRing& hole : part.holes) take(hole);
    starts.push_back(static_cast<std::uint32_t>(rings.size() - 1));
  }
  shape.set("ringStarts", array_of(rings));
  shape.set("partStarts", array_of(starts));
}

void put_segments(val& shape, const char* name, Vertices& vertices, const std::vector<SumSegment>& segments) {
  Indices ends;
  for (const SumSegment& segment : segments) {
    ends.push_back(vertices.take(segment.from));
    ends.push_back(vertices.take(segment.to));
  }
  shape.set(name, array_of(ends));
}

void put_points(val& shape, const char* name, Vertices& vertices, const std::vector<SumVertex>& points) {
  Indices at;
  for (const SumVertex& point : points) at.push_back(vertices.take(point));
  shape.set(name, array_of(at));
}

}  // namespace

val sum_shape(const PlanarSum& sum) {
  val shape = val::object();
  Vertices vertices(sum.vertex_count());
  put_rings(shape, vertices, sum.parts);
  put_segments(shape, "segments", vertices, sum.segments);
  put_points(shape, "points", vertices, sum.points);
  put_segments(shape, "tightSegments", vertices, sum.tight_segments);
  put_points(shape, "tightPoints", vertices, sum.tight_points);
  vertices.put(shape);
  shape.set("atError", sum.at_error);
  return shape;
}

val part_rings(const std::vector<SumPart>& parts) {
  val shape = val::object();
  Vertices vertices(0);
  put_rings(shape, vertices, parts);
  vertices.put(shape);
  return shape;
}

const SumVertex& vertex_at(const PlanarSum& sum, std::size_t index) {
  for (const SumPart& part : sum.parts) {
    if (index < part.outer.vertices.size()) return part.outer.vertices[index];
    index -= part.outer.vertices.size();
    for (const SumRing& hole : part.holes) {
      if (index < hole.vertices.size()) return hole.vertices[index];
      index -= hole.vertices.size();
    }
  }
  for (const bool tight : {false, true}) {
    const auto& segments = tight ? sum.tight_segments : sum.segments;
    if (index < 2 * segments.size()) return index % 2 == 0 ? segments[index / 2].from : segments[index / 2].to;
    index -= 2 * segments.size();
    const auto& points = tight ? sum.tight_points : sum.points;
    if (index < points.size()) return points[index];
    index -= points.size();
  }
  throw Thrown{{ErrorCode::bad_index, "the sum has no such vertex", {}}};
}

}  // namespace dymsum::web
