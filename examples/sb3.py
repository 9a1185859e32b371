"""Stable-Baselines3 on thousands of worlds: its ``VecEnv`` over ours.

    python3 -m examples.sb3 --level 00-0-first-steps --steps 500000

It needs Stable-Baselines3, which is in none of the extras: `python3 -m pip install stable-baselines3`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray
from stable_baselines3 import PPO
from stable_baselines3.common.vec_env import VecEnv

from ninja_game.learn import NinjaVectorEnv


class SB3VecEnv(VecEnv):  # type: ignore[misc]
    """A ``NinjaVectorEnv`` as Stable-Baselines3 drives its own; ``settings``: its arguments.

    A world that has ended begins at once; what it showed last is in its info as ``terminal_observation``, with
    ``TimeLimit.truncated``, ``episode`` (return and length) and ``is_success``. Each step's observations are an
    array of their own, as SB3 stores those of the step before after the next one: nothing is copied besides.
    """

    def __init__(self, num_envs: int, **settings: Any) -> None:
        self.envs = NinjaVectorEnv(num_envs, autoreset_mode="SameStep", **settings)
        self.render_mode = self.envs.render_mode
        super().__init__(num_envs, self.envs.single_observation_space, self.envs.single_action_space)
        self._returns, self._lengths = np.zeros(num_envs), np.zeros(num_envs, np.int64)

    def reset(self) -> Any:
        """Begin new episodes, by the seeds and options given before."""
        seeds = self._seeds if any(seed is not None for seed in self._seeds) else None
        observations, _ = self.envs.reset(seed=seeds, options=self._options[0] or None)
        self._returns[:], self._lengths[:] = 0.0, 0
        self._reset_seeds()
        self._reset_options()
        return observations

    def step_async(self, actions: NDArray[Any]) -> None:
        """Take the actions of the next step."""
        self._actions = actions

    def step_wait(self) -> tuple[Any, NDArray[np.float32], NDArray[np.bool_], list[dict[str, Any]]]:
        """One step of all worlds."""
        observations, rewards, terminated, truncated, infos = self.envs.step(self._actions)
        self._returns += rewards
        self._lengths += 1
        per_world: list[dict[str, Any]] = [{} for _ in range(self.num_envs)]
        for index in np.flatnonzero(terminated | truncated).tolist():
            per_world[index] = {
                "terminal_observation": infos["final_obs"][index],
                "TimeLimit.truncated": bool(truncated[index]),
                "is_success": bool(infos["final_info"]["outcome"][index] == 1),
                "level": infos["final_info"]["level"][index],
                "episode": {"r": float(self._returns[index]), "l": int(self._lengths[index]), "t": 0.0},
            }
            self._returns[index], self._lengths[index] = 0.0, 0
        return observations, rewards.astype(np.float32), terminated | truncated, per_world

    def close(self) -> None:
        """Close the environment."""
        self.envs.close()

    def get_images(self) -> Sequence[Any]:
        """A picture of each world."""
        return self.envs.render() or ()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """The environment's attribute, for each of the worlds."""
        return [getattr(self.envs, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Worlds have no attributes of their own."""
        raise NotImplementedError(f"{attr_name}: worlds of one vector have no attributes of their own")

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> list[Any]:
        """Worlds have no methods of their own."""
        raise NotImplementedError(f"{method_name}: worlds of one vector have no methods of their own")

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:  # noqa: ARG002 - as VecEnv has it
        """None is."""
        return [False for _ in self._get_indices(indices)]


@click.command(help=__doc__.replace("\n    python3", "\n\b\n    python3"))
@click.option("--level", default="00-0-first-steps", show_default=True, help="As of an environment.")
@click.option("--steps", type=click.IntRange(1), default=500_000, show_default=True, help="Of all worlds together.")
@click.option("--worlds", type=click.IntRange(1), default=64, show_default=True)
@click.option("--seed", type=click.IntRange(0), default=0, show_default=True)
def main(level: str, steps: int, worlds: int, seed: int) -> None:
    envs = SB3VecEnv(worlds, level=level, repeat=0.25, longest_wait=7, time_limit=2000)
    agent = PPO("MlpPolicy", envs, n_steps=128, batch_size=2048, gamma=0.99, ent_coef=0.01, seed=seed, verbose=1)
    agent.learn(steps)


if __name__ == "__main__":
    main()
