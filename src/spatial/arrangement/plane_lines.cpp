#include "spatial/arrangement/plane_lines.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>

namespace dymsum::spatial {

void PointTable::rehash(std::size_t slots) {
  slots_.assign(slots, kNoId);
  for (PointId id = 0; id < sources_.size(); ++id) {
    std::size_t at = hash_[id] & (slots - 1);
    while (slots_[at] != kNoId) at = (at + 1) & (slots - 1);
    slots_[at] = id;
  }
}

namespace {

/// Each source once, and which of these every one is.
struct NamedOnce {
  std::vector<PointSource> sources;
  std::vector<std::uint32_t> index;
};

NamedOnce named_once(std::span<const PointSource> all) {
  NamedOnce once;
  once.index.reserve(all.size());
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * all.size() + 1), kNoId);
  for (const PointSource& s : all) {
    const std::uint64_t mixed = ((static_cast<std::uint64_t>(s.a) << 32 | s.b) ^ s.c * 0x9e3779b97f4a7c15ULL) *
                                (0xd6e8feb86659fd93ULL + 2 * static_cast<std::uint64_t>(s.kind));
    std::size_t at = (mixed >> 32) & (slots.size() - 1);
    while (slots[at] != kNoId && once.sources[slots[at]] != s) at = (at + 1) & (slots.size() - 1);
    if (slots[at] == kNoId) {
      slots[at] = static_cast<std::uint32_t>(once.sources.size());
      once.sources.push_back(s);
    }
    once.index.push_back(slots[at]);
  }
  return once;
}

}  // namespace

std::vector<PointId> PointTable::add(std::span<const PointSource> all, StageWatch& watch) {
  const NamedOnce once = named_once(all);
  std::vector<PointId> ids = add_named_once(once.sources, watch), result;
  result.reserve(all.size());
  for (const std::uint32_t k : once.index) result.push_back(ids[k]);
  return result;
}

std::vector<PointId> PointTable::add_named_once(std::span<const PointSource> sources, StageWatch& watch) {
  constexpr std::size_t kPart = 1024;
  std::vector<exact::Residue> hashes(sources.size());
  watch.run((sources.size() + kPart - 1) / kPart, [&](std::size_t part) {
    const std::size_t first = part * kPart, count = std::min(kPart, sources.size() - first);
    const std::vector<exact::Residue> some = space_.point_hashes(sources.subspan(first, count));
    std::copy(some.begin(), some.end(), hashes.begin() + static_cast<std::ptrdiff_t>(first));
  });
  const std::size_t room = std::bit_ceil(2 * (sources_.size() + sources.size()) + 16);
  if (room > slots_.size()) rehash(room);
  const std::size_t known = sources_.size();
  std::vector<PointId> ids;
  ids.reserve(sources.size());
  std::vector<std::uint32_t> fresh;  // of the sources: those of new points
  const auto source_of = [&](PointId id) { return id < known ? sources_[id] : sources[fresh[id - known]]; };
  const auto hash_of = [&](PointId id) { return id < known ? hash_[id] : hashes[fresh[id - known]]; };
  for (std::size_t k = 0; k < sources.size(); ++k) {
    std::size_t at = hashes[k] & (slots_.size() - 1);
    while (slots_[at] != kNoId &&
           !(hash_of(slots_[at]) == hashes[k] && space_.same_point(source_of(slots_[at]), sources[k])))
      at = (at + 1) & (slots_.size() - 1);
    if (slots_[at] == kNoId) {
      slots_[at] = static_cast<PointId>(known + fresh.size());
      fresh.push_back(static_cast<std::uint32_t>(k));
    }
    ids.push_back(slots_[at]);
  }
  const std::size_t all = known + fresh.size();
  sources_.reserve(all), hash_.reserve(all), approx_.reserve(all);
  for (const std::uint32_t k : fresh) sources_.push_back(sources[k]), hash_.push_back(hashes[k]);
  watch.hold((sources_.size() - known) *
             (sizeof(PointSource) + sizeof(Approx) + sizeof(exact::Residue) + 4 * sizeof(PointId)));
  approx_.resize(sources_.size());
  watch.run((sources_.size() - known + kPart - 1) / kPart, [&](std::size_t part) {
    const std::size_t first = known + part * kPart;
    for (std::size_t k = first; k < std::min(first + kPart, sources_.size()); ++k)
      approx_[k] = space_.approximate(sources_[k]);
  });
  return ids;
}

