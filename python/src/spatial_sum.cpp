// The sum of two solids of any shape and what it is made of.
#include "dymsum/spatial_sum.h"

#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/solid_sum_io.h"
#include "dymsum/volume_text.h"
#include "enumeration.h"
#include "extent.h"
#include "paths.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_spatial_options(nb::module_& m) {
  enumeration<SpatialEngine>(m, "SpatialEngine", "How the boundary is found; both give the same result.");
  Record<SpatialOptions> options(m, "SpatialOptions", "Options of sums of solids.");
  options.def(
      "__init__",
      [](SpatialOptions* self, SpatialEngine engine, Semantics semantics, bool tight, bool trace, int threads,
         std::uint64_t memory, Progress progress) {
        new (self) SpatialOptions{engine, semantics, tight, trace, threads, memory, std::move(progress)};
      },
      "engine"_a = SpatialEngine::fast, "semantics"_a = Semantics::closed, "tight"_a = true, "trace"_a = false,
      "threads"_a = 0, "memory"_a = 0, "progress"_a = nb::none());
  options.option("engine", &SpatialOptions::engine)
      .option("semantics", &SpatialOptions::semantics)
      .option("tight", &SpatialOptions::tight)
      .option("trace", &SpatialOptions::trace)
      .option("threads", &SpatialOptions::threads)
      .option("memory", &SpatialOptions::memory, "bytes that the computation may hold; 0: no limit")
      .option("progress", &SpatialOptions::progress);
}

void bind_spatial_parts(nb::module_& m) {
  Record<SolidFeature> feature(m, "SolidFeature", "A feature of an operand, by indices into its mesh.");
  enumeration<SolidFeature::Kind>(feature, "Kind", "What a feature is.");
  feature.listed();
  Record<SolidContact>(m, "SolidContact", "A feature of P and one of Q that touch.").listed();
  Record<SpatialFace>(m, "SpatialFace", "A face of the boundary: a polygon in one plane, perhaps with holes.")
      .field("loops", &SpatialFace::loops, "vertex indices: the outer loop, then holes")
      .field("p", &SpatialFace::p)
      .field("q", &SpatialFace::q)
      .field("shell", &SpatialFace::shell);
  Record<SpatialEdge>(m, "SpatialEdge", "An edge of the boundary.")
      .field("from_", &SpatialEdge::from)
      .field("to", &SpatialEdge::to)
      .field("faces", &SpatialEdge::faces)
      .field("contact", &SpatialEdge::contact);
  Record<SpatialStats> stats(m, "SpatialStats", "The work that was done.");
  Record<SpatialStats::Stage>(stats, "Stage", "Time of a stage.").listed();
  stats.listed();
}

void bind_spatial_trace(nb::module_& m) {
  Record<SpatialTrace> trace(m, "SpatialTrace", "The stages of a sum as data, rounded.");
  Record<SpatialTrace::Facet> facet(trace, "Facet", "A facet of the reduced convolution.");
  enumeration<SpatialTrace::Facet::Kind>(facet, "Kind", "What a facet is the sum of.");
  facet.field("corners", &SpatialTrace::Facet::corners).field("kind", &SpatialTrace::Facet::kind);
  trace.field("facets", &SpatialTrace::facets).field("pieces", &SpatialTrace::pieces);
}

void bind_fields(nb::class_<SpatialSum>& sum) {
  sum.def_prop_ro(
         "vertices",
         [](nb::handle_t<SpatialSum> self) {
           return view_of<3>(std::span<const Point3>(nb::inst_ptr<SpatialSum>(self)->vertices), self);
         },
         "Positions within at_error: a view of shape (n, 3).")
      .def_ro("at_error", &SpatialSum::at_error)
      .def_ro("faces", &SpatialSum::faces)
      .def_ro("shells", &SpatialSum::shells)
      .def_prop_ro("edges", &SpatialSum::edges)
      .def_ro("vertex_contacts", &SpatialSum::vertex_contacts)
      .def_ro("tight_faces", &SpatialSum::tight_faces)
      .def_ro("tight_segments", &SpatialSum::tight_segments)
      .def_ro("tight_points", &SpatialSum::tight_points)
      .def_ro("tight_face_contacts", &SpatialSum::tight_face_contacts)
      .def_ro("tight_segment_contacts", &SpatialSum::tight_segment_contacts)
      .def_ro("tight_point_contacts", &SpatialSum::tight_point_contacts)
      .def_ro("stats", &SpatialSum::stats)
      .def_ro("trace", &SpatialSum::trace);
}

