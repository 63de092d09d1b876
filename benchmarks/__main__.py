"""``make bench``: every benchmark, one after the other; some fifteen minutes."""

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
    traced,
)

foundation.main()
peers_table.table()
quality.report(quality.run(list(quality.own_corpus()), peers=True))
estimation.main()
methods.main()
traced.table(traced.TOLERANCE)
ordering.table(None)
drawings.main()
scale.everything(7)
raise SystemExit(
    pytest.main(["benchmarks/test_kernels.py", "--benchmark-only", "--benchmark-enable"])
)
