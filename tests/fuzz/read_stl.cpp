// Fuzz target: the .stl reader.
#include "fuzz/check_mesh_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  return dymsum::fuzz::require_good_mesh_reader(data, size, dymsum::MeshFormat::stl);
}
