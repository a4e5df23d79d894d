#include "planar/edit/edit_arrangement.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dymsum::planar {

EditArrangement::EditArrangement(const PlacedPair& placed, const FollowedConvolution& convolution,
                                 const CountedCover& cover)
    : convolution_(&convolution), cover_(cover), chain_(*this) {
  soup_.emplace(*placed.lattice, *placed.p, *placed.q);
  const Grid& grid = cover.grid();
  cells_.resize(static_cast<std::size_t>(grid.rows) * static_cast<std::size_t>(grid.columns));
  list_all();
  convolution.for_each([&](const WalkSegment& s) {
    if (has_live_cell(soup_->box(s))) add(s);
  });
  find_meetings();
}

// Names of segments.

std::optional<WalkSegment> EditArrangement::follower(const WalkSegment& s) const {
  const std::uint32_t after = soup_->operands[s.side]->next[s.edge];
  if (convolution_->find(s.side, after, s.vertex) != kNoRank) return WalkSegment{s.side, after, s.vertex};
  if (convolution_->find(1 - s.side, s.vertex, after) != kNoRank) return WalkSegment{1 - s.side, s.vertex, after};
  return std::nullopt;
}

std::optional<WalkSegment> EditArrangement::predecessor(const WalkSegment& s) const {
  const std::uint32_t before = soup_->operands[s.side]->prev[s.edge];
  if (convolution_->find(s.side, before, s.vertex) != kNoRank) return WalkSegment{s.side, before, s.vertex};
  const std::uint32_t edge = soup_->operands[1 - s.side]->prev[s.vertex];
  if (convolution_->find(1 - s.side, edge, s.edge) != kNoRank) return WalkSegment{1 - s.side, edge, s.edge};
  return std::nullopt;
}

std::vector<Incidence> EditArrangement::incident(WalkPair v) const {
  const Operand &p = *soup_->operands[0], &q = *soup_->operands[1];
  std::vector<Incidence> out;
  const auto look = [&](const WalkSegment& s, bool starts) {
    if (const std::uint32_t slot = find_live(s); slot != kNone) out.push_back({slot, starts});
  };
  look({0, v.p, v.q}, true);
  look({1, v.q, v.p}, true);
  look({0, p.prev[v.p], v.q}, false);
  look({1, q.prev[v.q], v.p}, false);
  return out;
}

void EditArrangement::LiveChain::incident(WalkPair v, Array<Incidence>& out) const {
  for (const Incidence& at : all_.incident(v)) out.push_back(at);
}

// Cells.

template <class F>
void EditArrangement::for_each_cell(const SoupBox& b, F&& f) const {
  const Grid& grid = cover_.grid();
  const Point shift = cover_.shift();
  const auto run = [&](int row, int first, int last) {
    for (int c = first; c <= last; ++c)
      f(row, c, static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(c));
  };
  for_each_cell_run(grid, b.ax + shift.x, b.ay + shift.y, b.bx + shift.x, b.by + shift.y, run);
}

bool EditArrangement::has_live_cell(const SoupBox& b) const {
  const Grid& grid = cover_.grid();
  const Point shift = cover_.shift();
  const double reach = kReach * grid.cell;
  if (!cover_.any_live(
          grid.row(std::min(b.ay, b.by) + shift.y - reach), grid.column(std::min(b.ax, b.bx) + shift.x - reach),
          grid.row(std::max(b.ay, b.by) + shift.y + reach), grid.column(std::max(b.ax, b.bx) + shift.x + reach)))
    return false;
  bool live = false;
  for_each_cell(b, [&](int row, int column, std::size_t) { live |= !cover_.covered(row, column); });
  return live;
}

// The segments of an edge, and those of a vertex, form lists.

void EditArrangement::list(std::uint32_t s) {
  const WalkSegment w = name(s);
  const std::array heads{&first_of_edge(w.side, w.edge), &first_of_vertex(w.side, w.vertex)};
  for (std::size_t k = 0; k < 2; ++k) {
    const std::uint32_t next = std::exchange(*heads[k], s);
    slots_[s].next_of[k] = next;
    slots_[s].prev_of[k] = kNone;
    if (next != kNone) slots_[next].prev_of[k] = s;
  }
}

