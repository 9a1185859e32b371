"""Every input that is kept in tests/corpus goes through its door: only our own errors come out (`tool soak.doors`)."""

from __future__ import annotations

from pathlib import Path

import pytest

from tools.soak.door_table import DOORS, errors_of

CORPUS = Path(__file__).parent / "corpus"
MOST_BYTES = 200_000


@pytest.mark.parametrize("name", DOORS)
def test_door_reads_or_refuses_its_corpus(name: str, tmp_path: Path) -> None:
    outcomes = set()
    for number, file in enumerate(sorted((CORPUS / name.replace(" ", "-")).iterdir())):
        folder = tmp_path / str(number)
        folder.mkdir()
        try:
            DOORS[name].read(file.read_bytes(), folder)
            outcomes.add("read")
        except errors_of(name) as error:
            outcomes.add(str(error) and "refused")
    assert outcomes <= {"read", "refused"}
    assert "read" in outcomes


def test_corpus_is_small_and_of_doors_that_are_there() -> None:
    assert {folder.name.replace("-", " ") for folder in CORPUS.iterdir()} == DOORS.keys()
    assert sum(file.stat().st_size for file in CORPUS.rglob("*") if file.is_file()) <= MOST_BYTES
