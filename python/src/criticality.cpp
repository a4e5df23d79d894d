// All structures of a sum of convex solids during a turn.
#include "arguments.h"
#include "bind.h"
#include "calls.h"
#include "dymsum/criticality_map.h"
#include "record.h"
#include "remember.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

void bind_critical_angles(nb::module_& m) {
  Record<CriticalAngle>(m, "CriticalAngle", "An angle at which the structure of the sum changes.")
      .field("radians", &CriticalAngle::radians)
      .field("coefficients", &CriticalAngle::coefficients)
      .field("slope", &CriticalAngle::slope)
      .field("face", &CriticalAngle::face)
      .field("edge", &CriticalAngle::edge)
      .field("face_of_p", &CriticalAngle::face_of_p);
  Record<CriticalityStats>(m, "CriticalityStats", "What was counted while a map was made.")
      .field("pairs", &CriticalityStats::pairs)
      .field("persistent", &CriticalityStats::persistent)
      .field("meetings", &CriticalityStats::meetings)
      .field("exact_pairs", &CriticalityStats::exact_pairs)
      .field("exact_orders", &CriticalityStats::exact_orders)
      .field("angle_bytes", &CriticalityStats::angle_bytes)
      .field("key_bytes", &CriticalityStats::key_bytes)
      .field("difference_bytes", &CriticalityStats::difference_bytes)
      .field("full_bytes", &CriticalityStats::full_bytes);
}

/// With what it is made of again.
struct MapObject {
  nb::object p, q;
  std::array<std::int32_t, 3> axis;
  CriticalityMap map;
};

MapObject created_map(const MeshArgument& p, const MeshArgument& q, std::array<std::int32_t, 3> axis,
                      const Progress& progress) {
  return {p.object, q.object, axis,
          run(progress, [&](Progress own) { return CriticalityMap::create(*p, *q, axis, own); })};
}

}  // namespace

void bind_criticality(nb::module_& m) {
  bind_critical_angles(m);
  nb::class_<MapObject>(m, "CriticalityMap",
                        "All structures that the sum of two convex solids takes while P turns about an axis.")
      .def(
          "__init__",
          [](MapObject* self, const MeshArgument& p, const MeshArgument& q, std::array<std::int32_t, 3> axis,
             const Progress& progress) { new (self) MapObject(created_map(p, q, axis, progress)); },
          "p"_a, "q"_a, "axis"_a, "progress"_a = nb::none(),
          "Raises Error: not_convex, no_area, bad_rotation, cancelled.")
      .def_static("create", &created_map, "p"_a, "q"_a, "axis"_a, "progress"_a = nb::none())
      .def_ro_static("kAxisBits", &CriticalityMap::kAxisBits)
      .def("size", [](const MapObject& self) { return self.map.size(); })
      .def("__len__", [](const MapObject& self) { return self.map.size(); })
      .def(
          "angle",
          [](const MapObject& self, std::size_t i) {
            if (i >= self.map.size()) throw nb::index_error("no such angle");
            return self.map.angle(i);
          },
          "i"_a, "In [0, 2 pi].")
      .def(
          "exact_angle",
          [](const MapObject& self, std::size_t i) {
            if (i >= self.map.size()) throw nb::index_error("no such angle");
            return self.map.exact_angle(i);
          },
          "i"_a)
      .def("stats", [](const MapObject& self) { return self.map.stats(); })
      .def("bytes", [](const MapObject& self) { return self.map.bytes(); })
      .def(
          "near", [](const MapObject& self, double radians) { return self.map.near(radians); }, "radians"_a)
      .def(
          "inside",
          [](const MapObject& self, std::size_t i) {
            if (i >= self.map.size()) throw nb::index_error("no such interval");
            return self.map.inside(i);
          },
          "i"_a, "A rotation strictly inside interval i, or None.")
      .def(
          "interval", [](const MapObject& self, const Rotation& rotation) { return take(self.map.interval(rotation)); },
          "rotation"_a)
      .def(
          "facet_count",
          [](const MapObject& self, const Rotation& rotation) { return take(self.map.facet_count(rotation)); },
          "rotation"_a)
      .def(
          "at",
          [](const MapObject& self, const Rotation& rotation) {
            SolidSum sum = take(self.map.at(rotation));
            return remembered(std::move(sum), "convex_sum", self.p, self.q, SolidPose{rotation, {}}, SolidPose());
          },
          "rotation"_a, "The sum at a rotation about the axis.")
      .def("__reduce__", [](nb::handle_t<MapObject> self) {
        const auto* object = nb::inst_ptr<MapObject>(self);
        return nb::make_tuple(self.type(), nb::make_tuple(object->p, object->q, object->axis));
      });
}

}  // namespace dymsum::python
