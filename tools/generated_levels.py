"""Make the generated levels that come with the game: `dev.py tool generated_levels --count 1000`.

Difficulties in turn. What is in FOLDER already is not made again; the file is written when all are there.
"""

import argparse
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from ninja_game.files.bundled import data_folder
from ninja_game.generator.generate import HARDEST, generate
from ninja_game.generator.packed import PACKED, PackedLevel, pack


def made(seed: int) -> str:
    """The line of a seed, '' where it gives no level."""
    wanted = 1 + seed % HARDEST
    level = generate(seed, wanted)
    if level is None:
        return ""
    return PackedLevel(seed, wanted, level.named.name, level.difficulty, level.named.level, level.run.inputs).line


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=1000, help="levels, as many of each difficulty")
    parser.add_argument("--folder", type=Path, default=Path("build/generated"), help="where levels wait for the others")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    lines: dict[int, str] = {}
    seeds = list(range(1, options.count + 1))
    with ProcessPoolExecutor(options.jobs) as pool:
        # A seed that gives no level has another one of the same difficulty after it.
        while seeds:
            missing = [seed for seed in seeds if not (options.folder / f"{seed}.tsv").exists()]
            for seed, line in zip(missing, pool.map(made, missing), strict=True):
                (options.folder / f"{seed}.tsv").write_text(line, "utf-8")
                print(seed, "made" if line else "none found", flush=True)
            lines |= {seed: (options.folder / f"{seed}.tsv").read_text("utf-8") for seed in seeds}
            seeds = [seed + options.count for seed in seeds if not lines[seed]]
    chosen = [line for _, line in sorted(lines.items()) if line]
    data = pack(chosen)
    (data_folder("assets") / PACKED).write_bytes(data)
    print(f"{len(chosen)} levels, {len(data)} bytes in {data_folder('assets') / PACKED}")


if __name__ == "__main__":
    main()
