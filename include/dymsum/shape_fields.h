// Fields of what growing discs see of a region.
#pragma once

#include "dymsum/decomposition.h"
#include "dymsum/field.h"
#include "dymsum/growing_disc.h"
#include "dymsum/shape_features.h"

namespace dymsum::names {

template <>
inline constexpr std::tuple kFields<FeatureBar>{
    Field<&FeatureBar::born>{},
    Field<&FeatureBar::died>{},
    Field<&FeatureBar::birth>{"event; equal events are exactly equal diameters"},
    Field<&FeatureBar::death>{"event; None: never"},
    Field<&FeatureBar::birth_alpha>{"diameter, the nearest double"},
    Field<&FeatureBar::death_alpha>{"the same; infinity for never"},
    Field<&FeatureBar::parent>{"index of the bar that it merged into"},
    Field<&FeatureBar::vertex>{"of the region: where a corner is born"},
    Field<&FeatureBar::minimum>{"vertex of the region: the pocket minimum; None of gaps"},
    Field<&FeatureBar::concavity>{"of the minimum where the bar dies, rounded"},
    Field<&FeatureBar::counts_from>{"diameter from which significant() counts its life, rounded"},
    Field<&FeatureBar::significance>{"how much it counts: see significant(); infinity for gaps without end"},
    Field<&FeatureBar::in_hole>{"its disc touches the ring of a hole"},
    Field<&FeatureBar::loop>{"boundary ring of its minimum: outer ring, then holes, part by part"}};

template <>
inline constexpr std::tuple kFields<BridgeContact>{Field<&BridgeContact::at_vertex>{},
                                                   Field<&BridgeContact::index>{"vertex or edge of the region"},
                                                   Field<&BridgeContact::at>{"rounded"}};

template <>
inline constexpr std::tuple kFields<AlphaBridge>{
    Field<&AlphaBridge::from>{},
    Field<&AlphaBridge::to>{},
    Field<&AlphaBridge::centre>{"of the disc, rounded"},
    Field<&AlphaBridge::gap>{"between two boundary rings: there is no pocket"},
    Field<&AlphaBridge::length>{},
    Field<&AlphaBridge::bar>{"index of its bar"},
    Field<&AlphaBridge::minimum>{"vertex of the region"},
    Field<&AlphaBridge::concavity>{},
    Field<&AlphaBridge::pocket_size>{"vertices of the pocket between the contacts"}};

template <>
inline constexpr std::tuple kFields<Cut>{
    Field<&Cut::vertex>{"of the region: where it begins"},
    Field<&Cut::end>{},
    Field<&Cut::index>{"vertex or edge of the region, or earlier cut, that it ends at"},
    Field<&Cut::from>{},
    Field<&Cut::to>{},
    Field<&Cut::bar>{"the most significant bar whose minimum it begins at; of a partner that of the other cut"},
    Field<&Cut::partner>{"made at once with a cut that would have separated nothing without it"},
    Field<&Cut::runs>{"what of it separates pieces: all but the holes that it passes over and their edges"}};

template <>
inline constexpr std::tuple kFields<DiscEvent>{
    Field<&DiscEvent::radius>{"the nearest double"},
    Field<&DiscEvent::nodes>{"discs that touch the region there as others beside them do not"}};

template <>
inline constexpr auto kFields<Measured> = kMembers<&Measured::value, &Measured::error>;

template <>
inline constexpr auto kFields<Piece> = kMembers<&Piece::outer, &Piece::holes>;

template <>
inline constexpr std::tuple kFields<Decomposition>{
    Field<&Decomposition::cuts>{"in the order in which they were made"},
    Field<&Decomposition::pieces>{"they tile the region: its connected components without the cuts"}};

}  // namespace dymsum::names