void EditArrangement::unlist(std::uint32_t s) {
  const WalkSegment w = name(s);
  const std::array heads{&first_of_edge(w.side, w.edge), &first_of_vertex(w.side, w.vertex)};
  const Slot& slot = slots_[s];
  for (std::size_t k = 0; k < 2; ++k) {
    const std::uint32_t next = slot.next_of[k], prev = slot.prev_of[k];
    if (prev == kNone) *heads[k] = next;
    else slots_[prev].next_of[k] = next;
    if (next != kNone) slots_[next].prev_of[k] = prev;
  }
}

void EditArrangement::list_all() {
  for (std::uint32_t side = 0; side < 2; ++side) {
    first_of_[side].assign(soup_->operands[side]->size(), kNone);
    first_of_[2 + side].assign(soup_->operands[1 - side]->size(), kNone);
  }
  for (std::uint32_t s = 0; s < slots_.size(); ++s)
    if (slots_[s].alive) list(s);
}

// Segments.

std::uint32_t EditArrangement::add(const WalkSegment& w) {
  std::uint32_t s = static_cast<std::uint32_t>(slots_.size());
  const SoupBox box = soup_->box(w);
  if (free_slots_.empty()) {
    slots_.emplace_back();
    stamps_.push_back(0);
    soup_->add(w, box);
    chain_.links().push_back(kNone);
  } else {
    s = free_slots_.back();
    free_slots_.pop_back();
    soup_->segments[s] = {(w.side << 31) | w.edge, w.vertex};
    soup_->boxes[s] = box;
    slots_[s] = Slot{};
    chain_.links()[s] = kNone;
  }
  Slot& slot = slots_[s];
  slot.alive = true;
  slot.marks.assign(1, kFresh);
  slot.fresh = true;
  fresh_.push_back(s);
  live_.emplace(key(w), s);
  list(s);
  ++work_.added;
  if (const auto to = follower(w))
    if (const std::uint32_t n = find_live(*to); n != kNone) set_next(s, n);
  if (const auto from = predecessor(w))
    if (const std::uint32_t p = find_live(*from); p != kNone) set_next(p, s);
  ++stamp_;
  for_each_cell(box, [&](int row, int column, std::size_t cell) {
    if (cover_.covered(row, column)) return;
    for (const std::uint32_t t : cells_[cell])
      if (stamps_[t] != stamp_) {
        stamps_[t] = stamp_;
        candidates_.push_back({s, t});
      }
    cells_[cell].push_back(s);
    slots_[s].cells.push_back(static_cast<std::uint32_t>(cell));
  });
  if (!pairs_.empty()) {
    slots_[s].start_node = pairs_.count(key(soup_->start(s))) != 0;
    slots_[s].end_node = pairs_.count(key(soup_->end(s))) != 0;
    if (slots_[s].start_node) unsettled_.push_back({s, EventName::kStart});
    if (slots_[s].end_node) unsettled_.push_back({s, EventName::kEnd});
  }
  return s;
}

void EditArrangement::set_next(std::uint32_t s, std::uint32_t next) {
  std::uint32_t& to = chain_.links()[s];
  if (to == next) return;
  if (to != kNone && slots_[to].prev == s) slots_[to].prev = kNone;
  to = next;
  if (next != kNone) {
    if (const std::uint32_t p = slots_[next].prev; p != kNone && p != s && chain_.links()[p] == next)
      chain_.links()[p] = kNone;
    slots_[next].prev = s;
  }
  freshen(s, event_count(s));
}

// The sub-edge is not what it was.
void EditArrangement::freshen(std::uint32_t s, std::uint32_t k) {
  Slot& slot = slots_[s];
  if (slot.marks[k] >= kFirstCycle) broken_.push_back(slot.marks[k]);
  slot.marks[k] = kFresh;
  if (slot.fresh) return;
  slot.fresh = true;
  fresh_.push_back(s);
}

std::vector<std::uint32_t> EditArrangement::take_fresh() {
  std::vector<std::uint32_t> list;
  for (const std::uint32_t s : fresh_) {
    if (!slots_[s].alive || !slots_[s].fresh) continue;
    slots_[s].fresh = false;
    list.push_back(s);
  }
  fresh_.clear();
  return list;
}

