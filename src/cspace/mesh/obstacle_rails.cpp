#include "cspace/mesh/obstacle_rails.h"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <utility>

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

}  // namespace dymsum::cspace
