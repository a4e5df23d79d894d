#include "planar/frame/piece_lists.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {

NodeLinks::NodeLinks(const Window& window)
    : window_(window),
      touch_active_(window.touches.size(), 0),
      node_active_(window.nodes.size(), 0),
      entered_(window.rays.size(), 0),
      link_(window.rays.size(), kNone) {}

void NodeLinks::begin(bool first) {
  dirty_.clear();
  if (!first) return;
  for (std::uint32_t k = 0; k < window_.nodes.size(); ++k)
    if (window_.nodes[k].hands_on && !window_.nodes[k].covered) dirty_.push_back(k);
}

void NodeLinks::sort_dirty() {
  std::sort(dirty_.begin(), dirty_.end());
  dirty_.erase(std::unique(dirty_.begin(), dirty_.end()), dirty_.end());
}

// The sector rule of planar-sum.md on the rays that are there now; their order never changes.
NodeLinks::Activity NodeLinks::link_rays(const PersistentNode& n, std::uint32_t node) {
  rays_here_.clear();
  passages_before_.clear();
  bool any = false;
  for (std::uint32_t r = n.first_ray; r < n.last_ray; ++r) {
    passages_before_.push_back({link_[r], entered(r)});
    link_[r] = kNone;
    entered_[r] = 0;
    const PersistentNode::Ray& ray = window_.rays[r];
    if (ray.touch != kNone && !touch_active_[ray.touch]) continue;
    any |= ray.touch != kNone || n.hands_on;
    rays_here_.push_back(r);
  }
  const std::size_t m = any ? rays_here_.size() : 0;
  const auto group = [&](std::size_t k) { return window_.rays[rays_here_[k]].group; };
  for (std::size_t k = 0; k < m;) {
    std::size_t end = k + 1;
    while (end < m && group(end) == group(k)) ++end;
    const std::size_t to = end == m ? 0 : end;
    // Rays of one direction all leave or all arrive; otherwise the window is left to the static routine.
    if (!window_.rays[rays_here_[k]].out && window_.rays[rays_here_[to]].out) {
      entered_[rays_here_[to]] = 1;
      for (std::size_t q = k; q < end; ++q) link_[rays_here_[q]] = rays_here_[to];
    }
    k = end;
  }
  const bool was_active = active(node);
  node_active_[node] = any;
  return {was_active, any};
}

Meet meet(const Window& window, std::uint32_t a, std::uint32_t b, ExactFrame& frame) {
  const Lattice& l = frame.lattice();
  const Segment sa = window.exact(a), sb = window.exact(b);
  const Pair a0 = start_of(sa), a1 = end_of(sa), b0 = start_of(sb), b1 = end_of(sb);
  frame.exact_signs += 4;
  const int s1 = l.side(sa, b0), s2 = l.side(sa, b1);
  if (s1 * s2 > 0) return Meet::none;
  const int s3 = l.side(sb, a0), s4 = l.side(sb, a1);
  if (s3 * s4 > 0) return Meet::none;
  if (s1 != 0 && s2 != 0 && s3 != 0 && s4 != 0) return Meet::crossing;
  const auto on = [&](const Segment& s, Pair v) { return l.along(s, v) >= 0 && l.along(reversed(s), v) >= 0; };
  if ((s1 == 0 && on(sa, b0)) || (s2 == 0 && on(sa, b1)) || (s3 == 0 && on(sb, a0)) || (s4 == 0 && on(sb, a1)))
    return Meet::degenerate;
  return Meet::none;
}

PieceLists::PieceLists(Window& window) : window_(window), links_(window) {
  const std::size_t n = window.pieces.size();
  low_.assign(n, INFINITY);
  high_.assign(n, -INFINITY);
  blocks_.assign((n + kBlock - 1) / kBlock, {INFINITY, -INFINITY});
  list_.assign(window.of.size() + window.touches.size(), 0);
  add_entries();
  touched_.assign(n, 0);
  changed_at_.assign(n, 0);
  new_subs_.assign(n, {});
}

