#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "cspace/boundary/obstacle_state.h"
#include "cspace/events/walked_rings.h"
#include "cspace/mesh/obstacle_rails.h"
#include "exact/rounding_bound.h"

namespace dymsum::cspace {
namespace {

/// An edge of each operand at most: the line of a contact. With both, the edges are parallel and the line is that of
/// all contacts of one with an end of the other.
using Line = std::array<std::uint32_t, 4>;
using Crossing = std::pair<Line, Line>;

Point along(const RingTable& table, std::uint32_t edge) {
  const Point &a = table.at[edge], &b = table.at[table.next[edge]];
  return {b.x - a.x, b.y - a.y};
}

/// The error of the cross product of an edge and a rotated one, besides what the angle errs by, is this times their
/// lengths. The edges (1 each), the cosine and the sine (2), products and their sum (1 each): a component of the turned
/// edge errs by 5, as a vector that is less than 8. The other edge, and the products and their difference, 1 each.
constexpr double kTurnedEdges = exact::rounding_bound(8 + 1 + 1 + 1, 16);

/// Whether d and r, turned by an angle, are parallel.
bool parallel_at(const planar::ExactAngle& angle, const std::array<Point, 2>& d, const std::array<Point, 2>& r) {
  using exact::BigInteger;
  using exact::BigRational;
  const auto difference = [](double b, double a) { return BigRational(exact::exact_value(b) - exact::exact_value(a)); };
  const BigRational dx = difference(d[1].x, d[0].x), dy = difference(d[1].y, d[0].y), rx = difference(r[1].x, r[0].x),
                    ry = difference(r[1].y, r[0].y);
  const BigRational cross = dx * ry - dy * rx, dot = dx * rx + dy * ry;
  // (1 + t^2) d x (turned r) = (1 - t^2) d x r + 2 t d . r, in the other chart less by a sign.
  const BigInteger scale = denominator(cross) * denominator(dot);
  const exact::Big a(BigInteger(numerator(BigRational(cross * scale)))),
      b(BigInteger(2 * numerator(BigRational(dot * scale)))), c(BigInteger(-numerator(BigRational(cross * scale))));
  return exact::sign_at(angle.t, exact::Polynomial({a, b, c})) == 0;
}

class Lines {
 public:
  explicit Lines(const CspaceObstacle& obstacle)
      : state_(planar::ObstacleInternals::of(obstacle)),
        obstacle_(ring_table(obstacle.obstacle())),
        robot_(ring_table(obstacle.robot())) {}

  /// Rotates to an event angle.
  void turn(std::uint32_t angle) {
    const EventAngle& near = state_.angles[angle];
    angle_ = &state_.exact_angles[angle];
    cosine_ = std::cos(near.theta), sine_ = std::sin(near.theta), width_ = near.high - near.low;
  }

  /// The line of a contact at the angle of turn().
  Line of(const Contact& c) const {
    const bool fixed = c.kind == Contact::Kind::edge_of_p;
    const RingTable& other = fixed ? robot_ : obstacle_;
    const std::uint32_t vertex = fixed ? c.q : c.p;
    for (const std::uint32_t edge : {vertex, other.previous[vertex]}) {
      const std::uint32_t of_obstacle = fixed ? c.p : edge, of_robot = fixed ? edge : c.q;
      if (parallel(of_obstacle, of_robot)) return {of_obstacle, of_robot, kNobody, kNobody};
    }
    return {c.p, c.q, static_cast<std::uint32_t>(c.kind), 0};
  }

 private:
  /// Whether they have the same direction in the sum. Doubles tell most, and of parallel ones whether it is the same.
  bool parallel(std::uint32_t of_obstacle, std::uint32_t of_robot) const {
    const Point d = along(obstacle_, of_obstacle), r = along(robot_, of_robot);
    const Point e{sine_ * r.y - cosine_ * r.x, -sine_ * r.x - cosine_ * r.y};  // of the reflected robot, turned
    const double dot = d.x * e.x + d.y * e.y, cross = d.x * e.y - d.y * e.x;
    const auto ends = [](const RingTable& table, std::uint32_t edge) {
      return std::array{table.at[edge], table.at[table.next[edge]]};
    };
    return std::abs(cross) <= (kTurnedEdges + width_) * dot &&
           parallel_at(*angle_, ends(obstacle_, of_obstacle), ends(robot_, of_robot));
  }

  const planar::ObstacleState& state_;
  RingTable obstacle_, robot_;
  const planar::ExactAngle* angle_ = nullptr;
  double cosine_ = 1, sine_ = 0;
  double width_ = 0;  ///< the angle errs by less
};

/// The joints of one side of a station that have no counterpart of the same name, by the lines that cross in them.
/// kNobody where two joints do.
std::map<Crossing, std::uint32_t> unmatched(const ObstacleLayout& layout, const CspaceObstacle& obstacle,
                                            const Lines& lines, const std::vector<std::uint32_t>& pieces,
                                            std::uint32_t other_layer) {
  std::map<Crossing, std::uint32_t> found;
  for (const std::uint32_t k : pieces) {
    const Piece& piece = layout.pieces[k];
    const Patch& patch = obstacle.patches()[piece.patch];
    for (const std::size_t side : {0u, 1u}) {
      const std::uint32_t joint = piece.joint[side];
      if (layout.alive(joint, other_layer)) continue;
      const Crossing crossing{lines.of(side == 0 ? patch.left : patch.contact),
                              lines.of(side == 0 ? patch.contact : patch.right)};
      if (crossing.first == crossing.second) continue;
      const auto at = found.emplace(crossing, joint).first;
      if (at->second != joint) at->second = kNobody;
    }
  }
  return found;
}

}  // namespace

RingTable ring_table(const Region& region) {
  RingTable table;
  const auto add = [&](const Ring& ring) {
    const auto first = static_cast<std::uint32_t>(table.at.size()), n = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t k = 0; k < n; ++k) {
      table.at.push_back(ring[k]);
      table.next.push_back(first + (k + 1) % n);
      table.previous.push_back(first + (k + n - 1) % n);
    }
  };
  planar::for_each_ring(region, add);
  table.first_visit.resize(table.at.size());
  std::iota(table.first_visit.begin(), table.first_visit.end(), 0u);
  // Where rings touch, and where polylines end, fork and pass on their way back.
  if (region.touching_points().empty() && region.polylines().empty() && region.points().empty()) return table;
  std::map<std::pair<double, double>, std::uint32_t> visited;
  for (std::uint32_t v = 0; v < table.at.size(); ++v)
    table.first_visit[v] = visited.emplace(std::pair{table.at[v].x + 0.0, table.at[v].y + 0.0}, v).first->second;
  return table;
}

void name_joints_at_alignments(ObstacleLayout& layout, const CspaceObstacle& obstacle) {
  std::set<std::uint32_t> aligned;
  for (const ObstacleEvent& event : obstacle.events())
    if (event.kind == ObstacleEvent::Kind::alignment) aligned.insert(event.angle);
  Lines lines(obstacle);
  for (const std::uint32_t k : aligned) {
    Station& station = layout.stations[k];
    lines.turn(k);
    const auto below = unmatched(layout, obstacle, lines, station.ending, station.above);
    const auto above = unmatched(layout, obstacle, lines, station.beginning, station.below);
    for (const auto& [crossing, joint] : below) {
      const auto at = above.find(crossing);
      if (joint == kNobody || at == above.end() || at->second == kNobody) continue;
      station.name_above.emplace(joint, at->second);
      station.name_below.emplace(at->second, joint);
    }
  }
}

}  // namespace dymsum::cspace
