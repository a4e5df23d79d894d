"""Sums of solids of all scales of an interval, and of all angles, as one object."""

from __future__ import annotations

import pickle
import threading
from fractions import Fraction

import pytest

import dymsum
from dymsum import AxisTurn, EventChange, MovingOperand, SolidFamilyOptions, SolidRotationFamily, SolidScalingFamily, solids

ELL = solids.prism([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)], 1.0)
CUP = solids.prism([(0, 0), (4, 0), (4, 3), (3, 3), (3, 1), (1, 1), (1, 3), (0, 3)], 1.0)
BOX = solids.box(0, 0, 0, 1, 1, 1)


def test_sums_are_those_from_scratch() -> None:
    options = SolidFamilyOptions(moving=MovingOperand.q)
    family = SolidScalingFamily(CUP, ELL, Fraction(1, 4), 1, options)
    assert family.events() and family.work().cells == len(family.events()) + 1
    for s in (Fraction(2, 7), Fraction(3, 10), Fraction(2, 7), Fraction(9, 10), *(e.s for e in family.events()[:3])):
        scale = dymsum.Scale.of(s)
        pose = dymsum.SolidPose(scale=[scale, scale, scale])
        assert family.at(s) == dymsum.posed_sum(CUP, ELL, dymsum.SolidPose(), pose), s
    assert family.work().made <= 3
    listed = dymsum.SolidScaleEvents(CUP, ELL).events(Fraction(1, 4), 1)
    assert family.changes(Fraction(1, 4), 1) == listed
    assert family.next(Fraction(1, 4)) == next(e for e in listed if e.s > Fraction(1, 4))
    assert all(e.topology for e in family.changes(Fraction(1, 4), 1, EventChange.topology))
    first = family.locate(family.events()[0].s)
    assert (first.index, first.event) == (0, True)
    with pytest.raises(dymsum.Error):
        family.at(2)
    again = pickle.loads(pickle.dumps(family))
    assert again.at(Fraction(1, 3)) == family.at(Fraction(1, 3)) and again.options().moving == MovingOperand.q
    sum = family.at(Fraction(1, 3))
    assert pickle.loads(pickle.dumps(sum)) == sum


def test_the_volume_is_a_polynomial() -> None:
    family = SolidScalingFamily(ELL, BOX, 1, 3)
    c = family.volume_polynomial(Fraction(5, 4))
    for s in (Fraction(5, 4), Fraction(9, 7)):
        if family.locate(s).index == family.locate(Fraction(5, 4)).index:
            assert family.at(s).volume_exact() == c[0] + c[1] * s + c[2] * s**2 + c[3] * s**3
    assert c[0] == 1 and c[3] == 5  # of the box, and of P


def test_lifetimes_and_memory() -> None:
    options = SolidFamilyOptions(moving=MovingOperand.q, structure_bytes=1)
    family = SolidScalingFamily(CUP, BOX, Fraction(1, 2), 4, options)
    lives = family.lifetimes()
    assert {life.feature for life in lives} == {dymsum.SolidFamilyFeature.face, dymsum.SolidFamilyFeature.shell}
    assert all(life.first_cell <= life.last_cell < family.work().cells for life in lives)
    assert family.work().kept == 1


def test_threads_share_a_family() -> None:
    family = SolidScalingFamily(CUP, ELL, Fraction(1, 4), 1)
    expected = [family.at(Fraction(k, 40)) for k in range(10, 40)]
    wrong: list[int] = []

    def ask() -> None:
        for k in range(10, 40):
            if family.at(Fraction(k, 40)) != expected[k - 10]:
                wrong.append(k)

    threads = [threading.Thread(target=ask) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_turns() -> None:
    some, more = AxisTurn.of(Fraction(-1, 5)), AxisTurn.of(Fraction(1, 5))
    family = SolidRotationFamily(ELL, BOX, (0, 0, 1), some, more)
    plain = dymsum.SolidRotationEvents(ELL, BOX, (0, 0, 1))
    for t in (Fraction(-1, 7), Fraction(-1, 8), Fraction(0), Fraction(1, 9), Fraction(1, 5)):
        assert family.at(AxisTurn.of(t)) == plain.at(AxisTurn.of(t)), t
    assert family.locate(AxisTurn.of(Fraction(0))).event and list(family.ends() or ()) == [some, more]
    assert family.next(some) is not None and list(family.axis()) == [0, 0, 1]
    again = pickle.loads(pickle.dumps(family))
    assert len(again.events()) == len(family.events())
    sum = family.at(AxisTurn.of(Fraction(1, 9)))
    assert pickle.loads(pickle.dumps(sum)) == sum
    with pytest.raises(dymsum.Error):
        family.at(AxisTurn.half_turn())
    with pytest.raises(ValueError):
        family.locate(AxisTurn.half_turn())
    with pytest.raises(ValueError):
        SolidRotationFamily(ELL, BOX, (0, 0, 1), some)
