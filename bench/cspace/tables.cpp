#include "cspace/tables.h"

#include <algorithm>

namespace dymsum::bench {
namespace {

std::string ms(double v) { return fixed(v, v < 10 ? 2 : v < 100 ? 1 : 0); }
std::string ratio(double a, double b) {
  return a > 0 && b > 0 ? fixed(a / b, a / b < 1 ? 2 : a / b < 10 ? 1 : 0) : "-";
}
std::string count(std::uint64_t v) { return std::to_string(v); }
/// Ours beside the thesis's, which is 0 where it prints nothing.
std::string beside(std::uint64_t ours, int thesis) {
  return count(ours) + " (" + (thesis > 0 ? std::to_string(thesis) : "-") + ")";
}

std::string events(const ObstacleWork& w) {
  return count(w.alignments) + ", " + count(w.vertex_events) + ", " + count(w.triple_events) + ", " +
         count(w.tight_events);
}

void csv_line(Report& report, const std::string& kind, const ObstacleRow& r) {
  const ObstacleWork& w = r.work;
  add_values(report, kind, r.name,
             {{"cpu_ms", r.cpu.median()},
              {"cpu_min_ms", r.cpu.min()},
              {"wall_ms", r.wall.median()},
              {"runs", r.cpu.ms.size()},
              {"surfaces", w.surfaces},
              {"patches", r.patches},
              {"shells", r.shells},
              {"free_cells", r.cells},
              {"angles", r.angles},
              {"alignments", w.alignments},
              {"vertex_events", w.vertex_events},
              {"triple_events", w.triple_events},
              {"tight_events", w.tight_events},
              {"local_updates", w.local_updates},
              {"whole_slices", w.slices},
              {"slabs_compared", r.slabs_compared},
              {"slabs_different", r.slabs_different}});
}

template <class Row>
const Row* find(const std::vector<Row>& rows, const std::string& name) {
  const auto at = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.name == name; });
  return at == rows.end() ? nullptr : &*at;
}

}  // namespace

void add_values(Report& report, const std::string& kind, const std::string& pair, const std::vector<Value>& values) {
  for (const Value& v : values) report.csv << kind << "," << pair << "," << v.name << "," << v.value << "\n";
}

void obstacle_heading(Report& report) {
  report.heading({"P/Q", "shapes, vertices", "N_s", "n_s", "n_b", "event angles",
                  "events: aligned, vertex, three, tight", "near the event", "whole slices",
                  "cpu ms, median (min; runs)", "wall ms", "thesis s", "slabs compared, different"});
}

void obstacle_line(Report& report, const ObstacleRow& r) {
  const PrintedObstacle& t = r.thesis;
  report.row(
      {r.name, r.shapes, beside(r.work.surfaces, t.surfaces), beside(r.patches, t.patches), beside(r.shells, t.shells),
       count(r.angles), events(r.work), count(r.work.local_updates), count(r.work.slices),
       "**" + ms(r.cpu.median()) + "** (" + ms(r.cpu.min()) + "; " + count(r.cpu.ms.size()) + ")", ms(r.wall.median()),
       t.seconds > 0 ? fixed(t.seconds, 2) : "-", count(r.slabs_compared) + ", " + count(r.slabs_different)});
  csv_line(report, "obstacle", r);
}

void slices_heading(Report& report) {
  report.heading({"P/Q", "obstacle cpu ms", "static 360 ms", "/ obstacle", "static 3600 ms", "/ obstacle",
                  "static, a slice a slab: slabs", "ms (scaled)", "/ obstacle", "CGAL 360 ms", "/ obstacle",
                  "CGAL measured", "compared", "vertices, holes, area differ", "any",
                  "CGAL's other method agrees with ours"});
}

