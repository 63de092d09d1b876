"""The promise of a fit, from outside."""

from benchmarks.outside_metric import two_sided

from shapespline import Status


def checked(fit, tolerance):
    """Assert the promise from outside: with scipy's evaluation and a sampler of its own."""
    contour = fit.contour
    found = two_sided(fit.curve, contour.points, closed=contour.closed, step=tolerance / 10)
    # The certified distance may fall short of a sampled one by rounding alone.
    assert found.larger <= fit.hausdorff_distance + 1e-9 * contour.box_diagonal
    assert fit.status == Status.KEPT
    assert fit.kept
    assert fit.hausdorff_distance <= tolerance == fit.tolerance
    return fit
