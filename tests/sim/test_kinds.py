"""Every kind of object has an entry in every place that needs one; what a kind does not need, its table says so."""

import ast
import inspect
import re
from collections import Counter
from collections.abc import Callable
from math import inf
from pathlib import Path
from typing import Any

import pytest

from ninja_game.backend.plain import PlainWorlds
from ninja_game.editor.palette import OBJECT_TYPES
from ninja_game.formats.ascii.legend import SYMBOLS
from ninja_game.formats.ascii.object_lines import FORMS
from ninja_game.learn.observations import objects
from ninja_game.learn.observations.pixels import SHADES
from ninja_game.levels.picture import SIGN_COLOURS
from ninja_game.runs.advice import WHY
from ninja_game.runs.deaths import KILLERS, SELF
from ninja_game.runs.level_design import clearance
from ninja_game.runs.trace import trace_level
from ninja_game.search.formula.names import FLAGS
from ninja_game.sim import events, kinds
from ninja_game.sim.death import idle_event
from ninja_game.sim.digest import replay_digest
from ninja_game.sim.kinds import INERT, KINDS, NINJA, NO_KIND, Kind
from ninja_game.sim.level import Level, ObjectSpec
from ninja_game.sim.objects import dispatch
from ninja_game.sim.rules import RADIUS
from ninja_game.sim.schema.object_fields import Header, Object
from ninja_game.sim.traces import is_traced, status_of
from ninja_game.ui.audio.music import affects_music
from ninja_game.ui.audio.table import BY_DEATH, BY_EVENT, OTHER_DEATH, warning_of
from ninja_game.view.ninja.ragdoll import KICKS
from ninja_game.view.sprites.moving_sprites import PAINTERS
from ninja_game.view.sprites.object_animation import STATE_FIELDS
from ninja_game.view.sprites.static_sprites import static_sprites_of
from tests.support.crowded import crowded_inputs, crowded_level
from tests.support.own_fields import own_fields_only

ROOT = Path(__file__).resolve().parent.parent.parent
OF_LEVELS = [kind for kind in KINDS if kind.number >= 0]
DISPATCHING: dict[str, Callable[..., Any]] = {
    "create": dispatch.create,
    "touch": dispatch.touch,
    "update": dispatch.update_objects,
    "think": dispatch.think,
    "idle": idle_event,
    "status": status_of,
}
SILENT = {
    events.DIED,  # sounds by its cause
    events.BLOCK_WOKEN, events.THWUMP_FELL, events.THWUMP_LANDED, events.GUARD_STARTED,
    events.LASER_ON, events.LASER_OFF, events.CHAINGUN_ON,
}  # fmt: skip
"""Events that deliberately have no sound of their own; some start or end a loop."""


RULES: dict[int, tuple[str, ...]] = {
    kinds.GOLD: ("create", "touch", "idle", "status"),
    kinds.BOUNCE_BLOCK: ("create", "touch", "update", "think", "status"),
    kinds.LAUNCH_PAD: ("create", "touch"),
    kinds.TURRET: ("create", "update", "think", "idle", "status"),
    kinds.FLOOR_GUARD: ("create", "touch", "update", "idle", "status"),
    kinds.DRONE: ("create", "touch", "update", "think", "idle", "status"),
    kinds.ONE_WAY: ("create", "touch"),
    kinds.THWUMP: ("create", "touch", "update", "status"),
    kinds.DOOR: ("create", "touch", "update", "idle", "status"),
    kinds.LAUNCHER: ("create", "touch", "update", "think", "idle", "status"),
    kinds.EXIT: ("create", "touch", "idle", "status"),
    kinds.MINE: ("create", "touch", "status"),
    kinds.SWITCH: ("touch",),
    kinds.NINJA: (),
    kinds.INERT: (),
}
"""By kind the dispatching functions that know it."""


def chained(function: Callable[..., Any]) -> Counter[int]:
    """The kinds that a function compares ``kind`` with, as often as it does."""
    found: list[int] = []
    for node in ast.walk(ast.parse(inspect.getsource(function))):
        if isinstance(node, ast.Compare) and isinstance(node.left, ast.Name) and node.left.id == "kind":
            for side in node.comparators:
                names = side.elts if isinstance(side, ast.Set) else [side]
                found += [getattr(kinds, ast.unparse(name).removeprefix("kinds.")) for name in names]
    return Counter(found)


