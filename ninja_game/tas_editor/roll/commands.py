"""The roll's commands: moving, selecting, changing ticks, the clipboard, markers."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from ninja_game.errors import ArgumentError
from ninja_game.files.shown_text import counted
from ninja_game.formats.replay.input_text import Inputs
from ninja_game.formats.replay.notations import Marker, write_inputs
from ninja_game.play.clipboard import copy_text, pasted_text
from ninja_game.play.menu_screen import ask_text
from ninja_game.play.workspace import Commands
from ninja_game.sim.inputs import JUMP_HELD, KEY_LEFT, KEY_RIGHT
from ninja_game.tas.files import inputs_of_text
from ninja_game.tas.tracks import InputTrack, first_different_index, marker_name
from ninja_game.tas_editor.editor import Span, TasEditor
from ninja_game.tas_editor.roll.facts import compared_run, differing_ticks

_NOTHING_HERE = "Nothing here: the run ends earlier"  # where nothing can be copied or taken out


class RollCommands:
    """The commands of the piano roll: cursor, selection, edits of keys. ``page``: the number of visible rows."""

    def __init__(self, editor: TasEditor, page: Callable[[], int]) -> None:
        self._editor = editor
        self._page = page

    def commands(self) -> Commands:
        editor, moves = self._editor, self._moves()
        return {
            **{name: partial(self._move, to) for name, to in moves.items()},
            **{f"select_{name}": partial(self._move, to, select=True) for name, to in moves.items()},
            "select_last": lambda: editor.go(max(len(editor.track) - 1, editor.session.timeline.end[0]), select=True),
            "select_all": lambda: editor.select(0, len(editor.track)),
            "go_to": lambda: ask_text(editor.app, "Go to", "Tick or name", "", "Go", self.go_to),
            "next_marker": lambda: self._to_marker(1), "previous_marker": lambda: self._to_marker(-1),
            "next_difference": lambda: self._to_difference(1),
            "previous_difference": lambda: self._to_difference(-1),
            "key_left": lambda: self.toggle(KEY_LEFT), "key_right": lambda: self.toggle(KEY_RIGHT),
            "key_jump": lambda: self.toggle(JUMP_HELD),
            "clear": self.clear, "insert": self.insert, "remove": self.remove,
            "copy": self.copy, "cut": self.cut,
            "paste": self.paste, "paste_insert": lambda: self.paste(between=True),
            "cut_end": self.cut_end, "marker": self.name_tick,
            "undo": lambda: self._step(editor.session.undo, "Undone", "Nothing to undo"),
            "redo": lambda: self._step(editor.session.redo, "Redone", "Nothing to redo"),
        }  # fmt: skip

    # --- moving ---

    def _moves(self) -> dict[str, Callable[[], int]]:
        editor = self._editor
        return {
            "up": lambda: editor.cursor - 1, "down": lambda: editor.cursor + 1,
            "page_up": lambda: editor.cursor - self._page() + 1, "page_down": lambda: editor.cursor + self._page() - 1,
            "first": lambda: 0, "last": self._last,
        }  # fmt: skip

    def _move(self, target: Callable[[], int], *, select: bool = False) -> None:
        self._editor.go(target(), select=select)

    def _last(self) -> int:
        """The tick of exit or death; from there or behind it the last one."""
        end = self._editor.session.timeline.end[0]
        return end if self._editor.cursor < end else self._editor.last_tick

    def go_to(self, text: str) -> None:
        """Go to a tick by its number or its marker's name; a notice for an unknown one."""
        text = text.strip().removeprefix("#")
        named = [tick for tick, name in self._editor.track.markers if name.casefold() == text.casefold()]
        if named or (text.isascii() and text.isdigit()):
            self._editor.go(named[0] if named else int(text[:9]))
        elif text:
            self._editor.app.notify(f"No tick is named {text}")

    def _to_marker(self, direction: int) -> None:
        cursor = self._editor.cursor
        ticks = [tick for tick, _ in self._editor.track.markers if (tick - cursor) * direction > 0]
        if ticks:
            self._editor.go(min(ticks, key=lambda tick: abs(tick - cursor)))
        else:
            self._editor.app.notify(f"No named tick {'behind' if direction > 0 else 'before'} this one: M names it")

    def _to_difference(self, direction: int) -> None:
        editor, other = self._editor, compared_run(self._editor)
        if other is None:
            editor.app.notify("Other runs are not shown: G shows them")
            return
        ticks = differing_ticks(editor.track.inputs, other.track.inputs)
        ticks = ticks[ticks <= editor.last_tick]
        ahead = ticks[(ticks - editor.cursor) * direction > 0]
        if len(ahead):
            editor.go(int(ahead[0] if direction > 0 else ahead[-1]))
        else:
            where = "no" if not len(ticks) else "no more" if direction > 0 else "no earlier"
            editor.app.notify(f"There are {where} ticks with other keys than {other.name}")

    # --- changing ---

    def _selected_ticks(self) -> Span:
        first, last = self._editor.selection
        return first, min(last, len(self._editor.track))

    def toggle(self, key: int) -> None:
        """Press a key in the selected ticks; release it if it is down in all of them."""
        first, last = self._editor.selection
        down = not all(self._editor.track.keys_at(tick) & key for tick in range(first, last))
        self._editor.edit_selected(lambda track: track.with_key(first, last, key, down=down))

    def clear(self) -> None:
        first, last = self._selected_ticks()
        if first >= last:
            self._editor.app.notify(_NOTHING_HERE)
        else:
            self._editor.edit_selected(lambda track: track.replaced(first, last, bytes(last - first)))

    def insert(self) -> None:
        """Insert as many ticks without a key before the selected ones."""
        first, last = self._editor.selection
        self._editor.edit_selected(lambda track: track.replaced(first, first, bytes(last - first)))

    def remove(self) -> None:
        first, last = self._selected_ticks()
        if first >= last:
            self._editor.app.notify(_NOTHING_HERE)
        elif self._editor.edit_selected(lambda track: track.replaced(first, last, b"")):
            self._editor.go(first)

    def cut_end(self) -> None:
        editor = self._editor
        editor.session.timeline.ensure(editor.last_tick)
        end = editor.session.timeline.end[0]
        if end < 0:
            editor.app.notify("The run neither reaches the exit nor dies: there is nothing behind its end")
        elif end + 1 >= len(editor.track):
            editor.app.notify("There are no keys behind the end")
        else:
            editor.edit(lambda track: track.replaced(end + 1, len(track), b""))

    def _step(self, step: Callable[[], bool], done: str, refusal: str) -> None:
        """Undo or redo, and restore the cursor and the selection of that time; else go to the change."""
        editor = self._editor
        editor.session.end()
        before, place = editor.track, (editor.cursor, editor.anchor)
        if not step():
            editor.app.notify(refusal)
            return
        first = first_change(before, editor.track)
        cursor, anchor = editor.places.get(editor.track, place)
        tick = cursor if anchor is None else min(cursor, anchor)
        editor.app.notify(f"{done}: {_change_text(before, editor.track, first, tick)}")
        if editor.track in editor.places:
            editor.places[before] = place
        else:
            cursor, anchor = first, None
        last = len(editor.track) - first_different_index(before.inputs[first:][::-1], editor.track.inputs[first:][::-1])
        near = first - self._page() < cursor < max(first, last) + self._page()
        editor.go(first if not near or anchor is None else anchor)
        editor.go(cursor if near else first, select=near and anchor is not None)

    # --- clipboard ---

    def copy(self) -> None:
        """Copy the selected ticks as text of our notation, with their markers."""
        first, last = self._selected_ticks()
        markers = [Marker(tick - first, name) for tick, name in self._editor.track.markers if first <= tick < last]
        text = "\n".join(write_inputs(self._editor.track.inputs[first:last], markers))
        if text:
            notice = f"{counted(last - first, 'tick')} copied"
            title = self._editor.session.origin.name or "inputs"
            copy_text(self._editor.app, text, title=title, suffix=".inputs.txt", notice=notice)
        else:
            self._editor.app.notify(_NOTHING_HERE)

    def cut(self) -> None:
        self.copy()
        first, last = self._selected_ticks()
        if first < last:
            self.remove()

    def paste(self, *, between: bool = False) -> None:
        """Paste the clipboard's ticks over the present ones, or ``between``, and select them."""
        editor = self._editor
        with editor.app.errors_as_notices("Not pasted: "):
            pasted = inputs_of_text(pasted_text(), "clipboard")
            first, count = editor.selection[0], len(pasted.keys)
            if editor.edit_selected(lambda track: _with_pasted(track, first, pasted, between=between)):
                editor.select(first, first + count)
                editor.app.notify(f"{counted(count, 'tick')} pasted")

    # --- markers ---

    def name_tick(self) -> None:
        editor, tick = self._editor, self._editor.cursor
        name = next((name for marker, name in editor.track.markers if marker == tick), "")
        named = partial(self.put_name, tick)
        ask_text(editor.app, f"Tick {tick}", "Name or comment (empty removes it)", name, "Name it", named)

    def put_name(self, tick: int, text: str) -> None:
        earlier = [at for at, name in self._editor.track.markers if name == marker_name(text) and at != tick]

        def named(track: InputTrack) -> InputTrack:
            if text.strip() and tick > len(track):
                raise ArgumentError(f"the run has {len(track)} ticks: give this one a key first")
            return track.named(tick, text)

        if self._editor.edit(named) and earlier:
            self._editor.app.notify(f"It is moved here from tick {earlier[0]}: each name stands once")


