"""Files of runs: nothing that a person wrote is replaced, authors stay, what is saved opens again as it was."""

import json
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import given, strategies as st

from ninja_game.document import OccupiedError, digest_of_file
from ninja_game.errors import ArgumentError, FileError, LevelError, NinjaGameError, ReplayError
from ninja_game.formats import load
from ninja_game.formats.load import load_replays
from ninja_game.formats.n14.level_string import level_digest, parse_level_string
from ninja_game.formats.named_level import NamedLevel
from ninja_game.formats.recording import Recording
from ninja_game.formats.replay.provenance import Provenance
from ninja_game.formats.replay.text import parse_replay, write_episode, write_replay
from ninja_game.runs.archive import verify_all
from ninja_game.runs.verify import Verdict
from ninja_game.sim.inputs import fit_inputs
from ninja_game.tas.contributions import Contributions
from ninja_game.tas.files import OpenedRun, RunFile, branches_path, new_run, open_run, save_run, track_of
from ninja_game.tas.journal import JOURNAL_FOLDER, lost_runs
from ninja_game.tas.session import TasSession
from ninja_game.tas.tracks import Branches, InputTrack
from tests.support.own_pack import PACK, instead_of_ours
from tests.support.samples import WALK, WALK_END, replay_of_walk, running, write_records
from tests.support.strategies import tracks

LEVEL = parse_level_string(WALK)


def saved_run(opened: OpenedRun, track: InputTrack, path: Path) -> OpenedRun:
    """Save an input track, and open it again."""
    save_run(opened.recording, track, Branches(), path, opened.file)
    return open_run(path)


@pytest.mark.parametrize("text", ["", "inputs:\n", ".*1\n", "R*3 RJ\n"])
def test_a_text_with_few_ticks_or_none_is_a_run_on_a_level_that_is_given(text: str, tmp_path: Path) -> None:
    file = tmp_path / "begun.txt"
    file.write_text(text, "utf-8")
    opened = open_run(file, level=LEVEL)
    assert list(opened.track.inputs) == {".*1\n": [0], "R*3 RJ\n": [2, 2, 2, 14]}.get(text, [])
    assert opened.file == RunFile()


def test_the_levels_of_an_episode_are_edited_one_by_one_and_it_says_how_they_are_put_together(tmp_path: Path) -> None:
    run = load_replays(PACK / "certificates" / "00-0-run-and-hop.exit.replay.txt")[0].replay
    file = tmp_path / "00.episode.txt"
    file.write_text(write_episode([run, run]))
    with pytest.raises(ReplayError, match="edit one with --record, 0 to 1; `ninja-game convert` puts the episode"):
        open_run(file)
    assert len(open_run(file, record=1).track) == run.ticks


def test_a_level_is_opened_as_a_new_run_of_it(tmp_path: Path) -> None:
    ours, records = PACK / "00-0-run-and-hop.txt", write_records(tmp_path / "n.txt", ("a", WALK, ""), ("b", WALK, ""))
    assert open_run(ours).recording.name == "Run and Hop"
    with pytest.raises(LevelError, match=r"2 levels.*--record"):
        open_run(records)
    opened = open_run(records, record=1)
    assert (opened.recording.name, opened.recording.level, len(opened.track)) == ("b", LEVEL, 0)
    with pytest.raises(LevelError, match="there is no record 2"):
        open_run(records, record=2)
    again = saved_run(opened, InputTrack(bytes([2] * 30)), tmp_path / "new.replay.txt")
    assert (again.recording.name, again.recording.level_author, again.recording.author) == ("b", "me", "")


@given(tracks(), st.sampled_from(["circle", "box"]))
def test_what_is_saved_opens_again_as_it_was(track: InputTrack, body: str) -> None:
    from tempfile import TemporaryDirectory

    replay = replace(parse_replay(replay_of_walk()), name="Töm\n", author='"us"', body=body, level_author="somebody")  # type: ignore[arg-type]
    recording = Recording(LEVEL, replay, file="a.txt")
    with TemporaryDirectory() as folder:
        path = Path(folder) / "a.replay.txt"
        if not track.inputs:
            with pytest.raises(ArgumentError, match="one tick"):
                save_run(recording, track, Branches(), path, RunFile())
            return
        again = saved_run(OpenedRun(recording, track), track, path)
    assert (again.recording.name, again.recording.author, again.recording.body) == ("Töm\n", '"us"', body)
    replay = again.recording.replay
    assert replay is not None
    assert replay.level_author == "somebody"
    # Ticks without a key behind the end may go, and those up to an end soon behind the keys come; nothing else.
    assert again.track.inputs == fit_inputs(track.inputs, len(again.track))
    assert not any(track.inputs[len(again.track) :])
    assert again.track.markers == track.markers
    assert again.file.path == path


