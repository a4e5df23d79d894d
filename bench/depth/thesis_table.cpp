#include "depth/thesis_table.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "depth/kinds.h"
#include "dymsum/local_sum.h"
#include "dymsum/moving_solid_sum.h"
#include "dymsum/orientation_sum.h"
#include "dymsum/planar_local_sum.h"
#include "dymsum/shapes.h"
#include "dymsum/solids.h"
#include "solid/inputs.h"

namespace dymsum::bench {
namespace {

double ms_of(const std::function<void()>& run) {
  const auto begin = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double median_of(std::vector<double> list) {
  std::sort(list.begin(), list.end());
  return list.empty() ? 0 : list[list.size() / 2];
}

/// Three bars along the axes that cross in the origin: the surface of seven cubes.
MeshData axes(double arm) {
  const std::vector<double> cut{-arm, -1, 1, arm};
  const auto cell = [](int x, int y, int z) {
    const auto in = [](int v) { return v >= 0 && v <= 2; };
    return in(x) && in(y) && in(z) && (x == 1) + (y == 1) + (z == 1) >= 2;
  };
  MeshData mesh;
  std::vector<int> number(64, -1);
  const auto vertex = [&](int x, int y, int z) {
    int& n = number[static_cast<std::size_t>(16 * x + 4 * y + z)];
    const auto at = [&](int k) { return cut[static_cast<std::size_t>(k)]; };
    if (n < 0) n = static_cast<int>(mesh.vertices.size()), mesh.vertices.push_back({at(x), at(y), at(z)});
    return static_cast<std::uint32_t>(n);
  };
  for (int k = 0; k < 27; ++k) {
    const std::array<int, 3> c{k / 9, k / 3 % 3, k % 3};
    if (!cell(c[0], c[1], c[2])) continue;
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        std::array<int, 3> next = c;
        next[static_cast<std::size_t>(axis)] += 2 * side - 1;
        if (cell(next[0], next[1], next[2])) continue;
        const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
        std::vector<std::uint32_t> face;
        for (const auto& [du, dv] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
          std::array<int, 3> at = c;
          at[static_cast<std::size_t>(axis)] += side, at[u] += du, at[v] += dv;
          face.push_back(vertex(at[0], at[1], at[2]));
        }
        if (side == 0) std::reverse(face.begin(), face.end());
        mesh.faces.push_back({{face[0], face[1], face[2]}, {}});
        mesh.faces.push_back({{face[0], face[2], face[3]}, {}});
      }
  }
  return mesh;
}

/// A profile (distance from the z axis, height), counter-clockwise, turned about the axis; its first and last point lie
/// on it.
MeshData revolved(const std::vector<Point>& profile, int slices) {
  MeshData mesh;
  const auto snapped = [](double v) { return std::round(v * 0x1p16) / 0x1p16; };
  const auto n = static_cast<std::uint32_t>(slices), rings = static_cast<std::uint32_t>(profile.size() - 2);
  for (std::uint32_t k = 1; k <= rings; ++k)
    for (std::uint32_t i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * i / n;
      mesh.vertices.push_back(
          {snapped(profile[k].x * std::cos(a)), snapped(profile[k].x * std::sin(a)), snapped(profile[k].y)});
    }
  const std::uint32_t bottom = rings * n, top = bottom + 1;
  mesh.vertices.push_back({0, 0, snapped(profile.front().y)}),
      mesh.vertices.push_back({0, 0, snapped(profile.back().y)});
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = (i + 1) % n;
    mesh.faces.push_back({{bottom, j, i}, {}});
    for (std::uint32_t k = 0; k + 1 < rings; ++k) {
      const std::uint32_t a = k * n + i, b = k * n + j, c = a + n, d = b + n;
      mesh.faces.push_back({{a, b, d}, {}}), mesh.faces.push_back({{a, d, c}, {}});
    }
    mesh.faces.push_back({{top, (rings - 1) * n + i, (rings - 1) * n + j}, {}});
  }
  return mesh;
}

MeshData cup() {
  return revolved({{0, 0},
                   {0.8, 0},
                   {1, 0.4},
                   {1.1, 1},
                   {1.2, 1.6},
                   {1.2, 2},
                   {1.1, 2},
                   {1.1, 1.6},
                   {1, 1},
                   {0.9, 0.5},
                   {0.7, 0.2},
                   {0, 0.2}},
                  50);
}

MeshData stretched(MeshData mesh, double x, double y, double z) {
  for (Point3& v : mesh.vertices) v = {v.x * x, v.y * y, v.z * z};
  return mesh;
}

struct ThesisPair {
  std::string name;
  MeshData p, q;
  std::array<double, 4> published;  // full, brute, hierarchy, gap filling, in ms
};

std::vector<ThesisPair> thesis_pairs() {
  const MeshData ring = torus(1, 0.4, 40, 25);
  return {{"cone 78 + axes 60",
           solids::cone(40, 1, 2, solids::kDemoSnap).data(),
           stretched(axes(5), 0.25, 0.25, 0.25),
           {58.91, 16.10, 24.23, 10.33}},
          {"spoon 1,352 + cup 1,000",
           stretched(blob(1, 0.2, 27, 26, 5), 2, 0.5, 0.25),
           cup(),
           {1393.61, 453.29, 69.38, 13.91}},
          {"fish 1,012 + torus 2,000",
           stretched(blob(1, 0.25, 23, 23, 9), 1, 0.5, 0.25),
           ring,
           {1719.12, 584.39, 185.82, 28.80}},
          {"torus 2,000 + torus 2,000", ring, turned(ring, 0.7, 0.3, 0.2), {2842.93, 1158.74, 390.65, 36.06}}};
}

struct LocalTimes {
  std::vector<double> updated, hierarchy, whole;
  double brute = 0;
  std::uint64_t faces = 0;
  bool same = true;
};

/// The ball lies about a vertex of the sum that is at the midpoint of its list, and stays there while P turns.
LocalTimes local_times(const ThesisPair& pair, int frames) {
  const Mesh p = Mesh::create(pair.p).value(), q = Mesh::create(pair.q).value();
  const SpatialSum sum = minkowski_sum(p, q).value();
  double size = 0;
  for (const Point3& v : sum.vertices) size = std::max(size, std::hypot(v.x, v.y, v.z));
  const ClipBall ball{sum.vertices[sum.vertices.size() / 2], size / 5};
  LocalOptions by_hierarchy, by_brute;
  by_hierarchy.engine = LocalEngine::hierarchy, by_brute.engine = LocalEngine::brute;
  LocalSum updated = LocalSum::create(p, q).value(), hierarchy = LocalSum::create(p, q, by_hierarchy).value();
  LocalTimes times;
  for (int k = 0; k < frames; ++k) {
    SolidPose pose;
    pose.rotation = Rotation::about({1, 2, 3}, 2 * std::numbers::pi * k / 500).value();
    std::optional<LocalPart> a, b;
    const double u = ms_of([&] { a = updated.in(ball, pose).value(); });
    const double h = ms_of([&] { b = hierarchy.in(ball, pose).value(); });
    if (k > 0) times.updated.push_back(u), times.hierarchy.push_back(h);
    times.same = times.same && *a == *b, times.faces += a->boundary.faces.size();
    if (k % 10 == 1) times.whole.push_back(ms_of([&] { posed_sum(p, q, pose).value(); }));
    if (k > 0 || pair.p.faces.size() > 100) continue;
    LocalSum brute = LocalSum::create(p, q, by_brute).value();
    std::optional<LocalPart> c;
    times.brute = ms_of([&] { c = brute.in(ball, pose).value(); });
    times.same = times.same && *a == *c;
  }
  return times;
}

}  // namespace

