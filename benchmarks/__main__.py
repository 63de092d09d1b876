"""``make bench``: every benchmark, one after the other."""

from benchmarks import foundation, sections

foundation.main()
sections.table()
sections.small_contour()