void slices_line(Report& report, const SlicesRow& r, const ObstacleRow& obstacle) {
  const double own = obstacle.cpu.median();
  const bool scaled = r.cgal_measured < 360;
  const double all_slabs = r.ours_ms / 360 * static_cast<double>(obstacle.angles);
  const std::string silent = r.unfinished > 0 ? ", " + count(r.unfinished) + " without answer" : "";
  report.row({r.name, ms(own), ms(r.ours_ms), ratio(r.ours_ms, own),
              ms(r.fine_ms) + (r.fine_measured ? "" : " (10 x 360)"), ratio(r.fine_ms, own), count(obstacle.angles),
              ms(all_slabs), ratio(all_slabs, own), ms(r.cgal_ms) + (scaled ? " (scaled)" : ""),
              "**" + ratio(r.cgal_ms, own) + "**", count(r.cgal_measured) + " of 360" + silent,
              count(r.compared) + " (" + count(r.exact_areas) + " areas as fractions)",
              count(r.vertices_differ) + ", " + count(r.holes_differ) + ", " + count(r.area_differs),
              count(r.any_differs), r.queried > 0 ? count(r.confirmed) + " of " + count(r.queried) + " asked" : "-"});
  add_values(report, "slices", r.name,
             {{"static_360_ms", r.ours_ms},
              {"static_3600_ms", r.fine_ms},
              {"static_3600_measured", r.fine_measured},
              {"cgal_360_ms", r.cgal_ms},
              {"cgal_measured", r.cgal_measured},
              {"compared", r.compared},
              {"vertices_differ", r.vertices_differ},
              {"holes_differ", r.holes_differ},
              {"area_differs", r.area_differs},
              {"any_differs", r.any_differs}});
}

void slices_remarks(Report& report, const std::vector<SlicesRow>& rows) {
  bool first = true;
  for (const SlicesRow& r : rows)
    for (const std::string& remark : r.remarks) {
      if (first) report.line("");
      first = false;
      report.line("- " + r.name + " at " + remark);
    }
}

void sizes_heading(Report& report) {
  report.heading({"P/Q", "complete N", "its crossings I", "reduced n", "its crossings i",
                  "crossings our engine computes", "segments doubles misjudge"});
}

void sizes_line(Report& report, const std::string& name, const ConvolutionCounts& c, const PrintedObstacle& t) {
  report.row({name, beside(c.complete, t.complete), beside(c.complete_crossings, t.complete_crossings),
              beside(c.reduced, t.reduced), beside(c.reduced_crossings, t.reduced_crossings), count(c.live_crossings),
              count(c.misjudged)});
  add_values(report, "sizes", name,
             {{"complete", c.complete},
              {"complete_crossings", c.complete_crossings},
              {"reduced", c.reduced},
              {"reduced_crossings", c.reduced_crossings},
              {"computed_crossings", c.live_crossings}});
}

void symmetric_heading(Report& report) {
  report.heading({"pair", "vertices", "N_s", "n_s", "n_b", "event angles", "events: aligned, vertex, three, tight",
                  "near the event", "whole slices", "cpu ms, median (min; runs)", "us an event angle",
                  "slabs compared, different"});
}

void symmetric_line(Report& report, const ObstacleRow& r) {
  const double each = r.angles > 0 ? 1e3 * r.cpu.median() / static_cast<double>(r.angles) : 0;
  report.row({r.name, r.shapes, count(r.work.surfaces), count(r.patches), count(r.shells), count(r.angles),
              events(r.work), count(r.work.local_updates), count(r.work.slices),
              ms(r.cpu.median()) + " (" + ms(r.cpu.min()) + "; " + count(r.cpu.ms.size()) + ")", ms(each),
              count(r.slabs_compared) + ", " + count(r.slabs_different)});
  csv_line(report, "symmetric", r);
}

void rotation_heading(Report& report) {
  report.heading({"P/Q", "steps a turn", "update us, median", "mean", "p99", "worst", "static us, median", "mean",
                  "static / update", "of means", "windows", "us to build one", "from scratch", "of them undecided",
                  "pieces, pairs a frame", "collision tests", "vertices", "compared, different"});
}