void EditArrangement::remove(std::uint32_t s) {
  Slot& slot = slots_[s];
  for (const std::uint32_t mark : slot.marks)
    if (mark >= kFirstCycle) broken_.push_back(mark);
  const std::vector<Event> events = std::move(slot.events);
  for (const Event& e : events) {
    if (e.id & kTouchBit) {
      const std::uint32_t t = e.id & ~kTouchBit;
      if (const auto it = pairs_.find(key(touches_[t].pair)); it != pairs_.end()) std::erase(it->second.touches, t);
      free_touches_.push_back(t);
    } else {
      erase_event(other(s, e.id), e.id);
      free_crossings_.push_back(e.id);
    }
  }
  for (const std::uint32_t cell : slot.cells) {
    std::vector<std::uint32_t>& list = cells_[cell];
    *std::find(list.begin(), list.end(), s) = list.back();
    list.pop_back();
  }
  if (slot.prev != kNone) {
    if (chain_.links()[slot.prev] == s) chain_.links()[slot.prev] = kNone;
    relink_.push_back(slot.prev);
  }
  if (const std::uint32_t n = chain_.links()[s]; n != kNone) {
    if (slots_[n].prev == s) slots_[n].prev = kNone;
    relink_.push_back(n);
  }
  live_.erase(key(name(s)));
  unlist(s);
  const WalkPair start = soup_->start(s), end = soup_->end(s);
  slot = Slot{};
  soup_->segments[s].vertex = kNone;
  free_slots_.push_back(s);
  ++work_.removed;
  for (const WalkPair v : {start, end})
    if (pairs_.count(key(v)) != 0 && incident(v).empty()) drop_pair(v);
}

// Segments whose neighbours in their chains are gone may have others.
void EditArrangement::relink() {
  for (const std::uint32_t s : std::exchange(relink_, {})) {
    if (!slots_[s].alive) continue;
    const WalkSegment w = name(s);
    if (chain_.links()[s] == kNone) {
      freshen(s, event_count(s));
      if (const auto to = follower(w))
        if (const std::uint32_t n = find_live(*to); n != kNone) set_next(s, n);
    }
    if (slots_[s].prev == kNone)
      if (const auto from = predecessor(w))
        if (const std::uint32_t p = find_live(*from); p != kNone) set_next(p, s);
  }
}

bool EditArrangement::stays(std::uint32_t s, const std::array<WalkChanges, 2>& changes,
                            const FollowedConvolution& after) const {
  const WalkSegment w = name(s);
  const std::uint32_t edge = changes[w.side].edge_after(w.edge), vertex = changes[1 - w.side].after(w.vertex);
  if (edge == kNone || vertex == kNone) return false;
  return changes[1 - w.side].corner_stays(vertex) || after.find(w.side, edge, vertex) != kNoRank;
}

// The segments that do not stay.
std::vector<std::uint32_t> EditArrangement::gone(const std::array<WalkChanges, 2>& changes,
                                                 const FollowedConvolution& after) {
  std::vector<std::uint32_t> list;
  if (!changes[0].only_moves() || !changes[1].only_moves()) {
    for (std::uint32_t s = 0; s < slots_.size(); ++s)
      if (slots_[s].alive && !stays(s, changes, after)) list.push_back(s);
    return list;
  }
  ++stamp_;
  const auto look = [&](std::uint32_t s, std::size_t k) {
    for (; s != kNone; s = slots_[s].next_of[k])
      if (std::exchange(stamps_[s], stamp_) != stamp_ && !stays(s, changes, after)) list.push_back(s);
  };
  for (std::uint32_t op = 0; op < 2; ++op) {
    for (const std::uint32_t e : changes[op].new_edges()) look(first_of_edge(op, e), 0);
    for (const std::uint32_t v : changes[op].new_corners()) look(first_of_vertex(1 - op, v), 1);
  }
  return list;
}

void EditArrangement::remove_changed(const std::array<WalkChanges, 2>& changes, const FollowedConvolution& after) {
  work_ = {};
  links_.clear();
  const std::vector<std::uint32_t> list = gone(changes, after);
  for (const std::uint32_t s : list) unsettle_nodes_of(s);
  for (const std::uint32_t s : list) remove(s);
}

void EditArrangement::rename(const PlacedPair& placed, const FollowedConvolution& after,
                             const std::array<WalkChanges, 2>& changes, bool elsewhere) {
  Soup next(*placed.lattice, *placed.p, *placed.q);
  next.segments = std::move(soup_->segments);
  next.boxes = std::move(soup_->boxes);
  soup_.emplace(std::move(next));
  convolution_ = &after;
  if (changes[0].renumbered() || changes[1].renumbered()) rename_indices(changes);
  if (elsewhere) round_again();
}

