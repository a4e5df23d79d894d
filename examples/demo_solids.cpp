// Writes solids to try the command line with, into a folder: the models of the thesis's figures 5.3 and 5.4. Usage:
// demo_solids FOLDER
#include <dymsum/dymsum.h>
#include <filesystem>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    const bool asked = argc == 2 && (argv[1] == std::string("--help") || argv[1] == std::string("-h"));
    (asked ? std::cout : std::cerr) << "usage: demo_solids FOLDER\n";
    return asked ? 0 : 1;
  }
  const std::string folder = argv[1];
  std::filesystem::create_directories(folder);
  for (const dymsum::solids::NamedMesh& model : dymsum::solids::thesis_models()) {
    const auto written = dymsum::write_mesh(model.mesh, folder + "/" + std::string(model.name) + ".off");
    if (written) continue;
    std::cerr << written.error().to_string() << "\n";
    return 2;
  }
}