std::array<double, 6> bounds_of(const SpatialSum& sum) {
  return extent_of<3>(sum.at_error, [&](auto&& add) {
    for (std::size_t v = 0; v < sum.vertices.size(); ++v) {
      const Point3& at = sum.vertices[v];
      add({at.x, at.y, at.z}, [&](std::size_t k) {
        const RationalPoint3 exact = sum.exact(v);
        return (k == 0 ? exact.x : k == 1 ? exact.y : exact.z).to_double();
      });
    }
  });
}

void bind_spatial_numbers(nb::class_<SpatialSum>& sum) {
  sum.def("tight_triangles", &SpatialSum::tight_triangles)
      .def(
          "exact",
          [](const SpatialSum& self, std::size_t vertex) {
            if (vertex >= self.vertices.size()) throw nb::index_error("no such vertex");
            return self.exact(vertex);
          },
          "vertex"_a, "The exact position of a vertex.")
      .def(
          "volume", [](const SpatialSum& self) { return without_gil([&] { return self.volume(); }); },
          "The nearest double to the exact volume.")
      .def(
          "bounds", [](const SpatialSum& self) { return without_gil([&] { return bounds_of(self); }); },
          "[min x, min y, min z, max x, max y, max z], each the nearest double to the exact one; zeros for nothing.")
      .def("area", [](const SpatialSum& self) { return without_gil([&] { return self.area(); }); })
      .def(
          "volume_exact", [](const SpatialSum& self) { return without_gil([&] { return self.volume_exact(); }); },
          "The volume as one Fraction; expensive for thousands of vertices.")
      .def(
          "volume_exact_within",
          [](const SpatialSum& self, std::size_t bits) {
            return without_gil([&] { return self.volume_exact_within(bits); });
          },
          "bits"_a)
      .def(
          "rounded",
          [](const SpatialSum& self, Precision precision, double tolerance) {
            return take(without_gil([&] { return self.rounded(precision, tolerance); }));
          },
          "precision"_a = Precision::doubles, "tolerance"_a = 0.0,
          "The boundary as triangles, every vertex rounded, and merged where surfaces meet otherwise. Raises Error: "
          "rounding_changed_topology, cannot_write.")
      .def("is_convex", &SpatialSum::is_convex, "Whether it was made of convex solids.")
      .def(
          "rounded_mesh",
          [](const SpatialSum& self, Precision precision) {
            return take(without_gil([&] { return self.rounded_mesh(precision); }));
          },
          "precision"_a = Precision::doubles,
          "A valid mesh: of a convex sum a convex one with whole faces, of others triangles. Raises Error: "
          "rounding_changed_topology, not_finite, cannot_write.")
      .def(
          "rounded_hull",
          [](const SpatialSum& self, Precision precision) {
            return take(without_gil([&] { return self.rounded_hull(precision); }));
          },
          "precision"_a = Precision::doubles,
          "Of a convex sum the hull of its rounded vertices. Raises Error: not_convex for others, not_finite, no_area.")
      .def(
          "drawn", [](const SpatialSum& self) { return without_gil([&] { return self.drawn(); }); },
          "The same for a picture, whatever rounding does.");
}

