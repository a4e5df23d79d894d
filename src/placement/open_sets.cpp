#include "placement/open_sets.h"

namespace dymsum::placement {
namespace {

/// Whether one set may cover some of the other's boundary.
bool may_meet(const PlacedSet& a, const PlacedSet& b) {
  if (a.set().unbounded() || b.set().unbounded()) return true;
  const auto &p = a.box(), &q = b.box();
  return p[0] <= q[2] && q[0] <= p[2] && p[1] <= q[3] && q[1] <= p[3];
}

}  // namespace

void OpenSets::add(std::uint32_t id, std::shared_ptr<const OpenSet> set, HomogeneousPoint move) {
  Member member;
  member.set = std::make_shared<const PlacedSet>(std::move(set), std::move(move), id);
  for (auto& [other_id, other] : members_) {
    if (!may_meet(*member.set, *other.set)) continue;
    auto [own, others] = covers(*member.set, *other.set);
    if (!own.edges.empty()) member.covers.emplace(other_id, std::move(own));
    if (others.edges.empty()) continue;
    other.covers.emplace(id, std::move(others));
    other.changed = true;
  }
  members_.emplace(id, std::move(member));
}

void OpenSets::remove(std::uint32_t id) {
  members_.erase(id);
  for (auto& [other_id, other] : members_)
    if (other.covers.erase(id) > 0) other.changed = true;
}

std::vector<std::uint32_t> OpenSets::ids() const {
  std::vector<std::uint32_t> ids;
  for (const auto& [id, member] : members_) ids.push_back(id);
  return ids;
}

FreeSet OpenSets::free() {
  std::vector<const FreeBoundary*> boundaries;
  std::vector<std::shared_ptr<const PlacedSet>> sets;
  for (auto& [id, member] : members_) {
    if (member.changed) {
      std::vector<const Cover*> covers;
      for (const auto& [by, cover] : member.covers) covers.push_back(&cover);
      member.boundary = free_boundary(*member.set, covers);
      member.changed = false;
    }
    boundaries.push_back(&member.boundary);
    sets.push_back(member.set);
  }
  return free_set(boundaries, std::move(sets));
}

std::vector<std::uint32_t> OpenSets::holding(const HomogeneousPoint& at) const {
  const PlacedSet position(OpenSet::position(at), {0, 0, 1}, kNone);
  std::vector<std::uint32_t> ids;
  for (const auto& [id, member] : members_) {
    if (!may_meet(position, *member.set)) continue;
    const auto own = covers(position, *member.set)[0];
    if (!own.edges.empty() && own.edges[0].cuts.empty()) ids.push_back(id);
  }
  return ids;
}

}  // namespace dymsum::placement
