"""The price of smoothness=2 in stored points, over the project's own corpus.

python -m benchmarks.smoothness
"""

from __future__ import annotations

import shapespline as ss
from benchmarks.quality import own_corpus

PERCENTS = (0.5, 0.1)


def main() -> None:
    """Prints one row a tolerance."""
    print("| tolerance | outlines | points, smoothness 1 | smoothness 2 | ratio | not reached |")
    print("|---" * 6 + "|")
    for percent in PERCENTS:
        sums, outlines, missed = [0, 0], 0, 0
        for outline in own_corpus():
            plain, smooth = (
                ss.fit_curve(outline.contour, tolerance=f"{percent}%", smoothness=smoothness)
                for smoothness in (1, 2)
            )
            outlines += 1
            missed += smooth.status != ss.Status.KEPT
            sums = [sums[0] + plain.n_stored_points, sums[1] + smooth.n_stored_points]
        ratio = sums[1] / sums[0]
        print(f"| {percent} % | {outlines} | {sums[0]} | {sums[1]} | {ratio:.2f} | {missed} |")


if __name__ == "__main__":
    main()
