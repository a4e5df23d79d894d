// Fields of what obstacles in (x, y, theta) and plans report.
#pragma once

#include "dymsum/cspace_obstacle.h"
#include "dymsum/field.h"
#include "dymsum/obstacle_queries.h"
#include "dymsum/path_check.h"
#include "dymsum/planner.h"

namespace dymsum::names {

template <>
inline constexpr auto kFields<Configuration> = kMembers<&Configuration::x, &Configuration::y, &Configuration::theta>;

template <>
inline constexpr auto kFields<ObstacleEvent> =
    kMembers<&ObstacleEvent::kind, &ObstacleEvent::angle, &ObstacleEvent::at>;

template <>
inline constexpr auto kFields<TightFeature> =
    kMembers<&TightFeature::angle, &TightFeature::from, &TightFeature::to, &TightFeature::error>;

template <>
inline constexpr std::tuple kFields<Patch>{Field<&Patch::contact>{},
                                           Field<&Patch::left>{},
                                           Field<&Patch::right>{},
                                           Field<&Patch::left_corner>{},
                                           Field<&Patch::right_corner>{},
                                           Field<&Patch::begin>{"index in angles(), or kNone"},
                                           Field<&Patch::end>{"index in angles(), or kNone"},
                                           Field<&Patch::shell>{}};

template <>
inline constexpr auto kFields<Shell> = kMembers<&Shell::outer, &Shell::patches, &Shell::euler, &Shell::free_component>;

template <>
inline constexpr auto kFields<ObstacleWork> =
    kMembers<&ObstacleWork::windows, &ObstacleWork::segments, &ObstacleWork::candidate_pairs,
             &ObstacleWork::candidate_triples, &ObstacleWork::surfaces, &ObstacleWork::potential_events,
             &ObstacleWork::visible_events, &ObstacleWork::alignments, &ObstacleWork::vertex_events,
             &ObstacleWork::triple_events, &ObstacleWork::tight_events, &ObstacleWork::local_updates,
             &ObstacleWork::slices, &ObstacleWork::exact_signs, &ObstacleWork::collision_tests, &ObstacleWork::ms>;

template <>
inline constexpr std::tuple kFields<Clearance>{
    Field<&Clearance::distance>{"negative inside: minus the penetration depth"},
    Field<&Clearance::error>{"proved: the exact distance differs by at most this"},
    Field<&Clearance::patch>{"where the nearest point lies; Patch.kNone at a tight placement"},
    Field<&Clearance::nearest>{}};

template <>
inline constexpr auto kFields<FreeAngles> =
    kMembers<&FreeAngles::begin, &FreeAngles::end, &FreeAngles::begin_error, &FreeAngles::end_error,
             &FreeAngles::begin_patch, &FreeAngles::end_patch>;

template <>
inline constexpr auto kFields<FreeComponent> =
    kMembers<&FreeComponent::index, &FreeComponent::unbounded, &FreeComponent::all_angles, &FreeComponent::from,
             &FreeComponent::to, &FreeComponent::shells>;

template <>
inline constexpr auto kFields<SearchLimit::Passage> =
    kMembers<&SearchLimit::Passage::from, &SearchLimit::Passage::to, &SearchLimit::Passage::reached,
             &SearchLimit::Passage::beyond>;

template <>
inline constexpr auto kFields<SearchLimit> =
    kMembers<&SearchLimit::out_of_time, &SearchLimit::seconds, &SearchLimit::passage>;

template <>
inline constexpr auto kFields<NoPath> = kMembers<&NoPath::kind, &NoPath::text, &NoPath::contact, &NoPath::start,
                                                 &NoPath::goal, &NoPath::limit, &NoPath::unexamined_angles>;

template <>
inline constexpr auto kFields<PlanWork> =
    kMembers<&PlanWork::levels, &PlanWork::slices, &PlanWork::rotations, &PlanWork::refinements, &PlanWork::ms>;

template <>
inline constexpr auto kFields<PathCheck> =
    kMembers<&PathCheck::outcome, &PathCheck::piece, &PathCheck::moves, &PathCheck::turns, &PathCheck::low,
             &PathCheck::high, &PathCheck::at, &PathCheck::contact, &PathCheck::pieces>;

}  // namespace dymsum::names
