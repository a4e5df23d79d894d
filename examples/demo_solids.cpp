// Writes solids to try the command line with, into a folder: the models of the thesis's figures 5.3 and 5.4, a channel,
// a bar exactly as wide as its groove, and a pin. Usage: demo_solids FOLDER
#include <dymsum/dymsum.h>
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
  for (const dymsum::solids::NamedMesh& model : models) {
    const auto written = dymsum::write_mesh(model.mesh, folder + "/" + std::string(model.name) + ".off");
    if (written) continue;
    std::cerr << written.error().to_string() << "\n";
    return 2;
  }
}
