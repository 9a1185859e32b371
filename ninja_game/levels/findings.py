"""What an examination of a level, a pack or a run can find, by code: text and hint (docs/findings.md)."""

from __future__ import annotations

from typing import NamedTuple

Cell = tuple[int, int]
"""Column 1…31, row 1…23."""


class Rule(NamedTuple):
    """``text``: what is odd, with {values}; ``hint``: how to fix it. ``about_switch``: whether it is about a switch."""

    text: str
    hint: str
    about_switch: bool = False


_EASIER = "Make the way there easier, or give the solver more time."
LEVEL_RULES = {
    "too-many-objects": Rule(
        "there are {count} objects, more than {most}: the level cannot be played", "Take some away."
    ),
    "many-objects": Rule("there are {count} objects, more than {most}: the game may be slow", "Take some away."),
    "no-ninja": Rule("there is no ninja: the level cannot be played", "Put one where the run begins."),
    "several-ninjas": Rule(
        "there are {count} ninjas: the last one plays, {last}; the others only stand there", "Delete all but one."
    ),
    "no-exit": Rule("there is no exit: the level cannot be passed", "Put an exit and its switch."),
    "deadly-start": Rule(
        "{mine}: the ninja touches it where it starts and dies at once", "Move the mine or the ninja."
    ),
    "slow-thinkers": Rule(
        "{count} enemies look at the ninja in turn: each one only every {seconds:.1f} s",
        "Take some of them away, or expect slow ones.",
    ),
    "unknown-type": Rule(
        "{count} records create nothing (unknown type), the first is {first!r}",
        "Delete them, or keep them as they are.",
    ),
    "odd-tile": Rule("a tile id {what}", "Draw another tile there."),
    "value-count": Rule(
        "it has {count} values where its kind needs {needed}: it {does}", "Delete it and place it again."
    ),
    "not-a-number": Rule("one of its values is not a number", "Delete it and place it again."),
    "outside-grid": Rule("it is outside the grid", "Move it into the level, or delete it."),
    "in-border": Rule("it is in the border of the level, inside the rock", "Move it into the level."),
    "in-tile": Rule("it {what}", "Move it, or clear the tile."),
    "in-full-tile": Rule("it is inside a full tile", "Move it, or clear the tile."),
    "unreachable": Rule("the ninja cannot reach it", "Open a way to it, or move it."),
    "unreachable-switch": Rule("the ninja cannot reach its switch at {place}", "Open a way to it, or move it.", True),
    "hidden-gold": Rule("the tiles hide it", "Move it, or clear the tile."),
    "pad-normal": Rule(
        "its normal has length {length:.3g} instead of 1 and its strength changes with it",
        "Choose one of the eight directions.",
    ),
    "direction": Rule("its direction is not 0 to 3{but}", "Choose a direction."),
    "guard-in-border": Rule(
        "a guard in the left or right border or outside hangs the original game; here it does nothing",
        "Move it into the level.",
    ),
    "guard-without-floor": Rule(
        "it does not stand on a solid floor: it cannot run to the left", "Put it on a floor, or a tile below it."
    ),
    "weapon": Rule("its weapon is not 0 to 2: it is harmless", "Choose a weapon."),
    "movement": Rule("its movement is not 0 to 5: it gets stuck", "Choose how it moves."),
    "seeker-flag": Rule("its seeker flag is not 0 or 1", "Choose whether it seeks."),
    "seeker-with-weapon": Rule(
        "only zap drones seek: its seeker flag does nothing", "Make it a zap drone, or no seeker."
    ),
    "closed-in": Rule("it is closed in on all sides: it never moves", "Clear a cell beside it."),
    "vertical-flag": Rule(
        "its vertical flag is not 0 or 1: it closes another side than it is drawn on", "Choose the side of its cell."
    ),
    "door-flags": Rule("its trap or locked flag is not 0 or 1", "Choose which kind of door it is."),
    "locked-trap": Rule("it is flagged as locked and as trap: it is a locked door", "Choose which kind of door it is."),
    "door-outside": Rule("it is not between two cells of the grid", "Move it between two cells of the level."),
    "doors-on-one-side": Rule(
        "another door is on the same side: the later one may never open", "Delete one of the two."
    ),
    "closed-anyway": Rule(
        "the tiles close this side anyway: the door changes nothing", "Clear the tiles on both sides, or move the door."
    ),
    "duplicate": Rule("the same object is in this place already", "Delete one of the two."),
    "mine-over-gold": Rule("it is drawn over a piece of gold", "Move one of the two."),
    "untouched-switch": Rule("its switch was touched in no try of the solver", _EASIER, True),
    "unreached-exit": Rule("open, it was reached in no try of the solver", _EASIER),
    "gold-left": Rule("{most} at most were collected at once, {never}", _EASIER),
}