void EditArrangement::rename_indices(const std::array<WalkChanges, 2>& changes) {
  live_.clear();
  for (std::uint32_t s = 0; s < slots_.size(); ++s) {
    if (!slots_[s].alive) continue;
    const WalkSegment w = name(s);
    const WalkSegment to{w.side, changes[w.side].edge_after(w.edge), changes[1 - w.side].after(w.vertex)};
    soup_->segments[s] = {(to.side << 31) | to.edge, to.vertex};
    live_.emplace(key(to), s);
  }
  const auto renamed = [&](WalkPair v) { return WalkPair{changes[0].after(v.p), changes[1].after(v.q)}; };
  std::unordered_map<std::uint64_t, PairMeetings> pairs;
  for (auto& [k, meetings] : pairs_) {
    meetings.pair = renamed(meetings.pair);
    for (const std::uint32_t t : meetings.touches) touches_[t].pair = meetings.pair;
    for (std::uint64_t& other : meetings.same)
      other = key(renamed({static_cast<std::uint32_t>(other >> 32), static_cast<std::uint32_t>(other)}));
    pairs.emplace(key(meetings.pair), std::move(meetings));
  }
  pairs_ = std::move(pairs);
  list_all();
}

// The numbers of a sum from scratch. The order of events stays, also of those at one position, which names of sub-edges
// depend on: it is a fact.
void EditArrangement::round_again() {
  std::vector<std::uint32_t> ids;
  for (std::uint32_t s = 0; s < slots_.size(); ++s) {
    if (!slots_[s].alive) continue;
    soup_->boxes[s] = soup_->box(name(s));
    for (const Event& e : slots_[s].events)
      if (!(e.id & kTouchBit) && crossings_[e.id].a == s) ids.push_back(e.id);
  }
  std::vector<std::array<std::uint32_t, 2>> list;
  for (const std::uint32_t id : ids) list.push_back({crossings_[id].a, crossings_[id].b});
  for (const auto& [k, meetings] : pairs_)
    for (const std::uint32_t t : meetings.touches)
      for (const Incidence& at : incident(meetings.pair)) list.push_back({touches_[t].segment, at.segment});
  Meetings found;
  CrossingFinder(*soup_, found, &chain_).pairs(list);
  work_.exact_signs += found.exact_signs;
  if (found.crossings.size() < ids.size()) throw std::logic_error("EditArrangement: a crossing is gone");
  for (std::size_t k = 0; k < ids.size(); ++k) {
    Crossing& c = crossings_[ids[k]];
    const Crossing& again = found.crossings[k];
    if (again.a != c.a || again.b != c.b) throw std::logic_error("EditArrangement: another crossing");
    c = again;
  }
  for (const Touch& again : found.touches) {
    const auto at = pairs_.find(key(again.pair));
    if (at == pairs_.end()) continue;
    for (const std::uint32_t t : at->second.touches)
      if (touches_[t].segment == again.segment) touches_[t] = again;
  }
  for (std::uint32_t s = 0; s < slots_.size(); ++s)
    for (Event& e : slots_[s].events) {
      if (e.id & kTouchBit) e.t = touches_[e.id & ~kTouchBit].t;
      else e.t = crossings_[e.id].a == s ? crossings_[e.id].ta : crossings_[e.id].tb;
    }
}

void EditArrangement::add_missing(const WalkSegment& w) {
  if (find_live(w) == kNone && has_live_cell(soup_->box(w))) add(w);
}

// Segments of vertices that meet other edges than before, and of edges that are new.
void EditArrangement::add_changed(const std::array<WalkChanges, 2>& changes, std::span<const GridCell> uncovered) {
  for (std::uint32_t side = 0; side < 2; ++side) {
    for (const std::uint32_t v : changes[1 - side].new_corners())
      convolution_->for_each_edge_at(side, v, [&](std::uint32_t e) { add_missing({side, e, v}); });
    convolution_->for_each_at_edges(side, changes[side].new_edges(),
                                    [&](std::uint32_t e, std::uint32_t v) { add_missing({side, e, v}); });
  }
  open_cells(uncovered);
  relink();
  find_meetings();
}

