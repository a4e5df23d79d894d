#include "depth/other_systems.h"

#include <chrono>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "dymsum/mesh_io.h"
#include "dymsum/penetration_depth.h"
#include "dymsum/solids.h"
#include "page.h"
#include "python.h"
#include "solid/inputs.h"
#include "versus/bullet.h"
#include "versus/fcl_meshes.h"

namespace dymsum::bench {
namespace {

void convex_row(const std::string& name, const std::string& system, double us, double width,
                const std::vector<double>& depths, const std::vector<double>& truth, Report& report) {
  int wrong = 0, none = 0;
  double worst = 0;
  for (std::size_t k = 0; k < depths.size(); ++k) {
    const double error = std::abs(depths[k] - truth[k]) / width;
    none += std::isnan(error), wrong += error > 1e-6;
    if (error > worst) worst = error;
  }
  std::ostringstream text;
  text << worst;
  report.row({name, system, fixed(us / static_cast<double>(truth.size()), 1), std::to_string(none),
              std::to_string(wrong), text.str()});
}

/// By its own clock, with its own tolerances.
void coal_row(const std::string& name, const Mesh& p, const Mesh& q, double width, const std::vector<Point3>& positions,
              const std::vector<double>& truth, Report& report) {
  if (!has_python()) return;
  std::ostringstream queries;
  queries << std::setprecision(17);
  for (const Point3& at : positions) queries << "1 0 0 0 1 0 0 0 1 " << at.x << " " << at.y << " " << at.z << "\n";
  std::istringstream answer(query_python("coal_depth.py",
                                         {{"p.off", format_mesh(p, MeshFormat::off)},
                                          {"q.off", format_mesh(q, MeshFormat::off)},
                                          {"queries.txt", queries.str()}},
                                         "0", 120));
  std::string version;
  double us = 0;
  answer >> version >> us;
  std::vector<double> depths;
  for (double depth; answer >> depth;) depths.push_back(depth);
  if (depths.size() == positions.size()) convex_row(name, "Coal " + version, us, width, depths, truth, report);
}

struct CoalMeshes {
  std::string distance = "-", contacts = "-", deepest = "-";
};

CoalMeshes coal_meshes(const Mesh& p, const Mesh& q, Point3 at) {
  if (!has_python()) return {};
  std::ostringstream move;
  move << std::setprecision(17) << "'" << at.x << " " << at.y << " " << at.z << "'";
  std::istringstream answer(query_python(
      "coal_meshes.py", {{"p.off", format_mesh(p, MeshFormat::off)}, {"q.off", format_mesh(q, MeshFormat::off)}},
      move.str(), 60));
  std::string version;
  double distance = 0, deepest = 0;
  std::size_t contacts = 0;
  if (!(answer >> version >> distance >> contacts >> deepest)) return {};
  return {fixed(distance, 4), std::to_string(contacts), fixed(deepest, 2)};
}

void mesh_row(const std::string& name, double truth, const Mesh& p, const Mesh& q, Point3 at, Report& report) {
  const SolidDistance d = SolidDepth::create(p, q).value().at(at);
  const double ours = d.meeting == Meeting::overlapping ? -d.distance : d.distance;
  const MeshAnswer fcl = fcl_mesh_distance(p.data(), q.data(), at);
  const CoalMeshes coal = coal_meshes(p, q, at);
  const BulletMeshes bullet = bullet_meshes(p.data(), q.data(), at);
  report.row({name, fixed(truth, 4), fixed(ours, 4), fixed(fcl.signed_distance, 4), std::to_string(fcl.contacts),
              fixed(fcl.deepest, 2), coal.distance, coal.contacts, coal.deepest, std::to_string(bullet.contacts),
              fixed(bullet.deepest, 2)});
}

}  // namespace

void other_convex_rows(const std::string& name, const Mesh& p, const Mesh& q, double width,
                       const std::vector<Point3>& positions, const std::vector<double>& truth, Report& report) {
  const BulletPair bullet(p, q);
  std::vector<double> depths;
  const auto begin = std::chrono::steady_clock::now();
  for (const Point3& at : positions) depths.push_back(bullet.depth(at));
  const double us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
  convex_row(name, "Bullet GJK + EPA", us, width, depths, truth, report);
  coal_row(name, p, q, width, positions, truth, report);
}

void mesh_rows(Report& report) {
  report.line("\n## Meshes\n");
  report.line(
      "Signed distances, below 0 inside; numbers of contacts (FCL and Coal are asked for 1,000 at most) and the "
      "largest "
      "depth of them. The truth is known by construction. FCL 0.7 and Coal: BVHModel of OBBRSS; Bullet: GImpact "
      "meshes, "
      "which have no distance. `./run bench depth --only meshes` prints this table alone.\n");
  report.heading({"case", "truth", "dymsum", "FCL", "contacts", "deepest", "Coal", "contacts", "deepest",
                  "Bullet contacts", "deepest"});
  for (const int k : {1, 2, 4, 8})
    mesh_row("cubes of 2 that overlap by 0.5, " + std::to_string(12 * k * k) + " triangles", -0.5,
             solids::tessellated_cube(2, k, solids::kDemoSnap), solids::tessellated_cube(2, k, solids::kDemoSnap),
             {1.5, 0, 0}, report);
  mesh_row("the same, moved aside by 1/8 and 1/4", -0.5, solids::tessellated_cube(2, 1, solids::kDemoSnap),
           solids::tessellated_cube(2, 1, solids::kDemoSnap), {1.5, 0.125, 0.25}, report);
  mesh_row("a cube of 0.4 inside one of 2", -1.2, solids::tessellated_cube(2, 1, solids::kDemoSnap),
           solids::tessellated_cube(0.4, 1, solids::kDemoSnap), {}, report);
  const Mesh pipe = Mesh::create(tunnel()).value();
  mesh_row("a cube of 1 in a tunnel of 2, 0.25 into its wall", -0.25, pipe,
           solids::tessellated_cube(1, 1, solids::kDemoSnap), {0, 0.75, 0}, report);
  mesh_row("a cube of 1 in a tunnel of 2", 0.5, pipe, solids::tessellated_cube(1, 1, solids::kDemoSnap), {}, report);
}

}  // namespace dymsum::bench