void bind_spatial_sum_class(nb::module_& m) {
  nb::class_<SpatialSum> sum(m, "SpatialSum", nb::dynamic_attr(),
                             R"doc(The exact sum of two solids. Equal sets compare equal.

>>> from dymsum import minkowski_sum, solids
>>> sum = minkowski_sum(solids.box(0, 0, 0, 1, 1, 1), solids.box(0, 0, 0, 2, 2, 2))
>>> sum.volume_exact(), len(sum.faces), sum.vertices.shape
(Fraction(27, 1), 6, (8, 3))
)doc");
  bind_fields(sum);
  bind_spatial_numbers(sum);
  Record<SpatialSum::Rounded>(sum, "Rounded", "Triangles of a sum, rounded.")
      .field("mesh", &SpatialSum::Rounded::mesh)
      .field("face", &SpatialSum::Rounded::face, "of every triangle the face that it is a part of")
      .field("vertex", &SpatialSum::Rounded::vertex,
             "of every vertex which one of the sum it is, or that it is next to")
      .field("nearest", &SpatialSum::Rounded::nearest, "nothing happened but rounding to the nearest")
      .field("merged_vertices", &SpatialSum::Rounded::merged_vertices)
      .field("collapsed_edges", &SpatialSum::Rounded::collapsed_edges)
      .field("bends", &SpatialSum::Rounded::bends, "edges and triangles that got a vertex that was near")
      .field("lost_faces", &SpatialSum::Rounded::lost_faces, "faces of the sum of which no triangle is left")
      .field("distance", &SpatialSum::Rounded::distance, "how far the mesh is from the exact boundary, at most")
      .field("volume_change", &SpatialSum::Rounded::volume_change, "how far its volume is from the exact one, at most")
      .field("topology_kept", &SpatialSum::Rounded::topology_kept)
      .def("to_string", &SpatialSum::Rounded::to_string, "What was merged, and how far the surface moved.");
  sum.def(
         "__eq__", [](const SpatialSum& a, const SpatialSum& b) { return without_gil([&] { return a == b; }); },
         nb::is_operator())
      .def("__repr__",
           [](const SpatialSum& self) {
             return "<SpatialSum: " + std::to_string(self.vertices.size()) + " vertices, " +
                    std::to_string(self.faces.size()) + " faces, " + std::to_string(self.shells) +
                    " shells, tight: " + std::to_string(self.tight_points.size()) + " points, " +
                    std::to_string(self.tight_segments.size()) + " segments, " +
                    std::to_string(self.tight_faces.size()) + " faces>";
           })
      .def(
          "to_trimesh",
          [](const SpatialSum& self) {
            const nb::object mesh = nb::cast(take(self.rounded()).mesh);
            return nb::module_::import_("dymsum._convert").attr("to_trimesh")(mesh);
          },
          "rounded() as a trimesh object (needs trimesh).")
      .def(
          "to_glb",
          [](nb::handle_t<SpatialSum> self) { return nb::module_::import_("dymsum._display").attr("solid_glb")(self); },
          nb::sig("def to_glb(self) -> bytes"), "The bytes of a .glb file, rounded.")
      .def(
          "_repr_svg_",
          [](nb::handle_t<SpatialSum> self) { return nb::module_::import_("dymsum._display").attr("solid_svg")(self); })
      .def("__reduce__", [](nb::handle_t<SpatialSum> self) { return made_again(self); })
      .def(
          "to_json", [](const SpatialSum& self) { return without_gil([&] { return solid_sum_to_json(self); }); },
          "As solid_sum_to_json.");
  sum.attr("__hash__") = nb::none();
}

void bind_solid_sum_files(nb::module_& m) {
  m.def(
      "solid_sum_to_json", [](const SpatialSum& sum) { return without_gil([&] { return solid_sum_to_json(sum); }); },
      "sum"_a, "Vertices, edges, faces and what is tight, exactly and with provenance, as JSON text.");
  m.def(
      "parse_solid_sum",
      [](const std::string& text, const std::string& name_for_errors) {
        return remembered(take(without_gil([&] { return parse_solid_sum(text, name_for_errors); })), "parse_solid_sum",
                          text, name_for_errors);
      },
      "text"_a, "name_for_errors"_a = "text",
      R"doc(The exact sum that to_json has written, as an operand. Raises Error: malformed; unsupported_operand; out_of_range; truncated.

>>> from dymsum import minkowski_sum, parse_solid_sum, solids
>>> sum = minkowski_sum(solids.box(0, 0, 0, 1, 1, 1), solids.box(0, 0, 0, 2, 2, 2))
>>> parse_solid_sum(sum.to_json()) == sum
True
)doc");
  m.def(
      "read_solid_sum",
      [](const PathArgument& path) {
        SpatialSum sum = take(without_gil([&] { return read_solid_sum(path.text); }));
        std::string own = without_gil([&] { return solid_sum_to_json(sum); });
        return remembered(std::move(sum), "parse_solid_sum", std::move(own), path.text);
      },
      "path"_a, "The same of a file. Raises Error: cannot_open; as parse_solid_sum.");
  m.def(
      "begins_like_solid_sum", [](const std::string& text) { return begins_like_solid_sum(text); }, "text"_a,
      "Whether a text begins as what to_json writes.");
  m.def(
      "names_solid_sum", [](const PathArgument& path) { return names_solid_sum(path.text); }, "path"_a,
      "Whether a path ends in .json or .json.gz and names a file that begins so.");
}

}  // namespace

void bind_spatial_sum(nb::module_& m) {
  bind_spatial_options(m);
  bind_spatial_parts(m);
  bind_spatial_trace(m);
  bind_spatial_sum_class(m);
  bind_solid_sum_files(m);
  m.def(
      "volume_text", [](const SpatialSum& sum) { return volume_text(sum); }, "sum"_a);
  m.def(
      "surface_text", [](const SpatialSum& sum) { return surface_text(sum); }, "sum"_a);
}

}  // namespace dymsum::python
