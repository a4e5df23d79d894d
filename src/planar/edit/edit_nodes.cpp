// Nodes of an edited arrangement: positions where crossings coincide or segments end on others, found when a walk or a
// change comes to one, and how the boundary goes on there (lemma 4 of docs/design/planar-sum.md).
#include <algorithm>

#include "planar/edit/edit_arrangement.h"

namespace dymsum::planar {

// The crossings and pairs of vertices of one position, and where segments pass it.
struct EditArrangement::NodeSearch {
  std::vector<std::uint32_t> crossings;
  std::vector<WalkPair> pairs;
  std::vector<Spot> spots;

  void add(std::uint32_t crossing) {
    if (std::find(crossings.begin(), crossings.end(), crossing) == crossings.end()) crossings.push_back(crossing);
  }
  void add(WalkPair v) {
    if (std::find(pairs.begin(), pairs.end(), v) == pairs.end()) pairs.push_back(v);
  }
  bool degenerate() const { return crossings.size() + pairs.size() > 1 || (!pairs.empty() && !spots.empty()); }
};

// The events [begin, end) of s at the position of its k-th one.
EditArrangement::Spot EditArrangement::equal_run(std::uint32_t s, std::uint32_t k) const {
  const std::vector<Event>& events = slots_[s].events;
  Spot run{s, k, k + 1};
  if (!slots_[s].suspect) return run;
  while (run.begin > 0 && compare(s, events[run.begin - 1], events[k]) == 0) --run.begin;
  while (run.end < events.size() && compare(s, events[run.end], events[k]) == 0) ++run.end;
  return run;
}

bool EditArrangement::degenerate(std::uint32_t s, std::uint32_t k) const {
  const std::uint32_t id = slots_[s].events[k].id;
  if (id & kTouchBit) return true;
  const auto alone = [&](std::uint32_t t, std::uint32_t at) {
    const Spot run = equal_run(t, at);
    return run.end - run.begin == 1;
  };
  if (slots_[s].suspect && !alone(s, k)) return true;
  const std::uint32_t t = other(s, id);
  return slots_[t].suspect && !alone(t, index_of(t, id));
}

void EditArrangement::search(NodeSearch& found) const {
  const auto pass = [&](std::uint32_t s, std::uint32_t id) {
    const Spot run = equal_run(s, index_of(s, id));
    for (const Spot& known : found.spots)
      if (known.segment == s && known.begin == run.begin) return;
    found.spots.push_back(run);
    for (std::uint32_t k = run.begin; k < run.end; ++k) {
      const std::uint32_t e = slots_[s].events[k].id;
      if (e & kTouchBit) found.add(touches_[e & ~kTouchBit].pair);
      else found.add(e);
    }
  };
  for (std::size_t i = 0, j = 0; i < found.crossings.size() || j < found.pairs.size();) {
    if (i < found.crossings.size()) {
      const std::uint32_t id = found.crossings[i++];
      const Crossing c = crossings_[id];
      pass(c.a, id);
      pass(c.b, id);
      continue;
    }
    const auto it = pairs_.find(key(found.pairs[j++]));
    if (it == pairs_.end()) continue;
    for (const std::uint32_t t : it->second.touches) pass(touches_[t].segment, t | kTouchBit);
    for (const std::uint64_t other : it->second.same)
      found.add(WalkPair{static_cast<std::uint32_t>(other >> 32), static_cast<std::uint32_t>(other)});
  }
}

std::optional<EditNode> EditArrangement::node_of(NodeSearch& found) const {
  search(found);
  if (!found.degenerate()) return std::nullopt;
  EditNode node;
  for (const Spot& run : found.spots) {
    node.rays.push_back({{run.segment, run.begin}, false});
    node.rays.push_back({{run.segment, run.end}, true});
    for (std::uint32_t k = run.begin; k < run.end; ++k)
      node.names.push_back({run.segment, slots_[run.segment].events[k].id});
  }
  for (const WalkPair v : found.pairs)
    for (const Incidence& at : incident(v)) {
      node.rays.push_back({{at.segment, at.starts ? 0 : event_count(at.segment)}, at.starts});
      node.names.push_back({at.segment, at.starts ? EventName::kStart : EventName::kEnd});
    }
  if (node.names.empty()) return std::nullopt;
  node.key = node.names[0].key();
  for (const EventName& name : node.names) node.key = std::min(node.key, name.key());
  return node;
}

std::optional<EditNode> EditArrangement::node_at(EventName name) const {
  if (name.segment >= slots_.size() || !slots_[name.segment].alive) return std::nullopt;
  NodeSearch found;
  if (name.id == EventName::kStart || name.id == EventName::kEnd) {
    found.add(name.id == EventName::kStart ? soup_->start(name.segment) : soup_->end(name.segment));
  } else {
    if (index_of(name.segment, name.id) == kNone) return std::nullopt;
    if (name.id & kTouchBit) found.add(touches_[name.id & ~kTouchBit].pair);
    else found.add(name.id);
  }
  return node_of(found);
}

std::optional<EditNode> EditArrangement::end_node(LiveSubEdge at) const {
  const Slot& slot = slots_[at.segment];
  if (ends_segment(at)) {
    if (!slot.end_node) return std::nullopt;
    return node_at({at.segment, EventName::kEnd});
  }
  if (!degenerate(at.segment, at.k)) return std::nullopt;
  return node_at({at.segment, slot.events[at.k].id});
}

SegmentPosition EditArrangement::position_of(EventName name) const {
  if (name.id == EventName::kStart) return position(segment_end(name.segment, 0), name.segment);
  if (name.id == EventName::kEnd) return position(segment_end(name.segment, 1), name.segment);
  return position(event_end(name.segment, index_of(name.segment, name.id)), name.segment);
}

// Nodes that an edit changes.

void EditArrangement::unsettle(const EditNode& node) {
  old_nodes_.push_back(node.key);
  for (const EditNode::Ray& ray : node.rays) freshen(ray.sub.segment, ray.sub.k);
  unsettled_.insert(unsettled_.end(), node.names.begin(), node.names.end());
}

void EditArrangement::unsettle_nodes_of(std::uint32_t s) {
  const Slot& slot = slots_[s];
  if (slot.start_node)
    if (const auto node = node_at({s, EventName::kStart})) unsettle(*node);
  if (slot.end_node)
    if (const auto node = node_at({s, EventName::kEnd})) unsettle(*node);
  if (!slot.suspect && std::none_of(slot.events.begin(), slot.events.end(), [&](const Event& e) {
        return (e.id & kTouchBit) != 0 || slots_[other(s, e.id)].suspect;
      }))
    return;
  for (std::uint32_t k = 0; k < slot.events.size(); ++k)
    if (degenerate(s, k))
      if (const auto node = node_at({s, slot.events[k].id})) unsettle(*node);
}

void EditArrangement::settle_nodes() {
  links_.clear();
  std::vector<std::uint64_t> done;
  for (const EventName& name : std::exchange(unsettled_, {})) {
    std::optional<EditNode> node = node_at(name);
    if (!node || std::find(done.begin(), done.end(), node->key) != done.end()) continue;
    done.push_back(node->key);
    // What was there before had one of these keys.
    for (const EventName& known : node->names) old_nodes_.push_back(known.key());
    for (const EditNode::Ray& ray : node->rays) freshen(ray.sub.segment, ray.sub.k);
    new_nodes_.push_back(*std::move(node));
  }
}

// Links. A sector between two neighbouring directions is free unless something leaves along the first or arrives along
// the second; the boundary comes in along the first and goes out along the second.
LiveNodeLinks EditArrangement::links_of(const EditNode& node) const {
  std::vector<EditNode::Ray> rays = node.rays;
  const auto upper = [&](const EditNode::Ray& r) {
    const SoupBox& b = soup_->boxes[r.sub.segment];
    return (half_plane(b.dx, b.dy) == 0) == r.out;
  };
  const auto compare = [&](const EditNode::Ray& a, const EditNode::Ray& b) {
    if (upper(a) != upper(b)) return upper(a) ? -1 : 1;
    const int c = soup_->cross(a.sub.segment, b.sub.segment);
    return a.out == b.out ? -c : c;
  };
  const auto id = [&](const EditNode::Ray& r) {
    const WalkSegment w = name(r.sub.segment);
    return convolution_->order(w.side, w.edge, w.vertex);
  };
  std::sort(rays.begin(), rays.end(), [&](const EditNode::Ray& a, const EditNode::Ray& b) {
    if (const int c = compare(a, b); c != 0) return c < 0;
    if (a.sub.segment != b.sub.segment) return id(a) < id(b);
    return a.sub.k < b.sub.k;
  });
  struct Group {
    std::size_t begin, end;
    bool left, right;
  };
  std::vector<Group> groups;
  for (std::size_t i = 0; i < rays.size();) {
    Group g{i, i, false, false};
    for (; g.end < rays.size() && compare(rays[i], rays[g.end]) == 0; ++g.end)
      (rays[g.end].out ? g.left : g.right) = true;
    groups.push_back(g);
    i = g.end;
  }
  LiveNodeLinks out;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Group &from = groups[g], &to = groups[g + 1 == groups.size() ? 0 : g + 1];
    if (from.left && from.right)
      for (std::size_t k = from.begin; k < from.end; ++k)
        if (rays[k].out) {
          if (upper(rays[k])) out.cracks.push_back(rays[k].sub);
          break;
        }
    if (from.left || to.right) continue;
    for (std::size_t k = from.begin; k < from.end; ++k) out.links.emplace_back(rays[k].sub, rays[to.begin].sub);
  }
  return out;
}

