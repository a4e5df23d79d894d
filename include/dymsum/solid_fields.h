// Fields of what sums of solids report.
#pragma once

#include "dymsum/convex_sum.h"
#include "dymsum/editable_solid_sum.h"
#include "dymsum/field.h"
#include "dymsum/mesh.h"
#include "dymsum/moving_solid_sum.h"
#include "dymsum/penetration_depth.h"
#include "dymsum/rational.h"
#include "dymsum/solid_scale_range.h"
#include "dymsum/spatial_sum.h"

namespace dymsum::names {

template <>
inline constexpr auto kFields<Point3> = kMembers<&Point3::x, &Point3::y, &Point3::z>;

template <>
inline constexpr auto kFields<RationalPoint3> = kMembers<&RationalPoint3::x, &RationalPoint3::y, &RationalPoint3::z>;

template <>
inline constexpr auto kFields<SolidFeature> = kMembers<&SolidFeature::kind, &SolidFeature::a, &SolidFeature::b>;

template <>
inline constexpr auto kFields<SolidContact> = kMembers<&SolidContact::p, &SolidContact::q>;

template <>
inline constexpr auto kFields<SpatialStats::Stage> = kMembers<&SpatialStats::Stage::name, &SpatialStats::Stage::ms>;

template <>
inline constexpr auto kFields<SpatialStats> =
    kMembers<&SpatialStats::bits, &SpatialStats::face_vertex, &SpatialStats::edge_edge, &SpatialStats::inner_facets,
             &SpatialStats::box_pairs, &SpatialStats::contacts, &SpatialStats::points, &SpatialStats::cells,
             &SpatialStats::patches, &SpatialStats::collision_tests, &SpatialStats::tight_tests,
             &SpatialStats::double_pair_signs, &SpatialStats::exact_signs, &SpatialStats::held_bytes,
             &SpatialStats::stages>;

template <>
inline constexpr std::tuple kFields<SolidFrameWork>{
    Field<&SolidFrameWork::rebuilt>{"computed from scratch"},
    Field<&SolidFrameWork::normals_checked>{"faces whose certificates had ended"},
    Field<&SolidFrameWork::pairs_checked>{"pairs of edges that may have come or gone"},
    Field<&SolidFrameWork::facets>{"of the reduced convolution"},
    Field<&SolidFrameWork::facets_added>{},
    Field<&SolidFrameWork::facets_removed>{},
    Field<&SolidFrameWork::inner_kept>{"facets that stay deep inside the open sum"},
    Field<&SolidFrameWork::inner_tested>{"facets for which that was found out anew"},
    Field<&SolidFrameWork::contacts>{"of the other facets"},
    Field<&SolidFrameWork::exact_signs>{},
    Field<&SolidFrameWork::ms>{}};

template <>
inline constexpr std::tuple kFields<SolidEditWork>{
    Field<&SolidEditWork::kept>{"the sum of an earlier step was still there"},
    Field<&SolidEditWork::vertices_edited>{"that are new or have other positions"},
    Field<&SolidEditWork::faces_edited>{"that are new or have other vertices"},
    Field<&SolidEditWork::facets>{"of the reduced convolution"},
    Field<&SolidEditWork::contacts>{},
    Field<&SolidEditWork::exact_signs>{},
    Field<&SolidEditWork::ms>{"wall time"}};

template <>
inline constexpr std::tuple kFields<SolidFrameChanges>{
    Field<&SolidFrameChanges::appeared>{"pairs of features that make faces now, and did not before"},
    Field<&SolidFrameChanges::disappeared>{},
    Field<&SolidFrameChanges::changed>{"those that did and do, with other neighbours or vertices"},
    Field<&SolidFrameChanges::shells>{"how many more there are; so the following"},
    Field<&SolidFrameChanges::tight_faces>{},
    Field<&SolidFrameChanges::tight_segments>{},
    Field<&SolidFrameChanges::tight_points>{}};

template <>
inline constexpr auto kFields<MotionWork> =
    kMembers<&MotionWork::vertex_checks, &MotionWork::vertex_errors, &MotionWork::crossing_checks,
             &MotionWork::arc_checks, &MotionWork::arcs_changed, &MotionWork::steps, &MotionWork::facets_added,
             &MotionWork::facets_removed, &MotionWork::exact_signs>;

template <>
inline constexpr std::tuple kFields<ConvexDepth>{
    Field<&ConvexDepth::inside>{"in the interior"},
    Field<&ConvexDepth::depth>{},
    Field<&ConvexDepth::depth_squared>{"exact"},
    Field<&ConvexDepth::direction>{"unit outward normal of the nearest facet"},
    Field<&ConvexDepth::p>{},
    Field<&ConvexDepth::q>{}};

template <>
inline constexpr auto kFields<ConvexSum::FacetCount> =
    kMembers<&ConvexSum::FacetCount::all, &ConvexSum::FacetCount::changed>;

template <>
inline constexpr std::tuple kFields<SolidTouch>{
    Field<&SolidTouch::p>{"by the mesh's indices"}, Field<&SolidTouch::q>{},
    Field<&SolidTouch::dimension>{"of what they have in common: 0 a point, 1 a segment, 2 a part of a plane"},
    Field<&SolidTouch::at>{"one of these positions, exact, Q being moved"},
    Field<&SolidTouch::patch>{"the connected piece of all that touches, from 0 on"}};

template <>
inline constexpr std::tuple kFields<SolidWay>{
    Field<&SolidWay::move>{"exact"}, Field<&SolidWay::direction>{"of length 1, rounded; zero where `move` is"},
    Field<&SolidWay::contacts>{"all pairs of features that touch once Q is moved, the greatest dimension first"}};

template <>
inline constexpr std::tuple kFields<SolidDistance::Work>{
    Field<&SolidDistance::Work::facets>{"of the convolution that were looked at"},
    Field<&SolidDistance::Work::candidates>{"positions that were asked about"},
    Field<&SolidDistance::Work::exact_tests>{"of these, in exact arithmetic"},
    Field<&SolidDistance::Work::collision_tests>{"exact ones; none where a free position of the last answer tells"}};

template <>
inline constexpr std::tuple kFields<SolidDistance>{
    Field<&SolidDistance::meeting>{},
    Field<&SolidDistance::squared>{"the exact square of `distance`"},
    Field<&SolidDistance::distance>{"the nearest double, in the unit of the coordinates"},
    Field<&SolidDistance::ways>{"all shortest moves, sorted; one of nothing where the solids touch"},
    Field<&SolidDistance::complete>{"false where the time limit came first"},
    Field<&SolidDistance::at_least>{"a lower bound of the distance; itself where complete"},
    Field<&SolidDistance::work>{"no part of the value"}};

template <>
inline constexpr auto kFields<SolidScaleContact> =
    kMembers<&SolidScaleContact::part, &SolidScaleContact::obstacle, &SolidScaleContact::leg, &SolidScaleContact::along,
             &SolidScaleContact::at>;

template <>
inline constexpr auto kFields<SolidScaleInterval> = kMembers<&SolidScaleInterval::low, &SolidScaleInterval::high,
                                                             &SolidScaleInterval::at_low, &SolidScaleInterval::at_high>;

template <>
inline constexpr std::tuple kFields<SolidScaleRange>{Field<&SolidScaleRange::free>{"intervals in order, disjoint"},
                                                     Field<&SolidScaleRange::critical>{},
                                                     Field<&SolidScaleRange::tested>{}};

}  // namespace dymsum::names