namespace {

/// So many intervals, or crossings, are compared with one another faster than they are sorted, or hashed.
constexpr std::size_t kFew = 24;

}  // namespace

void PlaneLines::run(std::span<const PlaneSegment> segments) {
  merge_equal(segments);
  find_lines();
  make_runs();
  cross_runs();
  place_dots();
  name_crossings();
  cut_runs();
}

/// Segments with the same ends are one interval.
void PlaneLines::merge_equal(std::span<const PlaneSegment> segments) {
  intervals_.clear(), dots_.clear();
  for (const PlaneSegment& s : segments) {
    if (s.a == s.b) {
      dots_.push_back(s);
      continue;
    }
    const bool along = s.a < s.b;
    const int left = along ? s.inside : -s.inside;
    intervals_.push_back({std::min(s.a, s.b), std::max(s.a, s.b), s.cut, along, s.side > 0 ? left : 0,
                          s.side > 0 ? 0 : left, s.facet_edge, 0, along ? s.a_inner : s.b_inner,
                          along ? s.b_inner : s.a_inner});
  }
  std::stable_sort(dots_.begin(), dots_.end(), [](const PlaneSegment& s, const PlaneSegment& t) { return s.a < t.a; });
  dots_.erase(
      std::unique(dots_.begin(), dots_.end(), [](const PlaneSegment& s, const PlaneSegment& t) { return s.a == t.a; }),
      dots_.end());
  if (intervals_.size() <= kFew) merge_few();
  else merge_sorted();
}

void PlaneLines::merge(Interval& t, const Interval& s) {
  t.front += s.front, t.back += s.back;
  t.a_inner = t.a_inner && s.a_inner, t.b_inner = t.b_inner && s.b_inner;
  if (t.facet_edge == kNoId) t.facet_edge = s.facet_edge;
  else if (s.facet_edge != kNoId && s.facet_edge != t.facet_edge) t.facet_edge = kManyEdges;
}

void PlaneLines::merge_sorted() {
  std::sort(intervals_.begin(), intervals_.end(), [](const Interval& s, const Interval& t) {
    return std::tie(s.a, s.b, s.cut, s.facet_edge) < std::tie(t.a, t.b, t.cut, t.facet_edge);
  });
  std::size_t kept = 0;
  for (const Interval& s : intervals_) {
    if (kept == 0 || intervals_[kept - 1].a != s.a || intervals_[kept - 1].b != s.b) intervals_[kept++] = s;
    else merge(intervals_[kept - 1], s);
  }
  intervals_.resize(kept);
}

void PlaneLines::merge_few() {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < intervals_.size(); ++k) {
    const Interval& s = intervals_[k];
    std::size_t same = 0;
    while (same < kept && (intervals_[same].a != s.a || intervals_[same].b != s.b)) ++same;
    if (same < kept) merge(intervals_[same], s);
    else if (kept++ < k) intervals_[kept - 1] = s;
  }
  intervals_.resize(kept);
}

bool PlaneLines::on_line(const Interval& line, const Interval& s) const {
  return points_.left_of(line.cut, s.a) == 0 && points_.left_of(line.cut, s.b) == 0;
}