// A step of the boundary.
LiveSubEdge EditArrangement::next(LiveSubEdge at) {
  const std::uint32_t s = at.segment;
  const Slot& slot = slots_[s];
  const bool last = ends_segment(at);
  const bool plain = last ? !slot.end_node : !(slot.events[at.k].id & kTouchBit) && !degenerate(s, at.k);
  if (plain && last) {
    const std::uint32_t n = chain_.links()[s];
    return n == kNone ? LiveSubEdge{} : LiveSubEdge{n, 0};
  }
  if (plain) {
    const std::uint32_t id = slot.events[at.k].id, a = crossings_[id].a;
    return a == s ? LiveSubEdge{} : LiveSubEdge{a, index_of(a, id) + 1};
  }
  const std::uint64_t in = std::uint64_t{s} << 32 | at.k;
  if (const auto it = links_.find(in); it != links_.end()) return it->second;
  const std::optional<EditNode> node = end_node(at);
  if (!node) {  // an end that was at a node
    const std::uint32_t n = chain_.links()[s];
    return links_[in] = n == kNone ? LiveSubEdge{} : LiveSubEdge{n, 0};
  }
  for (const EditNode::Ray& ray : node->rays)
    if (!ray.out) links_[std::uint64_t{ray.sub.segment} << 32 | ray.sub.k] = {};
  const LiveNodeLinks links = links_of(*node);
  for (const auto& [from, to] : links.links) links_[std::uint64_t{from.segment} << 32 | from.k] = to;
  return links_[in];
}

}  // namespace dymsum::planar
