"""Make the levels of days to come, which nobody waits for then: `tool daily_levels --from 2026-11-23 --days 404`.

What is in FOLDER already is not made again; the pack is written when all are there.
"""

from __future__ import annotations

import argparse
import zipfile
from datetime import date, timedelta
from pathlib import Path
from threading import Event

from ninja_game.files.user_folder import data_folder
from ninja_game.formats.pack.files import PARS, PackFiles
from ninja_game.formats.pack.pars import parse_pars
from ninja_game.generator.daily import FOLDER, PACKED, daily_file, make_daily

MOMENT = (1980, 1, 1, 0, 0, 0)
"""Of all files in the zip, so that the same levels are the same bytes."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--from", dest="first", type=date.fromisoformat, required=True, help="the first day")
    parser.add_argument("--days", type=int, default=404)
    parser.add_argument("--folder", type=Path, default=Path("build"), help="where levels wait for the others")
    options = parser.parse_args()
    days = [options.first + timedelta(number) for number in range(options.days)]
    for day in days:
        if not daily_file(options.folder, day).exists():
            made = make_daily(options.folder, day, report=lambda _: None, stop=Event())
            print(day, "made" if made else "none found", flush=True)
    files = PackFiles(options.folder / FOLDER)
    pars = parse_pars(files.text(PARS))
    with zipfile.ZipFile(data_folder("assets") / PACKED, "w") as packed:
        for name in files.names:
            entry = zipfile.ZipInfo(name, MOMENT)
            packed.writestr(entry, files.text(name), zipfile.ZIP_DEFLATED, 9)
    print(f"{len(pars)} levels in {data_folder('assets') / PACKED}")


if __name__ == "__main__":
    main()