_MAKE_PARS = "Make it with `ninja-game levels pars`."
PACK_RULES = {
    "unreadable": Rule("{why}", "Mend the file as the message says, or take it out of the pack."),
    "no-author": Rule("the pack has no author", "Name one: it is that of every level without its own."),
    "no-name": Rule("no name", "Give it one."),
    "column-without-name": Rule(
        "column {column} has episodes and no name; expected {needed} names in columns", "Name every column."
    ),
    "episode-name": Rule("episode {number} has no name", "Give it one."),
    "same-episode-name": Rule("episode {number} has the name of episode {other}", "Choose another name."),
    "empty-episode": Rule("episode {number} has no levels; expected files {number:02d}-….txt", "Add levels to it."),
    "no-episodes": Rule("no episodes; expected a table [[episode]] for each", "Add an episode."),
    "single-level": Rule("in no episode; it can be played as a single level", "Add it to an episode, if it belongs."),
    "same-name": Rule("the same name as {other}", "Choose another name."),
    "same-content": Rule("the same content as {other}", "Delete one of the two."),
    "same-place": Rule("the place {number} is that of {other} too", "Rename one of the two."),
    "stray-certificate": Rule(
        "of no level here; expected LEVEL.exit.replay.txt or LEVEL.gold.replay.txt", "Rename it, or delete it."
    ),
    "no-certificate": Rule(
        "no certificate, so nobody knows whether it can be passed", "Find one with `ninja-game check --replays`."
    ),
    "no-gold-run": Rule(
        "no run with all gold is known", "Find one with `ninja-game check --replays`, or accept that there is none."
    ),
    "certificate": Rule("{why}", "Make it again with `ninja-game check --replays`."),
    "accepted-in-vain": Rule("accepts {finding} of {file}, which is not found there", "Take it out of the index."),
    "no-pars": Rule("no medal times yet", _MAKE_PARS),
    "old-pars": Rule("medal times of other levels or certificates", _MAKE_PARS),
}
"""What may be odd about a pack, by code; what is odd about its levels has the codes of levels."""

DESIGN_RULES = {
    "safe-gold": Rule(
        "{value:.0%} of the gold is in danger; expected {bound:.0%} or more", "Put gold where a hazard guards it."
    ),
    "even-gold": Rule(
        "the gold is strewn evenly ({value:.2f}; expected {bound} at most)", "Lay it in groups where it is bait."
    ),
    "even-mines": Rule(
        "the mines are strewn evenly ({value:.2f}; expected {bound} at most)",
        "Lay them in lines and rims that guard something.",
    ),
    "far-hazards": Rule(
        "half of the hazards are {value:.0f} px or more from the run to the exit; expected {bound} at most",
        "Move them to what they guard, or take them away.",
    ),
    "same-bay": Rule("{value} bays have the same tiles; expected {bound} at most", "Draw each place differently."),
    "unused-space": Rule(
        "{value:.0%} of the space is far from every object and from the run; expected {bound:.0%} at most",
        "Fill it with rock, or with something to go there for.",
    ),
    "short-trip": Rule(
        "the run is {value:.1f} times as long as the way from the start to the exit; expected {bound} or more",
        "Move the exit nearer to the start, or what opens it farther away.",
    ),
}
"""What good levels have and a level lacks (docs/good-levels.md), by code: reported only where it is asked for."""

