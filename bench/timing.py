# SPDX-License-Identifier: MIT
"""Medians with their spread. Never the best of several."""
import math
import statistics


def summary(values):
    """The median and the quartiles: of fewer than three values, the least and the greatest in place of the
    quartiles."""
    if len(values) < 3:
        return {"median": statistics.median(values), "quartiles": [min(values), max(values)], "runs": len(values)}
    lower, middle, upper = statistics.quantiles(values, n=4, method="inclusive")
    return {"median": middle, "quartiles": [lower, upper], "runs": len(values)}


def fitted_exponent(sizes, costs):
    """The slope of the line that fits the points best in log-log scale."""
    return statistics.linear_regression([math.log(size) for size in sizes], [math.log(cost) for cost in costs]).slope
