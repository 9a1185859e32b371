"""Untrusted containers: TOML that is read in time, zips that take no more memory than they may."""

import io
import struct
import time
from zipfile import ZIP_LZMA, ZipFile

import pytest

from ninja_game.files.untrusted import MAX_PARTS, open_zip, parse_toml, unpacked

KEYS = ["a.", '"a" . ', "'a'.", '"\\"" .\t', "a-1."]


@pytest.mark.parametrize("part", KEYS)
@pytest.mark.parametrize("form", ["{} = 1", "[{}]", "[[{}]]", "x = {{ y = 1, {} = 2 }}"])
def test_a_key_of_very_many_parts_is_refused_at_once(part: str, form: str) -> None:
    started = time.process_time()
    with pytest.raises(ValueError, match=f"A key of more than {MAX_PARTS} parts"):
        parse_toml("b = 1\n" + form.format(part * 20_000 + "a"))
    assert time.process_time() - started < 1


@pytest.mark.parametrize(
    "text", ["a" * 60_000, '"' * 60_000, "'a\n" * 20_000, "a ." * 49, '"a\\' * 20_000, ".a " * 20_000]
)
def test_other_odd_texts_take_no_time_either(text: str) -> None:
    started = time.process_time()
    with pytest.raises(ValueError, match=r"."):
        parse_toml(text)
    assert time.process_time() - started < 1


def test_many_dots_elsewhere_are_no_key() -> None:
    dots = "." * 300
    listed = ", ".join(f'"{number:02d}.txt"' for number in range(90))
    assert parse_toml(f'# {dots}\na.b = "x {dots}"\nc = [{listed}]')["a"] == {"b": f"x {dots}"}


def test_nesting_without_end_is_a_value_error() -> None:
    with pytest.raises(ValueError, match="Nested too deep"):
        parse_toml("a = " + "[" * 50_000)


def test_the_entries_of_a_zip_are_counted_before_anything_is_made_of_them() -> None:
    entry = struct.pack("<4s4B4HL2L5H2L", b"PK\1\2", 20, 3, 20, *[0] * 8, 1, *[0] * 6) + b"a"
    end = struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, 5000, 5000, len(entry) * 5000, 0, 0)
    with pytest.raises(ValueError, match="more than 4096 files in a zip"):
        open_zip(io.BytesIO(entry * 5000 + end), most_files=4096, most_bytes=2**20)
    assert len(open_zip(io.BytesIO(entry * 5000 + end), most_files=5000, most_bytes=2**20).infolist()) == 5000


def test_what_all_files_hold_together_is_limited() -> None:
    out = io.BytesIO()
    with ZipFile(out, "w") as archive:
        for number in range(3):
            archive.writestr(str(number), bytes(2**20))
    with pytest.raises(ValueError, match="more than 2 MiB, unpacked"):
        open_zip(out, most_files=10, most_bytes=2 * 2**20)


def test_only_common_ways_of_packing_are_unpacked() -> None:
    out = io.BytesIO()
    with ZipFile(out, "w", ZIP_LZMA) as archive:
        archive.writestr("a", "text")
    archive = open_zip(out, most_files=10, most_bytes=2**20)
    with pytest.raises(ValueError, match="packed in an unusual way"):
        unpacked(archive, archive.infolist()[0])


def test_a_zip_whose_index_is_far_longer_than_its_names_is_refused_before_it_is_read() -> None:
    extra = struct.pack("<HH", 7, 0) * 16_383
    entry = (
        struct.pack("<4s6B5H3L5H2L", b"PK\1\2", *[0] * 6, *[0] * 5, *[0] * 3, 1, len(extra), *[0] * 5) + b"a" + extra
    )
    end = struct.pack("<4s4H2LH", b"PK\5\6", 0, 0, 40, 40, 40 * len(entry), 0, 0)
    with pytest.raises(ValueError, match="an index of more than 128 KiB"):
        open_zip(io.BytesIO(40 * entry + end), most_files=64, most_bytes=2**20)