_RECORD = "Run its inputs again with `ninja-game record`."
RUN_RULES = {
    "other-rules": Rule("recorded under rules {rules}, these are rules {now}", _RECORD),
    "missed-waypoint": Rule(
        "tick {tick}: ninja: {field} is {found}, the replay says {claimed} (agrees {agrees})", _RECORD
    ),
    "other-end": Rule("tick {tick}: the run ends here ({outcome}); the replay says it ends in tick {claimed}", _RECORD),
    "wrong-claim": Rule("tick {tick}: {field} is {found}, the replay says {claimed}", _RECORD),
    "not-passed": Rule("does not reach the exit: {ending}", "Look at its end with `ninja-game tas`."),
    "memories-differ": Rule("{what}", "Report it: it is a fault of the program."),
    "other-level": Rule(
        "level_digest is {digest}, which is not one of the levels that count", "Name its level with `--level`."
    ),
    "out-of-time": Rule(
        "the time of the episode runs out: {lifetime} ticks at the start, {gold} gold", "Play its levels faster."
    ),
    "other-episode": Rule(
        "its levels, in this order, are no episode that counts", "Put the runs of one episode in its order."
    ),
    "not-strict": Rule(
        "{field} is {found}, --strict expects {expected}", "Play it again as a board wants it (docs/verification.md)."
    ),
}
"""What `verify` finds wrong with a run, by code."""


class Finding(NamedTuple):
    """Something odd. ``text``: what; ``records``: numbers of the records that it is about; ``cells``: of odd tiles.

    ``names``: how a text calls what it is about, '' where ``text`` says it.
    """

    code: str
    text: str
    records: tuple[int, ...] = ()
    cells: tuple[Cell, ...] = ()
    names: str = ""

    @property
    def sentence(self) -> str:
        """Names and text as one line."""
        return f"{self.names}: {self.text}" if self.names else self.text

    @property
    def advice(self) -> str:
        """What is odd and how to fix it, as sentences."""
        return f"{self.sentence[0].upper()}{self.sentence[1:]}. {self.hint}"

    @property
    def hint(self) -> str:
        """How to fix it, a sentence."""
        return LEVEL_RULES[self.code].hint

    @property
    def about_switch(self) -> bool:
        """Whether it is about the objects' switches rather than about themselves."""
        return LEVEL_RULES[self.code].about_switch


class PackFinding(NamedTuple):
    """Something odd about a pack. ``place``: the file, with a line where one is known; '' where ``text`` names it."""

    place: str
    code: str
    text: str

    def __str__(self) -> str:
        return f"{self.place}: {self.text}" if self.place else self.text

    @property
    def hint(self) -> str:
        """How to fix it, a sentence."""
        return (PACK_RULES | LEVEL_RULES | DESIGN_RULES)[self.code].hint


class RunProblem(NamedTuple):
    """Why a run is not what its file says, or not what is demanded of it."""

    code: str
    text: str

    def __str__(self) -> str:
        return self.text

    @property
    def hint(self) -> str:
        """How to fix it, a sentence."""
        return RUN_RULES[self.code].hint


def in_run(code: str, **values: object) -> RunProblem:
    """A problem of this code about a run; ``values``: what its text names."""
    return RunProblem(code, RUN_RULES[code].text.format(**values))


def in_pack(code: str, place: str = "", **values: object) -> PackFinding:
    """A finding of this code about a pack; ``values``: what its text names."""
    return PackFinding(place, code, PACK_RULES[code].text.format(**values))


def in_design(code: str, place: str, **values: object) -> PackFinding:
    """What a level lacks; ``values``: what its text names."""
    return PackFinding(place, code, DESIGN_RULES[code].text.format(**values))


def found(code: str, records: tuple[int, ...] = (), cells: tuple[Cell, ...] = (), **values: object) -> Finding:
    """A finding of this code; ``values``: what its text names."""
    return Finding(code, LEVEL_RULES[code].text.format(**values), records, cells)