/// Numbers the lines of all intervals: `order_` lists intervals line by line.
void PlaneLines::find_lines() {
  if (intervals_.size() <= kFew) return find_few_lines();
  const auto n = static_cast<std::uint32_t>(intervals_.size());
  cuts_.clear(), order_.clear();
  for (std::uint32_t k = 0; k < n; ++k) cuts_.push_back(intervals_[k].cut), order_.push_back(k);
  points_.space().line_hashes(points_.plane(), cuts_, hash_);
  std::sort(order_.begin(), order_.end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::tie(hash_[a], a) < std::tie(hash_[b], b); });
  std::vector<std::uint32_t>& leaders = by_x_;  // the first interval of every line
  leaders.clear();
  std::uint32_t same_hash = 0;  // the first line with the hash at hand
  bool mixed = false;
  // What has the hash 0 may lie on any line, and comes first.
  const bool wild = n > 0 && hash_[order_[0]] == 0;
  for (std::uint32_t k = 0; k < n; ++k) {
    Interval& s = intervals_[order_[k]];
    const auto lines = static_cast<std::uint32_t>(leaders.size());
    if (k > 0 && hash_[order_[k]] != hash_[order_[k - 1]] && !wild) same_hash = lines;
    s.line = same_hash;
    while (s.line < lines && intervals_[leaders[s.line]].cut != s.cut && !on_line(intervals_[leaders[s.line]], s))
      ++s.line;
    if (s.line == lines) leaders.push_back(order_[k]);
    else mixed |= s.line + 1 < lines;
  }
  if (mixed)
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::tie(intervals_[a].line, a) < std::tie(intervals_[b].line, b);
    });
}

/// Each interval beside the first ones of all lines before: most are distinguished by doubles.
void PlaneLines::find_few_lines() {
  std::vector<std::uint32_t>& leaders = by_x_;
  leaders.clear(), order_.clear();
  bool mixed = false;
  for (std::uint32_t k = 0; k < intervals_.size(); ++k) {
    Interval& s = intervals_[k];
    const auto lines = static_cast<std::uint32_t>(leaders.size());
    s.line = 0;
    const auto differs = [&](const Interval& lead) {
      return lead.cut != s.cut &&
             (points_.off_line(lead.cut, s.a) || points_.off_line(lead.cut, s.b) || !on_line(lead, s));
    };
    while (s.line < lines && differs(intervals_[leaders[s.line]])) ++s.line;
    if (s.line == lines) leaders.push_back(k);
    else mixed |= s.line + 1 < lines;
    order_.push_back(k);
  }
  if (mixed)
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::tie(intervals_[a].line, a) < std::tie(intervals_[b].line, b);
    });
}

void PlaneLines::make_runs() {
  runs_.clear(), breaks_.clear();
  const auto n = static_cast<std::uint32_t>(order_.size());
  for (std::uint32_t first = 0, last = 0; first < n; first = last) {
    while (last < n && intervals_[order_[last]].line == intervals_[order_[first]].line) ++last;
    const Interval& s = intervals_[order_[first]];
    if (last - first == 1) add_run(first, last, s.a, s.b);
    else split_line(first, last);
  }
}

void PlaneLines::add_run(std::uint32_t first, std::uint32_t last, PointId a, PointId b) {
  const Interval& s = intervals_[order_[first]];
  Run run{a, b, s.cut, s.along, first, last, 1e300, 1e300, -1e300, -1e300};
  for (const PointId p : {a, b}) {
    const Approx& at = points_.approx(p);
    const double x = points_.x(at), y = points_.y(at);
    run.low_x = std::min(run.low_x, x - at.radius), run.high_x = std::max(run.high_x, x + at.radius);
    run.low_y = std::min(run.low_y, y - at.radius), run.high_y = std::max(run.high_y, y + at.radius);
  }
  runs_.push_back(run);
}

