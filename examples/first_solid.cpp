// A cube with a dent in its top, and its hull: how large, and convex or why not.
#include <dymsum/dymsum.h>
#include <iostream>

int main() {
  using namespace dymsum;
  MeshData data = solids::box(0, 0, 0, 2, 2, 2).data();
  data.vertices.push_back({1, 1, 0.5});  // below the middle of the top, face 1, which becomes four triangles
  data.faces[1] = {4, 5, 8};
  for (const Face& side : {Face{5, 7, 8}, {7, 6, 8}, {6, 4, 8}}) data.faces.push_back(side);
  const Mesh dented = Mesh::create(data).value();
  for (const Mesh& mesh : {dented, convex_hull(dented.vertices()).value()}) {
    const auto why_not = convexity_error(mesh);
    std::cout << mesh.faces().size() << " faces, volume " << volume(mesh) << ": "
              << (why_not ? why_not->to_string() : "convex") << "\n";
  }
  write_mesh(dented, "dented.off").value();
}
