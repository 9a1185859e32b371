"""A test of a message, and messages beside each other in the known run and in play."""

import re
from dataclasses import replace
from typing import Any
from unittest.mock import patch

import pygame
import pytest

from ninja_game.editor.draft import Draft
from ninja_game.editor.playtests import lead_in, place_before
from ninja_game.editor.solver import search_of
from ninja_game.editor.stamp import Stamp, with_stamp
from ninja_game.formats.ascii.reader import parse_ascii_level
from ninja_game.formats.messages import Moment
from ninja_game.formats.replay.input_text import read_inputs
from ninja_game.play.editor.playtest import PlaytestScreen
from ninja_game.play.level.hud_view import hud_view
from ninja_game.play.level.level_play import Phase
from ninja_game.player.playthrough import Playthrough
from ninja_game.runs.message_queue import read_ticks
from ninja_game.search.certificate import verified_run
from ninja_game.sim.grid import cell_of, middle_of
from ninja_game.sim.inputs import with_press_bits
from ninja_game.sim.kinds import GOLD, MINE
from ninja_game.sim.level import ObjectSpec
from ninja_game.sim.rules import CELL, RADIUS, TICKS_PER_SECOND
from ninja_game.simulation import Simulation
from ninja_game.view.hud import Hud, PlacedMessage
from ninja_game.view.places import away_from
from tests.support.draw_log import DrawLog, drawn
from tests.support.level_maker import ROOM, Maker
from tests.support.message_page import DOORS, LONG, RIGHT, WELCOME, AtOnce, opened, said, select, words


def column_of_ninja(trying: PlaytestScreen) -> int:
    ninja = trying.attempt.simulation.ninja
    return cell_of(ninja.x, ninja.y)[0]


def test_a_message_is_tried_from_just_before_it_and_esc_comes_back(room: Maker) -> None:
    screen = opened(room, "start: Go | at 20,22: Here | switch: Out")
    places = []
    for row in range(3):
        select(room, row)
        room.choose("Test")
        trying = room.shown(PlaytestScreen)
        places.append((column_of_ninja(trying), len(trying.play.playthrough.messages())))
        room.press("escape")
        assert room.top() is screen
    assert places == [(2, 3), (17, 3), (2, 3)]
    screen.edited.rows[1].detail = "20,22 9x5"
    select(room, 1)
    room.choose("Test")
    assert column_of_ninja(room.shown(PlaytestScreen)) == 15, "before its wider frame"
    room.press("escape")
    screen.edited.rows[0].text = ""
    room.choose("Test")
    assert room.top() is screen
    assert "Type what is said" in words(room)


def test_a_test_of_a_message_begins_where_the_ninja_lives_on_the_way_to_it(room: Maker) -> None:
    mines = tuple(ObjectSpec(MINE, middle_of((column, 22))) for column in range(8, 12))
    block = Stamp(dict.fromkeys([(column, 19) for column in range(14, 26)], 1))
    draft = with_stamp(with_stamp(room.draft, block), Stamp({}, mines))
    # On a block: from the side of the start, though both sides are alike.
    assert place_before(draft, middle_of((19, 18))) == middle_of((16, 18))
    assert place_before(draft, middle_of((5, 22))) is None, "that near is the level's start"
    # Both sides of this one are deadly, so it is the level's start.
    assert place_before(draft, middle_of((14, 22))) == middle_of((17, 22))
    assert place_before(draft, middle_of((8, 22))) == middle_of((5, 22))
    wide, high = middle_of((18, 18)), middle_of((19, 17))
    assert place_before(draft, wide, (7, 1)) == middle_of((14, 18)), "outside its frame"
    assert place_before(draft, high, (1, 7)) == middle_of((17, 18)), "on the floor beside its frame"
    shaft = with_stamp(
        Draft(DOORS), Stamp(dict.fromkeys([(column, row) for column in (6, 8) for row in range(12, 24)], 1))
    )
    floor = with_stamp(shaft, Stamp({(7, 16): 1}))
    assert place_before(floor, middle_of((7, 14))) == middle_of((7, 15)), "between walls"
    tight = with_stamp(draft, Stamp({}, (ObjectSpec(MINE, middle_of((5, 22))),)))
    assert place_before(tight, middle_of((8, 22))) == middle_of((6, 22)), "nearer, without room"


