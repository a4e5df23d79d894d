"""Edited sums: scripts, recordings, and what is refused."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import pytest

import dymsum
from dymsum import Edit, EditableSum, EditOptions, MovingOperand, ScriptAction, SolidEdit, minkowski_sum, shapes, solids

P = MovingOperand.p
SCRIPT = """
p move 0 5/2 0   # out
{
  p insert 0 2 1/2
  q move 2 1 1.5
}
undo
redo
"""


def test_a_script_is_made_and_recorded(tmp_path: Path) -> None:
    sum = EditableSum(shapes.star(5, 1, 2), shapes.rectangle(0, 0, 1, 1), EditOptions(reflect_q=True))
    sum.record()
    steps = dymsum.parse_script(SCRIPT)
    assert [step.action for step in steps] == [ScriptAction.edit, ScriptAction.edit, ScriptAction.undo, ScriptAction.redo]
    assert [step.line for step in steps] == [2, 3, 7, 8]
    for step in steps:
        dymsum.make_step(sum, step)
    assert sum.sum() == minkowski_sum(sum.p(), dymsum.negated(sum.q()))
    recording = sum.recording()
    assert dymsum.format_script(recording.steps) == dymsum.format_script(steps)
    assert recording.hashes[-1] == sum.hash() and recording.reflect_q
    file = tmp_path / "session.json"
    file.write_text(dymsum.format_recording(recording))
    read = dymsum.read_recording(file)
    for again in (read, pickle.loads(pickle.dumps(read)), copy.deepcopy(read)):
        replay = dymsum.replay(again)
        assert (replay.steps, replay.differs, replay.refused) == (4, None, None)
    hashes = read.hashes[:2] + [read.hashes[2] ^ 1] + read.hashes[3:]
    other = dymsum.EditRecording(read.p, read.q, reflect_q=True, steps=read.steps, hashes=hashes)
    assert dymsum.replay(other).differs == 2


def test_steps_of_any_kind_are_recorded() -> None:
    sum = EditableSum(shapes.star(5, 1, 2), shapes.rectangle(0, 0, 1, 1))
    with pytest.raises(ValueError):
        sum.recording()
    sum.record()
    with sum.edit() as e:
        e.move(P, 0, (2.5, 0))
    with pytest.raises(dymsum.Error):
        sum.edit(Edit.remove(P, 99))
    sum.undo()
    assert dymsum.format_script(sum.recording().steps) == "p move 0 2.5 0\nundo\n"
    by_hand = dymsum.begin_recording(EditableSum(sum.p(), sum.q()))
    dymsum.record_step(by_hand, dymsum.parse_script("undo")[0], sum)
    refused = dymsum.replay(by_hand).refused
    assert isinstance(refused, dymsum.Error) and refused.code == dymsum.ErrorCode.out_of_range


def test_recording_begins_with_nothing_to_redo() -> None:
    sum = EditableSum(shapes.star(5, 1, 2), shapes.rectangle(0, 0, 1, 1))
    sum.edit(Edit.move(P, 0, (2.5, 0)))
    sum.undo()
    with pytest.raises(ValueError):
        sum.record()


def test_a_line_is_named() -> None:
    with pytest.raises(dymsum.Error) as raised:
        dymsum.parse_script("undo\np move 1 1/3 0", "edits.txt")
    assert raised.value.evidence.line == 2 and "1/3 is no double" in str(raised.value)


def test_solids_are_edited_recorded_and_pickled(tmp_path: Path) -> None:
    sum = dymsum.EditableSolidSum(solids.box(0, 0, 0, 1, 1, 1), solids.tessellated_cube(2, 1))
    sum.record()
    script = "p extrude 0 by 0 0 -1\n{\nq move 0 -1.5 -1 -1\np insert-in-face 1 0.5 0.5 2\n}\nundo\nredo\n"
    for step in dymsum.parse_solid_script(script):
        work = dymsum.make_step(sum, step)
    assert work.kept and work.vertices_edited == 2
    assert sum.sum() == minkowski_sum(sum.p(), sum.q()) == pickle.loads(pickle.dumps(sum.sum()))
    assert len(set(sum.face_names(P))) == len(sum.p().faces) == len(sum.face_ancestors(P))
    assert sum.vertex_names(P)[:8] == list(range(1, 9))
    before, names = sum.hash(), sum.vertex_names(P)
    with pytest.raises(dymsum.Error) as raised:
        sum.edit(SolidEdit.move(P, 0, (9, 9, 9)))
    assert raised.value.evidence.face is not None and sum.hash() == before and sum.vertex_names(P) == names
    file = tmp_path / "session.json"
    file.write_text(dymsum.format_recording(sum.recording()))
    replay = dymsum.replay(dymsum.read_solid_recording(file))
    assert (replay.steps, replay.differs) == (4, None)
    again = pickle.loads(pickle.dumps(sum))
    assert again.hash() == before
