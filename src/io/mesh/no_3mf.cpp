// Stands for read_3mf.cpp and write_3mf.cpp where there are no archives, without which nothing in them is reached.
#include "io/archive.h"
#include "io/mesh/mesh_files.h"

namespace dymsum::io {

MeshFile read_3mf(const Source& source) {
  if (!is_zip(source.text)) source.fail_in_bytes(ErrorCode::malformed, "a .3mf file is a .zip file, and this is none");
  throw ReadFailure{zip_entry(source.text, {}, source.file).error()};
}

std::string write_3mf(const MeshData&) { return {}; }

}  // namespace dymsum::io