// Segments in cells that are covered no longer: those that lay in covered cells, and the others' pairs there.
void EditArrangement::open_cells(std::span<const GridCell> list) {
  if (list.empty()) return;
  const Grid& grid = cover_.grid();
  std::vector<std::uint8_t> open(cells_.size(), 0);
  int row0 = grid.rows, row1 = 0, column0 = grid.columns, column1 = 0;
  for (const GridCell& c : list) {
    open[static_cast<std::size_t>(c.row) * static_cast<std::size_t>(grid.columns) +
         static_cast<std::size_t>(c.column)] = 1;
    row0 = std::min(row0, c.row), row1 = std::max(row1, c.row);
    column0 = std::min(column0, c.column), column1 = std::max(column1, c.column);
  }
  const double reach = 2 * kReach * grid.cell;
  const Point shift = cover_.shift();
  const double x0 = column0 * grid.cell - reach - shift.x, x1 = (column1 + 1) * grid.cell + reach - shift.x;
  const double y0 = row0 * grid.cell - reach - shift.y, y1 = (row1 + 1) * grid.cell + reach - shift.y;
  convolution_->for_each([&](const WalkSegment& w) {
    const SoupBox b = soup_->box(w);
    // Clamped cells at the rim of the grid hold what lies beyond it, but nothing does.
    if (std::max(b.ax, b.bx) < x0 || std::min(b.ax, b.bx) > x1 || std::max(b.ay, b.by) < y0 ||
        std::min(b.ay, b.by) > y1)
      return;
    bool opened = false;
    for_each_cell(b, [&](int, int, std::size_t cell) { opened |= open[cell] != 0; });
    if (!opened) return;
    const std::uint32_t s = find_live(w);
    if (s == kNone) {
      add(w);
      return;
    }
    for_each_cell(b, [&](int, int, std::size_t cell) {
      if (!open[cell]) return;
      std::vector<std::uint32_t>& segments = cells_[cell];
      if (std::find(segments.begin(), segments.end(), s) != segments.end()) return;
      for (const std::uint32_t t : segments)
        if (!has_crossing(s, t)) candidates_.push_back({s, t});
      segments.push_back(s);
      slots_[s].cells.push_back(static_cast<std::uint32_t>(cell));
    });
  });
}

// Events.

void EditArrangement::find_meetings() {
  Meetings found;
  CrossingFinder(*soup_, found, &chain_).pairs(candidates_);
  work_.pairs += candidates_.size();
  work_.exact_signs += found.exact_signs;
  candidates_.clear();
  for (const Crossing& c : found.crossings)
    if (!has_crossing(c.a, c.b)) add_crossing(c);
  for (const auto& [a, b] : found.same) add_same(a, b);
  for (const Touch& t : found.touches) add_touch(t);
  settle_nodes();
}

bool EditArrangement::has_crossing(std::uint32_t a, std::uint32_t b) const {
  if (event_count(a) > event_count(b)) std::swap(a, b);
  return std::any_of(slots_[a].events.begin(), slots_[a].events.end(),
                     [&](const Event& e) { return !(e.id & kTouchBit) && other(a, e.id) == b; });
}

int EditArrangement::compare(std::uint32_t s, const Event& a, const Event& b) const {
  const double gap = a.t - b.t, bound = error(s, a.id) + error(s, b.id);
  if (gap > bound) return 1;
  if (gap < -bound) return -1;
  return compare_cuts(*soup_, s, sub_end(s, a.id), sub_end(s, b.id));
}

// Events at one position are in the order of their rounded parameters, as those of a sum from scratch.
std::uint32_t EditArrangement::insert_event(std::uint32_t s, Event e) {
  Slot& slot = slots_[s];
  std::vector<Event>& events = slot.events;
  auto at = std::upper_bound(events.begin(), events.end(), e, [](const Event& a, const Event& b) { return a.t < b.t; });
  std::uint32_t k = static_cast<std::uint32_t>(at - events.begin());
  const auto before = [&](const Event& a, const Event& b) {
    const int order = compare(s, a, b);
    return order != 0 ? order < 0 : a.t < b.t;
  };
  while (k > 0 && before(e, events[k - 1])) --k;
  while (k < events.size() && before(events[k], e)) ++k;
  freshen(s, k);
  events.insert(events.begin() + k, e);
  slot.marks.insert(slot.marks.begin() + k, kFresh);
  slot.suspect |= (e.id & kTouchBit) != 0 || (k > 0 && close(s, k - 1)) || (k + 1 < events.size() && close(s, k));
  ++work_.events;
  return k;
}

// Whether doubles do not distinguish events k and k + 1.
bool EditArrangement::close(std::uint32_t s, std::uint32_t k) const {
  const Event &a = slots_[s].events[k], &b = slots_[s].events[k + 1];
  return !(b.t - a.t > error(s, a.id) + error(s, b.id));
}

