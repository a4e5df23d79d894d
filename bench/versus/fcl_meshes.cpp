#include "versus/fcl_meshes.h"

#include <fcl/fcl.h>

#include <algorithm>
#include <chrono>
#include <memory>

namespace dymsum::bench {
namespace {

using FclModel = fcl::BVHModel<fcl::OBBRSSd>;

std::shared_ptr<FclModel> model_of(const MeshData& mesh) {
  auto model = std::make_shared<FclModel>();
  std::vector<fcl::Vector3d> at;
  std::vector<fcl::Triangle> triangles;
  for (const Point3& v : mesh.vertices) at.emplace_back(v.x, v.y, v.z);
  for (const Face& f : mesh.faces)
    for (std::size_t k = 2; k < f.size(); ++k) triangles.emplace_back(f[0], f[k - 1], f[k]);
  model->beginModel();
  model->addSubModel(at, triangles);
  model->endModel();
  return model;
}

}  // namespace

MeshAnswer fcl_mesh_distance(const MeshData& p, const MeshData& q, Point3 q_moved_by) {
  const fcl::CollisionObjectd a(model_of(p));
  fcl::CollisionObjectd b(model_of(q));
  b.setTranslation({q_moved_by.x, q_moved_by.y, q_moved_by.z});
  b.computeAABB();
  const auto begin = std::chrono::steady_clock::now();
  MeshAnswer answer;
  fcl::DistanceRequestd distance;
  distance.enable_signed_distance = true;
  fcl::DistanceResultd nearest;
  fcl::distance(&a, &b, distance, nearest);
  answer.signed_distance = nearest.min_distance;
  const fcl::CollisionRequestd request(1000, true);
  fcl::CollisionResultd result;
  fcl::collide(&a, &b, request, result);
  answer.contacts = result.numContacts();
  for (std::size_t k = 0; k < result.numContacts(); ++k)
    answer.deepest = std::max(answer.deepest, result.getContact(k).penetration_depth);
  answer.us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
  return answer;
}

}  // namespace dymsum::bench
