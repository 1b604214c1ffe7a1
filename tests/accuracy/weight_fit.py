# SPDX-License-Identifier: GPL-3.0-or-later
"""Weights of a sum of evidences fitted to the truth, and how they do on what they were not fitted to.

The truth of a cell is the share of its volume that is empty. A building is (terms, volume, empty): a row of terms per cell, its volume
and the part of that which is empty. Cells count by their volume, every building counts the same: a large one must not outvote the others.
"""
import numpy

RIDGE = 1e-4  # pull of every weight towards 0: enough for those that the data leave open, no more
TOLERANCE = 1e-9
STEPS = 200


class NotConverged(Exception):
    """The fit did not come to an end: a bug."""


def joined(parts):
    """One building out of several scans of it."""
    return tuple(numpy.concatenate(column) for column in zip(*parts))


def pooled(buildings):
    """Terms, share of the truth and weight of all cells; the weights of each building add up to one over their number."""
    buildings = list(buildings)
    terms = numpy.concatenate([terms for terms, _, _ in buildings])
    share = numpy.concatenate([empty / numpy.where(volume > 0, volume, 1) for _, volume, empty in buildings])
    weight = numpy.concatenate([volume / volume.sum() / len(buildings) for _, volume, _ in buildings])
    return terms, share, weight


def fit(buildings, low, high, ridge=RIDGE):
    """Weights within [low, high] with the smallest mean log-loss (projected Newton steps). The first term is the constant."""
    terms, share, weight = pooled(buildings)
    pull = numpy.full(terms.shape[1], ridge)
    pull[0] = 0.01 * ridge  # only lest it run away where all is empty or all solid

    def cost(theta):
        odds = terms @ theta
        return weight @ (numpy.logaddexp(0, odds) - share * odds) + 0.5 * pull @ theta**2

    theta = numpy.clip(numpy.zeros(terms.shape[1]), low, high)
    for _ in range(STEPS):
        beta = 0.5 * (1 + numpy.tanh(0.5 * (terms @ theta)))
        slope = terms.T @ (weight * (beta - share)) + pull * theta
        if numpy.abs(theta - numpy.clip(theta - slope, low, high)).max() < TOLERANCE:
            return theta
        free = ~(((theta <= low) & (slope > 0)) | ((theta >= high) & (slope < 0)))
        curvature = (terms[:, free].T * (weight * beta * (1 - beta))) @ terms[:, free] + numpy.diag(pull[free])
        step = numpy.zeros(len(theta))
        step[free] = numpy.linalg.solve(curvature, slope[free])
        theta = descend(cost, theta, step, slope, low, high)
    raise NotConverged(f"slope {slope} after {STEPS} steps")


def descend(cost, theta, step, slope, low, high):
    """The first of the step, half of it, … that lowers the cost enough."""
    now = cost(theta)
    for halvings in range(40):
        moved = numpy.clip(theta - 0.5**halvings * step, low, high)
        if cost(moved) <= now - 1e-4 * slope @ (theta - moved) + 1e-16:
            return moved
    return theta


def signs(weights):
    """Bounds of a fit in which every weight but the constant keeps its sign: what speaks for empty never speaks against it."""
    low = numpy.where(weights > 0, 0.0, -numpy.inf)
    high = numpy.where(weights > 0, numpy.inf, 0.0)
    low[0], high[0] = -numpy.inf, numpy.inf
    return low, high


def score(building, theta):
    """`wrong`: share of the volume on which the sign of the sum is wrong; `log_loss`: mean over the volume."""
    terms, volume, empty = building
    odds = terms @ theta
    wrong = numpy.where(odds > 0, volume - empty, empty)
    loss = volume * numpy.logaddexp(0, odds) - empty * odds
    return {"wrong": float(wrong.sum() / volume.sum()), "log_loss": float(loss.sum() / volume.sum())}


def bound(building):
    """What no weights can better: the share of the volume that is wrong with the truth's own label on every cell."""
    _, volume, empty = building
    return float(numpy.minimum(empty, volume - empty).sum() / volume.sum())


def leave_out(buildings, shipped):
    """For each of the named buildings: the scores of the shipped weights, of those fitted without it and of those fitted with all;
    and the weights fitted with all."""
    low, high = signs(shipped)
    fitted = fit(buildings.values(), low, high)
    rows = []
    for name, building in buildings.items():
        without = fit([other for key, other in buildings.items() if key != name], low, high)
        rows.append({"name": name, "cells": len(building[1]), "volume_m3": float(building[1].sum()), "bound": bound(building),
                     "shipped": score(building, shipped), "without": score(building, without), "all": score(building, fitted),
                     "weights": without})
    return rows, fitted