void thesis_table(int frames, Kind kind, Report& report) {
  report.line("\n## Table 7.1 of the thesis\n");
  report.line(
      "Stand-ins of equal size; P turns in steps of 1/500 turn; a ball of a fifth of the sum's radius, as in the "
      "thesis, "
      "about a vertex of it. Medians in milliseconds, the thesis's behind them. `brute` is our reference, which tests "
      "every cell of the whole sum by itself: for the smallest pair only.\n");
  report.heading({"pair", "faces in the ball", "whole", "brute", "hierarchy", "updated", "whole / updated",
                  "thesis: whole / updated", "same"});
  for (const ThesisPair& pair : with_coordinates(thesis_pairs(), kind, report)) {
    const LocalTimes t = local_times(pair, frames);
    const double whole = median_of(t.whole), updated = median_of(t.updated);
    const auto with = [&](double ours, int k) {
      return (ours > 0 ? fixed(ours, 2) : std::string("-")) + " (" +
             fixed(pair.published[static_cast<std::size_t>(k)], 1) + ")";
    };
    report.row({pair.name, fixed(static_cast<double>(t.faces) / frames, 0), with(whole, 0), with(t.brute, 1),
                with(median_of(t.hierarchy), 2), with(updated, 3), fixed(whole / updated, 1),
                fixed(pair.published[0] / pair.published[3], 0), t.same ? "yes" : "no"});
  }
}

