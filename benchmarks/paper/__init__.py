"""``make paper``: the published method judged, written to docs/paper.md with tables and figures."""
