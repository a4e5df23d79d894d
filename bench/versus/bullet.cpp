#include "versus/bullet.h"

#include <BulletCollision/Gimpact/btGImpactCollisionAlgorithm.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dymsum::bench {
namespace {

std::unique_ptr<btConvexHullShape> hull_of(const Mesh& mesh) {
  auto hull = std::make_unique<btConvexHullShape>();
  hull->setMargin(0);
  for (const Point3& v : mesh.vertices()) hull->addPoint(btVector3(v.x, v.y, v.z), false);
  hull->recalcLocalAabb();
  return hull;
}

btTransform moved_to(Point3 at) {
  btTransform position;
  position.setIdentity();
  position.setOrigin(btVector3(at.x, at.y, at.z));
  return position;
}

std::unique_ptr<btTriangleMesh> triangles_of(const MeshData& mesh) {
  auto triangles = std::make_unique<btTriangleMesh>();
  const auto at = [&](std::uint32_t v) {
    return btVector3(mesh.vertices[v].x, mesh.vertices[v].y, mesh.vertices[v].z);
  };
  for (const Face& f : mesh.faces)
    for (std::size_t k = 2; k < f.size(); ++k) triangles->addTriangle(at(f[0]), at(f[k - 1]), at(f[k]));
  return triangles;
}

BulletMeshes read_contacts(btDispatcher& all) {
  BulletMeshes found;
  for (int k = 0; k < all.getNumManifolds(); ++k)
    for (int i = 0; i < all.getManifoldByIndexInternal(k)->getNumContacts(); ++i) {
      ++found.contacts;
      const double depth = -all.getManifoldByIndexInternal(k)->getContactPoint(i).getDistance();
      found.deepest = std::max(found.deepest, depth);
    }
  return found;
}

}  // namespace

struct BulletPair::Objects {
  std::unique_ptr<btConvexHullShape> p, q;
};

BulletPair::BulletPair(const Mesh& p, const Mesh& q) : objects_(new Objects{hull_of(p), hull_of(q)}) {}
BulletPair::~BulletPair() = default;

double BulletPair::depth(Point3 at) const {
  btGjkEpaSolver2::sResults found;
  const btVector3 guess(at.x + 1e-3, at.y + 1e-3, at.z + 1e-3);
  if (btGjkEpaSolver2::Penetration(objects_->p.get(), moved_to({}), objects_->q.get(), moved_to(at), guess, found,
                                   false))
    return -found.distance;
  return found.status == btGjkEpaSolver2::sResults::Separated ? 0 : std::numeric_limits<double>::quiet_NaN();
}

BulletMeshes bullet_meshes(const MeshData& p, const MeshData& q, Point3 at) {
  const auto a = triangles_of(p), b = triangles_of(q);
  btGImpactMeshShape shape_a(a.get()), shape_b(b.get());
  for (btGImpactMeshShape* shape : {&shape_a, &shape_b}) shape->setMargin(0), shape->updateBound();
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btGImpactCollisionAlgorithm::registerAlgorithm(&dispatcher);
  btDbvtBroadphase pairs;
  btCollisionWorld world(&dispatcher, &pairs, &configuration);
  btCollisionObject object_a, object_b;
  object_a.setCollisionShape(&shape_a), object_b.setCollisionShape(&shape_b);
  object_b.setWorldTransform(moved_to(at));
  world.addCollisionObject(&object_a), world.addCollisionObject(&object_b);
  world.performDiscreteCollisionDetection();
  const BulletMeshes found = read_contacts(dispatcher);
  world.removeCollisionObject(&object_a), world.removeCollisionObject(&object_b);
  return found;
}

}  // namespace dymsum::bench
