"""Links: what they carry comes back as it was; broken and hostile ones are refused, in bounded time and memory."""

import json
import random
import statistics
import time
import tracemalloc
import zlib
from base64 import urlsafe_b64encode
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from ninja_game.cli.convert import link_of
from ninja_game.errors import FormatError, LinkError, NinjaGameError
from ninja_game.files import reading
from ninja_game.files.bundled import bundled_levels, bundled_replays, data_folder
from ninja_game.formats.ascii.writer import headers_of
from ninja_game.formats.links import (
    MAX_CHARACTERS,
    MAX_LINK_BYTES,
    MAX_TEXTS,
    is_link,
    level_link,
    linked_texts,
    pack_link,
    pack_texts,
    read_link,
    recording_link,
    recordings_in_links,
    replay_link,
    watched_names,
    write_link,
    write_watch,
)
from ninja_game.formats.load import load_levels, load_replays
from ninja_game.formats.n14.level_string import level_digest, parse_level_string
from ninja_game.formats.pack.pack import Pack, PackFiles, is_pack
from ninja_game.formats.replay.text import write_replay
from ninja_game.runs.packs import lint
from ninja_game.runs.recording_reader import texts_in
from ninja_game.runs.verify import verify_recording
from tests.support.own_pack import PACK
from tests.support.reference import levels as levels_of_reference, recordings, require_reference

LEVEL = parse_level_string("1" * 23 + "0" * 690 + "|5^60,564!11^708,540,396,540!0^396.1000000001,NaN")
LINK = level_link(LEVEL, name="a <b>hill</b>", author='"us" & them', comment="x\ny")
MEDIAN, LONGEST = 8 * 1024, 64 * 1024
"""Characters: of the median link, which is demanded, and of the longest of ours and the reference."""


@pytest.mark.parametrize("broken", ["# level=1.", "#\nlev\r\nel =1.", "#level%3D1.", "#%6Cevel=1."])
def test_a_link_that_was_broken_or_escaped_on_its_way_is_still_one(broken: str) -> None:
    link = "https://example.org/game/" + LINK.replace("#level=1.", broken)
    assert is_link(link)
    assert not is_pack(Path(link))
    (named,) = load_levels(Path(link))
    assert level_digest(named.level) == level_digest(LEVEL)
    assert is_pack(Path(pack_link({"pack.toml": ""}).replace("#pack", "# pa ck")))


def test_every_level_of_ours_comes_back_and_its_link_is_short() -> None:
    sizes = []
    for path in bundled_levels():
        (named,) = load_levels(path)
        link = link_of([path])
        (back,) = load_levels(f"https://example.org/game/?x=1{link}")
        assert headers_of(back) == headers_of(named)
        assert back.level == named.level
        sizes.append(len(link))
    assert statistics.median(sizes) <= 1150
    assert max(sizes) <= 1536


def test_every_certificate_comes_back_verifies_and_its_link_is_short() -> None:
    certificates = [each for path in bundled_replays() for each in load_replays(path)]
    links = [recording_link([each]) for each in certificates]
    assert statistics.median(map(len, links)) <= 2048
    for recording, link in list(zip(certificates, links, strict=True))[::20]:
        (back,) = load_replays(link)
        assert recording.replay is not None
        assert back.replay == replace(recording.replay, level=recording.level, level_path="", waypoints=())
        assert verify_recording(back).good


def test_reference_levels_and_recordings_come_back_and_their_links_are_short() -> None:
    require_reference()
    levels, runs = [], []
    for row in levels_of_reference():
        level = parse_level_string(row.data)
        link = level_link(level, name=row.name, author=row.author)
        assert level_digest(load_levels(link)[0].level) == level_digest(level)
        levels.append(len(link))
    for run in recordings()[::10]:
        (recording,) = recordings_in_links([f"$run###{run.data}#{run.demo}#"])
        link = recording_link([recording])
        (back,) = load_replays(link)
        assert back.inputs == recording.inputs
        runs.append(len(link))
    for sizes in (levels, runs):
        assert statistics.median(sizes) <= MEDIAN
        assert max(sizes) <= LONGEST


def test_pack_comes_back_with_episodes_and_par_times() -> None:
    path = data_folder("levels")
    link = Path("https://example.org/" + PackFiles(path).link())
    assert is_pack(link)
    ours, back = Pack(path), Pack(link)
    assert back.index == ours.index
    assert back.pars == ours.pars
    assert [named.level for named in back.levels.values()] == [named.level for named in ours.levels.values()]
    assert not back.problems
    assert len(load_levels(link)) == len(ours.levels)


