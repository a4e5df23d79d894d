#include "planar/measure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "versus/cgal.h"
#include "versus/clipper.h"

namespace dymsum::bench {
namespace {

constexpr Repeats kOurRepeats{5, 200, 150, 3000};
constexpr Repeats kRivalRepeats{5, 15, 100, 2500};
constexpr Repeats kOtherRepeats{3, 5, 50, 500};

/// CGAL's area of a larger sum is added up in doubles, so the exact one is not needed either.
constexpr std::size_t kExactAreaVertices = 1500;

PlanarSum sum_of(const Region& p, const Region& q, bool no_fit) {
  return no_fit ? nfp(p, q).value() : minkowski_sum(p, q).value();
}

/// The area from the rounded vertices, about one of them: good to about 1e-13 of the bounding box.
double rounded_area(const PlanarSum& sum) {
  if (sum.parts.empty()) return 0;
  const Point origin = sum.parts[0].outer.vertices[0].at;
  double twice = 0;
  const auto add = [&](const SumRing& ring) {
    const std::size_t n = ring.vertices.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Point a = ring.vertices[i].at, b = ring.vertices[(i + 1) % n].at;
      twice += (a.x - origin.x) * (b.y - origin.y) - (b.x - origin.x) * (a.y - origin.y);
    }
  };
  for (const SumPart& part : sum.parts) {
    add(part.outer);
    for (const SumRing& hole : part.holes) add(hole);
  }
  return twice / 2;
}

/// The median of each stage over all repetitions.
class StageTimes {
 public:
  void add(const std::vector<SumStats::Stage>& stages) {
    for (const SumStats::Stage& stage : stages) times_[stage.name].ms.push_back(stage.ms);
  }
  void put_medians(std::vector<SumStats::Stage>& stages) const {
    for (SumStats::Stage& stage : stages) stage.ms = times_.at(stage.name).median();
  }

 private:
  std::map<std::string_view, Times> times_;
};

/// From points to the sum, as users pay for it who sum two regions once. Of CGAL's times nothing but the sum is
/// counted.
double fresh_median_ms(const Pair& pair) {
  Times times;
  for (int k = 0; k < 25; ++k) {
    RegionData p = pair.p.data(), q = pair.q.data();
    struct Made {
      Region p, q;
      PlanarSum sum;
    };
    const auto from_points = [&] {
      Made made{Region::create(std::move(p)).value(), Region::create(std::move(q)).value(), {}};
      made.sum = sum_of(made.p, made.q, pair.no_fit);
      return made;
    };
    times.ms.push_back(measure(Repeats{}, from_points, [](Made&&) {}).median());
    if (k >= 8 && times.ms.back() > 1) break;
  }
  return times.median();
}

OurAnswer our_answer(const Pair& pair) {
  OurAnswer ours;
  PlanarSum sum;
  StageTimes stages;
  const Times times = measure(
      kOurRepeats, [&] { return sum_of(pair.p, pair.q, pair.no_fit); },
      [&](PlanarSum&& last) {
        stages.add(last.stats.stages);
        sum = std::move(last);
      });
  ours.median_ms = times.median();
  ours.min_ms = times.min();
  ours.runs = static_cast<int>(times.ms.size());
  ours.fresh_ms = fresh_median_ms(pair);
  ours.outer = sum.parts.size();
  ours.holes = sum.hole_count();
  ours.vertices = sum.vertex_count();
  ours.stats = sum.stats;
  stages.put_medians(ours.stats.stages);
  ours.convolution = convolution_sizes(pair.p, pair.no_fit ? negated(pair.q) : pair.q);
  if (ours.vertices <= kExactAreaVertices) {
    const Rational area = sum.area_exact();
    ours.area = area.to_double();
    ours.area_exact = area.to_string();
  } else {
    ours.area = rounded_area(sum);
  }
  return ours;
}

bool same_area(const OurAnswer& ours, const RivalAnswer& rival) {
  if (!ours.area_exact.empty() && !rival.area_exact.empty()) return ours.area_exact == rival.area_exact;
  return std::fabs(ours.area - rival.area) <= 1e-12 * std::fabs(ours.area);
}

bool same_answer(const OurAnswer& ours, const RivalAnswer& rival) {
  return rival.finished && ours.outer == rival.outer && ours.holes == rival.holes && ours.vertices == rival.vertices &&
         same_area(ours, rival);
}

std::string difference(const OurAnswer& ours, const RivalAnswer& rival) {
  std::ostringstream text;
  text.precision(15);
  text << "ours: " << ours.holes << " holes, " << ours.vertices << " vertices, area " << ours.area
       << "; CGAL: " << rival.holes << " holes, " << rival.vertices << " vertices, area " << rival.area;
  return text.str();
}

/// Compares with the reduced convolution; where it differs, asks CGAL's vertical decomposition, which shares no code
/// with it.
void judge(Row& row, const CgalOperands& operands, double limit_s) {
  if (!row.reduced.finished) {
    row.remark = "CGAL reduced convolution " + row.reduced.why_not;
    return;
  }
  if (same_answer(row.ours, row.reduced)) {
    row.verdict = Verdict::equal;
    return;
  }
  if (!row.vertical.finished) {
    row.vertical = operands.sum_in_child(CgalMethod::vertical_decomposition, Repeats{}, std::max(limit_s, 20.0));
  }
  row.remark = difference(row.ours, row.reduced);
  const bool confirmed = same_answer(row.ours, row.vertical);
  row.verdict = confirmed ? Verdict::cgal_defect : Verdict::mismatch;
  row.remark += confirmed ? "; CGAL's vertical decomposition says what we say"
                          : "; CGAL's vertical decomposition does not confirm ours";
  if (!confirmed && row.vertical.finished) row.remark += " (" + difference(row.ours, row.vertical) + ")";
}

}  // namespace

