#include "versus/solid_rivals.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <ccd/ccd.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>

#include "versus/rival.h"

namespace dymsum::bench {

HullAnswer cgal_hull_of_sums(const std::vector<Point3>& p, const std::vector<Point3>& q) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const double start = cpu_ms();
  std::vector<Kernel::Point_3> sums;
  sums.reserve(p.size() * q.size());
  for (const Point3& a : p)
    for (const Point3& b : q) sums.emplace_back(a.x + b.x, a.y + b.y, a.z + b.z);
  CGAL::Surface_mesh<Kernel::Point_3> hull;
  CGAL::convex_hull_3(sums.begin(), sums.end(), hull);
  HullAnswer answer;
  answer.ms = cpu_ms() - start;
  answer.vertices = hull.number_of_vertices();
  answer.volume = CGAL::to_double(CGAL::Polygon_mesh_processing::volume(hull));
  return answer;
}

const char* name(DepthRival rival) {
  switch (rival) {
    case DepthRival::fcl:
      return "FCL 0.7, its own tolerance";
    case DepthRival::fcl_tight:
      return "FCL 0.7, tolerance 1e-12";
    case DepthRival::ccd_gjk_epa:
      return "libccd GJK/EPA";
    case DepthRival::ccd_mpr:
      return "libccd MPR";
  }
  return "";
}

namespace {

std::shared_ptr<fcl::Convex<double>> fcl_convex(const Mesh& mesh) {
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Point3& v : mesh.vertices()) vertices->emplace_back(v.x, v.y, v.z);
  auto faces = std::make_shared<std::vector<int>>();
  for (const Face& f : mesh.faces()) {
    faces->push_back(static_cast<int>(f.size()));
    for (const std::uint32_t v : f) faces->push_back(static_cast<int>(v));
  }
  return std::make_shared<fcl::Convex<double>>(vertices, static_cast<int>(mesh.faces().size()), faces);
}

/// A turned and moved point set for libccd: the support vertex by looking at all of them, as its examples do.
struct CcdObject {
  const std::vector<Point3>* vertices;
  double m[9];
  Point3 at;
};

Point3 placed(const CcdObject& o, const Point3& v) {
  return {o.m[0] * v.x + o.m[1] * v.y + o.m[2] * v.z + o.at.x, o.m[3] * v.x + o.m[4] * v.y + o.m[5] * v.z + o.at.y,
          o.m[6] * v.x + o.m[7] * v.y + o.m[8] * v.z + o.at.z};
}

void ccd_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const auto& o = *static_cast<const CcdObject*>(object);
  const double x = direction->v[0], y = direction->v[1], z = direction->v[2];
  const double dx = o.m[0] * x + o.m[3] * y + o.m[6] * z, dy = o.m[1] * x + o.m[4] * y + o.m[7] * z,
               dz = o.m[2] * x + o.m[5] * y + o.m[8] * z;
  const Point3* best = &o.vertices->front();
  double most = -1e300;
  for (const Point3& v : *o.vertices) {
    const double d = dx * v.x + dy * v.y + dz * v.z;
    if (d <= most) continue;
    most = d;
    best = &v;
  }
  const Point3 at = placed(o, *best);
  ccdVec3Set(out, at.x, at.y, at.z);
}

void ccd_center(const void* object, ccd_vec3_t* out) {
  const auto& o = *static_cast<const CcdObject*>(object);
  Point3 sum;
  for (const Point3& v : *o.vertices) sum = {sum.x + v.x, sum.y + v.y, sum.z + v.z};
  const auto n = static_cast<double>(o.vertices->size());
  const Point3 at = placed(o, {sum.x / n, sum.y / n, sum.z / n});
  ccdVec3Set(out, at.x, at.y, at.z);
}

}  // namespace

struct DepthPair::Objects {
  Mesh p, q;
  std::shared_ptr<fcl::Convex<double>> fcl_p, fcl_q;
};

DepthPair::DepthPair(const Mesh& p, const Mesh& q) : objects_(new Objects{p, q, fcl_convex(p), fcl_convex(q)}) {}
DepthPair::~DepthPair() = default;

double DepthPair::depth(DepthRival rival, const double (&m)[9], Point3 at) const {
  if (rival == DepthRival::fcl || rival == DepthRival::fcl_tight) {
    fcl::Transform3d a = fcl::Transform3d::Identity(), b = fcl::Transform3d::Identity();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) a.linear()(r, c) = m[3 * r + c];
    b.translation() = fcl::Vector3d(at.x, at.y, at.z);
    fcl::CollisionRequest<double> request(1, true);
    request.gjk_solver_type = fcl::GST_LIBCCD;
    if (rival == DepthRival::fcl_tight) request.gjk_tolerance = 1e-12;
    fcl::CollisionResult<double> result;
    const fcl::CollisionObject<double> x(objects_->fcl_p, a), y(objects_->fcl_q, b);
    fcl::collide(&x, &y, request, result);
    return result.isCollision() ? result.getContact(0).penetration_depth : 0;
  }
  CcdObject x{&objects_->p.vertices(), {}, {0, 0, 0}}, y{&objects_->q.vertices(), {1, 0, 0, 0, 1, 0, 0, 0, 1}, at};
  std::copy(m, m + 9, x.m);
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = ccd_support;
  ccd.center1 = ccd.center2 = ccd_center;
  ccd.max_iterations = 200;
  ccd.epa_tolerance = 1e-8;
  ccd.mpr_tolerance = 1e-8;
  ccd_real_t depth = 0;
  ccd_vec3_t direction, position;
  const int apart = rival == DepthRival::ccd_gjk_epa ? ccdGJKPenetration(&x, &y, &ccd, &depth, &direction, &position)
                                                     : ccdMPRPenetration(&x, &y, &ccd, &depth, &direction, &position);
  return apart == 0 ? depth : 0;
}

}  // namespace dymsum::bench
