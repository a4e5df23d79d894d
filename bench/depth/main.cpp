// dymsum_bench_depth: penetration depth along motions, against FCL, libccd, Bullet and Coal on convex pairs and meshes.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "depth/continuous.h"
#include "depth/gap_filling.h"
#include "depth/kinds.h"
#include "depth/other_systems.h"
#include "depth/thesis_table.h"
#include "dymsum/local_sum.h"
#include "dymsum/moving_solid_sum.h"
#include "dymsum/penetration_depth.h"
#include "dymsum/solids.h"
#include "page.h"
#include "solid/inputs.h"
#include "versus/solid_rivals.h"

namespace dymsum::bench {
namespace {

double us_of(const std::function<void()>& run) {
  const auto begin = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
}

struct MotionPair {
  std::string name;
  MeshData p, q;
  double reach;
};

std::vector<MotionPair> motion_pairs() {
  return {{"torus 1024 + torus 1024", torus(1, 0.4, 32, 16), turned(torus(1, 0.4, 32, 16), 0.7, 0.3, 0.2), 1.6},
          {"blob 1012 + blob 1012", blob(1, 0.3, 23, 23, 1), blob(1, 0.3, 23, 23, 2), 1.6},
          {"gear 380 + gear 380", gear(24, 10), gear(24, 10), 14},
          {"ell + tunnel", ell(), tunnel(), 8}};
}

/// Along a closed curve through and around P.
Point3 position_on_curve(double reach, int k, int steps) {
  const double a = 2 * std::numbers::pi * k / steps, r = reach * (0.35 + 0.3 * std::sin(3 * a));
  return {r * std::cos(a), r * std::sin(a), 0.3 * r * std::sin(2 * a)};
}

void motions(int steps, Kind kind, Report& report) {
  report.line("\n## Along a motion\n");
  report.line(
      "Q follows a closed curve. `prepare` makes the facets of the convolution once; the first step and the others are "
      "told apart, as the later ones know what the last answers covered.\n");
  report.heading({"pair", "facets", "prepare ms", "overlapping", "first us", "median us", "p99 us", "worst us",
                  "facets a step", "positions", "exact tests"});
  for (const MotionPair& pair : with_coordinates(motion_pairs(), kind, report)) {
    const Mesh p = Mesh::create(pair.p).value(), q = Mesh::create(pair.q).value();
    std::optional<SolidDepth> depth;
    const double prepare = us_of([&] { depth = SolidDepth::create(p, q).value(); });
    std::vector<double> us;
    double first = 0;
    SolidDistance::Work work;
    int overlapping = 0;
    for (int k = 0; k < steps; ++k) {
      SolidDistance d;
      const double t = us_of([&] { d = depth->at(position_on_curve(pair.reach, k, steps)); });
      overlapping += d.meeting == Meeting::overlapping;
      if (k == 0) {
        first = t;
        continue;
      }
      us.push_back(t);
      work.facets += d.work.facets, work.candidates += d.work.candidates, work.exact_tests += d.work.exact_tests;
    }
    std::sort(us.begin(), us.end());
    const auto mean = [&](std::uint64_t v) { return fixed(static_cast<double>(v) / (steps - 1), 0); };
    report.row({pair.name, std::to_string(depth->facet_count()), fixed(prepare / 1000, 1),
                std::to_string(overlapping) + " of " + std::to_string(steps), fixed(first, 0),
                fixed(us[us.size() / 2], 0), fixed(us[us.size() * 99 / 100], 0), fixed(us.back(), 0), mean(work.facets),
                mean(work.candidates), mean(work.exact_tests)});
  }
}

void convex_pairs(Kind kind, Report& report) {
  report.line("\n## Convex pairs\n");
  report.line("Q somewhere inside P, 200 translations. Ours is exact; the others' errors are relative to P's width.\n");
  report.heading({"pair", "system", "us a query", "no answer", "wrong by more than 1e-6", "largest error"});
  const std::vector<solids::NamedMesh> models = solids::thesis_models();
  const auto named = [&](std::string_view name) {
    const auto at = std::find_if(models.begin(), models.end(), [&](const auto& m) { return m.name == name; });
    return hull_with_coordinates(at->mesh, kind).value();
  };
  const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (const auto& [a, b] : {std::pair{"cube", "T"}, {"T", "TI"}, {"GS1", "cylinder"}}) {
    const Mesh p = named(a), q = named(b);
    double width = 0;
    for (const Point3& v : p.vertices())
      width = std::max({width, 2 * std::abs(v.x), 2 * std::abs(v.y), 2 * std::abs(v.z)});
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> offset(-0.3 * width, 0.3 * width);
    std::vector<Point3> positions(200);
    for (Point3& at : positions) at = {offset(random), offset(random), offset(random)};
    SolidDepth ours = SolidDepth::create(p, q).value();
    std::vector<double> truth;
    const double our_us = us_of([&] {
      for (const Point3& at : positions) truth.push_back(ours.at(at).distance);
    });
    const std::string name = std::string(a) + " + " + b;
    report.row({name, "dymsum", fixed(our_us / 200, 1), "0", "0", "0"});
    const DepthPair rivals(p, q);
    for (const DepthRival rival :
         {DepthRival::fcl, DepthRival::fcl_tight, DepthRival::ccd_gjk_epa, DepthRival::ccd_mpr}) {
      int wrong = 0, none = 0;
      double worst = 0;
      const double us = us_of([&] {
        for (std::size_t k = 0; k < positions.size(); ++k) {
          const double error = std::abs(rivals.depth(rival, identity, positions[k]) - truth[k]) / width;
          none += std::isnan(error), wrong += error > 1e-6, worst = std::max(worst, error);
        }
      });
      std::ostringstream text;
      text << worst;
      report.row({name, dymsum::bench::name(rival), fixed(us / 200, 1), std::to_string(none), std::to_string(wrong),
                  text.str()});
    }
    other_convex_rows(name, p, q, width, positions, truth, report);
  }
}

/// Translations anywhere about P, on all cores; a part of them again on one thread, which has to answer the same.
void batch(std::size_t first_rows, Kind kind, Report& report) {
  const std::vector<MotionPair> pairs = with_coordinates(motion_pairs(), kind, report);
  report.line("\n## A batch\n");
  report.line(
      "Translations of Q at random, without order, on all cores. `late`: rows that a limit of 20 ms each leaves with "
      "bounds, in a run of its own. The last column compares rows with those of one thread.\n");
  report.heading({"pair", "rows", "seconds", "rows a second", "overlapping", "late", "same rows"});
  for (const MotionPair& pair : pairs) {
    const std::size_t rows = &pair == &pairs.front() ? first_rows : 300;
    const SolidDepth depth = SolidDepth::create(Mesh::create(pair.p).value(), Mesh::create(pair.q).value()).value();
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> offset(-0.65 * pair.reach, 0.65 * pair.reach);
    std::vector<Point3> moves(rows);
    for (Point3& at : moves) at = {offset(random), offset(random), 0.3 * offset(random)};
    DepthBatchOptions limited;
    limited.time_limit = 0.02;
    std::size_t late = 0, overlapping = 0;
    for (const SolidDistance& row : depth_batch(depth, moves, limited).value()) late += !row.complete;
    std::vector<SolidDistance> answers;
    const double us = us_of([&] { answers = depth_batch(depth, moves).value(); });
    for (const SolidDistance& row : answers) overlapping += row.meeting == Meeting::overlapping;
    DepthBatchOptions single;
    single.threads = 1;
    const std::size_t part = std::min<std::size_t>(rows, 500);
    const std::vector<SolidDistance> again = depth_batch(depth, std::span(moves).first(part), single).value();
    const bool same = std::equal(again.begin(), again.end(), answers.begin());
    report.row({pair.name, std::to_string(rows), fixed(us / 1e6, 1), fixed(static_cast<double>(rows) / us * 1e6, 0),
                std::to_string(overlapping), std::to_string(late), same ? "yes" : "no"});
  }
}

/// Local sums while P turns, in balls about vertices of the sum, against the whole sum at the same poses.
void local_sums(int frames, Kind kind, Report& report) {
  report.line("\n## Sums near a place\n");
  report.line(
      "P turns in steps of 1/500 turn; a ball about a vertex of the sum, its radius a 20th of the sum's size, another "
      "one every ten frames. Milliseconds: the part by update and by hierarchy, medians and worst; the whole sum at "
      "the same pose, and with the engine that tests every cell, then cut. The last column compares all of them.\n");
  report.heading({"pair", "faces", "near", "updated median", "worst", "hierarchy median", "worst", "brute", "whole sum",
                  "gain on whole", "same"});
  for (const MotionPair& pair : with_coordinates(motion_pairs(), kind, report)) {
    const Mesh p = Mesh::create(pair.p).value(), q = Mesh::create(pair.q).value();
    const SpatialSum sum = minkowski_sum(p, q).value();
    double size = 0;
    for (const Point3& v : sum.vertices) size = std::max({size, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    LocalOptions by_hierarchy, by_brute;
    by_hierarchy.engine = LocalEngine::hierarchy, by_brute.engine = LocalEngine::brute;
    LocalSum updated = LocalSum::create(p, q).value(), hierarchy = LocalSum::create(p, q, by_hierarchy).value(),
             brute = LocalSum::create(p, q, by_brute).value();
    std::vector<double> ms[2];
    double brute_ms = 0, whole_ms = 0;
    std::uint64_t faces = 0, near = 0;
    bool same = true;
    for (int k = 0; k < frames; ++k) {
      SolidPose pose;
      pose.rotation = Rotation::about({1, 2, 3}, 2 * std::numbers::pi * k / 500).value();
      const ClipBall ball{sum.vertices[static_cast<std::size_t>(k / 10) * 7919 % sum.vertices.size()], size / 20};
      std::optional<LocalPart> a, b, c;
      const double u = us_of([&] { a = updated.in(ball, pose).value(); }) / 1000;
      const double h = us_of([&] { b = hierarchy.in(ball, pose).value(); }) / 1000;
      if (k > 0) ms[0].push_back(u), ms[1].push_back(h);
      same = same && *a == *b;
      faces += a->boundary.faces.size(), near += a->work.facets;
      if (k > 0) continue;
      whole_ms = us_of([&] { posed_sum(p, q, pose).value(); }) / 1000;
      if (pair.name.starts_with("blob") || pair.name.starts_with("gear")) continue;  // minutes
      brute_ms = us_of([&] { c = brute.in(ball, pose).value(); }) / 1000;
      same = same && *a == *c;
    }
    for (std::vector<double>& list : ms) std::sort(list.begin(), list.end());
    const double median = ms[0][ms[0].size() / 2];
    const auto mean = [&](std::uint64_t v) { return fixed(static_cast<double>(v) / frames, 0); };
    report.row({pair.name, mean(faces), mean(near), fixed(median, 2), fixed(ms[0].back(), 2),
                fixed(ms[1][ms[1].size() / 2], 2), fixed(ms[1].back(), 2), brute_ms > 0 ? fixed(brute_ms, 0) : "-",
                fixed(whole_ms, 1), fixed(whole_ms / median, 0), same ? "yes" : "no"});
  }
}

/// The thesis's update of local sums in place of ours, in a box that stays where it is while P turns.
void gap_filling(int frames, Kind kind, Report& report) {
  report.line("\n## The thesis's gap filling\n");
  report.line(
      "The same part in a box, kept by the thesis's method (7.2.3) and by ours, while P turns in steps of 1/500 turn "
      "and the box stays. `ended`: facets a frame that hold no longer; `queries`: boxes a frame that are searched "
      "about "
      "open ends of the surface. `wrong`: frames whose part is not the exact one, of which `open` with a surface that "
      "still ends inside the box; the others look finished.\n");
  report.heading({"pair", "frames", "ended", "repaired", "queries", "gap filling median ms", "worst", "ours median ms",
                  "worst", "gain", "wrong", "open"});
  for (const MotionPair& pair : with_coordinates(motion_pairs(), kind, report)) {
    const Mesh p = Mesh::create(pair.p).value(), q = Mesh::create(pair.q).value();
    const SpatialSum sum = minkowski_sum(p, q).value();
    double size = 0;
    for (const Point3& v : sum.vertices) size = std::max({size, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    const ClipBox box = bounding_box({sum.vertices[7919 % sum.vertices.size()], size / 20});
    LocalOptions options;
    options.tight = false;
    LocalSum ours = LocalSum::create(p, q, options).value();
    GapFilling theirs(p, q);
    std::vector<double> ms[2];
    GapFillingWork work;
    int wrong = 0, open = 0;
    for (int k = 0; k < frames; ++k) {
      SolidPose pose;
      pose.rotation = Rotation::about({1, 2, 3}, 2 * std::numbers::pi * k / 500).value();
      std::optional<LocalPart> a, b;
      const double t = us_of([&] { a = ours.in(box, pose).value(); }) / 1000;
      const double g = us_of([&] { b = theirs.in(box, pose); }) / 1000;
      if (k == 0) continue;
      ms[0].push_back(g), ms[1].push_back(t);
      wrong += !(*a == *b), open += !(*a == *b) && !theirs.work().closed;
      work.ended += theirs.work().ended, work.repaired += theirs.work().repaired;
      work.queries += theirs.work().queries;
    }
    for (std::vector<double>& list : ms) std::sort(list.begin(), list.end());
    const double g = ms[0][ms[0].size() / 2], t = ms[1][ms[1].size() / 2];
    const auto mean = [&](std::uint64_t v) { return fixed(static_cast<double>(v) / (frames - 1), 1); };
    report.row({pair.name, std::to_string(frames - 1), mean(work.ended), mean(work.repaired), mean(work.queries),
                fixed(g, 2), fixed(ms[0].back(), 2), fixed(t, 2), fixed(ms[1].back(), 2), fixed(g / t, 1),
                std::to_string(wrong), std::to_string(open)});
  }
}

constexpr const char* kUsage =
    "dymsum_bench_depth [--steps N] [--only PART] [--continuity N] [--long | --off-grid] [--coordinates KIND]\n"
    "                   [--results DIR]\n"
    "  With --coordinates without the part `meshes`: their depths are known of the coordinates they have.\n";

struct Options {
  int steps = 1000;
  bool is_long = false;
  long walked = 0;
  std::string results, only;
  KindOptions coordinates;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int k = 1; k < argc; ++k) {
    const auto value = [&](const char* flag) -> const char* {
      return std::strcmp(argv[k], flag) == 0 && k + 1 < argc ? argv[++k] : nullptr;
    };
    if (const char* steps = value("--steps")) options.steps = std::max(10, std::atoi(steps));
    else if (const char* dir = value("--results")) options.results = dir;
    else if (std::strcmp(argv[k], "--long") == 0) options.is_long = true;
    else if (const char* walked = value("--continuity")) options.walked = std::max(1200L, std::atol(walked));
    else if (const char* part = value("--only")) options.only = part;
    else if (!options.coordinates.take(argc, argv, k)) throw std::invalid_argument(std::string(kUsage) + kKindUsage);
  }
  return options;
}

void run_continuity(const Options& options, Kind kind) {
  const std::string folder = KindOptions::folder(options.results, kind);
  Report report;
  report.line("# Continuous depth");
  report.line("\n`./run bench depth --continuity 1000000 --results docs/results` makes this page and figure-7.4.svg.");
  if (kind) report.line("\nCoordinates: " + name(*kind) + ".");
  continuity(options.walked, kind, report);
  two_rates(10, kind, report);
  write_result(folder, "continuous-depth.md", report.markdown.str());
  if (!kind) write_result(folder, "figure-7.4.svg", folder.empty() ? "" : figure_7_4());
}

void run_kind(const Options& options, Kind kind) {
  Report report;
  report.line("# Penetration depth");
  report.line(
      "\n`./run bench depth --long --results docs/results` makes this page; without --long the first batch has 1,000 "
      "rows, too.");
  if (kind) report.line("\nCoordinates: " + name(*kind) + ".");
  const std::vector<std::pair<std::string, std::function<void()>>> parts = {
      {"motions", [&] { motions(options.steps, kind, report); }},
      {"batch", [&] { batch(options.is_long ? 100000 : 1000, kind, report); }},
      {"local-sums", [&] { local_sums(21, kind, report); }},
      {"thesis-table", [&] { thesis_table(21, kind, report); }},
      {"planar-local-sums", [&] { planar_local_sums(100, kind, report); }},
      {"gap-filling", [&] { gap_filling(100, kind, report); }},
      {"convex-pairs", [&] { convex_pairs(kind, report); }},
      {"meshes", [&] { mesh_rows(report); }}};
  for (const auto& [name, make] : parts)
    if ((options.only.empty() || options.only == name) && !(kind && name == "meshes")) make();
  write_result(KindOptions::folder(options.results, kind), "depth.md", report.markdown.str());
}

int run(int argc, char** argv) {
  const Options options = parse(argc, argv);
  const bool whole = options.walked == 0 && options.only.empty() && !options.coordinates.chosen();
  if (!options.coordinates.off_grid)
    for (const Kind& kind : options.coordinates.kinds) {
      if (options.walked > 0) run_continuity(options, kind);
      else run_kind(options, kind);
    }
  return !(options.coordinates.off_grid || whole) || measure_kinds(options.results) ? 0 : 3;
}

}  // namespace
}  // namespace dymsum::bench

int main(int argc, char** argv) { return dymsum::bench::guarded(dymsum::bench::run, argc, argv); }