std::uint32_t EditArrangement::index_of(std::uint32_t s, std::uint32_t id) const {
  const std::vector<Event>& events = slots_[s].events;
  for (std::uint32_t k = 0; k < events.size(); ++k)
    if (events[k].id == id) return k;
  return kNone;
}

void EditArrangement::erase_event(std::uint32_t s, std::uint32_t id) {
  const std::uint32_t k = index_of(s, id);
  if (k == kNone) return;
  Slot& slot = slots_[s];
  freshen(s, k);
  freshen(s, k + 1);
  slot.events.erase(slot.events.begin() + k);
  slot.marks.erase(slot.marks.begin() + k + 1);
  ++work_.events;
}

void EditArrangement::add_crossing(const Crossing& c) {
  std::uint32_t id = static_cast<std::uint32_t>(crossings_.size());
  if (free_crossings_.empty()) {
    crossings_.push_back(c);
  } else {
    id = free_crossings_.back();
    free_crossings_.pop_back();
    crossings_[id] = c;
  }
  const std::uint32_t j = insert_event(c.a, {c.ta, id}), k = insert_event(c.b, {c.tb, id});
  static_cast<void>(j);
  static_cast<void>(k);
  if (slots_[c.a].suspect) unsettled_.push_back({c.a, id});
  if (slots_[c.b].suspect) unsettled_.push_back({c.b, id});
}

EditArrangement::PairMeetings& EditArrangement::meetings_at(WalkPair v) {
  const auto [it, fresh] = pairs_.try_emplace(key(v));
  if (fresh) {
    it->second.pair = v;
    for (const Incidence& at : incident(v)) {
      (at.starts ? slots_[at.segment].start_node : slots_[at.segment].end_node) = true;
      unsettled_.push_back({at.segment, at.starts ? EventName::kStart : EventName::kEnd});
    }
  }
  return it->second;
}

void EditArrangement::add_touch(const Touch& t) {
  PairMeetings& at = meetings_at(t.pair);
  if (std::any_of(at.touches.begin(), at.touches.end(),
                  [&](std::uint32_t k) { return touches_[k].segment == t.segment; }))
    return;
  std::uint32_t index = static_cast<std::uint32_t>(touches_.size());
  if (free_touches_.empty()) {
    touches_.push_back(t);
  } else {
    index = free_touches_.back();
    free_touches_.pop_back();
    touches_[index] = t;
  }
  at.touches.push_back(index);
  insert_event(t.segment, {t.t, index | kTouchBit});
  unsettled_.push_back({t.segment, index | kTouchBit});
}

void EditArrangement::add_same(WalkPair a, WalkPair b) {
  std::vector<std::uint64_t>& of_a = meetings_at(a).same;
  if (std::find(of_a.begin(), of_a.end(), key(b)) != of_a.end()) return;
  of_a.push_back(key(b));
  meetings_at(b).same.push_back(key(a));
  for (const WalkPair v : {a, b})
    for (const Incidence& at : incident(v))
      unsettled_.push_back({at.segment, at.starts ? EventName::kStart : EventName::kEnd});
}

// No segment has its end there any more.
void EditArrangement::drop_pair(WalkPair v) {
  const auto it = pairs_.find(key(v));
  const PairMeetings gone = std::move(it->second);
  pairs_.erase(it);
  for (const std::uint32_t t : gone.touches) {
    erase_event(touches_[t].segment, t | kTouchBit);
    free_touches_.push_back(t);
  }
  for (const std::uint64_t other : gone.same)
    if (const auto at = pairs_.find(other); at != pairs_.end()) std::erase(at->second.same, key(v));
}

LiveSubEdge EditArrangement::sub_from(EventName start) const {
  if (start.segment >= slots_.size() || !slots_[start.segment].alive) return {};
  if (start.id == EventName::kStart) return {start.segment, 0};
  const std::uint32_t k = index_of(start.segment, start.id);
  return k == kNone ? LiveSubEdge{} : LiveSubEdge{start.segment, k + 1};
}

SegmentPosition EditArrangement::sample(LiveSubEdge at) const {
  const End from = start_of(at), to = end_of(at);
  return sample_between(*soup_, at.segment, {cut_of(*soup_, from.end), from.t, from.error},
                        {cut_of(*soup_, to.end), to.t, to.error});
}

}  // namespace dymsum::planar
