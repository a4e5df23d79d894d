#include "depth/kinds.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "dymsum/local_sum.h"
#include "dymsum/moving_solid_sum.h"
#include "dymsum/penetration_depth.h"
#include "off_grid.h"
#include "versus/rival.h"

namespace dymsum::bench {
namespace {

/// Along a closed curve through and around P.
std::vector<Point3> positions_on_curve(double reach, int steps) {
  std::vector<Point3> positions;
  for (int k = 0; k < steps; ++k) {
    const double a = 2 * std::numbers::pi * k / steps, r = reach * (0.35 + 0.3 * std::sin(3 * a));
    positions.push_back({r * std::cos(a), r * std::sin(a), 0.3 * r * std::sin(2 * a)});
  }
  return positions;
}

OffGridCase depth_case(const std::string& name, const MeshData& p, const MeshData& q, double reach, int steps) {
  return off_grid_case("depth, " + name, Mesh::create(p).value(), Mesh::create(q).value(),
                       [=](const Mesh& a, const Mesh& b) {
                         const std::vector<Point3> positions = positions_on_curve(reach, steps);
                         OffGridWork work;
                         work.run = [=] {
                           SolidDepth depth = SolidDepth::create(a, b).value();
                           for (const Point3& at : positions) depth.at(at);
                           return positions.size();
                         };
                         work.compare = [=] {
                           DepthOptions boundary;
                           boundary.engine = DepthEngine::boundary;
                           SolidDepth ours = SolidDepth::create(a, b).value();
                           SolidDepth theirs = SolidDepth::create(a, b, boundary).value();
                           constexpr std::size_t kCompared = 20;
                           std::size_t different = 0;
                           for (std::size_t k = 0; k < kCompared; ++k) {
                             const Point3 at = positions[k * positions.size() / kCompared];
                             const SolidDistance x = ours.at(at), y = theirs.at(at);
                             different += x.meeting != y.meeting || !(x.squared == y.squared);
                           }
                           const bool wrong = different > 0;
                           return Compared{wrong ? std::to_string(different) + " DIFFERENT" : "equal", wrong, 0};
                         };
                         return work;
                       });
}

SolidPose solid_pose(int frame) {
  SolidPose pose;
  pose.rotation = Rotation::about({1, 2, 3}, 2 * std::numbers::pi * frame / 500).value();
  return pose;
}

/// The part in a ball about a vertex of the sum while P turns there and back.
OffGridCase local_case(const std::string& name, const MeshData& p, const MeshData& q) {
  return off_grid_case(
      "near a place, " + name, Mesh::create(p).value(), Mesh::create(q).value(), [](const Mesh& a, const Mesh& b) {
        constexpr int kFrames = 10;
        const SpatialSum sum = minkowski_sum(a, b).value();
        double size = 0;
        for (const Point3& v : sum.vertices) size = std::max({size, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
        // The vertex that lies furthest along a direction is the same one in all kinds but for turning.
        const auto along = [](const Point3& v) { return 3 * v.x + 2 * v.y + v.z; };
        const Point3 at = *std::max_element(sum.vertices.begin(), sum.vertices.end(),
                                            [&](const Point3& u, const Point3& v) { return along(u) < along(v); });
        const ClipBall ball{at, size / 10};
        const auto updated = std::make_shared<LocalSum>(LocalSum::create(a, b).value());
        OffGridWork work;
        work.run = [=] {
          std::size_t faces = 0;
          for (int k = 1; k <= 2 * kFrames; ++k)
            faces += updated->in(ball, solid_pose(k <= kFrames ? k : 2 * kFrames - k)).value().boundary.faces.size();
          return faces;
        };
        work.compare = [=] {
          LocalOptions options;
          options.engine = LocalEngine::hierarchy;
          LocalSum hierarchy = LocalSum::create(a, b, options).value();
          std::size_t different = 0;
          for (int k = 1; k <= kFrames; ++k)
            different += !(updated->in(ball, solid_pose(k)).value() == hierarchy.in(ball, solid_pose(k)).value());
          const double start = cpu_ms();
          posed_sum(a, b, solid_pose(kFrames)).value();
          const double whole = 2 * kFrames * (cpu_ms() - start);
          return Compared{different > 0 ? std::to_string(different) + " DIFFERENT" : "equal", different > 0, whole};
        };
        return work;
      });
}

}  // namespace

bool measure_kinds(const std::string& folder) {
  const MeshData ring = torus(1, 0.4, 16, 8), other = turned(ring, 0.7, 0.3, 0.2);
  return off_grid_table(
      {"depth",
       "Penetration depth: preparing a pair and asking at places on a curve (per question). Near a place: the "
       "part of a sum in a ball while P turns there and back (per face of it).",
       "piece", "whole sums",
       "Whole sums: at as many poses, from scratch. Compared: depths of small pairs with those of the exact sum's "
       "boundary; parts with those made by the hierarchy alone."},
      {depth_case("torus 256 + torus 256", ring, other, 1.6, 100), depth_case("ell + tunnel", ell(), tunnel(), 8, 100),
       local_case("torus 256 + torus 256", ring, other), local_case("ell + tunnel", ell(), tunnel())},
      folder);
}

}  // namespace dymsum::bench
