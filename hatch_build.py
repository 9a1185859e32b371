"""Puts the documents into a wheel, and the compiled kernels of one system, where ``NINJA_GAME_KERNELS`` names them."""

import os
import sys
import sysconfig
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class KernelsHook(BuildHookInterface):
    """Makes a wheel for this Python and this system of it; without the variable it is for any."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add the folder and name the wheel; an editable one has none."""
        if version == "standard":
            # Of their pictures those that are small, and the first page's.
            for path in Path(self.root, "docs").rglob("*.*"):
                if path.suffix in {".md", ".svg"} or path.name.startswith(("lab-", "ninja-game.")):
                    name = path.relative_to(self.root).as_posix()
                    build_data["force_include"][str(path)] = f"ninja_game/data/{name}"
        folder = os.environ.get("NINJA_GAME_KERNELS")
        if folder and version == "standard":
            build_data["force_include"][folder] = "ninja_game/data/kernels"
            build_data["pure_python"] = False
            # They are linked with nothing but Numba's own parts, so with no libc of a certain age.
            system = sysconfig.get_platform().replace("linux-", "manylinux_2_17_")
            name = "".join(sign if sign.isalnum() else "_" for sign in system)
            build_data["tag"] = f"cp{sys.version_info.major}{sys.version_info.minor}-none-{name}"