def _with_pasted(track: InputTrack, first: int, pasted: Inputs, *, between: bool) -> InputTrack:
    """An input track with pasted ticks; markers in it keep their ticks."""
    last = first if between else first + len(pasted.keys)
    result = track.replaced(first, last, pasted.keys)
    for tick, name in pasted.markers:
        if all(name != marker.name and first + tick != marker.tick for marker in result.markers):
            result = result.named(first + tick, name)
    return result


def first_change(before: InputTrack, after: InputTrack) -> int:
    """The first tick with other keys, else that of the first other marker, else 0."""
    if before.inputs != after.inputs:
        return before.first_difference(after)
    return min((tick for tick, _ in set(before.markers) ^ set(after.markers)), default=0)


def _change_text(before: InputTrack, after: InputTrack, first: int, edit_tick: int) -> str:
    """The change in words, from tick ``first``; ``edit_tick``: named if ticks were inserted or deleted there."""
    if before.inputs == after.inputs:
        return f"a marker in tick {first}"
    more = len(after) - len(before)
    short, long = sorted((before.inputs, after.inputs), key=len)
    tick = edit_tick if more and short == long[:edit_tick] + long[edit_tick + abs(more) :] else first
    length = f", {counted(abs(more), 'tick')} {'more' if more > 0 else 'fewer'}"
    return f"keys from tick {tick} on{length if more else ''}"
