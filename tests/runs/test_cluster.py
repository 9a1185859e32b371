"""The same verification on a Dask cluster of several worker processes, one of which is killed on the way."""

import os
import signal
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest

from ninja_game.runs import archive as archives
from ninja_game.runs.archive import verify_all, write_report
from ninja_game.runs.workers import ClusterError
from tests.support.samples import SPIKED, WALK, replay_of_walk, running, write_records

distributed: Any = pytest.importorskip("distributed", reason="Dask distributed (extra 'cluster') is not installed")
pytestmark = pytest.mark.filterwarnings("ignore")  # Dask's own

RUNS = 60


@pytest.fixture(scope="module")
def cluster() -> Iterator[Any]:
    """A scheduler and two worker processes on this machine."""
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, silence_logs=50
    ) as found:
        yield found


@pytest.fixture
def archive(tmp_path: Path) -> Path:
    """A folder of recordings, some of them bad."""
    folder = tmp_path / "archive"
    folder.mkdir()
    still = WALK.replace("^100,566", "^400,100", 1)
    for number in range(RUNS):
        level = SPIKED if number % 7 == 0 else still if number % 3 else WALK
        write_records(folder / f"run-{number:03}.txt", (f"Run {number}", level, running(500)))
    (folder / "broken.txt").write_text("ninja-game replay 3\nnonsense\n")
    (folder / "walk.replay.txt").write_text(replay_of_walk())
    return folder


def test_a_killed_worker_changes_nothing_in_the_report(
    cluster: Any, archive: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(archives, "JOB_WEIGHT", 2)
    here, there = BytesIO(), BytesIO()
    alone = list(write_report(verify_all([archive], memory="plain", jobs=1, processes=False), here))
    with distributed.Client(cluster.scheduler_address) as client:
        pids = sorted(client.run(os.getpid).values())
    log = tmp_path / "log"
    results = write_report(verify_all([archive], memory="plain", cluster=cluster.scheduler_address, resume=log), there)
    together = [next(results)]
    os.kill(pids[0], signal.SIGKILL)
    together += results
    assert together == alone
    assert there.getvalue() == here.getvalue()
    with distributed.Client(cluster.scheduler_address) as client:
        # One that dies while it is asked has no answer.
        assert pids[0] not in client.run(os.getpid, on_error="ignore").values()
    # Every chunk stands once in the log.
    keys = [line.split(b'"results"')[0] for line in log.read_bytes().splitlines()[1:]]
    assert len(keys) == len(set(keys)) == RUNS + 2


def test_nobody_at_the_address_is_one_of_our_errors() -> None:
    with pytest.raises(ClusterError, match="no Dask scheduler at 'nowhere'"):
        list(verify_all([Path("x")], cluster="nowhere"))
