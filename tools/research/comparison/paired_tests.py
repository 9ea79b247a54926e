# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Significance tests of paired differences."""

import warnings
from dataclasses import dataclass

import numpy
from scipy import stats

MOST_EXACT_PAIRS = 25
MOST_RESAMPLES = 2**16  # all sign patterns of up to 16 differences; for more, as many random ones


@dataclass(frozen=True)
class PairedTest:
    pairs: int
    greater: int  # differences above 0
    less: int
    mean: float
    p: float  # two-sided: probability of such a difference by chance


def test_of(differences, p):
    mean = float(numpy.mean(differences)) if len(differences) else 0.0
    return PairedTest(len(differences), int(sum(differences > 0)), int(sum(differences < 0)), mean, float(p))


def signed_rank_test(differences):
    """Wilcoxon's signed-rank test (1945): zeros are left out, ties share their mean rank. The distribution is exact for
    few pairs without ties, otherwise the normal approximation with correction for ties and continuity."""
    differences = numpy.asarray(differences, dtype=float)
    some = differences[differences != 0]
    if len(some) == 0:
        return test_of(differences, 1)
    exact = len(some) <= MOST_EXACT_PAIRS and len(numpy.unique(abs(some))) == len(some)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # with few pairs and ties SciPy warns that it approximates
        # Passed by position, because SciPy 1.9 renamed the last parameter.
        _, p = stats.wilcoxon(some, None, "wilcox", True, "two-sided", "exact" if exact else "approx")
    return test_of(differences, p)


def sign_flip_test(differences):
    """Sign-flip test of the mean (Fisher 1935): the share of sign patterns whose mean is at least
    as large."""
    differences = numpy.asarray(differences, dtype=float)
    tried = stats.permutation_test(
        (differences,), numpy.mean, permutation_type="samples", n_resamples=MOST_RESAMPLES, random_state=0
    )
    return test_of(differences, tried.pvalue)