@pytest.mark.parametrize("rule", DISPATCHING)
def test_each_dispatching_function_knows_just_the_kinds_that_the_table_says(rule: str) -> None:
    distinguished = chained(DISPATCHING[rule])
    assert max(distinguished.values()) == 1, "a kind stands twice: its second branch is never reached"
    assert set(distinguished) == {kind.number for kind in KINDS if rule in RULES[kind.number]}


def test_rules_in_the_table_are_known() -> None:
    assert {rule for known in RULES.values() for rule in known} == set(DISPATCHING)


def test_numbers_are_in_order_and_internal_kinds_can_never_meet_a_new_one() -> None:
    assert [kind.number for kind in KINDS if kind.number >= 0] == list(range(len(OF_LEVELS)))
    assert len({kind.number for kind in KINDS} | {NO_KIND}) == len(KINDS) + 1
    assert len({kind.name for kind in KINDS}) == len(KINDS)
    assert {kind.number for kind in KINDS} | {NO_KIND} == {
        value for name, value in vars(kinds).items() if name.isupper() and isinstance(value, int)
    }


def named(function: Callable[..., Any]) -> set[int]:
    """The kinds that a function names at all."""
    nodes = ast.walk(ast.parse(inspect.getsource(function)))
    names = {node.id if isinstance(node, ast.Name) else getattr(node, "attr", "") for node in nodes}
    return {kind.number for kind in KINDS} & {vars(kinds).get(name) for name in names if name.isupper()}


STEADY = {kinds.GOLD, kinds.MINE, kinds.SWITCH}
MACHINES = {kinds.BOUNCE_BLOCK, kinds.TURRET, kinds.FLOOR_GUARD, kinds.THWUMP, kinds.LAUNCHER}
HARMLESS = {kind.number for kind in KINDS if not kind.killer}
PLACES: dict[str, tuple[set[int], set[int]]] = {
    "velocity": (
        named(objects.velocity_of),
        STEADY | {kinds.LAUNCH_PAD, kinds.TURRET, kinds.ONE_WAY, kinds.DOOR, kinds.EXIT},
    ),
    "face": (
        named(objects.face_of),
        STEADY | {kinds.BOUNCE_BLOCK, kinds.FLOOR_GUARD, kinds.LAUNCHER, kinds.DOOR, kinds.EXIT},
    ),
    "activity": (named(objects.activity_of), STEADY | {kinds.LAUNCH_PAD, kinds.ONE_WAY}),
    "warning": (named(warning_of), HARMLESS | {kinds.MINE, kinds.THWUMP}),
    "music": (named(affects_music), HARMLESS - {kinds.EXIT} | {kinds.MINE, kinds.THWUMP}),
    # A switch looks as its exit does.
    "look": (set(STATE_FIELDS), MACHINES | {kinds.LAUNCH_PAD, kinds.ONE_WAY, kinds.SWITCH}),
    "formula": (
        {kind for fields in FLAGS.values() for kind in fields},
        MACHINES | {kinds.DRONE, kinds.LAUNCH_PAD, kinds.ONE_WAY, kinds.SWITCH},
    ),
}
"""By place: the kinds that it knows, and those that need nothing there."""


@pytest.mark.parametrize("place", PLACES)
def test_a_place_knows_each_kind_or_the_kind_needs_nothing_there(place: str) -> None:
    known, without = PLACES[place]
    assert not known & without
    assert known | without >= {kind.number for kind in KINDS} - {NINJA, INERT}


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: str(kind.name))
def test_a_kind_is_complete_in_the_world(kind: Kind) -> None:
    assert kind.fields is Header or kind.fields in Object.__bases__
    assert ("create" in RULES[kind.number]) == (kind.number >= 0 and kind.number != NINJA)
    assert ("touch" in RULES[kind.number]) == (kind.disc is not None) + (kind.box is not None), (
        "its contact needs one shape"
    )
    assert not kind.by_touch or (kind.killer and "touch" in RULES[kind.number])


def test_every_class_of_the_schema_belongs_to_a_kind() -> None:
    assert {kind.fields for kind in KINDS} == {Header, *Object.__bases__}


