#include "planar/frame/rotating_frame.h"

#include <algorithm>
#include <cmath>

namespace dymsum::planar {
namespace {

/// Edges whose cross product is less are looked at exactly: any value is right beyond what it errs by.
constexpr double kNearlyStraight = 64 * kTurnedCross;

float rounded_up(double error) { return static_cast<float>(error) * exact::kFloatOutwards; }

}  // namespace

void RotatingFrame::enter(const RotatingWindow& window) {
  window_ = &window;
  const std::size_t n = window.segments.size(), m = window.forms().size(1);
  placed_.resize(n);
  for (auto& of_side : busy_) of_side.clear();
  for (std::uint32_t i = 0; i < n; ++i) {
    const RotatingSegment& s = window.segments[i];
    if (window.first_of[s.first_piece] == window.first_of[s.last_piece]) continue;
    busy_[s.side].push_back({i, s.start().p, s.start().q, s.edge});
    placed_[i].length1 = window.forms().length1(s);
    placed_[i].error = kTurnedEndSide * window.forms().span() * placed_[i].length1;
  }
  meetings_.clear();
  meetings_.reserve(window.candidates.size());
  for (const RotationCandidate& c : window.candidates)
    meetings_.push_back({window.segment_of(c.a), window.segment_of(c.b)});
  exists_.assign(n, 1);
  turned_.resize(m);
  turned_edge_.resize(m);
  count_.resize(window.pieces.size());
  entries_.resize(window.of.size());
  walked_.resize(window.pieces.size());
  intervals_.clear();
  intervals_.reserve(window.pieces.size());
  for (std::size_t i = 0; i < window.pieces.size(); ++i)
    intervals_.push_back({Two{window.pieces[i].head, window.pieces[i].tail}, entries_.data() + window.first_of[i]});
  continuations_.clear();
  continuations_.reserve(window.pieces.size());
  for (const RotatingPiece& p : window.pieces) {
    Continuation way{{kNone, kNone}, kNone, p.segment};
    const bool dead = p.tail_dead || (p.follower != kNone && window.pieces[p.follower].tail_dead);
    if (!dead && p.follower != kNone) way.leap = window.pieces[p.follower].run_last;
    for (std::size_t k = 0; k < 2 && !dead && p.follower == kNone; ++k) {
      const std::uint32_t next = window.segments[p.segment].next[k];
      if (next == kNone || window.pieces[window.segments[next].first_piece].head_cut) continue;
      way.next[k] = window.segments[next].first_piece;
    }
    continuations_.push_back(way);
  }
}

std::size_t RotatingFrame::bytes() const {
  return bytes_of(turned_, turned_edge_, continuations_, busy_[0], busy_[1], placed_, meetings_, near_, crossings_,
                  entries_, intervals_, count_, next_, path_, exists_, seen_, walked_, steps_, cycles_);
}

bool RotatingFrame::compute(double delta, Heading heading) {
  heading_ = heading;
  delta_ = delta;
  proved_ = true;
  if (!place_segments(delta)) return false;
  find_near();
  return find_crossings() && link_crossings() && find_cycles();
}

bool RotatingFrame::place_segments(double delta) {
  const TurningForms& forms = window_->forms();
  const auto turn = [&](Point p) {
    return Point{heading_.c * p.x - heading_.s * p.y, heading_.s * p.x + heading_.c * p.y};
  };
  for (std::uint32_t i = 0; i < turned_.size(); ++i) {
    turned_[i] = turn(forms.points(1)[i]);
    turned_edge_[i] = turn(forms.edge(1, i));
  }
  for (const std::uint32_t i : window_->changing) {
    const RotationCatalog::Span& span = window_->segments[i].span;
    const double before = delta - span.from, after = span.to - delta;
    if (std::abs(before) < kAngleSlack || std::abs(after) < kAngleSlack) return false;
    exists_[i] = before > 0 && after > 0;
    // Everything lies beside what does not exist.
    placed_[i].error = exists_[i] != 0 ? kTurnedEndSide * forms.span() * placed_[i].length1 : -INFINITY;
  }
  for (const std::uint32_t side : {0u, 1u})
    for (const Busy& b : busy_[side]) {
      const Point at = position({b.p, b.q}), d = direction({side, b.edge, 0});
      placed_[b.segment].at = Two{at.x, at.y};
      placed_[b.segment].d = Two{d.x, d.y};
    }
  return true;
}

// Those are left out of which one does not exist, or both ends of one lie on one side of the other. Without branches:
// which of them cross cannot be predicted, so all are listed and the position moves on for those that may.
void RotatingFrame::find_near() {
  const std::size_t count = window_->candidates.size();
  near_.resize(count + 1);
  const Meeting* meetings = meetings_.data();
  const Placed* placed = placed_.data();
  Near* near = near_.data();
  for (std::uint32_t i = 0; i < count; ++i) {
    const Placed &a = placed[meetings[i].a], &b = placed[meetings[i].b];
    const Two w = b.at - a.at, crossed = a.d * exchanged(b.d), error = {a.error, b.error};
    const double k = crossed[0] - crossed[1];
    const Two starts = firsts(a.d, b.d) * seconds(w, w) - seconds(a.d, b.d) * firsts(w, w), ends = starts + both(k);
    *near = {starts, error, k, i};
    near += !any(most(least(starts, ends), -most(starts, ends)) > error);
  }
  near_count_ = static_cast<std::size_t>(near - near_.data());
}

// False where it cannot be determined whether two cross.
bool RotatingFrame::find_crossings() {
  std::fill(count_.begin(), count_.end(), 0);
  crossings_.resize(near_count_);
  std::uint32_t index = 0;
  for (std::size_t i = 0; i < near_count_; ++i) {
    const Near& n = near_[i];
    const RotationCandidate& m = window_->candidates[n.candidate];
    const Placed &a = placed_[meetings_[n.candidate].a], &b = placed_[meetings_[n.candidate].b];
    const bool unsure = any(least(magnitude(n.starts), magnitude(n.starts + both(n.k))) <= n.error);
    if (unsure || std::abs(n.k) <= kCrossKnown * a.length1 * b.length1) {
      if (!provably_beside(a, b) && !provably_beside(b, a)) return false;
      continue;
    }
    const Interval &p = intervals_[m.a], &q = intervals_[m.b];
    const double per = -1 / n.k;
    // First on b, then on a.
    const Two at = n.starts * both(per);
    if (any(at <= firsts(q.range, p.range)) | any(at > seconds(q.range, p.range)))
      continue;  // they cross in other pieces
    const Two error = both(kCrossingSlack * std::abs(per)) * n.error + both(kCrossingFraction);
    const bool out_on_a = n.k > 0;
    const Two t = out_on_a ? at : exchanged(at), e = out_on_a ? error : exchanged(error);
    crossings_[index] = {out_on_a ? m.b : m.a, out_on_a ? m.a : m.b, t[0], t[1], e[0], e[1]};
    insert(p.entries, count_[m.a]++, {at[1], rounded_up(error[1]), out_on_a ? index | kOut : index});
    insert(q.entries, count_[m.b]++, {at[0], rounded_up(error[0]), out_on_a ? index : index | kOut});
    ++index;
  }
  crossings_.resize(index);
  return true;
}

void RotatingFrame::insert(Entry* list, std::uint32_t k, Entry entry) {
  for (; k > 0 && list[k - 1].t > entry.t; --k) list[k] = list[k - 1];
  list[k] = entry;
}

// Along the first one, the second one lies before its start or after its end.
bool RotatingFrame::provably_beside(const Placed& a, const Placed& b) {
  const auto along = [&](Two v) { return a.d[0] * v[0] + a.d[1] * v[1]; };
  const double u = along(b.at - a.at), v = u + along(b.d), whole = along(a.d);
  return (u < -a.error && v < -a.error) || (u > whole + a.error && v > whole + a.error);
}

// A walk that leaves a crossing arrives at the next one on the piece, unless it comes from the left of what crosses
// there: then it is covered.
bool RotatingFrame::link_crossings() {
  next_.resize(crossings_.size());
  for (std::uint32_t i = 0; i < count_.size(); ++i) {
    if (count_[i] == 0) continue;
    const Entry* list = &entries_[window_->first_of[i]];
    const std::uint32_t last = count_[i] - 1;
    for (std::uint32_t k = 0; k < last; ++k) {
      if (!(list[k + 1].t - list[k].t > static_cast<double>(list[k].error) + static_cast<double>(list[k + 1].error)))
        return false;
      if (list[k].out()) next_[list[k].index()] = list[k + 1].out() ? kNone : list[k + 1].crossing;
    }
    if (list[last].out()) next_[list[last].index()] = window_->pieces[i].tail_dead ? kNone : kOnward;
  }
  return true;
}

std::uint32_t RotatingFrame::onward(std::uint32_t piece, std::uint32_t begin, std::vector<std::uint32_t>* path) {
  const auto exists = [&](std::uint32_t next) { return next != kNone && exists_[continuations_[next].segment] != 0; };
  for (std::size_t steps = 0; steps <= continuations_.size(); ++steps) {
    const Continuation& way = continuations_[piece];
    if (way.leap != kNone) {
      for (std::uint32_t next = piece; path != nullptr && next != way.leap; path->push_back(next))
        next = window_->pieces[next].follower;
      piece = way.leap;
      continue;
    }
    const bool first = exists(way.next[0]), second = exists(way.next[1]);
    if (first && second) proved_ = false;
    if (!first && !second) return kNone;
    piece = way.next[first ? 0 : 1];
    if (piece == begin) return kRound;
    if (path != nullptr) path->push_back(piece);
    if (count(piece) > 0) return entry(piece, 0).out() ? kNone : entry(piece, 0).index();
    if (begin != kNone && walked_[piece]) return kNone;
    walked_[piece] = 1;
  }
  return kNone;
}

std::uint32_t RotatingFrame::partner(std::uint32_t piece, std::uint32_t c) const {
  if (c == kEnd) return kEnd;
  const Crossing& x = crossings_[c];
  return window_->pieces[x.in == piece ? x.out : x.in].segment;
}

// Adds the steps from a crossing to the next one of its cycle, which it returns.
std::uint32_t RotatingFrame::record(std::uint32_t crossing) {
  const std::uint32_t piece = crossings_[crossing].out;
  const auto add = [&](std::uint32_t p, std::uint32_t from, std::uint32_t to) {
    steps_.push_back({p, window_->pieces[p].segment, partner(p, from), partner(p, to), from, to, false});
  };
  if (next_[crossing] != kOnward) {
    add(piece, crossing, next_[crossing]);
    return next_[crossing];
  }
  path_.clear();
  const std::uint32_t to = onward(piece, kNone, &path_);
  add(piece, crossing, kEnd);
  for (std::size_t k = 0; k < path_.size(); ++k) add(path_[k], kEnd, k + 1 == path_.size() ? to : kEnd);
  return to;
}

bool RotatingFrame::find_cycles() {
  cycles_.clear();
  steps_.clear();
  seen_.assign(crossings_.size(), 0);
  std::fill(walked_.begin(), walked_.end(), 0);
  for (std::uint32_t c = 0; c < crossings_.size(); ++c) {
    if (seen_[c]) continue;
    std::uint32_t at = c;
    do {
      seen_[at] = 1;
      at = successor(at);
    } while (at != kNone && !seen_[at]);
    // Every crossing has one predecessor, so only the first one can come again.
    if (at != c || !proved_) continue;
    const auto first = static_cast<std::uint32_t>(steps_.size());
    do at = record(at);
    while (at != c);
    if (!close(first)) return false;
  }
  return proved_ && find_plain_cycles();
}

// Cycles without a crossing: along segments that nothing crosses. Those of quiet pieces alone are known; others have
// one that is not.
bool RotatingFrame::find_plain_cycles() {
  const auto add = [&] {
    const auto first = static_cast<std::uint32_t>(steps_.size());
    for (const std::uint32_t piece : path_)
      steps_.push_back({piece, window_->pieces[piece].segment, kEnd, kEnd, kEnd, kEnd, false});
    return close(first);
  };
  for (const std::uint32_t i : window_->circles) {
    path_.assign(1, i);
    for (std::uint32_t k = window_->pieces[i].follower; k != i; k = window_->pieces[k].follower) path_.push_back(k);
    if (!add()) return false;
  }
  for (const std::uint32_t i : window_->rounds) {
    if (walked_[i] || count(i) != 0 || !exists_[window_->pieces[i].segment]) continue;
    path_.assign(1, i);
    walked_[i] = 1;
    if (onward(i, i, &path_) == kRound && !add()) return false;
  }
  return proved_;
}

// Sets proved_ to false where doubles do not decide.
int RotatingFrame::half(const RotatingSegment& s, Point d) {
  if (s.side == 0) return half_plane(d.x, d.y);  // rounded once from exact differences
  if (std::abs(d.y) <= kTurnedDirection * window_->forms().length1(s)) proved_ = false;
  return d.y > 0 ? 0 : 1;
}

bool RotatingFrame::close(std::uint32_t first) {
  const auto last = static_cast<std::uint32_t>(steps_.size());
  const RotatingSegment* a = &window_->segments[steps_[first].segment];
  Point d = direction(*a);
  int turns = 0, ht = half(*a, d);
  for (std::uint32_t i = first; i < last; ++i) {
    Step& from = steps_[i];
    const RotatingSegment* b = &window_->segments[steps_[i + 1 == last ? first : i + 1].segment];
    const Point e = direction(*b);
    const double k = d.x * e.y - d.y * e.x, lengths = window_->forms().length1(*a) * window_->forms().length1(*b);
    if (from.to == kEnd && std::abs(k) <= kNearlyStraight * lengths) from.straight = window_->forms().parallel(*a, *b);
    const int hf = ht;
    ht = half(*b, e);
    a = b;
    d = e;
    if (hf == ht) continue;
    int turn = -1;  // at crossings always to the right
    if (from.to == kEnd) {
      if (std::abs(k) <= kTurnedCross * lengths) proved_ = false;
      turn = k > 0 ? 1 : -1;
    }
    if (turn > 0 && hf == 1) ++turns;
    if (turn < 0 && hf == 0) --turns;
  }
  cycles_.push_back({first, last, turns});
  return proved_;
}

std::optional<Point> RotatingFrame::midpoint_of(const Step& s) const {
  const double from = from_fraction(s), to = to_fraction(s), midpoint = 0.5 * (from + to);
  const double low = s.from_crossing == kEnd ? 0 : crossings_[s.from_crossing].e_out,
               high = s.to_crossing == kEnd ? 0 : crossings_[s.to_crossing].e_in;
  if (!(midpoint - from > low && to - midpoint > high)) return std::nullopt;
  const RotatingSegment& segment = window_->segments[s.segment];
  const Point at = position(segment.start()), d = direction(segment);
  return Point{at.x + midpoint * d.x, at.y + midpoint * d.y};
}

RotatingFrame::Located RotatingFrame::end_of(const Step& s) const {
  if (s.to_crossing == kEnd) return {position(window_->segments[s.segment].end), point_error()};
  const Crossing& c = crossings_[s.to_crossing];
  const Placed &a = placed_[s.segment], &b = placed_[window_->pieces[c.out].segment];
  const double ea = c.e_in * std::max(std::abs(a.d[0]), std::abs(a.d[1])),
               eb = c.e_out * std::max(std::abs(b.d[0]), std::abs(b.d[1]));
  const Two at = ea <= eb ? a.at + both(c.t_in) * a.d : b.at + both(c.t_out) * b.d;
  return {{at[0], at[1]}, point_error() + std::min(ea, eb)};
}

}  // namespace dymsum::planar
