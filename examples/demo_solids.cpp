// Writes solids to try the command line with, into the folder given: the models of the thesis's figures 5.3 and 5.4.
#include <dymsum/dymsum.h>
#include <iostream>
#include <string>

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? argv[1] : ".";
  for (const dymsum::solids::NamedMesh& model : dymsum::solids::thesis_models()) {
    const auto written = dymsum::write_mesh(model.mesh, folder + "/" + std::string(model.name) + ".off");
    if (written) continue;
    std::cerr << written.error().to_string() << "\n";
    return 1;
  }
}