@pytest.mark.parametrize("kind", OF_LEVELS, ids=lambda kind: str(kind.name))
def test_a_kind_can_be_written_and_read(kind: Kind) -> None:
    assert any(symbol.kind == kind.number for symbol in SYMBOLS), "no character in the legend"
    assert any(form.kind == kind.number for form in FORMS.values()), "no form in lists of objects"
    assert kind.number in SIGN_COLOURS, "no colour in the terminal"
    assert kind.value_count >= 2


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: str(kind.name))
def test_a_kind_is_drawn(kind: Kind) -> None:
    assert kind.moves == (kind.number in PAINTERS)
    hidden = kind.number in (NINJA, INERT)
    assert hidden != (kind.moves or kind.number in chained(static_sprites_of))


def test_who_kills_is_counted_and_what_helps_against_it_is_said() -> None:
    assert {kind.killer for kind in KINDS if kind.killer} <= set(KILLERS)
    assert set(WHY) == set(KILLERS) - {SELF}


@pytest.mark.parametrize("kind", [kind for kind in OF_LEVELS if kind.killer], ids=lambda kind: str(kind.name))
def test_what_kills_counts_where_a_level_is_judged(kind: Kind) -> None:
    hazard = next(each.spec for each in OBJECT_TYPES if each.spec.kind == kind.number)
    placed = ObjectSpec(kind.number, (252.0, 300.0, *hazard.values[2:]))
    (space,) = clearance(trace_level(Level(objects=(ObjectSpec(NINJA, (120.0, 300.0)), placed)), bytes(1)))
    # What shoots has not begun to.
    expected = 132 - RADIUS - (kind.disc or kind.box or 0) if kind.disc or kind.box else inf
    assert space == pytest.approx(expected, abs=3)


def test_who_never_sleeps_costs_more_work_than_others() -> None:
    assert {kind.number for kind in KINDS if kind.cost > 1} == set(kinds.ENEMIES)


def test_the_field_that_shows_use_is_one_of_the_kind_s() -> None:
    assert all(kind.used in inspect.get_annotations(kind.fields) for kind in KINDS if kind.used)


def test_a_corpse_is_kicked_by_what_is_solid_and_by_what_kills_where_it_goes() -> None:
    solid = {kind.number for kind in KINDS if kind.box or kind.number == kinds.LAUNCH_PAD}
    # A rocket's tip is a point.
    assert set(KICKS) == solid | {*kinds.MOVING_ENEMIES} - {kinds.LAUNCHER}


@pytest.mark.parametrize("kind", [kind for kind in OF_LEVELS if kind.number != NINJA], ids=lambda kind: str(kind.name))
def test_a_kind_can_be_placed_and_agents_see_it(kind: Kind) -> None:
    assert kind.number in {each.spec.kind for each in OBJECT_TYPES}, "the editor's palette has no brush for it"
    assert kind.number in SHADES, "pictures for agents have no shade for it"


def test_every_event_has_a_name_and_a_sound_or_deliberately_none() -> None:
    assert set(BY_EVENT) | SILENT == set(range(len(events.EVENT_NAMES)))
    assert not set(BY_EVENT) & SILENT
    assert all(BY_DEATH.values())
    assert OTHER_DEATH


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind.traced], ids=lambda kind: str(kind.name))
def test_what_a_trace_shows_of_a_kind_is_documented(kind: Kind) -> None:
    table = (ROOT / "docs" / "replay-format.md").read_text("utf-8").partition("| kind | x, y | s |")[2]
    first_column = re.findall(r"^\| ([^|]+) \|", table, re.MULTILINE)
    assert kind.name in ", ".join(first_column).split(", ")


@pytest.mark.parametrize("seed", range(12))
def test_rules_and_traces_read_only_fields_that_an_object_s_kind_has(seed: int) -> None:
    memory = PlainWorlds([crowded_level(seed)], box=bool(seed % 2))
    slots = [slot for slot in range(1, memory.number("id_count") + 1) if is_traced(memory.world(), slot)]
    with own_fields_only():
        assert len(memory.trace(crowded_inputs(seed), slots, events=True).ninja)
        assert replay_digest(memory.world())
