"""What the learning environments cost, beside the bare kernel and a plain wrapper round Simulation (docs/learning.md).

usage: python3 tools/dev.py tool measure.learning_speed [FOLDER]

Prints the table of docs/learning.md; with a folder, also the chart of speed against worlds, as CSV and picture. By the
processor's time, on one thread; some minutes.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from benchmarks import measure_learning as measured
from ninja_game.learn.levels import level_source

WORLDS = 1024


def main() -> None:
    """Print the table, save the chart."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", nargs="?", type=Path)
    folder = parser.parse_args().folder
    levels = level_source("set").levels[::5]
    plain = measured.single_speed(measured.PlainWrapper, levels)
    print(f"plain wrapper round Simulation: {plain:,.0f} ticks/s")
    single = measured.single_speed(measured.single_env, levels)
    print(f"NinjaEnv: {single:,.0f} ticks/s, {single / plain:.2f} of the plain wrapper")
    for name, parts in measured.OBSERVATIONS.items():
        speed = measured.vector_speed(WORLDS, parts)
        print(
            f"NinjaVectorEnv, {WORLDS} worlds, {name}: {speed.environment:,.0f} ticks/s, "
            f"{speed.environment / measured.FRAME_SKIP:,.0f} steps/s, {speed.share:.2f} of the "
            f"bare kernel's {speed.kernel:,.0f} ticks/s, {speed.environment / plain:,.0f} times the plain wrapper"
        )
    print(f"memory of {measured.MANY:,} worlds: {measured.memory_of(measured.MANY) / 2**20:,.0f} MiB")
    if folder:
        measured.against_worlds().save(folder)


if __name__ == "__main__":
    main()