def test_a_test_in_aknown_run_begins_a_second_before_in_the_air_if_it_last_stood_long_before() -> None:
    level = parse_ascii_level(
        "\n".join(["ninja-game level 1", "|@" + "." * 30 + "|", *["|" + "." * 31 + "|"] * 22])
    ).level
    run, slides = Simulation(level), bytes([1]) * 600
    run.step_keys(1)
    while run.ninja.in_air:
        run.step_keys(1)
    landed = run.tick
    assert landed > 4 * TICKS_PER_SECOND, "down the wall"
    assert len(lead_in(level, slides, landed)) == landed - TICKS_PER_SECOND
    assert not lead_in(level, slides, 3 * TICKS_PER_SECOND), "the start is near"
    jumps = bytes([1]) * landed + with_press_bits(bytes([4]) * 20) + bytes(90)
    assert len(lead_in(level, jumps, landed + TICKS_PER_SECOND + 15)) == landed + 1, "where it stood"


def test_a_message_lies_where_it_will_in_play_wherever_its_test_begins(room: Maker) -> None:
    session = room.editor.session
    room.put_says("at 21,19: A text that lies beside the place")
    run = verified_run(ROOM.level, with_press_bits(bytes([2]) * 100))
    session.certifier.certification = search_of(room.draft.level, run)
    screen = opened(room)
    drawn(room.app)
    assert screen.checks.known_run.result
    shown = screen.checks.known_run.result[2]
    assert len(shown) > 3, "the run's way too"
    room.choose("Test")
    trying = room.shown(PlaytestScreen)
    assert trying.attempt.simulation.ninja.x > 300
    assert trying.play.things == shown
    room.press("escape")
    room.choose("Cancel")
    session.save(room.app.player.folder / "levels" / "said.txt")
    session.certify_file()
    entry = session.entry
    assert entry
    _, way = Playthrough(room.app.player, entry).beginning()
    assert way == session.certifying_inputs != b""


@pytest.mark.parametrize(
    "says, column",
    [("lock: Now", 9), ("lock 11,22: Now", 11), ("trap: Now", 13), ("gold 18,22: Now", 18), ("at 20,22 1x1: Now", 20)],
)
def test_a_test_begins_in_theknown_run_a_second_before_the_message(
    doors: Maker, monkeypatch: pytest.MonkeyPatch, says: str, column: int
) -> None:
    monkeypatch.setattr(doors.app.controls, "poll", lambda: 2)
    opened(doors, f"death 1: Go | {says}")
    select(doors, 1)
    doors.choose("Test")
    trying = doors.shown(PlaytestScreen)
    play = trying.play
    for _ in range(2):
        began = play.attempt.simulation.tick
        assert play.phase is Phase.READY
        assert bytes(play.attempt.inputs) == RIGHT[:began]
        play.begin()
        while "Now" not in said(play) and play.attempt.outcome == "running":
            play.run_ticks(1)
        assert 40 <= play.attempt.simulation.tick - began + (began == 0) * 40 <= 60
        assert abs(column_of_ninja(trying) - column) < 2
        play.retry()
    play.begin()
    while play.attempt.outcome != "exit":
        play.run_ticks(1)
    assert play.notices == ["It can be passed"], "its beginning was the solver's"


def test_a_test_of_what_is_said_after_deaths_or_seconds_begins_there(doors: Maker) -> None:
    opened(doors, "start: Go | death 3: Three | after 9 s: Nine")
    texts = []
    for row in (1, 2):
        select(doors, row)
        doors.choose("Test")
        trying = doors.shown(PlaytestScreen)
        texts.append((trying.play.messages.text, trying.attempt.simulation.tick))
        doors.press("escape")
    assert texts == [("Three", 0), ("Go", 8 * 40 - 1)], "the run is over by then: the ninja stands"