// Entries of a piece lie in the order that they have in the middle of the window: lists are then nearly sorted as they
// come.
void PieceLists::add_entries() {
  crossings_.reserve(window_.candidates.size());
  for (const Candidate& c : window_.candidates) crossings_.push_back({c.a, c.b, 0, 0, c.sign});
  const auto n = static_cast<std::uint32_t>(window_.pieces.size());
  const auto key = [&](const Entry& e) {
    const double t = e.t.at(0.5 * (window_.frame().tau0 + window_.frame().tau1));
    return t == t ? t : 0;  // nearly parallel lines
  };
  hot_.reserve(n);
  entries_.reserve(list_.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    const auto base = entries_.size();
    for (std::uint32_t k = window_.first_of[i]; k < window_.first_of[i + 1]; ++k) {
      const Candidate& c = window_.candidates[window_.of[k]];
      const bool a = c.a == i;
      entries_.push_back({c.out_low, c.in_low, c.in_high, c.out_high, a ? c.ta : c.tb, a ? c.error_a : c.error_b,
                          window_.of[k], false});
    }
    for (std::uint32_t k = window_.first_touch[i]; k < window_.first_touch[i + 1]; ++k) {
      const PersistentTouch& c = window_.touches[k];
      if (window_.nodes[c.node].covered) continue;
      entries_.push_back({c.out_low, c.in_low, c.in_high, c.out_high, c.t, c.error, k | kTouchBit, false});
    }
    std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(base), entries_.end(),
              [&](const Entry& a, const Entry& b) { return key(a) != key(b) ? key(a) < key(b) : a.id < b.id; });
    const Piece& p = window_.pieces[i];
    Hot h;
    h.base = static_cast<std::uint32_t>(base);
    h.entries = static_cast<std::uint32_t>(entries_.size() - base);
    h.next = p.next;
    h.head_ray = window_.head_ray[i];
    h.tail_ray = window_.tail_ray[i];
    h.head_cut = p.head_cut || p.covered;
    h.tail_cut = p.tail_cut || p.covered;
    h.next_turn = p.next_turn;
    h.half = p.half;
    hot_.push_back(h);
  }
}

std::size_t PieceLists::bytes() const {
  return bytes_of(entries_, crossings_, low_, high_, hot_, list_, touched_, changed_at_, changed_, items_, new_subs_);
}

bool PieceLists::repair(double tau, ExactFrame& frame, FrameWork& work) {
  ++frame_;
  looked_at_.clear();
  changed_.clear();
  links_.begin(frame_ == 1);
  bool generic = window_.folds.empty();
  const std::uint32_t n = static_cast<std::uint32_t>(hot_.size());
  for (std::uint32_t b = 0; b < blocks_.size(); ++b) {
    auto& [low, high] = blocks_[b];
    if (tau > low && tau < high) continue;
    low = -INFINITY;
    high = INFINITY;
    for (std::uint32_t i = b * kBlock; i < std::min(n, (b + 1) * kBlock); ++i) {
      if (!(tau > low_[i] && tau < high_[i])) {
        ++work.pieces_repaired;
        generic &= refresh(i, tau, frame, work);
      }
      low = std::max(low, low_[i]);
      high = std::min(high, high_[i]);
    }
  }
  work.lists_changed += changed_.size();
  links_.relink([&](std::uint32_t piece) { mark_changed(piece, {0, count(piece)}); });
  return generic;
}

bool PieceLists::stays_clear(std::uint32_t piece, const std::array<Linear, 2>& ends, double margin,
                             const std::array<std::uint32_t, 2>& but, double low, double high) const {
  const auto& [from, to] = ends;
  for (const Entry& e : entries(piece)) {
    if (e.id == but[0] || e.id == but[1] || e.out_high <= low || e.out_low >= high) continue;
    const double apart = margin + e.error, u = std::max(low, e.out_low), v = std::min(high, e.out_high),
                 t_u = e.t.at(u), t_v = e.t.at(v);
    const bool before = from.at(u) - t_u > apart && from.at(v) - t_v > apart;
    const bool after = t_u - to.at(u) > apart && t_v - to.at(v) > apart;
    if (!before && !after) return false;
  }
  return true;
}

Cut PieceLists::cut_at(std::uint32_t piece, std::uint32_t entry) const {
  Cut x;
  if (entry & kTouchBit) {
    x.pair = window_.exact(window_.nodes[window_.touches[entry & ~kTouchBit].node].at);
    return x;
  }
  const Candidate& c = window_.candidates[entry];
  x.kind = Cut::Kind::crossing;
  x.by = window_.exact(window_.pieces[c.a == piece ? c.b : c.a].segment);
  return x;
}

int PieceLists::compare_exactly(std::uint32_t piece, const Item& a, const Item& b, ExactFrame& frame) const {
  if (a.entry == b.entry) return 0;
  ++frame.exact_signs;
  return frame.lattice().compare(window_.exact(window_.pieces[piece].segment), cut_at(piece, a.entry),
                                 cut_at(piece, b.entry));
}

// Whether an entry lies before the end of a piece that is handed on.
bool PieceLists::before_end(std::uint32_t piece, std::uint32_t entry, ExactFrame& frame, Certainty& proved) const {
  const Piece& p = window_.pieces[piece];
  if (!p.handed_on) return true;
  ++frame.exact_signs;
  const int order = frame.lattice().compare(window_.exact(p.segment), cut_at(piece, entry),
                                            {Cut::Kind::pair, window_.exact(p.tail_at), {}});
  proved.generic &= order != 0;
  return order < 0;
}

