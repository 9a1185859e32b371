"""An attempt counts the lifetime, takes the score and records as game.md §1 and §4.3 say."""

from ninja_game.formats.replay.text import write_replay
from ninja_game.formats.run_time import level_score
from ninja_game.player.attempt import Attempt
from ninja_game.runs.run import run_level
from ninja_game.sim.rules import GOLD_BONUS, LIFETIME
from tests.support.players import EXIT_TICK, RIGHT, deadly_level, played, short_level


def test_score_is_taken_in_the_tick_of_the_exit_before_its_lifetime_step() -> None:
    attempt = played(short_level())
    assert (attempt.outcome, attempt.ended_tick) == ("exit", EXIT_TICK)
    assert attempt.score == attempt.lifetime == LIFETIME - EXIT_TICK == level_score(0, EXIT_TICK)


def test_gold_adds_two_seconds_each_at_once() -> None:
    attempt = played(short_level(gold=2))
    assert attempt.gold == 2
    assert attempt.lifetime == LIFETIME + 160 - EXIT_TICK


def test_level_score_does_not_depend_on_the_lifetime_at_its_start() -> None:
    attempt = played(short_level(), lifetime=1000)
    assert attempt.score == LIFETIME - EXIT_TICK
    assert attempt.lifetime == 1000 - EXIT_TICK


def test_episode_score_is_the_lifetime_at_the_last_exit() -> None:
    lifetime, results = LIFETIME, []
    for gold in (0, 1, 2):
        attempt = played(short_level(gold=gold), lifetime=lifetime)
        lifetime = attempt.lifetime
        results.append((gold, attempt.ended_tick))
    assert lifetime == LIFETIME + sum(GOLD_BONUS * gold - exit_tick for gold, exit_tick in results)


def test_recording_of_a_passed_level_has_as_many_frames_as_its_exit_tick() -> None:
    attempt = played(short_level())
    for _ in range(30):
        attempt.tick(RIGHT)
    assert len(attempt.inputs) == EXIT_TICK
    again = run_level(short_level(), attempt.replay().playback(EXIT_TICK + 1), memory="plain")
    assert (again.outcome, again.end_tick) == ("exit", EXIT_TICK)


def test_recording_of_a_death_has_as_many_frames_as_its_tick() -> None:
    attempt = played(deadly_level())
    assert attempt.outcome == "dead"
    assert len(attempt.inputs) == attempt.ended_tick


def test_lifetime_runs_out_only_once_a_picture_and_kills_then() -> None:
    attempt = Attempt(short_level(), lifetime=3)
    for _ in range(5):
        attempt.tick(0)
    assert attempt.outcome == "running"
    attempt.check_time()
    assert attempt.outcome == "dead"


def test_practice_has_no_countdown_but_gold_adds() -> None:
    attempt = played(short_level(gold=1), practice=True)
    assert attempt.lifetime == LIFETIME + 80
    assert attempt.assisted


def test_retry_gives_lifetime_gold_and_recording_back() -> None:
    attempt = played(deadly_level(), lifetime=500)
    attempt.restart()
    assert (attempt.lifetime, attempt.gold, bytes(attempt.inputs), attempt.outcome) == (500, 0, b"", "running")


def test_giving_up_is_a_death_by_own_hand() -> None:
    attempt = Attempt(short_level())
    attempt.tick(0)
    attempt.give_up(0.1, 2.0, -3.0)
    assert attempt.outcome == "dead"
    assert attempt.self_inflicted


def test_a_replay_of_practice_says_so() -> None:
    assert played(short_level(), practice=True).replay().practice
    assert not played(short_level()).replay().practice
    assert "made: played (practice)\n" in write_replay(played(short_level(), practice=True).replay())


def test_who_gave_up_and_goes_back_has_not_given_up() -> None:
    attempt = Attempt(short_level(), practice_mode=True)
    attempt.tick(0)
    moment = attempt.save()
    attempt.give_up(0.1, 2.0, -3.0)
    given_up = attempt.save()
    reported = []
    for each in (moment, given_up):
        attempt.restore(each)
        reported.append(attempt.self_inflicted)
    attempt.simulation.restore(moment[0])
    attempt.after_rewind()
    assert [*reported, attempt.self_inflicted] == [False, True, False]
