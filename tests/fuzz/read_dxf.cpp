// Fuzz target: the .dxf reader.
#include "fuzz/check_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  return dymsum::fuzz::require_good_reader(data, size, dymsum::RegionFormat::dxf);
}