bool PieceLists::refresh(std::uint32_t i, double tau, ExactFrame& frame, FrameWork& work) {
  touched_[i] = frame_;
  looked_at_.push_back(i);
  Certainty c;
  const std::uint32_t came_or_went = collect(i, tau, frame, c);
  sort_items(i, frame);
  look_at_neighbours(i, tau, frame, c);
  if (c.exact || !c.generic) {
    c.low = INFINITY;
    c.high = -INFINITY;
  }
  low_[i] = c.low;
  high_[i] = c.high;
  if (c.generic) {
    work.crossings_changed += came_or_went;
    if (const std::optional<NewSubs> subs = store(i)) mark_changed(i, *subs);
  } else {
    for (std::uint32_t k = 0; k < hot_[i].entries; ++k) entries_[hot_[i].base + k].inside = false;
    hot_[i].count = 0;
    mark_changed(i, {0, 0});
  }
  return c.generic;
}

// Whether something is on its piece; the list is proved only as long as that stays so.
inline bool PieceLists::inside(const Entry& e, double tau, Certainty& proved, bool& unsure) {
  if (tau <= e.out_low) {
    proved.high = std::min(proved.high, e.out_low);
    return false;
  }
  if (tau >= e.out_high) {
    proved.low = std::max(proved.low, e.out_high);
    return false;
  }
  unsure = !(tau > e.in_low && tau < e.in_high);
  if (unsure) return false;
  proved.low = std::max(proved.low, e.in_low);
  proved.high = std::min(proved.high, e.in_high);
  return true;
}

bool PieceLists::inside_exactly(std::uint32_t i, std::uint32_t id, ExactFrame& frame, Certainty& proved) const {
  proved.exact = true;
  if (!(id & kTouchBit)) {
    const Meet m =
        meet(window_, window_.pieces[crossings_[id].a].segment, window_.pieces[crossings_[id].b].segment, frame);
    proved.generic &= m != Meet::degenerate;
    return m == Meet::crossing && before_end(crossings_[id].a, id, frame, proved) &&
           before_end(crossings_[id].b, id, frame, proved);
  }
  const Segment s = window_.exact(window_.pieces[i].segment);
  const Pair v = window_.exact(window_.nodes[window_.touches[id & ~kTouchBit].node].at);
  const int from = frame.lattice().along(s, v), to = frame.lattice().along(reversed(s), v);
  frame.exact_signs += 2;
  proved.generic &= from != 0 && to != 0;
  return from > 0 && to > 0 && before_end(i, id, frame, proved);
}

// What crosses or touches on the piece here: into items_, not yet in order. Returns how much came and went; nodes are
// linked anew where a touch did.
std::uint32_t PieceLists::collect(std::uint32_t i, double tau, ExactFrame& frame, Certainty& proved) {
  items_.clear();
  std::uint32_t came_or_went = 0;
  for (Entry *at = entries_.data() + hot_[i].base, *end = at + hot_[i].entries; at != end; ++at) {
    Entry& e = *at;
    bool unsure = false, here = inside(e, tau, proved, unsure);
    if (unsure) here = inside_exactly(i, e.id, frame, proved);
    came_or_went += here != e.inside;
    e.inside = here;
    if (e.id & kTouchBit) links_.set_touch(e.id & ~kTouchBit, here);
    if (here) items_.push_back({e.t.at(tau), e.error, e.t.b, e.id});
  }
  return came_or_went;
}

void PieceLists::sort_items(std::uint32_t i, ExactFrame& frame) {
  const auto before = [&](const Item& a, const Item& b) { return compare(i, a, b, frame) < 0; };
  if (items_.size() > 24)
    return std::sort(items_.begin(), items_.end(), [&](const Item& a, const Item& b) {
      const int order = compare(i, a, b, frame);
      return order != 0 ? order < 0 : a.entry < b.entry;
    });
  for (std::size_t k = 1; k < items_.size(); ++k) {
    const Item e = items_[k];
    std::size_t j = k;
    for (; j > 0 && before(e, items_[j - 1]); --j) items_[j] = items_[j - 1];
    items_[j] = e;
  }
}

