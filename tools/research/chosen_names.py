# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Options that choose some of what there is."""

import argparse


def names_of(what, known):
    """Returns a type for argparse: NAME,... to a list, '' to none; other names than the known ones are refused."""

    def parsed(text):
        names = text.split(",") if text else []
        unknown = [name for name in names if name not in known]
        if unknown:
            raise argparse.ArgumentTypeError(f"there is no {what} {unknown[0]}")
        return names

    return parsed
