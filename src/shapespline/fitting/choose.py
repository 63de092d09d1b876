"""The one order of preference: which of the curves that were verified is the best."""

from __future__ import annotations

from typing import TYPE_CHECKING

from shapespline.fitting.strategies import ONE_SPLINE, PIECES, SMOOTHED

if TYPE_CHECKING:
    from collections.abc import Sequence

    from shapespline.fitting.problem import Problem
    from shapespline.fitting.verify import Verified

# A curve that stores more than this part of the number of points follows rough data; it tells
# nothing of what was drawn, and lines may be the smaller (PIE-05).
ROUGH_PART = 0.3
# The ranks of a shape as it was drawn, and of lines and arcs that only their number speaks for.
DRAWN, FEW_DRAWN = -1, -2


class Shortlist:
    """The verified candidates for a problem, and the best of them.

    The order of preference, first what counts most:

    1. both distances keep the tolerance;
    2. tangents that were asked for are met;
    3. it is as it was drawn, where that was asked for;
    4. the curve is fair (even knots, no near-cusp, no crossing that the data have not), where it
       stands in for corners of the data; it does not wave where the data do not, wherever;
    5. no corners where the data have none, if one smooth spline follows them, or one a run does;
    6. the fewest stored points; of curves that miss the tolerance the nearest;
    7. the simpler structure: lines and arcs, one spline, a symmetric one, one spline a run, pieces,
       lines, a line from each point to the next;
    8. the one that was found first.
    """

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._verified: list[Verified] = []

    def add(self, verified: Verified) -> None:
        """Take one more into account."""
        self._verified.append(verified)

    def __len__(self) -> int:
        return len(self._verified)

    @property
    def best(self) -> Verified:
        """The one that is preferred to all others."""
        return self._preferred(self._verified)

    @property
    def kept(self) -> bool:
        """Whether one keeps the tolerance."""
        return any(verified.kept for verified in self._verified)

    @property
    def missing_tangents(self) -> tuple[Verified, ...]:
        """Those that keep the tolerance, where all of these miss a tangent that was asked for."""
        kept = tuple(verified for verified in self._verified if verified.kept)
        return kept if all(verified.tangent_error for verified in kept) else ()

    def among(self, *ranks: int) -> Verified | None:
        """The best of some ranks, None if there is none of them."""
        those = [one for one in self._verified if one.candidate.rank in ranks]
        return self._preferred(those) if those else None

    def follows(self, verified: Verified) -> bool:
        """Whether a curve keeps the tolerance with few points for those of the data."""
        most = ROUGH_PART * len(self._problem.contour)
        return verified.kept and verified.fit.n_stored_points <= most

    def _preferred(self, those: Sequence[Verified]) -> Verified:
        """The best of some; one alone is not compared, which would look for corners."""
        return those[0] if len(those) == 1 else min(those, key=self._preference)

    def _preference(self, verified: Verified) -> tuple[bool, bool, bool, bool, bool, float, int]:
        problem, candidate = self._problem, verified.candidate
        instead = bool(candidate.fairness) and problem.has_corners
        return (
            not verified.kept,
            verified.tangent_error > 0,
            candidate.rank != DRAWN,
            (instead and not verified.fair) or verified.waves,
            self._makes_corners(verified),
            verified.fit.n_stored_points if verified.kept else verified.fit.hausdorff_distance,
            candidate.rank,
        )

    def _makes_corners(self, verified: Verified) -> bool:
        """Whether a curve has corners where the data, which a smooth one follows, have none."""
        if any(self._spares_corners(one, verified) for one in self._verified):
            return True
        if not verified.fit.sections or self._problem.has_corners:
            return False
        if verified.candidate.rank in (DRAWN, FEW_DRAWN):  # its corners are where edges meet
            return False
        if self._problem.request.style.free or not len(verified.fit.corners):
            return False
        return any(self.follows(one) for one in self._verified if not one.fit.sections)

    @staticmethod
    def _spares_corners(smooth: Verified, other: Verified) -> bool:
        """Whether one spline a run, or one for all, stands for what turns where it need not."""
        ranks = (smooth.candidate.rank, other.candidate.rank)
        if ranks == (SMOOTHED, PIECES):  # which was asked what it may cost
            return smooth.kept
        if ranks != (ONE_SPLINE, SMOOTHED) or not (smooth.kept and smooth.fair) or smooth.waves:
            return False
        return smooth.fit.n_stored_points <= other.fit.n_stored_points + len(other.fit.corners)
