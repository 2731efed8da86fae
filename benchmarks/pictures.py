"""`python -m benchmarks.pictures OTHER`: pictures of this checkout and of another one, in turn.

git worktree add ../before COMMIT && python -m benchmarks.pictures ../before
"""

import argparse
import os
import subprocess
import sys
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from benchmarks.measure import ONE_THREAD, medians

HERE = Path(__file__).resolve().parents[1]

COMMANDS: Mapping[str, tuple[str, ...]] = {
    "PNG": ("render", "--mode", "cab yaw", "--output", "yaw.png"),
    "GIF": ("render", "--mode", "cab yaw", "--output", "yaw.gif"),
    "MP4": ("render", "--mode", "cab yaw", "--output", "yaw.mp4"),
    "report": ("report", "--rates", "optimised", "--output", "report.html"),
}


def main() -> None:
    """Prints how long each command takes in both, and how many times longer in the other."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.pictures", description=__doc__)
    parser.add_argument("other", type=Path, help="folder of a checkout to compare with")
    parser.add_argument("--rounds", type=int, default=1, help="how often each has its turn")
    parser.add_argument("--only", choices=COMMANDS, nargs="+", default=list(COMMANDS))
    options = parser.parse_args()
    print("        here  there  ratio")
    for name in options.only:
        folders = {"here": HERE, "there": options.other.resolve()}
        calls = {place: partial(_run, folder, COMMANDS[name]) for place, folder in folders.items()}
        seconds = medians(calls, options.rounds)
        here, there = seconds["here"], seconds["there"]
        print(f"{name:6} {here:4.0f} s {there:4.0f} s {there / here:6.1f}", flush=True)


def _run(checkout: Path, arguments: tuple[str, ...]) -> None:
    """Runs a command of a checkout in a new folder; raises CalledProcessError if it fails."""
    environment = {**os.environ, **ONE_THREAD, "PYTHONPATH": str(checkout)}
    with TemporaryDirectory() as folder:
        command = [sys.executable, "-m", "modeviz", *arguments]
        subprocess.run(command, cwd=folder, env=environment, check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main()
