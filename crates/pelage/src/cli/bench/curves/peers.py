"""Points a second of a cubic B-spline with derivatives, by Python packages, as JSON.

The curve and parameters are those of rates.rs: 200 control points, all over the curve in no
order. Packages that are missing are left out.
"""
import json
import time

import numpy

POINTS, COUNT, SECONDS = 200, 4000, 0.5
at = numpy.arange(POINTS) * 0.3
control = numpy.stack([numpy.cos(at), numpy.sin(at), at], axis=1)
inner = POINTS - 3
knots = numpy.concatenate([[0.0] * 3, numpy.linspace(0.0, 1.0, inner + 1), [1.0] * 3])
us = (numpy.arange(COUNT) * 7919 % COUNT) / COUNT


def rate(work, count):
    """Millions a second in the best of the runs that fit into SECONDS."""
    best, end = float("inf"), time.perf_counter() + SECONDS
    while time.perf_counter() < end:
        started = time.perf_counter()
        work()
        best = min(best, time.perf_counter() - started)
    return count / best / 1e6


def scipy_spline():
    from scipy.interpolate import BSpline

    value = BSpline(knots, control, 3)
    splines = [value] + [value.derivative(k) for k in (1, 2, 3)]
    return lambda: [spline(us) for spline in splines]


def splipy_curve():
    from splipy import BSplineBasis, Curve

    curve = Curve(BSplineBasis(4, knots), control)
    sorted_us = numpy.sort(us)
    return lambda: [curve.derivative(sorted_us, d=k) for k in (0, 1, 2, 3)]


def geomdl_curve():
    from geomdl import BSpline

    curve = BSpline.Curve()
    curve.degree = 3
    curve.ctrlpts = control.tolist()
    curve.knotvector = knots.tolist()
    some = us[:40].tolist()
    return lambda: [curve.derivatives(u, order=3) for u in some]


found = {}
for name, make, count in [
    ("scipy", scipy_spline, COUNT),
    ("splipy", splipy_curve, COUNT),
    ("geomdl", geomdl_curve, 40),
]:
    try:
        work = make()
    except ImportError:
        continue
    found[name] = rate(work, count)
print(json.dumps(found))