def test_an_exit_behind_the_last_key_is_saved(tmp_path: Path) -> None:
    path = tmp_path / "walk.replay.txt"
    path.write_text(replay_of_walk(), "utf-8")
    opened = open_run(path)
    short = opened.track.replaced(WALK_END - 2, len(opened.track), [])
    again = saved_run(opened, short, path)
    assert again.recording.replay.outcome == "exit"
    assert again.recording.ticks > len(short)
    assert again.track.inputs == fit_inputs(short.inputs, again.recording.ticks)


def test_inputs_that_name_a_level_are_their_own_file(tmp_path: Path) -> None:
    (tmp_path / "level.txt").write_text(WALK, "utf-8")
    path = tmp_path / "idea.replay.txt"
    path.write_text("ninja-game replay 3\nname: idea\nlevel: level.txt\ninputs:\n  R*20\n", "utf-8")
    assert open_run(path).file.path == path


def test_nothing_behind_the_exit_is_written(tmp_path: Path) -> None:
    path = tmp_path / "walk.replay.txt"
    path.write_text(replay_of_walk(), "utf-8")
    opened = open_run(path)
    with_claims = saved_run(opened, opened.track.replaced(40, 60, [0] * 20), path)
    assert (with_claims.recording.ticks, with_claims.recording.replay.unclaimed) == (WALK_END + 1, False)
    for track in (opened.track.replaced(40, 41, [4]), opened.track.named(40, "later")):
        again = saved_run(open_run(path), track, path)
        assert (again.track, again.recording) == (with_claims.track, with_claims.recording)


def test_a_demo_of_n_opens_and_is_saved_as_a_new_replay(tmp_path: Path) -> None:
    source = write_records(tmp_path / "demos.txt", ("a", WALK, running(WALK_END)), ("b", WALK, running(9)))
    data = source.read_bytes()
    with pytest.raises(ReplayError, match="2 recordings"):
        open_run(source)
    with pytest.raises(ReplayError, match="no record 7"):
        open_run(source, record=7)
    opened = open_run(source, record=0)
    assert opened.file == RunFile()
    again = saved_run(opened, opened.track, tmp_path / "new.replay.txt")
    assert (again.track, again.recording.author) == (opened.track, "me")
    (verdict,) = verify_all([tmp_path / "new.replay.txt"], memory="plain", jobs=1, processes=False)
    assert isinstance(verdict, Verdict)
    assert (verdict.outcome, verdict.problems) == ("exit", ())
    assert source.read_bytes() == data


def test_other_files_are_never_replaced_unasked(tmp_path: Path) -> None:
    path, other = tmp_path / "walk.replay.txt", tmp_path / "other.replay.txt"
    path.write_text(replay_of_walk(), "utf-8")
    other.write_text("somebody's", "utf-8")
    session = TasSession(open_run(path), tmp_path, memory="plain")
    session.change(session.track.replaced(3, 4, [5]))
    with pytest.raises(OccupiedError, match=r"a file named other\.replay\.txt already exists"):
        session.save(other)
    path.write_text(replay_of_walk(gold=0), "utf-8")
    with pytest.raises(OccupiedError, match="another program has changed"):
        session.save(path)
    session.save(path, replacing=True)
    assert session.is_saved
    session.change(session.track.replaced(3, 4, [2]))
    session.save(path)
    session.keep_branch("one")
    branches_path(path).write_text("somebody's", "utf-8")
    with pytest.raises(OccupiedError, match=r"another program has changed walk\.replay\.txt\.branches\.json"):
        session.save(path)
    assert other.read_text("utf-8") == branches_path(path).read_text("utf-8") == "somebody's"
    session.close()


def edited_and_lost(path: Path, folder: Path) -> Path:
    """The journal of a session that has died, with an edit of the run in a file."""
    session = TasSession(open_run(path), folder, memory="plain")
    session.change(session.track.replaced(3, 4, [5]))
    session.close(keep=True)
    (journal,) = (folder / JOURNAL_FOLDER).glob("*.jsonl")
    return journal


