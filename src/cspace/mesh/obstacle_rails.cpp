#include "cspace/mesh/obstacle_rails.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "cspace/boundary/obstacle_state.h"
#include "cspace/events/walked_rings.h"
#include "exact/rounding_bound.h"

namespace dymsum::cspace {
namespace {

/// Joints by index, in the order they are met.
class Joints {
 public:
  explicit Joints(const CspaceObstacle& obstacle)
      : obstacle_(ring_table(obstacle.obstacle())), robot_(ring_table(obstacle.robot())) {}

  std::uint32_t left_of(const Patch& p) {
    return p.left_corner ? corner(p.contact.p, p.contact.q) : crossing(p.left, p.contact);
  }
  std::uint32_t right_of(const Patch& p) {
    if (!p.right_corner) return crossing(p.contact, p.right);
    if (p.rotating()) return corner(p.contact.p, robot_.next[p.contact.q]);
    return corner(obstacle_.next[p.contact.p], p.contact.q);
  }
  std::size_t size() const { return numbers_.size(); }

 private:
  using Key = std::array<std::uint32_t, 6>;

  std::uint32_t index(const Key& key) {
    return numbers_.emplace(key, static_cast<std::uint32_t>(numbers_.size())).first->second;
  }
  std::uint32_t corner(std::uint32_t p, std::uint32_t q) {
    return index({obstacle_.first_visit[p], robot_.first_visit[q], kNobody, 0, 0, 0});
  }
  std::uint32_t crossing(const Contact& a, const Contact& b) {
    return index({a.p, a.q, static_cast<std::uint32_t>(a.kind), b.p, b.q, static_cast<std::uint32_t>(b.kind)});
  }

  RingTable obstacle_, robot_;
  std::map<Key, std::uint32_t> numbers_;
};

void add_stations(ObstacleLayout& layout, const std::vector<EventAngle>& angles) {
  const bool at_pi = !angles.empty() && angles.back().exact && angles.back().exact->is_half_turn();
  for (const EventAngle& angle : angles) layout.stations.emplace_back().theta = angle.theta;
  if (!at_pi) layout.stations.emplace_back();
  layout.stations.back().theta = std::numbers::pi;
  const auto n = static_cast<std::uint32_t>(layout.stations.size());
  for (std::uint32_t k = 0; k < n; ++k) layout.stations[k].below = k, layout.stations[k].above = (k + 1) % n;
}

void add_pieces(ObstacleLayout& layout, const CspaceObstacle& obstacle, Joints& joints) {
  const auto layers = static_cast<std::uint32_t>(layout.stations.size());
  const std::vector<Patch>& patches = obstacle.patches();
  for (std::uint32_t k = 0; k < patches.size(); ++k) {
    const Patch& p = patches[k];
    Piece piece{k, 0, layers - 1, {joints.left_of(p), joints.right_of(p)}};
    const auto add = [&](std::uint32_t first, std::uint32_t last) {
      if (first > last || first >= layers) return;
      piece.first = first;
      piece.last = last;
      layout.pieces.push_back(piece);
    };
    if (p.begin == Patch::kNone) {
      add(0, layers - 1);
    } else if (p.begin < p.end) {
      add(p.begin + 1, p.end);
    } else {
      add(p.begin + 1, layers - 1);
      add(0, p.end);
    }
  }
}

/// The pieces on one side of a joint, in order; what is left of the first one begins at `from`.
struct Side {
  std::vector<std::uint32_t> pieces;
  std::size_t next = 0;
  std::uint32_t from = 0;

  bool done() const { return next == pieces.size(); }
  std::uint32_t start(const std::vector<Piece>& all) const { return std::max(from, all[pieces[next]].first); }
  std::uint32_t last(const std::vector<Piece>& all) const { return all[pieces[next]].last; }
};

void add_rails(ObstacleLayout& layout, std::uint32_t joint, Side before, Side after) {
  const std::vector<Piece>& all = layout.pieces;
  while (!before.done() || !after.done()) {
    Rail rail{joint, kNobody, kNobody, kNobody, kNobody};
    for (const Side* side : {&before, &after})
      if (!side->done()) rail.first = std::min(rail.first, side->start(all));
    const auto reach = [&](const Side& side, std::uint32_t& piece) {
      if (side.done()) return;
      const bool here = side.start(all) == rail.first;
      if (here) piece = side.pieces[side.next];
      rail.last = std::min(rail.last, here ? side.last(all) : side.start(all) - 1);
    };
    reach(before, rail.before);
    reach(after, rail.after);
    for (Side* side : {&before, &after}) {
      if (side->done()) continue;
      side->from = rail.last + 1;
      side->next += side->last(all) == rail.last ? 1 : 0;
    }
    layout.rails.push_back(rail);
  }
}

void collect_rails(ObstacleLayout& layout, std::size_t joints) {
  std::vector<Side> before(joints), after(joints);
  std::vector<std::uint32_t> order(layout.pieces.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) order[k] = k;
  const auto first = [&](std::uint32_t a, std::uint32_t b) { return layout.pieces[a].first < layout.pieces[b].first; };
  std::stable_sort(order.begin(), order.end(), first);
  for (const std::uint32_t k : order) {
    after[layout.pieces[k].joint[0]].pieces.push_back(k);
    before[layout.pieces[k].joint[1]].pieces.push_back(k);
  }
  layout.rails_of_joint.resize(joints);
  layout.rails_of_piece.resize(layout.pieces.size());
  for (std::uint32_t joint = 0; joint < joints; ++joint) {
    const std::size_t from = layout.rails.size();
    add_rails(layout, joint, before[joint], after[joint]);
    for (std::size_t k = from; k < layout.rails.size(); ++k) {
      const auto rail = static_cast<std::uint32_t>(k);
      layout.rails_of_joint[joint].push_back(rail);
      if (layout.rails[k].after != kNobody) layout.rails_of_piece[layout.rails[k].after][0].push_back(rail);
      if (layout.rails[k].before != kNobody) layout.rails_of_piece[layout.rails[k].before][1].push_back(rail);
    }
  }
}

}  // namespace

bool ObstacleLayout::alive(std::uint32_t joint, std::uint32_t layer) const {
  const std::vector<std::uint32_t>& list = rails_of_joint[joint];
  const auto ends_before = [&](std::uint32_t rail, std::uint32_t l) { return rails[rail].last < l; };
  const auto at = std::lower_bound(list.begin(), list.end(), layer, ends_before);
  return at != list.end() && rails[*at].first <= layer;
}

std::uint32_t ObstacleLayout::above(const Station& station, std::uint32_t joint) const {
  const auto named = station.name_above.find(joint);
  return named != station.name_above.end() ? named->second : alive(joint, station.above) ? joint : kNobody;
}

std::uint32_t ObstacleLayout::below(const Station& station, std::uint32_t joint) const {
  const auto named = station.name_below.find(joint);
  return named != station.name_below.end() ? named->second : alive(joint, station.below) ? joint : kNobody;
}

ObstacleLayout lay_out(const CspaceObstacle& obstacle) {
  ObstacleLayout layout;
  add_stations(layout, obstacle.angles());
  Joints joints(obstacle);
  add_pieces(layout, obstacle, joints);
  collect_rails(layout, joints.size());
  const std::size_t n = layout.stations.size();
  for (std::uint32_t k = 0; k < layout.pieces.size(); ++k) {
    layout.stations[layout.pieces[k].last].ending.push_back(k);
    layout.stations[(layout.pieces[k].first + n - 1) % n].beginning.push_back(k);
  }
  name_joints_at_alignments(layout, obstacle);
  return layout;
}

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