// The list is proved while the lines of neighbours stay apart by more than their errors. As doubles at tau they err by
// less than is left of what their errors grant, as do tau and the end: those of shares grant more than twice what they
// count. The margin's own roundings, its quotient's and the slopes' are fractions of the margin, taken off.
void PieceLists::look_at_neighbours(std::uint32_t i, double tau, ExactFrame& frame, Certainty& proved) const {
  for (std::size_t k = 0; k + 1 < items_.size(); ++k) {
    const Item &a = items_[k], &b = items_[k + 1];
    const double margin = (b.t - a.t) - (a.error + b.error);
    if (!(margin > 0)) {
      proved.exact = true;
      proved.generic &= compare(i, a, b, frame) != 0;
      continue;
    }
    // They meet at `end`, ahead or behind; never where they keep apart.
    const double closing = a.slope - b.slope, end = tau + margin / closing * exact::kInwards;
    proved.high = closing > 0 && end < proved.high ? end : proved.high;
    proved.low = closing < 0 && end > proved.low ? end : proved.low;
  }
}

// The items become the piece's list; nothing when they are it already, else the sub-edges that are new.
std::optional<PieceLists::NewSubs> PieceLists::store(std::uint32_t i) {
  std::uint32_t* list = list_.data() + base(i);
  const std::uint32_t n = static_cast<std::uint32_t>(items_.size()), before = hot_[i].count;
  std::uint32_t head = 0, tail = 0;
  while (head < n && head < before && list[head] == items_[head].entry) ++head;
  if (head == n && n == before) return std::nullopt;
  while (head + tail < n && head + tail < before && list[before - 1 - tail] == items_[n - 1 - tail].entry) ++tail;
  for (std::uint32_t k = head; k < n; ++k) {
    list[k] = items_[k].entry;
    if (list[k] & kTouchBit) {
      window_.touches[list[k] & ~kTouchBit].at = k;
      continue;
    }
    Crossing& c = crossings_[list[k]];
    (c.a == i ? c.at_a : c.at_b) = k;
  }
  hot_[i].count = n;
  return NewSubs{head, n - tail};
}

void PieceLists::mark_changed(std::uint32_t piece, NewSubs subs) {
  new_subs_[piece] = changed_at_[piece] == frame_ ? NewSubs{std::min(subs.first, new_subs_[piece].first),
                                                            std::max(subs.last, new_subs_[piece].last)}
                                                  : subs;
  if (changed_at_[piece] == frame_) return;
  changed_.push_back(piece);
  changed_at_[piece] = frame_;
}

// The position of an entry that may have left the list.
std::uint32_t PieceLists::position_in_list(std::uint32_t piece, std::uint32_t entry) const {
  if (entry & kTouchBit) return window_.touches[entry & ~kTouchBit].at;
  const Crossing& c = crossings_[entry];
  return c.a == piece ? c.at_a : c.at_b;
}

PieceLists::Step PieceLists::between(std::uint32_t piece, std::uint32_t from, std::uint32_t to) const {
  std::uint32_t sub = 0;
  if (from != kNone) {
    const std::uint32_t at = position_in_list(piece, from);
    if (at >= count(piece) || entry(piece, at) != from) return {};
    sub = at + 1;
  }
  const std::uint32_t end = sub == count(piece) ? kNone : entry(piece, sub);
  return end == to ? Step{piece, sub} : Step{};
}

PieceLists::Step PieceLists::target(std::uint32_t ray) const {
  const PersistentNode::Ray& r = window_.rays[ray];
  return r.touch == kNone ? Step{r.piece, 0} : Step{r.piece, window_.touches[r.touch].at + 1};
}

std::uint32_t PieceLists::end_node(Step s) const {
  if (s.sub < hot_[s.piece].count) {
    const std::uint32_t e = entry(s.piece, s.sub);
    return e & kTouchBit ? window_.touches[e & ~kTouchBit].node : kNone;
  }
  return links_.node_at(hot_[s.piece].tail_ray);
}

std::uint32_t PieceLists::arriving_ray(Step s) const {
  return s.sub < hot_[s.piece].count ? window_.touches[entry(s.piece, s.sub) & ~kTouchBit].in_ray
                                     : hot_[s.piece].tail_ray;
}

// A sub-edge that starts at a touch or at its piece's own end.
bool PieceLists::alive_at_touch(Step s) const {
  if (s.sub > 0) return links_.entered(window_.touches[entry(s.piece, s.sub - 1) & ~kTouchBit].out_ray);
  const std::uint32_t ray = hot_[s.piece].head_ray;
  return links_.node_at(ray) == kNone || links_.entered(ray);
}

// The step after a sub-edge that ends at a touch or at its piece's own end.
PieceLists::Step PieceLists::successor_at_touch(Step s) const {
  const Hot& h = hot_[s.piece];
  Step to{h.next, 0};
  if (end_node(s) != kNone) {
    const std::uint32_t ray = links_.leaving(arriving_ray(s));
    if (ray == kNone) return {};
    to = target(ray);
  }
  return to.piece == kNone || dead(to) ? Step{} : to;
}

}  // namespace dymsum::planar
