"""Events of a sum of solids while one of them turns."""

from __future__ import annotations

import math
import pickle
from fractions import Fraction

import pytest

import dymsum
from dymsum import AxisTurn, SolidRotationEvents, SolidRotationOptions, solids

BOX = solids.box(-1, -1, -1, 1, 1, 1)


def test_boxes_change_at_quarter_turns() -> None:
    sum = SolidRotationEvents(BOX, BOX, (0, 0, 3))
    assert tuple(sum.axis()) == (0, 0, 1)
    events = sum.events(AxisTurn.of(Fraction(-1, 2)), AxisTurn.of(1))
    assert [event.exact.t() for event in events] == [0, 1]
    assert all(event.visible and event.contacts for event in events)
    found = sum.next_event(events[0].exact, AxisTurn.half_turn())
    assert found is not None and found.exact == AxisTurn.of(1)
    assert math.isclose(found.radians, math.pi / 2)
    assert sum.at(found.exact).volume() == 64
    assert sum.work().events == 1


def test_turns_and_sums_pickle() -> None:
    turn = AxisTurn.nearest((1, 2, 3), 0.5)
    assert math.isclose(turn.radians((1, 2, 3)), 0.5)
    assert pickle.loads(pickle.dumps(turn)) == turn and hash(turn) == hash(AxisTurn.of(turn.t()))
    sum = SolidRotationEvents(BOX, BOX, (1, 2, 3), SolidRotationOptions(tight=False))
    at = sum.at(turn)
    assert pickle.loads(pickle.dumps(at)) == at
    again = pickle.loads(pickle.dumps(sum))
    assert not again.options.tight
    assert again.combinatorial_hash(again.at(turn)) == sum.combinatorial_hash(at)


def test_errors() -> None:
    with pytest.raises(dymsum.Error):
        SolidRotationEvents(BOX, BOX, (0, 0, 0))
    with pytest.raises(dymsum.Error):
        AxisTurn.nearest((0, 0, 1), math.nan)
