"""Piles of balls under the rule `contact`, beside Rapier, with all processors.

``python bench/heaps.py`` builds `bench/rapier` with cargo (some minutes the first time) and runs the piles of
``carom bench --set heaps`` under both, one after the other. The command `carom` is found on the path, or named
by ``--carom``. Only figures of one session compare.
"""

import argparse
import json
import os
import subprocess
from pathlib import Path

PEER = Path(__file__).parent / "rapier"
COLUMNS = "{:>8} {:>9} {:>12} {:>12} {:>7} {:>16} {:>20}"


def rapier(balls: int, friction: float, threads: int) -> dict[str, float]:
    """What came out of a pile under Rapier."""
    command = ["cargo", "run", "--release", "--quiet", "--manifest-path", str(PEER / "Cargo.toml")]
    environment = os.environ | {"RAYON_NUM_THREADS": str(threads)}
    answer = subprocess.run(
        [*command, "--", str(balls), str(friction)],
        check=True,
        capture_output=True,
        env=environment,
    )
    return json.loads(answer.stdout)


def main() -> None:
    """Prints a table of both."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--carom", default="carom", help="the command `carom`")
    parser.add_argument("--runs", default="1", help="runs of carom, of which the median counts")
    options = parser.parse_args()
    command = [options.carom, "bench", "--set", "heaps", "--json", "--runs", options.runs]
    bench = subprocess.run(command, check=True, capture_output=True)
    heaps = json.loads(bench.stdout)["heaps"]
    heaps = [heap for heap in heaps if (heap["rule"], heap["kind"]) == ("contact", "pile")]
    threads = heaps[0]["threads"]
    print(f"milliseconds for a frame, {threads} threads; overlap as a part of the radius and rms speed at the end")
    print(COLUMNS.format("balls", "friction", "carom", "rapier", "ratio", "overlap", "rms speed [m/s]"))
    for heap in heaps:
        peer = rapier(heap["balls"], heap["friction"], threads)
        own = heap["threads_frame_milliseconds"]
        print(
            COLUMNS.format(
                heap["balls"],
                heap["friction"],
                f"{own:.2f}",
                f"{peer['frame_milliseconds']:.2f}",
                f"{peer['frame_milliseconds'] / own:.1f}",
                f"{heap['overlap']:.4f}/{peer['overlap']:.4f}",
                f"{heap['rms_speed']:.1e}/{peer['rms_speed']:.1e}",
            )
        )


if __name__ == "__main__":
    main()