def test_pack_brings_its_certificates_though_they_are_short() -> None:
    link = PackFiles(PACK).link()
    assert len(link) < 6100
    back = Pack(Path(link))
    assert list(lint(back)) == []
    run = back.files.text("certificates/00-0-run-and-hop.exit.replay.txt")
    assert "waypoints" not in run
    assert "level-data" not in run


def test_several_replays_are_one_link() -> None:
    found = [load_replays(path)[0] for path in bundled_replays()[:3]]
    link = recording_link(found)
    assert [each.name for each in load_replays(link)] == [each.name for each in found]
    with pytest.raises(LinkError, match="no link carries 10"):
        recording_link(found[:1] * (MAX_TEXTS + 1))


def test_what_mail_and_chat_do_to_a_link_does_no_harm() -> None:
    expected = read_link(LINK)
    broken = "\r\n ".join(LINK[start : start + 70] for start in range(0, len(LINK), 70))
    for text in (f"https://x.example/a#b/{LINK}".replace("#b", ""), f"  <{LINK}>.", broken, LINK.replace("=", "%3D")):
        assert read_link(text) == expected
    assert read_link(Path(f"https://x.example/{LINK}")) == expected


def test_text_of_a_link_is_data() -> None:
    (named,) = load_levels(LINK)
    assert (named.name, named.author, named.comment) == ("a <b>hill</b>", '"us" & them', "x\ny")
    assert not set(LINK) & set("<>\"'& \n")


def packed(data: bytes, *, checked: bool = True) -> str:
    deflate = zlib.compressobj(9, zlib.DEFLATED, -15)
    sum_ = zlib.crc32(data).to_bytes(4, "big") if checked else b"\0\0\0\0"
    return urlsafe_b64encode(sum_ + deflate.compress(data) + deflate.flush()).rstrip(b"=").decode()


@pytest.mark.parametrize(
    "link,message",
    [
        ("#level=1.", "not a link"),
        ("#level=2.abcd", "unknown version"),
        ("#level=1.a*c", "not a link"),
        ("#level=1.abcde", "not whole"),
        (LINK[:-1], "not whole"),
        (LINK[:200] + ("A" if LINK[200] != "A" else "B") + LINK[201:], "not whole"),
        (LINK + "AAAA", "not whole"),
        (LINK + "&" + LINK[1:], "too many things"),
        (LINK.replace("#level", "#replay") + "&" + LINK[1:], "too many things"),
        (f"#level=1.{packed(b'x', checked=False)}", "not whole"),
        (f"#level=1.{packed(bytes(20))}", "not a text file"),
        (f"#level=1.{packed(b'0' * (MAX_LINK_BYTES + 1))}", "unpacks to too much"),
        ("#replay=" + "&replay=".join([f"1.{packed(b'0' * (MAX_LINK_BYTES // 2 + 1))}"] * 2), "unpacks to too much"),
        (
            "#replay=" + "&replay=".join([f"1.{packed('€'.encode() * (MAX_LINK_BYTES // 6 + 1))}"] * 2),
            "unpacks to too much",
        ),
        ("#level=1." + "A" * MAX_CHARACTERS, "too long"),
    ],
)
def test_broken_links_say_so(link: str, message: str) -> None:
    with pytest.raises(FormatError, match=message):
        load_levels(link)
    assert is_link(link)


