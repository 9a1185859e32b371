"""The roll's commands: moving, selecting, changing ticks, the clipboard, markers."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from ninja_game.errors import ArgumentError, NinjaGameError
from ninja_game.formats.replay.input_runs import Marker, write_inputs
from ninja_game.formats.replay.input_text import Inputs
from ninja_game.play.clipboard import copy_text, pasted_text
from ninja_game.play.menus.panels import Form
from ninja_game.play.tas.bench import Bench, Span
from ninja_game.play.tas.part import Commands
from ninja_game.play.tas.roll.differences import changes, compared
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT
from ninja_game.tas.files import inputs_of_text
from ninja_game.tas.take import Take

BEHIND = "The run has no keys here: it has ended before"
"""Where nothing can be copied or taken out."""


class RollCommands:
    """``page``: how many rows are seen."""

    def __init__(self, bench: Bench, page: Callable[[], int]) -> None:
        self._bench = bench
        self._page = page

    def commands(self) -> Commands:
        """By name."""
        bench, moves = self._bench, self._moves()
        return {
            **{name: partial(self._move, to) for name, to in moves.items()},
            **{f"select_{name}": partial(self._move, to, select=True) for name, to in moves.items()},
            "select_all": self.select_all, "go_to": self.ask_where,
            "next_marker": lambda: self._to_marker(1), "previous_marker": lambda: self._to_marker(-1),
            "next_difference": lambda: self._to_difference(1),
            "previous_difference": lambda: self._to_difference(-1),
            "key_left": lambda: self.toggle(KEY_LEFT), "key_right": lambda: self.toggle(KEY_RIGHT),
            "key_jump": lambda: self.toggle(JUMP_HELD),
            "clear": self.clear, "insert": self.insert, "remove": self.remove,
            "copy": self.copy, "cut": self.cut,
            "paste": self.paste, "paste_insert": lambda: self.paste(between=True),
            "cut_end": self.cut_end, "marker": self.name_tick,
            "undo": lambda: self._step(bench.session.undo, "Nothing to undo"),
            "redo": lambda: self._step(bench.session.redo, "Nothing to redo"),
        }  # fmt: skip

    # --- moving ---

    def _moves(self) -> dict[str, Callable[[], int]]:
        bench = self._bench
        return {
            "up": lambda: bench.cursor - 1, "down": lambda: bench.cursor + 1,
            "page_up": lambda: bench.cursor - self._page() + 1, "page_down": lambda: bench.cursor + self._page() - 1,
            "first": lambda: 0, "last": self._last,
        }  # fmt: skip

    def _move(self, to: Callable[[], int], *, select: bool = False) -> None:
        self._bench.go(to(), select=select)

    def _last(self) -> int:
        """The tick of exit or death; from there or behind it the last one."""
        end = self._bench.session.timeline.end[0]
        return end if self._bench.cursor < end else self._bench.last_tick

    def select_all(self) -> None:
        """Select all ticks that have keys."""
        self._bench.select(0, len(self._bench.take))

    def ask_where(self) -> None:
        """Ask for a tick or a marker's name, and go there."""
        bench = self._bench
        bench.app.push(Form(bench.app, "Go to", [("Tick or name", "", 100)], "Go", lambda texts: self.go_to(texts[0])))

    def go_to(self, text: str) -> None:
        """Go to a tick by its number or its marker's name; a notice tells where there is none."""
        text = text.strip().removeprefix("#")
        named = [tick for tick, name in self._bench.take.markers if name.casefold() == text.casefold()]
        if named or (text.isascii() and text.isdigit()):
            self._bench.go(named[0] if named else int(text[:9]))
        elif text:
            self._bench.app.notify(f"No tick is named {text}")

    def _to_marker(self, way: int) -> None:
        """The next named tick, or the one before."""
        cursor = self._bench.cursor
        ticks = [tick for tick, _ in self._bench.take.markers if (tick - cursor) * way > 0]
        if ticks:
            self._bench.go(min(ticks, key=lambda tick: abs(tick - cursor)))
        else:
            self._bench.app.notify(f"No named tick {'behind' if way > 0 else 'before'} this one: M names it")

    def _to_difference(self, way: int) -> None:
        """The next tick in which the keys part from those of the run that is compared, or the one before."""
        bench, other = self._bench, compared(self._bench)
        if other is None:
            bench.app.notify("Other runs are not shown: G shows them")
            return
        ticks = changes(bench.take.inputs, other.take.inputs)
        ticks = ticks[ticks <= bench.last_tick]
        ahead = ticks[(ticks - bench.cursor) * way > 0]
        if len(ahead):
            bench.go(int(ahead[0] if way > 0 else ahead[-1]))
        else:
            where = "no" if not len(ticks) else "no more" if way > 0 else "no earlier"
            bench.app.notify(f"There are {where} ticks with other keys than {other.name}")

    # --- changing ---

    def _filled(self) -> Span:
        """The selected ticks that the run has."""
        first, last = self._bench.selection
        return first, min(last, len(self._bench.take))

    def toggle(self, key: int) -> None:
        """A key down in the selected ticks; up where it is down in all of them."""
        first, last = self._bench.selection
        down = not all(self._bench.take.keys_at(tick) & key for tick in range(first, last))
        self._bench.edit_selected(lambda take: take.with_key(first, last, key, down=down))

    def clear(self) -> None:
        """All keys up in the selected ticks."""
        first, last = self._filled()
        if first >= last:
            self._bench.app.notify(BEHIND)
        else:
            self._bench.edit_selected(lambda take: take.replaced(first, last, bytes(last - first)))

    def insert(self) -> None:
        """Ticks without a key before the selected ones, as many as they are."""
        first, last = self._bench.selection
        self._bench.edit_selected(lambda take: take.replaced(first, first, bytes(last - first)))

    def remove(self) -> None:
        """Take the selected ticks out."""
        first, last = self._filled()
        if first >= last:
            self._bench.app.notify(BEHIND)
        elif self._bench.edit_selected(lambda take: take.replaced(first, last, b"")):
            self._bench.go(first)

    def cut_end(self) -> None:
        """Take out what is behind exit or death."""
        bench = self._bench
        bench.session.timeline.need(bench.last_tick)
        end = bench.session.timeline.end[0]
        if end < 0:
            bench.app.notify("The run neither reaches the exit nor dies: there is nothing behind its end")
        elif end + 1 >= len(bench.take):
            bench.app.notify("There are no keys behind the end")
        else:
            bench.edit(lambda take: take.replaced(end + 1, len(take), b""))

    def _step(self, step: Callable[[], bool], refusal: str) -> None:
        """Undo or redo, and have the cursor and the selection of that time again; else go where something changes."""
        bench = self._bench
        bench.session.end()
        before, place = bench.take, (bench.cursor, bench.anchor)
        if not step():
            bench.app.notify(refusal)
            return
        bench.app.notify("")
        if bench.take in bench.places:
            bench.places[before] = place
        first = _first_change(before, bench.take)
        cursor, anchor = bench.places.get(bench.take, (first, None))
        near = abs(cursor - first) < self._page()
        bench.go(first if not near or anchor is None else anchor)
        bench.go(cursor if near else first, select=near and anchor is not None)

    # --- clipboard ---

    def copy(self) -> None:
        """The selected ticks as text of our notation, with their markers."""
        first, last = self._filled()
        markers = [Marker(tick - first, name) for tick, name in self._bench.take.markers if first <= tick < last]
        text = "\n".join(write_inputs(self._bench.take.inputs[first:last], markers))
        if text:
            told = f"{last - first} tick{'s' * (last - first > 1)} copied"
            title = self._bench.session.about.name or "inputs"
            copy_text(self._bench.app, text, title=title, suffix=".inputs.txt", told=told)
        else:
            self._bench.app.notify(BEHIND)

    def cut(self) -> None:
        """Copy the selected ticks and take them out."""
        self.copy()
        first, last = self._filled()
        if first < last:
            self.remove()

    def paste(self, *, between: bool = False) -> None:
        """The ticks of the clipboard's text over what is there, or ``between``; they are selected then."""
        bench = self._bench
        try:
            pasted = inputs_of_text(pasted_text(), "clipboard")
        except NinjaGameError as error:
            bench.app.notify(f"Not pasted: {error}")
            return
        first, count = bench.selection[0], len(pasted.keys)
        if self._bench.edit_selected(lambda take: _with_pasted(take, first, pasted, between=between)):
            bench.select(first, first + count)
            bench.app.notify(f"{count} tick{'s' * (count > 1)} pasted")

    # --- markers ---

    def name_tick(self) -> None:
        """Ask for the name of the cursor's tick."""
        bench, tick = self._bench, self._bench.cursor
        name = next((name for at, name in bench.take.markers if at == tick), "")
        fields = [("Name (none: no marker)", name, 100)]
        bench.app.push(Form(bench.app, f"Tick {tick}", fields, "Name it", lambda texts: self._name(tick, texts[0])))

    def _name(self, tick: int, text: str) -> None:
        words = "-".join(text.split())

        def named(take: Take) -> Take:
            if words and tick > len(take):
                raise ArgumentError(f"the run has {len(take)} ticks: give this one a key first")
            return take.named(tick, words)

        if self._bench.edit(named) and words != text.strip():
            self._bench.app.notify(f"It is called {words}: names have no blanks")


def _with_pasted(take: Take, first: int, pasted: Inputs, *, between: bool) -> Take:
    """A take with pasted ticks; markers that it has keep their ticks."""
    last = first if between else first + len(pasted.keys)
    made = take.replaced(first, last, pasted.keys)
    for tick, name in pasted.markers:
        if all(name != each.name and first + tick != each.tick for each in made.markers):
            made = made.named(first + tick, name)
    return made


def _first_change(before: Take, after: Take) -> int:
    """The first tick whose keys or name differ."""
    if before.inputs != after.inputs:
        return before.first_difference(after)
    return min((tick for tick, _ in set(before.markers) ^ set(after.markers)), default=0)