/// Intervals of one line as runs, all in the direction of the first one's way from a to b.
void PlaneLines::split_line(std::uint32_t first, std::uint32_t last) {
  const Interval lead = intervals_[order_[first]];
  const int axis = points_.long_axis(lead.a, lead.b), direction = points_.order(lead.a, lead.b, axis);
  const auto before = [&](PointId p, PointId q) { return points_.order(p, q, axis) * direction > 0; };
  for (std::uint32_t k = first; k < last; ++k) {
    Interval& s = intervals_[order_[k]];
    s.cut = lead.cut, s.along = lead.along;
    if (!before(s.a, s.b)) std::swap(s.a, s.b), std::swap(s.a_inner, s.b_inner), s.front = -s.front, s.back = -s.back;
  }
  std::sort(order_.begin() + first, order_.begin() + last, [&](std::uint32_t i, std::uint32_t j) {
    const Interval &s = intervals_[i], &t = intervals_[j];
    if (s.a != t.a) return before(s.a, t.a);
    return i < j;
  });
  std::uint32_t begin = first;
  PointId end = intervals_[order_[first]].b;
  const auto finish = [&](std::uint32_t k) {
    const PointId start = intervals_[order_[begin]].a;
    const auto run = static_cast<std::uint32_t>(runs_.size());
    for (std::uint32_t i = begin; i < k; ++i) {
      const Interval& s = intervals_[order_[i]];
      if (!s.a_inner && s.a != start && s.a != end) breaks_.push_back({run, s.a});
      if (!s.b_inner && s.b != start && s.b != end) breaks_.push_back({run, s.b});
    }
    add_run(begin, k, start, end);
    begin = k;
  };
  for (std::uint32_t k = first + 1; k < last; ++k) {
    const Interval& s = intervals_[order_[k]];
    if (s.a != end && !before(s.a, end)) {
      finish(k);
      end = s.b;
    } else if (before(end, s.b)) {
      end = s.b;
    }
  }
  finish(last);
}

void PlaneLines::cross_runs() {
  crossings_.clear(), by_x_.clear(), open_.clear();
  for (std::uint32_t r = 0; r < runs_.size(); ++r) by_x_.push_back(r);
  std::sort(by_x_.begin(), by_x_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tie(runs_[a].low_x, a) < std::tie(runs_[b].low_x, b);
  });
  for (const std::uint32_t s : by_x_) {
    const Run& run = runs_[s];
    std::size_t kept = 0;
    for (const std::uint32_t t : open_) {
      const Run& other = runs_[t];
      if (other.high_x < run.low_x) continue;
      open_[kept++] = t;
      if (other.low_y <= run.high_y && run.low_y <= other.high_y) cross(s, t);
    }
    open_.resize(kept);
    open_.push_back(s);
  }
}

/// Crosses two runs on different lines, or apart on one.
void PlaneLines::cross(std::uint32_t i, std::uint32_t j) {
  const Run &s = runs_[i], &t = runs_[j];
  if (s.cut == t.cut) return;
  const auto side = [&](PointId end, const Run& r) {
    return end == r.a || end == r.b ? 0 : points_.left_of(r.cut, end);
  };
  const int sa = side(s.a, t), sb = side(s.b, t);
  if (sa * sb > 0) return;
  const int ta = side(t.a, s), tb = side(t.b, s);
  if (ta * tb > 0) return;
  if (sa * sb < 0 && ta * tb < 0) {
    PointSource at{PointSource::Kind::planes, points_.plane(), s.cut, t.cut};
    if (at.a > at.b) std::swap(at.a, at.b);
    if (at.b > at.c) std::swap(at.b, at.c);
    if (at.a > at.b) std::swap(at.a, at.b);
    crossings_.push_back({i, j, at});
    return;
  }
  // An end on the other run.
  if (sa == 0 && ta * tb < 0) breaks_.push_back({j, s.a});
  if (sb == 0 && ta * tb < 0) breaks_.push_back({j, s.b});
  if (ta == 0 && sa * sb < 0) breaks_.push_back({i, t.a});
  if (tb == 0 && sa * sb < 0) breaks_.push_back({i, t.b});
}

