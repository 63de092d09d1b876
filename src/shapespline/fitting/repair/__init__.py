"""Repairs: what is asked of some pieces only is asked for by sub-requests."""
