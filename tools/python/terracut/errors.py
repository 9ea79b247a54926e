# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""The exceptions and warnings of terracut, with the program's messages."""

import logging
import warnings

_log = logging.getLogger("terracut")


class Error(Exception):
    """A failure; `code` distinguishes cases: "not_found", "malformed", "invalid_argument", ..."""

    def __init__(self, code: str, message: str):
        super().__init__(message)
        self.code = code

    def __reduce__(self):
        return type(self), (self.code, str(self))


class InvalidArgument(Error, ValueError):
    """Raised for a setting that does not exist or is out of its range."""


class NotFound(Error, FileNotFoundError):
    """Raised if a named file, folder or stream does not exist."""

    def __str__(self) -> str:
        return self.args[0]


class TerracutWarning(UserWarning):
    """A warning of the program: a table of another unit, a guessed mount, a capture that breaks off."""


def of(code: str, message: str) -> Error:
    code = code.replace(" ", "_")
    kind = {"invalid_argument": InvalidArgument, "not_found": NotFound}.get(code, Error)
    return kind(code, message)


def say(line: str) -> None:
    _log.info(line)


def warn(line: str) -> None:
    warnings.warn(line, TerracutWarning, stacklevel=2)
