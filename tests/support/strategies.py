"""Hypothesis strategies of what the formats hold: numbers, levels, demos, replays, and broken text."""

from hypothesis import strategies as st

from ninja_game.formats.n14.level_string import level_digest
from ninja_game.formats.numbers import parse_flash_number
from ninja_game.formats.replay.notations import Marker, is_marker_name
from ninja_game.formats.replay.text import OUTCOMES, Replay
from ninja_game.sim.inputs import Demo
from ninja_game.sim.kinds import VALUE_COUNTS
from ninja_game.sim.level import BODIES, TILES, Level, ObjectSpec
from ninja_game.sim.rules import NAN
from ninja_game.tas.tracks import InputTrack

# Decimals of at most 15 digits, as they stand in levels, read by the game's rule.
decimal_texts = st.one_of(
    st.integers(-2000, 2000).map(str),
    st.builds(
        lambda sign, whole, fraction: f"{sign}{whole}.{fraction:06d}",
        st.sampled_from(["", "-"]),
        st.integers(0, 800),
        st.integers(0, 999_999),
    ),
    st.integers(10**14, 10**15 - 1).map(lambda digits: f"0.{digits}"),
)
values = st.one_of(decimal_texts.map(parse_flash_number), st.just(NAN))

NO_TEXT = st.just("")

proper_records = st.one_of(
    [
        st.builds(ObjectSpec, st.just(kind), st.tuples(*[values] * count), NO_TEXT)
        for kind, count in enumerate(VALUE_COUNTS)
    ]
)
inert_records = st.builds(ObjectSpec, st.integers(0, 12), st.lists(values, max_size=11).map(tuple), NO_TEXT)
ignored_records = st.builds(
    ObjectSpec,
    st.just(-1),
    st.just(()),
    st.sampled_from(["13^1,2", "abc^3", "99", "-1^0,0", "0.5^2,2", "nothing at all"]),
)

# Bytes are far quicker to draw than 713 integers.
proper_tiles = st.binary(min_size=TILES, max_size=TILES).map(lambda data: tuple(byte % 34 for byte in data))
odd_tile_ids = st.integers(-48, 200).filter(lambda tile: tile not in (ord("|") - 48, ord("$") - 48))


@st.composite
def odd_tiles(draw: st.DrawFn) -> tuple[int, ...]:
    """Tiles of which some have odd ids."""
    tiles = list(draw(proper_tiles))
    for cell, tile in draw(st.dictionaries(st.integers(0, TILES - 1), odd_tile_ids, max_size=5)).items():
        tiles[cell] = tile
    return tuple(tiles)


proper_levels = st.builds(Level, proper_tiles, st.lists(proper_records, max_size=8).map(tuple))
odd_levels = st.builds(
    Level, odd_tiles(), st.lists(st.one_of(proper_records, inert_records, ignored_records), max_size=8).map(tuple)
)

# What a record of a level file can say: no separators, no white space at its ends or breaks inside.
words = st.text(st.characters(codec="utf-8", exclude_categories=["C", "Z"], exclude_characters="#$&"), max_size=12)

inputs = st.lists(st.integers(0, 15), max_size=120).map(bytes)
demos = inputs.map(lambda inputs: Demo(inputs, float(len(inputs))))


@st.composite
def replays(draw: st.DrawFn) -> Replay:
    """Replays of every kind: with level inside, with digest, with path."""
    keys = draw(inputs)
    level = draw(st.one_of(st.none(), odd_levels))
    digest = level_digest(level) if level and draw(st.booleans()) else ""
    return Replay(
        inputs=keys,
        final_tick=max(0, len(keys) - 1 + draw(st.integers(0, 50))),
        outcome=draw(st.sampled_from(OUTCOMES)),
        gold=draw(st.integers(0, 99)),
        digest=draw(st.sampled_from(["", "0f" * 32])),
        name=draw(st.text(max_size=12)),
        author=draw(st.text(max_size=12)),
        body=draw(st.sampled_from(BODIES)),
        level_digest=digest,
        level_path="" if level else draw(st.text(min_size=1, max_size=12)),
        level_record=draw(st.integers(0, 3)),
        level=level,
    )


@st.composite
def mutations_of(draw: st.DrawFn, seeds: tuple[str, ...]) -> str:
    """A seed with some characters taken out, put in or doubled."""
    text = draw(st.sampled_from(seeds))
    for _ in range(draw(st.integers(1, 6))):
        start = draw(st.integers(0, len(text)))
        end = min(len(text), start + draw(st.sampled_from([0, 1, 1, 3, 40])))
        filling = draw(
            st.one_of(st.text(max_size=4), st.sampled_from([text[start:end] * 2, "#", "$", "|", ":", "\n", "1e999"]))
        )
        text = text[:start] + filling + text[end:]
    return text


names_of_ticks = st.text("abc-_.1 ;(#", min_size=1, max_size=3).filter(is_marker_name)


odd_inputs = st.lists(st.integers(0, 15), max_size=30).map(bytes)


@st.composite
def tracks(draw: st.DrawFn, inputs: st.SearchStrategy[bytes] = odd_inputs) -> InputTrack:
    """Runs under edit, with names of ticks."""
    keys = draw(inputs)
    markers = draw(st.dictionaries(names_of_ticks, st.integers(0, len(keys)), max_size=4))
    return InputTrack(keys, tuple(sorted(Marker(tick, name) for name, tick in markers.items())))
