// Writes solids to try the command line with, into a folder: the models of the thesis's figures 5.3 and 5.4, a channel,
// a bar exactly as wide as its groove, a pin, and a box and a rod turned in doubles. Usage: demo_solids FOLDER
#include <dymsum/dymsum.h>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    const bool asked = argc == 2 && (argv[1] == std::string("--help") || argv[1] == std::string("-h"));
    (asked ? std::cout : std::cerr) << "usage: demo_solids FOLDER\n";
    return asked ? 0 : 1;
  }
  const std::string folder = argv[1];
  std::filesystem::create_directories(folder);
  std::vector<dymsum::solids::NamedMesh> models = dymsum::solids::thesis_models();
  const dymsum::Region u = dymsum::shapes::letter_u(4, 4, 1);  // a groove of width 2 between walls of width 1
  models.push_back({"channel", dymsum::solids::prism(u.parts().front().outer, 5)});
  models.push_back({"bar", dymsum::solids::box(0, 0, 0, 2, 1, 1)});
  models.push_back({"pin", dymsum::solids::box(0, 0, 0, 0.5, 0.5, 0.5)});
  const double c = std::cos(0.5), s = std::sin(0.5);
  for (auto& [name, solid] :
       std::vector<dymsum::solids::NamedMesh>{{"turned_box", dymsum::solids::box(0, 0, 0, 3, 2, 1)},
                                              {"turned_rod", dymsum::solids::cylinder(12, 0.25, 1)}}) {
    const dymsum::TriangulatedMesh triangles = triangulated(solid);
    dymsum::MeshData data = triangles.mesh.data();
    for (dymsum::Point3& p : data.vertices)
      p = {c * p.x - s * p.y, c * (s * p.x + c * p.y) - s * p.z, s * (s * p.x + c * p.y) + c * p.z};
    models.push_back({name, dymsum::Mesh::create(data).value()});
  }
  for (const dymsum::solids::NamedMesh& model : models) {
    const auto written = dymsum::write_mesh(model.mesh, folder + "/" + std::string(model.name) + ".off");
    if (written) continue;
    std::cerr << written.error().to_string() << "\n";
    return 2;
  }
}