/// Points inside a run: from left to right, among the runs near each.
void PlaneLines::place_dots() {
  if (dots_.empty()) return;
  const auto left = [&](std::uint32_t k) {
    const Approx& at = points_.approx(dots_[k].a);
    return points_.x(at) - at.radius;
  };
  std::vector<std::uint32_t>& order = inner_;
  order.resize(dots_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return left(a) < left(b); });
  open_.clear();
  std::size_t next = 0;
  double most = 0;
  for (const PlaneSegment& dot : dots_) most = std::max(most, points_.approx(dot.a).radius);
  for (const std::uint32_t d : order) {
    const double low = left(d);
    while (next < by_x_.size() && runs_[by_x_[next]].low_x <= low + 2 * most) open_.push_back(by_x_[next++]);
    std::erase_if(open_, [&](std::uint32_t k) { return runs_[k].high_x < low; });
    for (const std::uint32_t k : open_) place_dot(dots_[d].a, k);
  }
}

void PlaneLines::place_dot(PointId dot, std::uint32_t k) {
  const Run& run = runs_[k];
  const Approx& at = points_.approx(dot);
  const double x = points_.x(at), y = points_.y(at), r = at.radius;
  if (x + r < run.low_x || x - r > run.high_x || y + r < run.low_y || y - r > run.high_y) return;
  if (dot == run.a || dot == run.b || points_.left_of(run.cut, dot) != 0) return;
  const int axis = points_.long_axis(run.a, run.b), direction = points_.order(run.a, run.b, axis);
  if (points_.order(run.a, dot, axis) * direction > 0 && points_.order(dot, run.b, axis) * direction > 0)
    breaks_.push_back({k, dot});
}

/// Names crossings where they are few, and doubles tell them from one another and from all other points of the lines.
bool PlaneLines::name_apart() {
  if (crossings_.size() > kFew || runs_.size() + breaks_.size() > 4 * kFew) return false;
  near_.clear();
  for (const Crossing& c : crossings_) near_.push_back(points_.space().approximate(c.at));
  const auto is_apart = [&](std::size_t k) {
    const auto from = [&](PointId p) { return points_.apart(near_[k], points_.approx(p)); };
    return std::all_of(near_.begin(), near_.begin() + static_cast<std::ptrdiff_t>(k),
                       [&](const Approx& at) { return points_.apart(near_[k], at); }) &&
           std::all_of(runs_.begin(), runs_.end(), [&](const Run& r) { return from(r.a) && from(r.b); }) &&
           std::all_of(breaks_.begin(), breaks_.end(), [&](const Break& b) { return from(b.at); });
  };
  for (std::size_t k = 0; k < near_.size(); ++k)
    if (!is_apart(k)) return false;
  for (std::size_t k = 0; k < near_.size(); ++k) {
    const PointId at = points_.add(crossings_[k].at, near_[k]);
    breaks_.push_back({crossings_[k].s, at});
    breaks_.push_back({crossings_[k].t, at});
  }
  return true;
}

void PlaneLines::name_crossings() {
  if (crossings_.empty() || name_apart()) return;
  sources_.clear(), named_.clear();
  for (const Crossing& c : crossings_) sources_.push_back(c.at);
  const std::vector<exact::Residue> hashes = points_.space().point_hashes(sources_);
  for (const Run& r : runs_)
    for (const PointId p : {r.a, r.b}) named_.emplace_back(points_.table().hash(p), p);
  for (const Break& b : breaks_) named_.emplace_back(points_.table().hash(b.at), b.at);
  // Crossings by their order, behind what is known.
  const auto known = points_.known();
  for (std::uint32_t k = 0; k < crossings_.size(); ++k) named_.emplace_back(hashes[k], known + k);
  std::sort(named_.begin(), named_.end());
  named_.erase(std::unique(named_.begin(), named_.end()), named_.end());
  std::vector<PointId>& same = inner_;  // points with one hash: nearly always one
  same.clear();
  for (std::size_t k = 0; k < named_.size(); ++k) {
    const auto [hash, id] = named_[k];
    if (k == 0 || hash != named_[k - 1].first) same.clear();
    if (id < known) {
      same.push_back(id);
      continue;
    }
    const Crossing& c = crossings_[id - known];
    PointId at = kNoId;
    for (const PointId p : same)
      if (points_.space().same_point(points_.source(p), c.at)) at = p;
    if (at == kNoId) same.push_back(at = points_.add(c.at));
    breaks_.push_back({c.s, at});
    breaks_.push_back({c.t, at});
  }
}