def test_a_journal_knows_no_file_but_a_run_that_is_there(tmp_path: Path) -> None:
    path, other = tmp_path / "walk.replay.txt", tmp_path / "profile"
    path.write_text(replay_of_walk(), "utf-8")
    other.write_text("# what every machine has, of a known digest\n")
    journal = edited_and_lost(path, tmp_path)
    first, _, rest = journal.read_text("utf-8").partition("\n")
    for place, home in ((path, path), (other, None), (tmp_path / "missing", None), (tmp_path, None)):
        head = json.loads(first) | {"path": str(place), "digest": digest_of_file(other)}
        journal.write_text(f"{json.dumps(head)}\n{rest}", "utf-8")
        (found,) = lost_runs(tmp_path)
        assert found.opened.file.path == home
    journal.write_text(f"{first}\n{rest}", "utf-8")
    (found,) = lost_runs(tmp_path)
    session = TasSession(found.opened, tmp_path, memory="plain")
    session.recover(found)
    path.unlink()
    with pytest.raises(OccupiedError, match=r"another program has removed walk\.replay\.txt"):
        session.save(path)
    session.close()


def test_branches_are_not_written_through_a_link(tmp_path: Path) -> None:
    path = tmp_path / "walk.replay.txt"
    path.write_text(replay_of_walk(), "utf-8")
    branches_path(path).symlink_to(tmp_path / "made")
    session = TasSession(open_run(path), tmp_path, memory="plain")
    session.keep_branch("$(touch marker)")
    with pytest.raises(OccupiedError):
        session.save(path)
    with pytest.raises(FileError, match="only a regular file is written"):
        session.save(path, replacing=True)
    assert not (tmp_path / "made").exists()
    session.close()


def test_saving_what_was_not_changed_writes_nothing(tmp_path: Path) -> None:
    path = tmp_path / "walk.replay.txt"
    path.write_text(replay_of_walk(), "utf-8", newline="\r\n")
    data = path.read_bytes()
    session = TasSession(open_run(path), tmp_path, memory="plain")
    session.save(path)
    assert path.read_bytes() == data
    session.keep_branch("one")
    session.save(path)
    assert path.read_bytes() == data
    assert [each.name for each in open_run(path).branches.all] == ["one"]


@pytest.mark.parametrize(
    "change",
    [
        lambda text: text.replace("inputs:", "; mine\ninputs:"),
        lambda text: text.replace("R*24", "(R*6)*4"),
        lambda text: text.replace("R*24", "R*20 R*4"),
        lambda text: text.replace("R*24", "R*24 ; to the exit"),
        lambda text: text.replace("  R*24", "  include rest.inputs.txt"),
        lambda text: text.replace("name: walk\n", "").replace("body:", "name: walk\nbody:"),
    ],
)
def test_texts_that_a_person_wrote_are_not_replaced(tmp_path: Path, change: object) -> None:
    path = tmp_path / "walk.replay.txt"
    (tmp_path / "rest.inputs.txt").write_text("R*24", "utf-8")
    text = change(replay_of_walk())  # type: ignore[operator]
    assert text != replay_of_walk()
    path.write_text(text, "utf-8")
    opened = open_run(path)
    assert opened.file == RunFile()
    assert opened.track == InputTrack(bytes([2] * 24))
    with pytest.raises(OccupiedError):
        save_run(opened.recording, opened.track, Branches(), path, opened.file)


def test_certificates_of_the_game_are_not_replaced(tmp_path: Path) -> None:
    with instead_of_ours():
        file = PACK / "certificates" / "00-0-run-and-hop.exit.replay.txt"
        assert open_run(file).file == RunFile()
    copy = tmp_path / "copy.replay.txt"
    copy.write_bytes(file.read_bytes())
    assert open_run(copy).file.path == copy


def test_a_replay_goes_on_naming_the_file_of_its_level(tmp_path: Path) -> None:
    (tmp_path / "level").write_text(WALK, "utf-8")
    path = tmp_path / "walk.replay.txt"
    path.write_text(replay_of_walk(level=None, level_path="level"), "utf-8")
    opened = open_run(path)
    again = saved_run(opened, opened.track.replaced(0, 0, [0]), path)
    replay = again.recording.replay
    assert replay is not None
    assert (replay.level_path, replay.level, replay.level_digest) == ("level", None, level_digest(LEVEL))
    elsewhere = saved_run(opened, opened.track, tmp_path / "b.replay.txt")
    assert elsewhere.recording.replay.level is not None


def test_branches_travel_beside_their_run(tmp_path: Path) -> None:
    path = tmp_path / "walk.replay.txt"
    path.write_text(replay_of_walk(), "utf-8")
    session = TasSession(open_run(path), tmp_path, memory="plain")
    session.keep_branch("as it was")
    session.change(session.track.replaced(5, 9, [0] * 4))
    session.keep_branch("slower")
    assert not session.is_saved
    session.save(path)
    again = TasSession(open_run(path), tmp_path, memory="plain")
    assert again.branches.all == session.branches.all
    assert [(each.outcome, each.end, each.gold) for each in again.branches.all] == [("exit", 23, 1), ("exit", 29, 1)]
    again.checkout_branch(0)
    assert again.track == InputTrack(bytes([2] * 24))
    for text in ("{", "[]", '{"branches": [{}], "current": null}', "[" * 100_000, '{"branches": [], "current": 1e999}'):
        branches_path(path).write_text(text, "utf-8")
        with pytest.raises(ReplayError, match="not the branches of a run"):
            open_run(path)


