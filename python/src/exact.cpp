// Exact scales, orientations of the plane and rotations of space, and poses made of them.
#include "arguments.h"
#include "bind.h"
#include "dymsum/orientation.h"
#include "dymsum/planar_pose.h"
#include "dymsum/rotation.h"
#include "enumeration.h"
#include "record.h"

namespace dymsum::python {
namespace {

using namespace nb::literals;

template <class T>
void bind_hash(nb::class_<T>& type, nb::object (*key)(const T&)) {
  type.def("__hash__", [key](const T& self) { return nb::hash(key(self)); });
}

void bind_scale(nb::module_& m) {
  nb::class_<Scale> scale(
      m, "Scale",
      R"doc(An exact scale s with 2^-64 <= s <= 2^64. Functions that take a Scale also take numbers, exactly.

>>> from dymsum import Scale
>>> Scale.parse("1.01").exact()
Fraction(101, 100)
>>> Scale(1.5) == Scale.parse("3/2")
True
)doc");
  scale
      .def(
          "__init__", [](Scale* self, const ScaleArgument& of) { new (self) Scale(of.value()); }, "value"_a = 1.0,
          "Raises Error: not_finite; bad_scale for zero, negative and out of range.")
      .def_static(
          "of", [](const ScaleArgument& of) { return of.value(); }, "value"_a)
      .def_static(
          "parse", [](const std::string& text) { return take(Scale::parse(text)); }, "text"_a,
          "\"3/2\", \"1.01\" or \"1e-3\", each exactly what it says.")
      .def("exact", &Scale::exact)
      .def("approx", &Scale::approx, "The nearest double.")
      .def(
          "__eq__", [](const Scale& a, const Scale& b) { return a == b; }, nb::is_operator())
      .def("__float__", &Scale::approx)
      .def("__repr__", [](const Scale& self) { return "Scale(" + self.exact().to_string() + ")"; })
      .def("__reduce__",
           [](nb::handle_t<Scale> self) { return nb::make_tuple(self.type(), nb::make_tuple(self.attr("exact")())); });
  bind_hash<Scale>(scale, [](const Scale& self) { return nb::cast(self.exact()); });
  enumeration<StepKind>(m, "StepKind", "How a step leads from one scale to the next.");
  m.def(
      "parse_scale_step", [](const std::string& text) { return take(parse_scale_step(text)); }, "text"_a);
  m.def(
      "scale_steps",
      [](const ScaleArgument& from, const ScaleArgument& to, const ScaleArgument& step, StepKind kind,
         std::size_t most) { return take(scale_steps(from.value(), to.value(), step.value(), kind, most)); },
      "from_"_a, "to"_a, "step"_a, "kind"_a, "most"_a,
      "From one scale to another in steps, both ends included. Raises Error: bad_scale for more than `most`.");
}

std::string orientation_text(const Orientation& theta) {
  return theta.is_half_turn() ? "inf" : theta.tan_half().to_string();
}

Orientation of_degrees(const Rational& degrees, std::optional<double> error) {
  const double radians = reduced_degrees(degrees);
  return take(error ? Orientation::nearest(radians, *error) : Orientation::nearest(radians));
}

void bind_orientation(nb::module_& m) {
  nb::class_<Orientation> orientation(
      m, "Orientation", R"doc(An exact rotation of the plane by theta about the origin, given by t = tan(theta / 2).

>>> from dymsum import Orientation
>>> Orientation.of(1, 1).radians() * 2
3.141592653589793
>>> Orientation.nearest(1.0, 1e-3).tan_half()
Fraction(35, 64)
>>> Orientation.of(1, 1) * Orientation.of(1, 1) == Orientation.half_turn()
True
)doc");
  orientation.def(nb::init<>())
      .def_ro_static("kAngularError", &Orientation::kAngularError, "Angles in radians are met within this at best.")
      .def_static(
          "of", [](std::int64_t n, std::int64_t d) { return take(Orientation::of(n, d)); }, "n"_a, "d"_a,
          "t = n / d; half a turn for d = 0. Raises Error: bad_rotation for 0 / 0.")
      .def_static(
          "of", [](const Rational& t) { return take(Orientation::of(t)); }, "tan_half"_a,
          "Any rational, exactly. Raises Error: bad_rotation beyond 4096 bits.")
      .def_static("half_turn", &Orientation::half_turn)
      .def_static(
          "parse", [](const std::string& text) { return take(Orientation::parse(text)); }, "tan_half"_a,
          "\"3/7\", \"0.25\" or \"-1e-3\", each exactly what it says; \"inf\" is half a turn.")
      .def_static(
          "nearest", [](double radians) { return take(Orientation::nearest(radians)); }, "radians"_a,
          "Within 2^-50 of the angle; quarter turns are met exactly. Raises Error: bad_rotation.")
      .def_static(
          "nearest", [](double radians, double error) { return take(Orientation::nearest(radians, error)); },
          "radians"_a, "error"_a, "Within `error` radians of the angle, the simplest one within 0.99 of that.")
      .def_static("of_degrees", &of_degrees, "degrees"_a, "error"_a = nb::none(),
                  R"doc(nearest of an angle in degrees; multiples of 90 are met exactly, however large.

>>> from dymsum import Orientation
>>> Orientation.of_degrees(450) == Orientation.of(1, 1), Orientation.of_degrees(450).degrees()
(True, 90.0)
>>> Orientation.of_degrees(60, 0.01).tan_half()
Fraction(4, 7)
)doc")
      .def(
          "degrees", [](const Orientation& self) { return in_degrees(self.radians()); }, "In (-180, 180].")
      .def("is_half_turn", &Orientation::is_half_turn)
      .def("tan_half", &Orientation::tan_half, "Raises ValueError for half a turn.")
      .def("radians", &Orientation::radians, "In (-pi, pi], within 2^-50.")
      .def("inverse", &Orientation::inverse)
      .def(
          "__mul__", [](const Orientation& a, const Orientation& b) { return a * b; }, nb::is_operator(),
          "First b, then a.")
      .def(
          "__eq__", [](const Orientation& a, const Orientation& b) { return a == b; }, nb::is_operator())
      .def("__repr__", [](const Orientation& self) { return "Orientation.parse('" + orientation_text(self) + "')"; })
      .def("__getstate__",
           [](const Orientation& self) {
             return nb::make_tuple(self.is_half_turn() ? nb::none() : nb::cast(self.tan_half()));
           })
      .def("__setstate__", [](Orientation& self, nb::tuple state) {
        new (&self) Orientation(state[0].is_none() ? Orientation::half_turn()
                                                   : take(Orientation::of(nb::cast<Rational>(state[0]))));
      });
  bind_hash<Orientation>(orientation,
                         [](const Orientation& self) -> nb::object { return nb::cast(orientation_text(self)); });
  m.def("reduced_radians", &reduced_radians, "radians"_a, "An angle less whole turns, in (-pi, pi].");
  m.def("reduced_degrees", &reduced_degrees, "degrees"_a, "The same of degrees, in radians.");
}

void bind_rotation(nb::module_& m) {
  nb::class_<Rotation> rotation(
      m, "Rotation", R"doc(An exact rotation of space, given by an integer quaternion (w, x, y, z) of any length.

>>> from dymsum import Rotation
>>> Rotation.of(2, 0, 0, 2)
Rotation.of(1, 0, 0, 1)
>>> Rotation.of(1, 0, 0, 1).matrix(), Rotation.of(1, 0, 0, 1).norm()
([0, -2, 0, 2, 0, 0, 0, 0, 2], 2)
)doc");
  rotation.def(nb::init<>())
      .def_ro_static("kBits", &Rotation::kBits)
      .def_ro_static("kAngularError", &Rotation::kAngularError)
      .def_static(
          "of",
          [](std::int64_t w, std::int64_t x, std::int64_t y, std::int64_t z) { return take(Rotation::of(w, x, y, z)); },
          "w"_a, "x"_a, "y"_a, "z"_a,
          "Raises Error: bad_rotation when all are zero, or larger than 2^30 without common divisor.")
      .def_static(
          "about", [](Point3 axis, double radians) { return take(Rotation::about(axis, radians)); }, "axis"_a,
          "radians"_a, "About an axis through the origin, counter-clockwise seen from its tip, within 2^-28.")
      .def_static(
          "about_degrees",
          [](Point3 axis, const Rational& degrees) { return take(Rotation::about(axis, reduced_degrees(degrees))); },
          "axis"_a, "degrees"_a, R"doc(The same of an angle in degrees.

>>> from dymsum import Rotation
>>> Rotation.about_degrees((0, 0, 1), 90)
Rotation.of(1, 0, 0, 1)
)doc")
      .def_static(
          "nearest", [](double w, double x, double y, double z) { return take(Rotation::nearest(w, x, y, z)); }, "w"_a,
          "x"_a, "y"_a, "z"_a, "The rotation of a quaternion of doubles, within 2^-28.")
      .def(
          "__mul__", [](const Rotation& a, const Rotation& b) { return a * b; }, nb::is_operator(), "First b, then a.")
      .def("inverse", &Rotation::inverse)
      .def("quaternion", &Rotation::quaternion)
      .def("matrix", &Rotation::matrix, "Row by row; to be divided by norm().")
      .def("norm", &Rotation::norm)
      .def("angle", &Rotation::angle, "In [0, pi].")
      .def(
          "degrees", [](const Rotation& self) { return in_degrees(self.angle()); }, "The angle in [0, 180].")
      .def(
          "__eq__", [](const Rotation& a, const Rotation& b) { return a == b; }, nb::is_operator())
      .def("__repr__",
           [](const Rotation& self) {
             const auto& q = self.quaternion();
             return "Rotation.of(" + std::to_string(q[0]) + ", " + std::to_string(q[1]) + ", " + std::to_string(q[2]) +
                    ", " + std::to_string(q[3]) + ")";
           })
      .def("__getstate__", [](const Rotation& self) { return self.quaternion(); })
      .def("__setstate__", [](Rotation& self, const std::array<std::int64_t, 4>& q) {
        new (&self) Rotation(take(Rotation::of(q[0], q[1], q[2], q[3])));
      });
  bind_hash<Rotation>(rotation,
                      [](const Rotation& self) -> nb::object { return nb::tuple(nb::cast(self.quaternion())); });
}

template <class Pose, class Turn, std::size_t N>
void bind_pose(nb::module_& m, const char* name, const char* doc) {
  Record<Pose> pose(m, name, doc);
  pose.def(
          "__init__",
          [](Pose* self, const Turn& rotation, const std::optional<std::array<ScaleArgument, N>>& scale) {
            new (self) Pose{rotation, {}};
            if (!scale) return;
            for (std::size_t k = 0; k < N; ++k) self->scale[k] = (*scale)[k].value();
          },
          "rotation"_a = Turn(), "scale"_a = nb::none())
      .def("__hash__", [](nb::handle_t<Pose> self) {
        return nb::hash(nb::make_tuple(self.attr("rotation"), nb::tuple(self.attr("scale"))));
      });
  pose.field("rotation", &Pose::rotation).field("scale", &Pose::scale);
}

}  // namespace

void bind_exact(nb::module_& m) {
  m.def(
      "_double", [](double number) { return number; }, "number"_a, "The double that a number is, for dymsum._convert.");
  bind_scale(m);
  bind_orientation(m);
  bind_rotation(m);
  bind_pose<SolidPose, Rotation, 3>(m, "SolidPose", "Where a solid stands: x -> rotation (diag(scale) x).");
  bind_pose<PlanarPose, Orientation, 2>(m, "PlanarPose", "Where a polygon stands: x -> rotation (diag(scale) x).");
}

}  // namespace dymsum::python