def test_without_aknown_run_a_test_goes_on_from_the_last_one(doors: Maker, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(type(doors.editor.session), "certifying_inputs", property(lambda _: b""))
    opened(doors, "trap: Now")
    doors.choose("Test")
    assert column_of_ninja(doors.shown(PlaytestScreen)) == 10, "beside the switch"
    doors.press("escape")
    doors.editor.session.add_playtest(doors.draft.level, RIGHT, over=True)
    doors.choose("Test")
    assert bytes(doors.shown(PlaytestScreen).attempt.inputs) == RIGHT[:26]


RUN = f"in the known run ({len(RIGHT) / TICKS_PER_SECOND:.1f} s)"


def test_a_message_that_is_lost_to_another_is_a_problem_with_its_place(doors: Maker) -> None:
    session = doors.editor.session
    session.certifier.certification = search_of(doors.draft.level, verified_run(doors.draft.level, RIGHT))
    doors.put_says("trap: Two | at 15,22!: Three | at 18,22: Four | at 9,22: Five | gold!: One | death 1: Six")
    late = [finding for finding in session.examine() if finding.code == "late-message"]
    assert [(finding.text, finding.cells) for finding in late] == [
        (f"the message '{text}' is not shown {RUN}: message {other} is read then", (cell,))
        for text, cell, other in (("Two", (13, 22), "5 'One'"), ("Four", (18, 22), "2 'Three'"))
    ]
    opened(doors)
    other, first = "Shorten this one, make it important", "Shorten what is read before it"
    for row, text, colour, by, hint in (
        (3, "Replaced by", "text", "by message 2 'Three' after", other),
        (2, "Message 3 is wrong. Not shown", "bad", "message 2 'Three' is read then", first),
    ):
        select(doors, row)
        assert re.search(rf"text .{text}.* at .* {colour}", drawn(doors.app))
        assert by in words(doors)
        assert hint in words(doors)
        assert ({other, first} - {hint}).pop() not in words(doors)


def test_a_place_has_its_bubble_beside_the_welcome_and_each_is_drawn_when_it_comes(room: Maker) -> None:
    room.put_says(f"start: {WELCOME} | at 3,22: Wall ahead | after 2 s!: Go on")
    assert read_ticks(WELCOME) == 6 * TICKS_PER_SECOND
    room.press("f5")
    play = room.shown(PlaytestScreen).play
    room.frames(40, ms=25)
    assert not play.attempt.inputs, "it waits at its start"
    assert said(play) == [WELCOME, ""]
    room.app.controls.poll = lambda: 4  # type: ignore[method-assign]
    seen: list[list[str]] = []
    for _ in range(3 * TICKS_PER_SECOND):
        log = DrawLog()
        with log.installed(), log.recording(room.app.theme.palette) as lines:
            room.frames(ms=25)
        picture = "\n".join(lines)
        seen += [said(play)] * (not seen or said(play) != seen[-1])
        assert [words in picture for words in ("Welcome to", "Wall ahead", "Go on")] == [
            words in " ".join(said(play)) for words in ("Welcome to", "Wall ahead", "Go on")
        ]
    assert seen == [[WELCOME, ""], [WELCOME, "Wall ahead"], ["Go on", "Wall ahead"]]


def test_a_new_text_keeps_away_from_the_one_that_is_there_and_that_one_stays(doors: Maker) -> None:
    """The bubble comes beside a text of gold, and a text of a door beside the bubble."""
    hud, places = Hud(doors.app.theme), dict[str, list[pygame.Rect]]()
    doors.put_says(f"gold: {LONG} | at 9,22 9x5: {LONG[::-1]} | lock 11,22: Now {LONG}")
    doors.press("f5")
    play = doors.shown(PlaytestScreen).play
    play.begin()
    with patch.object(doors.app.controls, "poll", lambda: 2):
        for _ in range(100):
            play.run_ticks(1)
            view = hud_view(play)
            rects = []
            for message in filter(None, (view.message, view.bubble)):
                rects.append(pygame.Rect(*map(round, hud.box(message).area)))
                places.setdefault(message.text, []).append(rects[-1])
            assert len(rects) < 2 or not rects[0].colliderect(rects[1])
    assert len(places) == 3
    assert all(len(set(map(tuple, rects))) == 1 for rects in places.values()), "none moves"


def test_what_is_lost_because_of_a_place_is_a_problem_and_a_welcome_cut_short_is_none(doors: Maker) -> None:
    session = doors.editor.session
    session.certifier.certification = search_of(doors.draft.level, verified_run(doors.draft.level, RIGHT))
    for says, late in (
        (
            f"at 3,22!: {WELCOME} | at 9,22: Wall ahead",
            f"'Wall ahead' is not shown {RUN}: message 1 '{WELCOME[:21].rstrip()}...' is read then",
        ),
        (f"start: {WELCOME} | at 3,22: Wall ahead", ""),
        (f"start: {WELCOME} | gold: Well", ""),
        (f"start: {WELCOME} | start: Two | trap: Late", ""),
    ):
        doors.put_says(says)
        texts = [finding.text for finding in session.examine() if finding.code == "late-message"]
        assert texts == [f"the message {late}"] * bool(late)
        opened(doors)
        doors.press("down")
        assert ("Not shown in the known run" in words(doors)) is bool(late), "beside the message, too"
        doors.choose("Cancel")


def test_an_important_message_comes_at_once_and_no_trifle_replaces_it(doors: Maker) -> None:
    """What is shown while the ninja runs to the gold and the doors, with and without the mark."""
    says = f"start: {WELCOME} | lock: Open | gold: Beware of the guard ahead"
    seen = []
    for marks in (0, 1):
        screen = opened(doors, says)
        select(doors, 2)
        if marks:
            doors.choose("No")
            assert "text '!'" in drawn(doors.app)
            assert doors.button("Yes") is screen.focus
            select(doors, 1)
            assert doors.button("No"), "of the one that is selected now"
        doors.choose("OK")
        doors.press("f5")
        play = doors.shown(PlaytestScreen).play
        doors.app.controls.poll = lambda: 2  # type: ignore[method-assign]
        play.begin()
        came = [play.messages.text]
        while play.messages.deaths == 0 and len(play.attempt.inputs) < 60:
            play.run_ticks(1)
            came += [play.messages.text] * (came[-1] != play.messages.text)
        seen.append([text[:6] for text in came])
        doors.press("escape")
    assert doors.draft.says == says.replace("gold:", "gold!:")
    assert seen == [["Welcom", "Beware", "Open"], ["Welcom", "Beware"]]


@pytest.mark.parametrize("says, helps", [("", True), ("after 99 s: Go", False)])
def test_in_a_level_with_messages_the_game_says_nothing_of_its_own(room: Maker, says: str, helps: bool) -> None:
    walls = Stamp({(column, row): 1 for row in range(10, 23) for column in (1, 5)}, ())
    room.put(replace(with_stamp(room.draft, walls), says=says))
    room.press("f5")
    play, runs = room.shown(PlaytestScreen).play, read_inputs([(1, ".*40 R*12 RJ*20 R*20 L*60 " * 2)]).keys
    room.app.controls.poll = iter(runs).__next__  # type: ignore[method-assign]
    play.begin()
    heard = set()
    for _ in runs:
        play.run_ticks(1)
        heard.add(play.messages.text.partition(",")[0])
    assert heard == ({"", "Hold {right}"} if helps else {""})


@pytest.mark.parametrize("text", ["Shiny!", LONG])
def test_what_is_said_of_an_event_lies_beside_it_and_points_to_it_in_play_and_in_the_picture(
    doors: Maker, text: str
) -> None:
    says = f"start: Go | gold: {text} | switch: {text} now | lock 11,22: {text} open | trap: {text} shut"
    screen = opened(doors, says)
    hud, drawn_texts = Hud(doors.app.theme), dict[str, PlacedMessage]()
    with patch.object(Hud, "draw", lambda _, __, view: drawn_texts.setdefault(view.message.text, view.message)):
        for row in range(5):
            select(doors, row)
            doors.frames(1)
    assert screen.checks.known_run.result, "the ninja's places in that run are known"
    doors.choose("OK")
    doors.press("f5")
    play = doors.shown(PlaytestScreen).play
    play.begin()
    shown = dict[str, PlacedMessage]()
    with patch.object(doors.app.controls, "poll", lambda: 2):
        for _ in range(120):
            play.run_ticks(1)
            placed = play.placed(play.messages)
            if placed and placed.text not in shown:
                shown[placed.text] = placed
                assert away_from(play.ninja_place(), *hud.box(placed).area) > RADIUS, "never over the ninja"
    places = {text: (5, 22), f"{text} now": (7, 22), f"{text} open": (11, 22), f"{text} shut": (13, 22)}
    assert {placed.text for placed in shown.values() if not placed.frame} == {"Go"}
    for words_of, cell in places.items():
        assert shown[words_of].place == middle_of(cell)
        assert away_from(middle_of(cell), *hud.box(shown[words_of]).area) <= 4.2 * CELL
    assert {words_of: hud.box(placed) for words_of, placed in drawn_texts.items()} == {
        words_of: hud.box(placed) for words_of, placed in shown.items()
    }


def test_a_message_that_waits_in_theknown_run_says_for_how_long(room: Maker, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(type(room.editor.session), "certifying_inputs", property(lambda _: bytes(400)))
    screen = opened(room, "after 1 s: Go | after 2 s: On | after 9 s: No")
    assert " late in" not in words(room)
    select(room, 1)
    assert "2 s late in the known run (10.0 s): message 1 'Go' is read first" in words(room)
    screen.edited.rows[0].text = "long " * 24
    assert "7 s late in" in words(room)
    select(room, 2)
    screen.edited.rows[2].when, screen.edited.rows[2].detail = Moment.AFTER, "3"
    monkeypatch.setattr(type(room.editor.session), "certifying_inputs", property(lambda _: bytes(300)))
    assert "Not shown in the known run (7.5 s): message 1 'long long long long l...' is read then" in words(room)


def test_a_test_of_gold_in_the_air_begins_on_a_floor_from_which_it_is_taken(
    doors: Maker, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(type(doors.editor.session), "certifying_inputs", property(lambda _: b""))
    high = with_stamp(doors.draft, Stamp({}, (ObjectSpec(GOLD, middle_of((20, 19))),)))
    doors.put(high)
    opened(doors, "start: Welcome | gold 20,19: Now")
    select(doors, 1)
    doors.choose("Test")
    play = doors.shown(PlaytestScreen).play
    ninja = play.attempt.simulation.ninja
    assert not play.messages.text, "without what is said at the start"
    column, row = cell_of(ninja.x, ninja.y)
    assert row == 22, "on the floor"
    assert abs(column - 20) <= 3


def test_the_known_run_is_played_in_the_background(doors: Maker, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []
    answer = AtOnce.ask
    monkeypatch.setattr(AtOnce, "ask", lambda _, question: asked.append(question))
    screen = opened(doors, "trap: One | lock: Two")
    drawn(doors.app)
    assert len(asked) == 1
    assert screen.checks.known_run.result is None
    run = screen.checks.known_run
    assert isinstance(run, AtOnce)
    answer(run, asked[0])
    doors.press("down")
    doors.frames(2)
    assert "Replaced by message 1 'One' after" in words(doors)