def test_markers_that_no_text_can_hold_are_not_replay_of_walk() -> None:
    replay = parse_replay(replay_of_walk())
    for markers in (((1, 'a"b'),), ((1, "a"), (2, "a")), ((-1, "a"),), ((99, "a"),)):
        track = InputTrack(replay.inputs).named(1, "x")
        bad = tuple(track.markers[0]._replace(tick=tick, name=name) for tick, name in markers)
        with pytest.raises(ReplayError):
            write_replay(replace(replay, markers=bad))


def test_mutated_replays_open_or_are_refused(tmp_path: Path) -> None:
    rng = Random(5)
    path = tmp_path / "walk.replay.txt"
    whole = replay_of_walk().replace("R*24", "#a R*10 ; c\n  (R RJ)*3 #b R*8")
    for _ in range(300):
        at = rng.randrange(len(whole))
        path.write_text(
            whole[:at] + rng.choice(["", "9", "(", ")*9", "#a", "\0", "é", "\n"]) + whole[at + 1 :], "utf-8"
        )
        try:
            opened = open_run(path)
        except NinjaGameError:
            continue
        assert opened.track == track_of(opened.recording)
        if opened.file.path:
            assert saved_run(opened, opened.track.replaced(0, 0, [1]), path).track.inputs[0] == 1


def test_names_come_from_load_replays(tmp_path: Path) -> None:
    path = tmp_path / "walk.replay.txt"
    path.write_text(replay_of_walk(name=""), "utf-8")
    opened = open_run(path)
    assert opened.recording.name == load_replays(path)[0].name


def by_ann(path: Path, **about: Any) -> TasSession:
    """A session of Bob's with a run that Ann played."""
    path.write_text(replay_of_walk(author="Ann", made=Provenance(played=True), **about), "utf-8")
    return TasSession(open_run(path), path.parent, player="Bob", memory="plain")


def test_a_saved_run_says_how_often_it_was_edited_and_by_whom(tmp_path: Path) -> None:
    path = tmp_path / "walk.replay.txt"
    session = by_ann(path)
    session.change(session.track.named(3, "corner"))
    assert session.origin.replay.made == Provenance(played=True), "a name for a tick is no edit"
    session.begin()
    for tick in (3, 4):
        session.change(session.track.replaced(tick, tick + 1, [0]))
    session.end()
    session.change(session.track.replaced(5, 6, [0]))
    session.save(path)
    replay = parse_replay(path.read_text("utf-8"))
    assert replay.made == Provenance(played=True, edits=2, begun_by="Ann")
    assert (replay.author, replay.co_authors) == ("Ann", ("Bob",))
    session.undo()
    session.undo()
    assert session.origin.replay.made == Provenance(played=True), "the keys are Ann's again"
    session.close()


def test_keys_that_are_taken_bring_their_authors_and_searches_along(tmp_path: Path) -> None:
    path = tmp_path / "walk.replay.txt"
    session = by_ann(path)
    found = Contributions.of(
        Recording(LEVEL, parse_replay(replay_of_walk(author="Cy", made=Provenance(searches=("solve",)))))
    )
    session.change(session.track.replaced(5, 6, [0]), taken=found)
    session.change(session.track.replaced(6, 7, [0]), taken=Contributions(commands=("search",)))
    expected = Provenance(played=True, edits=2, searches=("solve", "search"), begun_by="Ann"), ("Bob", "Cy")
    assert (session.origin.replay.made, session.origin.replay.co_authors) == expected
    session.close(keep=True)
    (lost,) = lost_runs(tmp_path)
    again = TasSession(lost.opened, tmp_path, player="Bob", memory="plain")
    again.recover(lost)
    assert (again.origin.replay.made, again.origin.replay.co_authors) == expected
    again.save(path)
    assert parse_replay(path.read_text("utf-8")).made == expected[0]
    again.close()


