"""The command line of ``python -m fbs.corpus``."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence

from fbs.corpus.cluster import LOCAL
from fbs.corpus.setting import PEERS, RATES, SIZES

_DESCRIPTION = """\
Encodes, decodes, measures and compares every clip below a folder, as tasks of Dask: a clip and a setting is one.
Results are Parquet tables and one report in HTML. The same command goes on where it was interrupted."""

_EXAMPLES = """\
examples:
  python -m fbs.corpus clips/ --out results/
  python -m fbs.corpus clips/ --out results/ --peers x264,av1 --peer-sizes 1 --frames 100
  python -m fbs.corpus /data/clips --out /data/results --scheduler tcp://10.0.0.1:8786
  python -m fbs.corpus --out results/ --report-only
"""


def _number(low: int, high: int):
    def read(text: str) -> int:
        value = int(text)
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{value} is not from {low} to {high}")
        return value

    read.__name__ = "number"  # argparse names it in its message
    return read


def _list_of(allowed: Sequence[object]):
    def read(text: str) -> list:
        by_name = {str(a): a for a in allowed}
        names = [n.strip().lower() for n in text.split(",") if n.strip()]
        for name in names:
            if name not in by_name:
                raise argparse.ArgumentTypeError(f"{name} is none of {', '.join(by_name)}")
        return [by_name[n] for n in dict.fromkeys(names)]

    return read


def _bytes(text: str) -> int:
    units = {"k": 10**3, "m": 10**6, "g": 10**9, "t": 10**12}
    number = text.lower().removesuffix("b")
    factor = units.get(number[-1:], 1)
    value = float(number.rstrip("kmgt")) * factor
    if not 2**20 <= value < 2**63:
        raise argparse.ArgumentTypeError(f"{text} is not a size of memory, such as 4GB")
    return int(value)


def _positive(text: str) -> float:
    value = float(text)
    if not 0 < value < 1e9:
        raise argparse.ArgumentTypeError(f"{text} is not above 0")
    return value


def parse(arguments: Sequence[str] | None = None) -> argparse.Namespace:
    """Read the command line; ends the process where it is wrong."""
    parser = argparse.ArgumentParser(
        prog="python -m fbs.corpus",
        description=_DESCRIPTION,
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("folder", metavar="DIR", nargs="?", help="folder of clips, with all below it")
    parser.add_argument("--out", metavar="RESULTS", required=True, help="folder for results")
    _add_measuring(parser.add_argument_group("what is measured"))
    _add_cluster(parser.add_argument_group("where"))
    _add_running(parser.add_argument_group("how"))
    parsed = parser.parse_args(arguments)
    if parsed.folder is None and not parsed.report_only:
        parser.error("DIR is missing; only --report-only does without")
    return parsed


def _add_measuring(group: argparse._ArgumentGroup) -> None:
    group.add_argument(
        "--qualities",
        metavar="Q",
        nargs="+",
        type=_number(0, 100),
        default=[20, 35, 50, 65, 80],
        help="of fbs (default: 20 35 50 65 80); BD-rate needs four",
    )
    group.add_argument(
        "--peers",
        type=_list_of(PEERS),
        default=[],
        metavar="LIST",
        help="also encode with these of x264,x265,av1, through ffmpeg; takes far longer",
    )
    group.add_argument(
        "--peer-sizes",
        type=_list_of(SIZES),
        default=list(SIZES),
        metavar="LIST",
        help="divisors of width and height for peers; 4 is for pictures of more than 400x400 (default: 1,2,4)",
    )
    group.add_argument(
        "--peer-rates",
        type=_list_of(RATES),
        default=list(RATES),
        metavar="LIST",
        help="peers code every so many pictures (default: 1,2,3)",
    )
    group.add_argument("--frames", type=_number(1, 10**9), metavar="N", help="the first N pictures of each clip only")
    group.add_argument("--effort", type=_number(0, 9), default=5, help="of fbs (default: 5)")
    group.add_argument("--allow-no-face", action="store_true", help="measure clips without a face, too")


def _add_cluster(group: argparse._ArgumentGroup) -> None:
    group.add_argument(
        "--scheduler",
        default=LOCAL,
        metavar="ADDRESS",
        help="of a Dask scheduler, such as tcp://10.0.0.1:8786 (default: local, on this machine)",
    )
    group.add_argument(
        "--workers",
        type=_number(1, 4096),
        metavar="N",
        help="processes of a local cluster (default: one for each core)",
    )
    group.add_argument(
        "--memory-limit",
        default="auto",
        metavar="SIZE",
        help="of a local worker, without the programs it runs (default: auto)",
    )
    group.add_argument("--dashboard", metavar="ADDRESS", help="show the dashboard of a local cluster, at :8787 say")
    group.add_argument(
        "--through-client",
        action="store_true",
        help="workers cannot write to RESULTS: send results through this process",
    )


def _add_running(group: argparse._ArgumentGroup) -> None:
    group.add_argument("--retry-failed", action="store_true", help="try again what failed in an earlier run")
    group.add_argument("--report-only", action="store_true", help="only make the report anew")
    group.add_argument("--keep-streams", action="store_true", help="keep all streams of fbs, in RESULTS/streams")
    group.add_argument(
        "--attempts",
        type=_number(1, 100),
        default=3,
        metavar="N",
        help="give a clip up when workers that had it were killed so often (default: 3)",
    )
    group.add_argument(
        "--timeout", type=_positive, default=3600, metavar="SECONDS", help="of one call of the program (default: 3600)"
    )
    group.add_argument(
        "--task-memory",
        type=_bytes,
        metavar="SIZE",
        help="most address space of one call of the program, such as 4GB (default: no limit)",
    )
    group.add_argument(
        "--in-flight",
        type=_number(1, 10**6),
        metavar="N",
        help="most tasks on the cluster at a time (default: 4 for each thread, 64 at least)",
    )
    group.add_argument(
        "--worst",
        type=_number(0, 100),
        default=10,
        metavar="N",
        help="clips that the report shows pictures of (default: 10)",
    )
    group.add_argument("--quiet", action="store_true", help="print no progress")


def order_facts(parsed: argparse.Namespace) -> dict[str, object]:
    """What run.json notes of a command line."""
    names = ("qualities", "peers", "peer_sizes", "peer_rates", "frames", "effort", "allow_no_face")
    return {"folder": os.path.abspath(parsed.folder)} | {n: getattr(parsed, n) for n in names}