double Row::ratio_to_best_cgal() const {
  double best = reduced.finished ? reduced.median_ms : INFINITY;
  for (const RivalAnswer* other : {&full, &angle_bisector, &vertical}) {
    if (same_answer(ours, *other)) best = std::min(best, other->median_ms);
  }
  return best / ours.median_ms;
}

bool Row::agrees(const RivalAnswer& clipper) const {
  return clipper.holes == ours.holes && std::fabs(clipper.area - ours.area) <= 1e-6 * std::fabs(ours.area);
}

Row measure_pair(const Pair& pair, const Effort& effort) {
  Row row;
  row.name = pair.name;
  row.group = pair.group;
  row.large = pair.large;
  row.p_vertices = pair.p.vertex_count();
  row.q_vertices = pair.q.vertex_count();
  row.p_corners = pair.p.canonical().vertex_count();
  row.q_corners = pair.q.canonical().vertex_count();
  row.ours = our_answer(pair);
  if (!effort.rivals) return row;
  const Region second = pair.no_fit ? negated(pair.q) : pair.q;
  const CgalOperands operands(pair.p.data(), second.data());
  row.reduced = operands.sum(CgalMethod::reduced_convolution, kRivalRepeats);
  const double limit = effort.others_limit_s;
  if (limit > 0) {
    row.full = operands.sum_in_child(CgalMethod::full_convolution, kOtherRepeats, limit);
    row.angle_bisector = operands.sum_in_child(CgalMethod::small_side_angle_bisector, kOtherRepeats, limit);
    row.vertical = operands.sum_in_child(CgalMethod::vertical_decomposition, kOtherRepeats, limit);
    row.clipper = clipper_sum_in_child(Clipper::six, pair.p.data(), second.data(), kOtherRepeats, limit);
    row.clipper2 = clipper_sum_in_child(Clipper::two, pair.p.data(), second.data(), kOtherRepeats, limit);
  }
  judge(row, operands, limit);
  return row;
}

}  // namespace dymsum::bench