@pytest.mark.parametrize("player", ["", "Bob"])
def test_a_result_that_is_taken_is_no_edit_and_its_origin_stays(player: str, tmp_path: Path) -> None:
    source = write_records(tmp_path / "person.txt", ("a", WALK, running(WALK_END)))
    session = TasSession(open_run(source, record=0), tmp_path, player=player, memory="plain")
    found = Contributions(commands=("improve",))
    session.change(session.track.replaced(5, 6, [0]), taken=found, edited=False)
    path = tmp_path / "new.replay.txt"
    session.save(path)
    saved = parse_replay(path.read_text("utf-8"))
    assert (str(saved.made), saved.author) == ("searched (improve) from a run by unknown (person.txt)", player)
    session.change(session.track.replaced(7, 8, [0]))
    assert session.origin.replay.made.edits == 1
    session.change(session.track.replaced(9, 10, [0]), taken=found, edited=False, whole=True)
    assert session.origin.replay.made.edits == 1, "edits that were made stay"
    session.close()


def test_an_empty_run_was_nobodys_before(tmp_path: Path) -> None:
    session = TasSession(new_run(NamedLevel("a room", "me", "", LEVEL, "")), tmp_path, memory="plain")
    session.change(session.track.replaced(0, 0, [2] * 9))
    assert str(session.origin.replay.made) == "edited 1"
    session.close()


def test_what_is_undone_is_credited_no_longer(tmp_path: Path) -> None:
    """Nor is what another branch has; a recovered run says what the lost one said."""
    path = tmp_path / "walk.replay.txt"
    session = by_ann(path)
    session.keep_branch("mine")
    spliced = session.track.replaced(5, 6, [0])
    session.change(spliced, taken=Contributions(commands=("improve",), names=("Cy",)))
    theirs = session.origin.replay.co_authors
    assert theirs == ("Bob", "Cy")
    session.save(path)
    session.keep_branch("theirs")
    session.undo()
    session.change(session.track.replaced(9, 10, [0]))
    own = Provenance(played=True, edits=1, begun_by="Ann"), ("Bob",)
    assert (session.origin.replay.made, session.origin.replay.co_authors) == own
    session.checkout_branch(1)
    assert session.origin.replay.co_authors == theirs
    session.checkout_branch(0)
    assert not session.origin.replay.made.edits
    session.change(session.track.replaced(9, 10, [0]))
    session.close(keep=True)
    (lost,) = lost_runs(tmp_path)
    again = TasSession(lost.opened, tmp_path, player="Bob", memory="plain")
    again.recover(lost)
    assert (again.origin.replay.made, again.origin.replay.co_authors) == own
    again.undo()
    again.undo()
    assert again.origin.replay.co_authors == theirs
    again.close()


def test_what_commands_searched_from_nobodys_run_has_no_author() -> None:
    def names(**about: object) -> tuple[str, ...]:
        return Contributions.of(Recording(LEVEL, parse_replay(replay_of_walk(**about)), file="s1.replay.txt")).names

    searched = Provenance(searches=("search",))
    assert names(made=searched) == ()
    assert names(made=searched, author="Ann") == ("Ann",)
    assert names(made=searched._replace(begun_by="Ann")) == ("Ann",)
    assert names(made=searched, co_authors=("Bob",)) == ("Bob",)
    for made in (Provenance(), searched._replace(edits=1), searched._replace(played=True)):
        assert names(made=made) == ("unknown (s1.replay.txt)",)


def test_the_name_in_a_record_of_n_is_no_players(tmp_path: Path) -> None:
    """It is that of who made the level; a record that says how its run was made is ours, and names the player."""
    source = write_records(tmp_path / "demos.txt", ("a", WALK, running(WALK_END)), ("b", WALK, running(9)))
    opened, other = open_run(source, record=0), load_replays(source)[1]
    assert (opened.recording.author, opened.recording.player) == ("me", "")
    session = TasSession(opened, tmp_path, player="Bob", memory="plain")
    assert session.origin.replay.credit == ""
    session.change(session.track.replaced(5, 6, [0]), taken=Contributions.of(other))
    session.save(tmp_path / "new.replay.txt")
    saved = parse_replay((tmp_path / "new.replay.txt").read_text("utf-8"))
    assert (saved.author, saved.co_authors, saved.level_author) == ("Bob", ("unknown (demos.txt)",), "me")
    assert saved.made.begun_by == "unknown (demos.txt)"
    session.close()
    ours = replace(other, replay=replace(other.replay, made=Provenance(edits=1)))
    assert Contributions.of(ours).names == ("me",)


def test_a_file_that_is_opened_is_read_once_as_text(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[Path] = []

    def reading(file: Path) -> str:
        read.append(file)
        return file.read_text("utf-8")

    path = write_records(tmp_path / "demos.txt", ("a run", WALK, running(30)))
    monkeypatch.setattr(load, "read_text", reading)
    assert open_run(path).recording.name == "a run"
    assert read == [path]
