#include "planar/local/local_part.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "planar/operand/contact_of.h"

namespace dymsum::planar {

namespace {

using exact::BigRational;

struct RationalVertex {
  BigRational x, y;
};

RationalVertex value_of(const LocalNodes& nodes, std::uint32_t n) {
  const LocalUnit& unit = nodes.posed().unit();
  const BigPlace& at = nodes.exact(n);
  return {unit.value(at.x, at.w), unit.value(at.y, at.w)};
}

/// Whether the closed disc meets the segment between two nodes, or the one node.
bool meets(const PlanarDisc& disc, const LocalNodes& nodes, std::uint32_t from, std::uint32_t to) {
  const RationalVertex m{exact::exact_value(disc.middle.x), exact::exact_value(disc.middle.y)};
  const RationalVertex a = value_of(nodes, from), b = value_of(nodes, to);
  const BigRational dx = b.x - a.x, dy = b.y - a.y, size = dx * dx + dy * dy;
  BigRational t = 0;
  if (size > 0) t = ((m.x - a.x) * dx + (m.y - a.y) * dy) / size;
  if (t < 0) t = 0;
  if (t > 1) t = 1;
  const BigRational x = a.x + t * dx - m.x, y = a.y + t * dy - m.y, r = exact::exact_value(disc.radius);
  return x * x + y * y <= r * r;
}

void keep_in_disc(const PlanarDisc& disc, const LocalNodes& nodes, LocalEdges& edges) {
  const auto off = [&](const LocalEdge& e) { return !meets(disc, nodes, e.from, e.to); };
  std::erase_if(edges.boundary, off), std::erase_if(edges.tight, off);
  std::erase_if(edges.tight_points, [&](std::uint32_t n) { return !meets(disc, nodes, n, n); });
}

/// Those that occur, by x, then y.
std::vector<std::uint32_t> sorted_nodes(const LocalNodes& nodes, const LocalEdges& edges) {
  std::vector<std::uint32_t> used = edges.tight_points;
  for (const std::vector<LocalEdge>* list : {&edges.boundary, &edges.tight})
    for (const LocalEdge& e : *list) used.push_back(e.from), used.push_back(e.to);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::sort(used.begin(), used.end(), [&](std::uint32_t m, std::uint32_t n) {
    const int x = compare(nodes.exact(m), nodes.exact(n), 0);
    return x != 0 ? x < 0 : compare(nodes.exact(m), nodes.exact(n), 1) < 0;
  });
  return used;
}

std::vector<PlanarLocalPart::Edge> named(const LocalNodes& nodes, const std::vector<LocalEdge>& edges,
                                         const std::map<std::uint32_t, std::uint32_t>& number) {
  std::vector<PlanarLocalPart::Edge> list;
  const PosedRegions& posed = nodes.posed();
  for (const LocalEdge& e : edges)
    list.push_back(
        {number.at(e.from), number.at(e.to), contact_of(nodes.segment(e.segment), posed.operand(0), posed.operand(1))});
  std::sort(list.begin(), list.end(),
            [](const auto& a, const auto& b) { return std::tie(a.from, a.to) < std::tie(b.from, b.to); });
  return list;
}

}  // namespace

std::shared_ptr<const PlanarLocalPart::Positions> assemble_part(const LocalNodes& nodes, LocalEdges edges,
                                                                const PlanarDisc* disc, PlanarLocalPart& part) {
  edges.boundary = joined(nodes, std::move(edges.boundary));
  edges.tight = joined(nodes, std::move(edges.tight));
  if (disc != nullptr) keep_in_disc(*disc, nodes, edges);
  auto positions = std::make_shared<PlanarLocalPart::Positions>();
  positions->unit = nodes.posed().unit();
  std::map<std::uint32_t, std::uint32_t> number;
  for (const std::uint32_t n : sorted_nodes(nodes, edges)) {
    number[n] = static_cast<std::uint32_t>(part.vertices.size());
    const BigPlace& at = nodes.exact(n);
    part.vertices.push_back({positions->unit.rounded(at.x, at.w), positions->unit.rounded(at.y, at.w)});
    positions->at.push_back(at);
  }
  part.edges = named(nodes, edges.boundary, number);
  part.tight_segments = named(nodes, edges.tight, number);
  for (const std::uint32_t n : edges.tight_points) part.tight_points.push_back(number.at(n));
  std::sort(part.tight_points.begin(), part.tight_points.end());
  return positions;
}

}  // namespace dymsum::planar

namespace dymsum {

RationalPoint PlanarLocalPart::exact(std::uint32_t vertex) const {
  if (vertex >= vertices.size()) throw std::out_of_range("PlanarLocalPart::exact: no vertex has this index");
  return positions_->unit.point(positions_->at[vertex]);
}

bool operator==(const PlanarLocalPart& a, const PlanarLocalPart& b) {
  const auto same_edge = [](const PlanarLocalPart::Edge& e, const PlanarLocalPart::Edge& f) {
    return e.from == f.from && e.to == f.to;
  };
  if (a.where != b.where || a.vertices != b.vertices || a.tight_points != b.tight_points ||
      !std::equal(a.edges.begin(), a.edges.end(), b.edges.begin(), b.edges.end(), same_edge) ||
      !std::equal(a.tight_segments.begin(), a.tight_segments.end(), b.tight_segments.begin(), b.tight_segments.end(),
                  same_edge))
    return false;
  for (std::uint32_t k = 0; k < a.vertices.size(); ++k)
    if (!(a.exact(k) == b.exact(k))) return false;
  return true;
}

}  // namespace dymsum
