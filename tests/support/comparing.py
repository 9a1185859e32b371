"""Compare a run with the reference, and say where they part: tick, thing, field, both values, section."""

import numpy as np

from ninja_game.formats.n14.demo import parse_demo
from ninja_game.formats.n14.level_string import parse_level_string
from ninja_game.runs.run import run_level
from ninja_game.runs.trace import NINJA_RECORD, OBJECT_RECORD, RunTrace, first_difference, trace_digests, trace_level
from ninja_game.sim.states import STATE_NAMES
from tests.support import reference


def trace_of(data: str, demo: str, ticks: int, memory: str) -> RunTrace:
    """The whole trace of a reference run: exactly ``ticks`` ticks, whatever happens."""
    return trace_level(parse_level_string(data), parse_demo(demo).playback(ticks), memory=memory)


def scene_difference(scene: reference.SceneRow, memory: str) -> str:
    """What differs between a scene's run and its recorded trace, in one line; empty if nothing does."""
    ours = trace_of(scene.data, scene.demo, scene.ticks, memory)
    if trace_digests(ours).run_sha256 == scene.run_sha256:
        return ""
    size = NINJA_RECORD.itemsize + OBJECT_RECORD.itemsize * len(ours.ids)
    raw = np.frombuffer(reference.scene_traces(), np.uint8, scene.ticks * size, scene.offset).reshape(scene.ticks, size)
    ninja = np.ascontiguousarray(raw[:, : NINJA_RECORD.itemsize]).view(NINJA_RECORD)[:, 0]
    objects = np.ascontiguousarray(raw[:, NINJA_RECORD.itemsize :]).view(OBJECT_RECORD)
    theirs = RunTrace(ninja, objects.reshape(scene.ticks, len(ours.ids)), ours.ids, ours.kinds)
    return f"{scene.rule}: {scene.name}: {first_difference(ours, theirs, scene.rule) or 'only the digest differs'}"


def run_difference(row: reference.RunRow, memory: str) -> str:
    """What differs between a recording's run and the table: positions and states first; empty if nothing does."""
    inputs = parse_demo(row.demo).playback(int(row.demo.partition(":")[0]) + 1)
    ours = run_level(parse_level_string(row.data), inputs, memory=memory)
    summary = (ours.outcome, ours.end_tick, ours.gold, ours.ticks)
    states = reference.positions()[row.offset + 16 * row.ticks : row.offset + 17 * row.ticks]
    if ours.xy_sha256 == row.sha256_xy and ours.states.tobytes() == states:
        expected = (row.outcome, row.end_tick, row.gold, row.ticks)
        return "" if summary == expected else f"{row.table} {row.row} ({row.label}): {summary}, expected {expected}"
    theirs = np.frombuffer(reference.positions(), "<f8", 2 * row.ticks, row.offset).reshape(-1, 2)
    for tick, (mine, other) in enumerate(zip(ours.positions.tolist(), theirs.tolist(), strict=False)):
        if mine != other or ours.states[tick] != states[tick]:
            names = STATE_NAMES[ours.states[tick]], STATE_NAMES[states[tick]]
            return f"{row.table} {row.row} ({row.label}): tick {tick}: {mine} {names[0]}, expected {other} {names[1]}"
    return f"{row.table} {row.row} ({row.label}): {summary[0]} after {ours.ticks} ticks, expected {row.ticks}"


def digest_difference(trace: RunTrace, name: str, ninja_sha256: str, run_sha256: str, objects: dict[int, str]) -> str:
    """Which parts of a run have another digest than the reference's; empty if none."""
    ours = trace_digests(trace)
    if (ours.ninja_sha256, ours.run_sha256) == (ninja_sha256, run_sha256):
        return ""
    kinds = dict(zip(trace.ids, trace.kinds, strict=True))
    parts = ["the ninja"] if ours.ninja_sha256 != ninja_sha256 else []
    parts += [f"object {id_} ({kinds[id_]})" for id_, digest in objects.items() if ours.objects.get(id_) != digest]
    return f"{name}: {', '.join(parts[:5]) or 'objects without digests'} differ"