def test_too_much_for_a_link_is_refused_when_it_is_made() -> None:
    noise = "".join(map(chr, random.Random(1).choices(range(0x100, 0x2000), k=MAX_CHARACTERS // 2)))
    for text in ("0" * (MAX_LINK_BYTES + 1), noise):
        with pytest.raises(LinkError, match="too much for a link"):
            write_link("level", [text])
    half = "€" * (MAX_LINK_BYTES // 6)
    assert linked_texts(write_link("level", [half * 2]), "level") == (half * 2,)
    with pytest.raises(LinkError, match="too much for a link"):
        write_link("replay", [half, f"{half}€€"])


def test_bomb_takes_no_more_memory_than_the_limit() -> None:
    bomb = f"#pack=1.{packed(bytes(1_000_000_000 // 8))}"
    tracemalloc.start()
    with pytest.raises(LinkError, match="unpacks to too much"):
        pack_texts(bomb)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 4 * MAX_LINK_BYTES


def test_replay_in_a_link_reads_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (recording,) = load_replays(bundled_replays()[0])
    assert recording.replay is not None
    (tmp_path / "level.txt").write_text(bundled_levels()[0].read_text("utf-8"), "utf-8")
    monkeypatch.chdir(tmp_path)
    text = write_replay(replace(recording.replay, level=None, level_path="level.txt"))
    with pytest.raises(LinkError, match="without its level"):
        load_replays(write_link("replay", [text]))
    with pytest.raises(LinkError, match="without its level"):
        recordings_in_links([text])
    with pytest.raises(LinkError, match="without its level"):
        replay_link([replace(recording.replay, level=None)])


@pytest.mark.parametrize(
    "name",
    ["../a.txt", "a/b.txt", "certificates/../a", "certificates/.a", ".hidden", "", "c:a.txt", "a\nb.txt", "n" * 200],
)
def test_pack_with_odd_names_is_refused(name: str) -> None:
    with pytest.raises(LinkError, match="a name that no file"):
        pack_texts(pack_link({"pack.toml": 'name = "x"', name: ""}))


@pytest.mark.parametrize("text", ["", "[]", '{"a": 1}', "{" * 100_000, "[" * 100_000, json.dumps({"pack.toml": None})])
def test_pack_that_is_not_a_pack_is_refused(text: str) -> None:
    with pytest.raises(LinkError, match="no pack in this link"):
        Pack(Path(write_link("pack", [text])))


def test_kind_must_fit() -> None:
    with pytest.raises(LinkError, match="a link of a level"):
        pack_texts(LINK)
    with pytest.raises(LinkError, match="a link of a pack"):
        linked_texts(pack_link({"a": "b"}), "level", "replay")


@pytest.mark.parametrize(
    "names", ["../../etc", "0123456789abcdeF", "a", "", "0123456789abcdef," * 9, "%2e%2e", f"{'a' * 16}-44"]
)
def test_only_files_of_the_board_are_watched(names: str) -> None:
    with pytest.raises(LinkError, match="not a link of runs"):
        watched_names(f"#watch={names}")


def test_watch_link_names_the_files_of_runs() -> None:
    assert watched_names(write_watch(["0123456789abcdef", "f" * 16])) == [
        "replays/0123456789abcdef.txt", "replays/ffffffffffffffff.txt",
    ]  # fmt: skip
    assert watched_names("#watch=0123456789abcdef-4") == ["replays/0123456789abcdef.txt"], "with the number of a colour"
    assert watched_names(LINK) == []


def _changed(link: str, rng: random.Random) -> str:
    """A link with a few characters changed, cut out, doubled or put in."""
    for _ in range(rng.randint(1, 4)):
        place = rng.randrange(len(link))
        link = rng.choice(
            (
                link[:place] + chr(rng.choice((rng.randint(0, 127), rng.randint(0, 0xD7FF)))) + link[place:],
                link[:place] + link[place + rng.randint(1, 30) :],
                link[:place] + link[max(0, place - rng.randint(1, 30)) :],
                link[:place] + rng.choice("#&=.-_AZaz09%") + link[place + 1 :],
            )
        )
        if not link:
            return "#"
    return link


def test_mutated_links_give_only_our_own_errors_in_bounded_time() -> None:
    rng = random.Random(7)
    pack = pack_link({name: (Path("tests/pack") / name).read_text("utf-8") for name in ("pack.toml", "pars.toml")})
    replays = recording_link([load_replays(path)[0] for path in bundled_replays()[:2]])
    readers: tuple[Callable[[str], object], ...] = (load_levels, load_replays, lambda link: Pack(Path(link)))
    start = time.process_time()
    for _ in range(1000):
        link = _changed(rng.choice((LINK, pack, replays)), rng)
        if is_link(link):
            for reader in readers:
                try:
                    reader(link)
                except NinjaGameError:
                    continue
    assert time.process_time() - start < 20


@given(st.binary(max_size=300), st.sampled_from(["level", "replay", "pack"]))
def test_any_bytes_in_a_sound_link_give_only_our_own_errors(data: bytes, kind: str) -> None:
    link = f"#{kind}=1.{packed(data)}"
    for reader in (load_levels, load_replays, pack_texts):
        try:
            reader(link)
        except NinjaGameError:
            continue


def test_a_file_that_is_called_as_links_are_gives_them_no_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "link").write_text("anything")
    (tmp_path / "run.tas").write_text("30,R\n")
    assert reading.has_folder("run.tas")
    assert not reading.has_folder(reading.LINK)


@pytest.mark.parametrize("name", ["z#replay=1.AAAA.txt", "a #level=1.AAAA.txt", "#replay=1.AAAA.txt"])
def test_a_file_with_the_name_of_a_link_is_read_in_its_folder(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path(name).write_text(bundled_replays()[0].read_text("utf-8"))
    assert list(texts_in([Path()])) == [(name, Path(name).read_text(), False)]
    assert is_link(name) == name.startswith("#")
    assert is_link(Path(f"https://example.org/{name}"))


def test_a_long_text_is_told_apart_from_a_link_in_time_of_its_length() -> None:
    start = time.process_time()
    assert not is_link("not " * 10**6)
    assert time.process_time() - start < 20
