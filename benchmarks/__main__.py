"""``make bench``: every benchmark, one after the other.

Some twenty minutes; with the large corpus beside the project an hour, and pictures of its worst
ten fits in bench-output.
"""

import pytest

from benchmarks import (
    drawings,
    estimation,
    foundation,
    methods,
    ordering,
    peers_table,
    quality,
    scale,
    tips,
    traced,
)

foundation.main()
peers_table.table()
quality.main([])
if (quality.LARGE / "manifest.csv").exists():
    quality.main(["--all", "--figures", "bench-output"])
else:
    print(f"the large corpus is not at {quality.LARGE}: its quality table is left out")
estimation.main()
tips.main([])
methods.main()
traced.table(traced.TOLERANCE)
ordering.table(None)
drawings.main()
scale.everything(7)
raise SystemExit(
    pytest.main(["benchmarks/test_kernels.py", "--benchmark-only", "--benchmark-enable"])
)