void planar_local_sums(int frames, Kind kind, Report& report) {
  report.line("\n## Regions near a place\n");
  report.line(
      "P turns in steps of 1/500 turn; discs of a 20th of the sum's size about a vertex of it. Medians in "
      "milliseconds; "
      "the whole sum at the same pose.\n");
  report.heading(
      {"pair", "segments near", "edges", "updated", "hierarchy", "whole", "whole / updated", "rebuilt", "same"});
  struct Regions {
    std::string name;
    Region p, q;
  };
  const std::vector<Regions> pairs = {
      {"gear 400 + gear 400", shapes::gear(100, 9, 10, shapes::demo_snap(10)),
       shapes::gear(100, 4, 5, shapes::demo_snap(5))},
      {"star 1000 + star 1000", shapes::noisy_star(1000, 0.4, 3), shapes::noisy_star(1000, 0.4, 4)},
      {"polygon 400 + L", shapes::random_polygon(400, 4, 5), shapes::letter_l(0.1, 0.1, 0.03)}};
  for (Regions pair : pairs) {
    const Result<Region> made_p = with_coordinates(pair.p, kind), made_q = with_coordinates(pair.q, kind);
    if (!made_p || !made_q) {
      report.row({pair.name, "left out: " + (made_p ? made_q : made_p).error().to_string()});
      continue;
    }
    pair.p = *made_p, pair.q = *made_q;
    const PlanarSum sum = minkowski_sum(pair.p, pair.q).value();
    const SumRing& ring = sum.parts.front().outer;
    double size = 0;
    for (const SumVertex& v : ring.vertices) size = std::max({size, std::abs(v.at.x), std::abs(v.at.y)});
    PlanarLocalOptions by_hierarchy;
    by_hierarchy.engine = LocalEngine::hierarchy;
    PlanarLocalSum updated = PlanarLocalSum::create(pair.p, pair.q).value(),
                   hierarchy = PlanarLocalSum::create(pair.p, pair.q, by_hierarchy).value();
    std::vector<double> u, h, whole;
    std::uint64_t segments = 0, edges = 0, rebuilt = 0;
    bool same = true;
    for (int k = 0; k < frames; ++k) {
      PlanarPose pose;
      pose.rotation = Orientation::nearest(2 * std::numbers::pi * k / 500, 1e-6).value();
      const PlanarDisc disc{ring.vertices[static_cast<std::size_t>(k / 10) * 7919 % ring.vertices.size()].at,
                            size / 20};
      std::optional<PlanarLocalPart> a, b;
      u.push_back(ms_of([&] { a = updated.in(disc, pose).value(); }));
      h.push_back(ms_of([&] { b = hierarchy.in(disc, pose).value(); }));
      if (k % 10 == 0) whole.push_back(ms_of([&] { rotated_sum(pair.p, pair.q, pose.rotation).value(); }));
      same = same && *a == *b;
      segments += a->work.segments, edges += a->edges.size(), rebuilt += a->work.rebuilt;
    }
    const auto mean = [&](std::uint64_t v) { return fixed(static_cast<double>(v) / frames, 0); };
    report.row({pair.name, mean(segments), mean(edges), fixed(median_of(u), 3), fixed(median_of(h), 3),
                fixed(median_of(whole), 2), fixed(median_of(whole) / median_of(u), 1),
                std::to_string(rebuilt) + " of " + std::to_string(frames), same ? "yes" : "no"});
  }
}

}  // namespace dymsum::bench