void rotation_line(Report& report, const RotationRow& r) {
  const auto us = [](double v) { return fixed(1e3 * v, 1e3 * v < 100 ? 1 : 0); };
  report.row({r.name, count(static_cast<std::uint64_t>(r.steps)), us(r.update_ms.median), us(r.update_ms.mean),
              us(r.update_ms.p99), us(r.update_ms.worst), us(r.static_ms.median), us(r.static_ms.mean),
              "**" + ratio(r.static_ms.median, r.update_ms.median) + "**", ratio(r.static_ms.mean, r.update_ms.mean),
              count(r.windows), us(r.window_ms), count(r.rebuilt), count(r.degenerate),
              fixed(r.pieces, 0) + ", " + fixed(r.pairs, 0), fixed(r.collision_tests, 2), fixed(r.vertices, 0),
              count(r.compared) + ", " + count(r.different)});
  add_values(report, "rotation_" + count(static_cast<std::uint64_t>(r.steps)), r.name,
             {{"update_ms", r.update_ms.median},
              {"update_mean_ms", r.update_ms.mean},
              {"update_p99_ms", r.update_ms.p99},
              {"update_worst_ms", r.update_ms.worst},
              {"static_ms", r.static_ms.median},
              {"static_mean_ms", r.static_ms.mean},
              {"window_ms", r.window_ms},
              {"windows", r.windows},
              {"rebuilt", r.rebuilt},
              {"degenerate", r.degenerate},
              {"pieces", r.pieces},
              {"pairs", r.pairs},
              {"compared", r.compared},
              {"different", r.different}});
}

void promises(Report& report, const std::vector<ObstacleRow>& obstacles, const std::vector<SlicesRow>& slices,
              const std::vector<RotationRow>& rotations) {
  struct Promise {
    const char* name;
    double times, guide_s;
    const char* more;
  };
  for (const Promise& p : {Promise{"dog/bird", 10, 3, " (aim 1/30)"}, Promise{"star/star", 20, 0.1, ""},
                           Promise{"grate1/grate2", 20, 0, ""}, Promise{"grate3/grate4", 20, 0, ""}}) {
    const ObstacleRow* own = find(obstacles, p.name);
    const SlicesRow* row = find(slices, p.name);
    if (own == nullptr || row == nullptr) continue;
    const double gain = row->cgal_ms / own->cpu.median();
    report.promise(std::string(p.name) + ": at most 1/" + fixed(p.times, 0) + " of CGAL's 360 slices" + p.more,
                   "1/" + fixed(gain, 1), gain >= p.times);
    if (p.guide_s > 0)
      report.promise(std::string(p.name) + ": guide " + fixed(p.guide_s, 1) + " s of processor time",
                     fixed(own->cpu.median() / 1e3, 3) + " s", own->cpu.median() <= 1e3 * p.guide_s);
  }
  std::size_t frames_different = 0, different = 0;
  std::vector<double> gains;
  for (const RotationRow& r : rotations) {
    frames_different += r.different;
    if (r.steps != 500) continue;
    gains.push_back(r.static_ms.mean / r.update_ms.mean);
    report.promise(
        r.name + ": at 500 steps a turn the mean of all frames at least 3 times faster than our static engine",
        fixed(gains.back(), 1) + " times (medians " + fixed(r.static_ms.median / r.update_ms.median, 1) + ")",
        gains.back() >= 3);
  }
  if (!gains.empty())
    report.promise("the same, geometric mean of the pairs: at least 5 times", fixed(geometric_mean(gains), 1),
                   geometric_mean(gains) >= 5);
  if (!rotations.empty())
    report.promise("every frame equals the slice from scratch", count(frames_different) + " differ",
                   frames_different == 0);
  for (const ObstacleRow& r : obstacles) different += r.slabs_different;
  report.promise("every compared slab equals the slice of the static engine", count(different) + " differ",
                 different == 0);
}

void losses(Report& report, const std::vector<ObstacleRow>& obstacles, const std::vector<SlicesRow>& slices) {
  for (const SlicesRow& r : slices) {
    const ObstacleRow* own = find(obstacles, r.name);
    if (own == nullptr) continue;
    const auto compare = [&](double ms, const std::string& who) {
      if (ms > 0 && ms < own->cpu.median())
        report.line("- " + r.name + ": 360 slices by " + who + " take " + ratio(ms, own->cpu.median()) +
                    " of the obstacle's time.");
    };
    compare(r.ours_ms, "our static engine");
    compare(r.cgal_ms, "CGAL");
  }
}

}  // namespace dymsum::bench
