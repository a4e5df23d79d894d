// Writes solids to try the command line with, into a folder: the models of the thesis's figures 5.3 and 5.4, a channel,
// a bar exactly as wide as its groove, and a pin. Usage: demo_solids FOLDER
#include <dymsum/dymsum.h>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

namespace {

/// A groove of width 2 between walls of width 1, 5 long: the ring of a letter U, from z = 0 to 5.
dymsum::Mesh channel() {
  const dymsum::Region u = dymsum::shapes::letter_u(4, 4, 1);
  const dymsum::Ring& ring = u.parts().front().outer;
  dymsum::MeshData data;
  const auto n = static_cast<std::uint32_t>(ring.size());
  for (const double z : {0.0, 5.0})
    for (const dymsum::Point& p : ring) data.vertices.push_back({p.x, p.y, z});
  dymsum::Face bottom, top;
  for (std::uint32_t k = 0; k < n; ++k) {
    bottom.insert(bottom.begin(), k);
    top.push_back(n + k);
    data.faces.push_back({k, (k + 1) % n, n + (k + 1) % n, n + k});
  }
  data.faces.push_back(bottom);
  data.faces.push_back(top);
  return dymsum::Mesh::create(data).value();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    const bool asked = argc == 2 && (argv[1] == std::string("--help") || argv[1] == std::string("-h"));
    (asked ? std::cout : std::cerr) << "usage: demo_solids FOLDER\n";
    return asked ? 0 : 1;
  }
  const std::string folder = argv[1];
  std::filesystem::create_directories(folder);
  std::vector<dymsum::solids::NamedMesh> models = dymsum::solids::thesis_models();
  models.push_back({"channel", channel()});
  models.push_back({"bar", dymsum::solids::box(0, 0, 0, 2, 1, 1)});
  models.push_back({"pin", dymsum::solids::box(0, 0, 0, 0.5, 0.5, 0.5)});
  for (const dymsum::solids::NamedMesh& model : models) {
    const auto written = dymsum::write_mesh(model.mesh, folder + "/" + std::string(model.name) + ".off");
    if (written) continue;
    std::cerr << written.error().to_string() << "\n";
    return 2;
  }
}
