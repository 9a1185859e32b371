"""Each input in tests/corpus goes through its entry point: only our own errors come out (`tool soak.inputs`)."""

from pathlib import Path

import pytest

from tools.soak.input_table import ENTRY_POINTS, errors_of

CORPUS = Path(__file__).parent / "corpus"
MAX_BYTES = 200_000


@pytest.mark.parametrize("name", ENTRY_POINTS)
def test_entry_point_reads_or_refuses_its_corpus(name: str, tmp_path: Path) -> None:
    outcomes = set()
    for number, file in enumerate(sorted((CORPUS / name.replace(" ", "-")).iterdir())):
        folder = tmp_path / str(number)
        folder.mkdir()
        try:
            ENTRY_POINTS[name].read(file.read_bytes(), folder)
            outcomes.add("read")
        except errors_of(name) as error:
            outcomes.add(str(error) and "refused")
    assert outcomes <= {"read", "refused"}
    assert "read" in outcomes


def test_corpus_is_small_and_of_known_entry_points() -> None:
    assert {folder.name.replace("-", " ") for folder in CORPUS.iterdir()} == ENTRY_POINTS.keys()
    assert sum(file.stat().st_size for file in CORPUS.rglob("*") if file.is_file()) <= MAX_BYTES