void PlaneLines::cut_runs() {
  pieces_.clear();
  std::sort(breaks_.begin(), breaks_.end(),
            [](const Break& x, const Break& y) { return std::tie(x.run, x.at) < std::tie(y.run, y.at); });
  std::size_t at = 0;
  for (std::uint32_t r = 0; r < runs_.size(); ++r) {
    inner_.clear();
    inner_.push_back(runs_[r].a);
    for (; at < breaks_.size() && breaks_[at].run == r; ++at)
      if (breaks_[at].at != inner_.back()) inner_.push_back(breaks_[at].at);
    if (inner_.size() > 2) {
      const int axis = points_.long_axis(runs_[r].a, runs_[r].b),
                direction = points_.order(runs_[r].a, runs_[r].b, axis);
      std::sort(inner_.begin() + 1, inner_.end(),
                [&](PointId p, PointId q) { return points_.order(p, q, axis) * direction > 0; });
    }
    inner_.push_back(runs_[r].b);
    cut_run(r, inner_);
  }
}

/// `points` in order from the run's a to its b.
void PlaneLines::cut_run(std::uint32_t r, std::span<PointId> points) {
  const Run& run = runs_[r];
  const std::size_t n = points.size() - 1;
  // Each piece has its changes (in the run's direction), facet edges, and the sum of their ids.
  steps_.assign(n + 1, {0, 0, 0, 0});
  if (run.last - run.first > 1) {
    index_.clear();
    for (std::uint32_t k = 0; k <= n; ++k) index_.push_back({points[k], k});
    std::sort(index_.begin(), index_.end());
  }
  const auto position = [&](PointId p) -> std::size_t {
    if (p == run.a) return 0;
    if (p == run.b) return n;
    return (*std::lower_bound(index_.begin(), index_.end(), std::array<std::uint32_t, 2>{p, 0}))[1];
  };
  for (std::uint32_t k = run.first; k < run.last; ++k) {
    const Interval& s = intervals_[order_[k]];
    const std::uint64_t facet_edges = s.facet_edge == kNoId ? 0 : s.facet_edge == kManyEdges ? 2 : 1;
    const std::array<std::uint64_t, 4> step{static_cast<std::uint64_t>(s.front), static_cast<std::uint64_t>(s.back),
                                            facet_edges, facet_edges == 1 ? s.facet_edge : 0};
    if (step == std::array<std::uint64_t, 4>{}) continue;  // contacts, whose inner ends are no points of the line
    const std::size_t from = position(s.a), to = position(s.b);
    for (std::size_t i = 0; i < 4; ++i) steps_[from][i] += step[i], steps_[to][i] -= step[i];
  }
  std::array<std::uint64_t, 4> sum{0, 0, 0, 0};
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < 4; ++i) sum[i] += steps_[k][i];
    const int front = static_cast<int>(sum[0]), back = static_cast<int>(sum[1]);
    const bool up = points[k] < points[k + 1];
    LinePiece piece{
        std::min(points[k], points[k + 1]),      std::max(points[k], points[k + 1]), run.cut, up == run.along, kNoId,
        {up ? front : -front, up ? back : -back}};
    if (sum[2] > 0) piece.facet_edge = sum[2] == 1 ? static_cast<EdgeId>(sum[3]) : kManyEdges;
    pieces_.push_back(piece);
  }
}

}  // namespace dymsum::spatial
