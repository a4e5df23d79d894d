// Fields of what planar sums report.
#pragma once

#include "dymsum/editable_sum.h"
#include "dymsum/family.h"
#include "dymsum/field.h"
#include "dymsum/frames.h"
#include "dymsum/penetration_depth.h"
#include "dymsum/planar_sum.h"
#include "dymsum/rational.h"
#include "dymsum/region.h"
#include "dymsum/result.h"
#include "dymsum/scale_range.h"
#include "dymsum/snap_rounding.h"

namespace dymsum::names {

template <>
inline constexpr auto kFields<Evidence> =
    kMembers<&Evidence::file, &Evidence::line, &Evidence::part, &Evidence::ring, &Evidence::vertex,
             &Evidence::other_part, &Evidence::other_ring, &Evidence::other_vertex, &Evidence::face,
             &Evidence::other_face, &Evidence::x, &Evidence::y, &Evidence::z>;

template <>
inline constexpr auto kFields<Point> = kMembers<&Point::x, &Point::y>;

template <>
inline constexpr auto kFields<RationalPoint> = kMembers<&RationalPoint::x, &RationalPoint::y>;

template <>
inline constexpr auto kFields<Contact> = kMembers<&Contact::kind, &Contact::p, &Contact::q>;

template <>
inline constexpr auto kFields<ConvolutionSizes> =
    kMembers<&ConvolutionSizes::full, &ConvolutionSizes::kinetic, &ConvolutionSizes::reduced>;

template <>
inline constexpr auto kFields<SumStats::Stage> = kMembers<&SumStats::Stage::name, &SumStats::Stage::ms>;

template <>
inline constexpr auto kFields<SumStats> =
    kMembers<&SumStats::tier_bits, &SumStats::reduced_segments, &SumStats::live_segments, &SumStats::cell_entries,
             &SumStats::pair_tests, &SumStats::crossings, &SumStats::degenerate_nodes, &SumStats::loops,
             &SumStats::collision_tests, &SumStats::filtered_signs, &SumStats::exact_signs, &SumStats::mask_grid,
             &SumStats::peak_bytes, &SumStats::stages>;

template <>
inline constexpr std::tuple kFields<Rounding>{
    Field<&Rounding::nearest>{"as PlanarSum.rounded: nothing happened but that"},
    Field<&Rounding::merged_vertices>{"positions that have the doubles of another one"},
    Field<&Rounding::collapsed_edges>{"edges whose ends are one"},
    Field<&Rounding::bends>{"vertices where edges cross or touch in doubles that did not"},
    Field<&Rounding::lines>{"polylines for what is thinner than rounding"},
    Field<&Rounding::points>{"points for what is smaller"},
    Field<&Rounding::vanished_rings>{"gaps that closed, and parts that lie within others now"},
    Field<&Rounding::moved>{"set and region are at most this far from each other"},
    Field<&Rounding::moved_ulps>{"the same in units in the last place of the largest coordinate"}};

template <>
inline constexpr auto kFields<FrameWork> =
    kMembers<&FrameWork::rebuilt, &FrameWork::new_window, &FrameWork::degenerate, &FrameWork::pieces,
             &FrameWork::candidates, &FrameWork::pieces_repaired, &FrameWork::lists_changed,
             &FrameWork::crossings_changed, &FrameWork::loops_traced, &FrameWork::loops_kept, &FrameWork::witnessed,
             &FrameWork::witnesses_lost, &FrameWork::collision_tests, &FrameWork::exact_signs, &FrameWork::window_low,
             &FrameWork::window_high, &FrameWork::ms, &FrameWork::peak_bytes>;

template <>
inline constexpr std::tuple kFields<EditWork>{
    Field<&EditWork::rebuilt>{"from scratch"},
    Field<&EditWork::degenerate>{"something touches that shows: the result is from scratch"},
    Field<&EditWork::segments_removed>{},
    Field<&EditWork::segments_added>{},
    Field<&EditWork::cells_changed>{},
    Field<&EditWork::cells_uncovered>{},
    Field<&EditWork::pairs_tested>{},
    Field<&EditWork::events_changed>{},
    Field<&EditWork::loops_traced>{},
    Field<&EditWork::loops_kept>{},
    Field<&EditWork::collision_tests>{},
    Field<&EditWork::exact_signs>{},
    Field<&EditWork::ms>{"wall time"}};

template <>
inline constexpr std::tuple kFields<RingChange>{Field<&RingChange::kind>{}, Field<&RingChange::ring>{"identity"},
                                                Field<&RingChange::vertices_appeared>{},
                                                Field<&RingChange::vertices_disappeared>{}};

template <>
inline constexpr auto kFields<FrameChanges> =
    kMembers<&FrameChanges::rings, &FrameChanges::tight_points, &FrameChanges::tight_segments, &FrameChanges::topology>;

template <>
inline constexpr std::tuple kFields<Lifetime>{
    Field<&Lifetime::feature>{},    Field<&Lifetime::in>{"of a vertex; of an edge both are its contact"},
    Field<&Lifetime::out>{},        Field<&Lifetime::corner_p>{"of a vertex that is a sum of vertices"},
    Field<&Lifetime::corner_q>{},   Field<&Lifetime::hole>{"of a hole, its identity"},
    Field<&Lifetime::first_cell>{}, Field<&Lifetime::last_cell>{}};

template <>
inline constexpr std::tuple kFields<FamilyWork>{Field<&FamilyWork::events>{},
                                                Field<&FamilyWork::visible>{"events at which the structure changes"},
                                                Field<&FamilyWork::cells>{},
                                                Field<&FamilyWork::kept>{"cells whose structure is kept"},
                                                Field<&FamilyWork::names>{"different vertices"},
                                                Field<&FamilyWork::bytes>{"of structures"},
                                                Field<&FamilyWork::ms>{}};

template <>
inline constexpr auto kFields<ScaleContact> =
    kMembers<&ScaleContact::kind, &ScaleContact::part, &ScaleContact::obstacle, &ScaleContact::leg,
             &ScaleContact::along, &ScaleContact::at>;

template <>
inline constexpr auto kFields<ScaleInterval> =
    kMembers<&ScaleInterval::low, &ScaleInterval::high, &ScaleInterval::at_low, &ScaleInterval::at_high>;

template <>
inline constexpr std::tuple kFields<ScaleRange>{Field<&ScaleRange::free>{"intervals in order, disjoint"},
                                                Field<&ScaleRange::critical>{}, Field<&ScaleRange::tested>{}};

template <>
inline constexpr auto kFields<PlanarFeature> = kMembers<&PlanarFeature::kind, &PlanarFeature::index>;

template <>
inline constexpr std::tuple kFields<PlanarTouch>{
    Field<&PlanarTouch::p>{"by the region's indices"}, Field<&PlanarTouch::q>{},
    Field<&PlanarTouch::dimension>{"of what they have in common: 0 a point, 1 a segment"},
    Field<&PlanarTouch::at>{"one of these points, exact, Q being moved"},
    Field<&PlanarTouch::patch>{"the connected piece of all that touches, from 0 on"}};

template <>
inline constexpr std::tuple kFields<PlanarWay>{
    Field<&PlanarWay::move>{"exact"}, Field<&PlanarWay::direction>{"of length 1, rounded; zero where `move` is"},
    Field<&PlanarWay::contacts>{"all pairs of features that touch then, the greatest dimension first"}};

template <>
inline constexpr std::tuple kFields<PlanarDistance>{Field<&PlanarDistance::meeting>{},
                                                    Field<&PlanarDistance::squared>{"the exact square of `distance`"},
                                                    Field<&PlanarDistance::distance>{"the nearest double"},
                                                    Field<&PlanarDistance::ways>{"all shortest moves, sorted by x, y"}};

}  // namespace dymsum::names
