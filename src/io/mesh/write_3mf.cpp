// 3MF: the three files that a package must have, with one object of triangles. Numbers read back as the same doubles.
#include <array>
#include <string>
#include <utility>

#include "io/archive.h"
#include "io/mesh/mesh_files.h"
#include "io/source.h"
#include "spatial/mesh/triangulate.h"

namespace dymsum::io {

namespace {

constexpr const char* kModel = "3D/3dmodel.model";
constexpr const char* kContentTypes =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)";
constexpr const char* kRelationships =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
)";
constexpr const char* kModelHead =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
 <metadata name="Application">dymsum</metadata>
 <resources>
  <object id="1" type="model">
   <mesh>
    <vertices>
)";

std::string model_of(const MeshData& data) {
  std::string out = kModelHead;
  for (const Point3& p : data.vertices) {
    for (const auto& [name, value] : {std::pair{"     <vertex x=\"", p.x}, {"\" y=\"", p.y}, {"\" z=\"", p.z}}) {
      out += name;
      append_number(out, value);
    }
    out += "\"/>\n";
  }
  out += "    </vertices>\n    <triangles>\n";
  for (const spatial::Triangle& triangle : spatial::triangulated(data).triangles) {
    out += "     <triangle v1=\"" + std::to_string(triangle[0]) + "\" v2=\"" + std::to_string(triangle[1]) +
           "\" v3=\"" + std::to_string(triangle[2]) + "\"/>\n";
  }
  return out +
         "    </triangles>\n   </mesh>\n  </object>\n </resources>\n <build>\n  <item objectid=\"1\"/>\n </build>\n"
         "</model>\n";
}

}  // namespace

std::string write_3mf(const MeshData& data) {
  const std::array<ZipEntry, 3> entries = {
      ZipEntry{"[Content_Types].xml", kContentTypes}, {"_rels/.rels", kRelationships}, {kModel, model_of(data)}};
  Result<std::string> bytes = zip_of(entries);
  return bytes ? std::move(bytes).value() : std::string();  // rounding_error tells that there are no archives
}

}  // namespace dymsum::io
