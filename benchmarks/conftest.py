"""What the kernel benchmarks print beside pytest-benchmark's own table: the roofline."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pytest

# The benchmark that moves bytes and does nothing else.
BANDWIDTH = "copy"


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """One row a kernel: time a point, how much of the memory bandwidth it uses, flops."""
    session = getattr(terminalreporter.config, "_benchmarksession", None)
    timed = {b.extra_info["kernel"]: b for b in session.benchmarks} if session else {}
    if BANDWIDTH not in timed or timed[BANDWIDTH].stats is None:
        return

    def rate(kernel: str, what: str) -> float:
        bench = timed[kernel]
        return bench.extra_info[what] * bench.extra_info["points"] / bench.stats.median

    bandwidth = rate(BANDWIDTH, "bytes")
    print = terminalreporter.write_line
    print(f"\nRoofline, {bandwidth / 1e9:.1f} GB/s measured by a copy\n")
    print("| kernel | ns a point | bytes moved a point | part of the bandwidth | Gflop/s |")
    print("|---|---|---|---|---|")
    for kernel, bench in timed.items():
        nanoseconds = 1e9 * bench.stats.median / bench.extra_info["points"]
        print(
            f"| {kernel} | {nanoseconds:.1f} | {bench.extra_info['bytes']}"
            f" | {rate(kernel, 'bytes') / bandwidth:.0%} | {rate(kernel, 'flops') / 1e9:.1f} |"
        )
