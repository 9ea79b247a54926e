# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Checks that every datagram is accounted for: each one sent is received or dropped by the kernel,
and each one received is decoded or counted by its cause."""

from __future__ import annotations

from .report import Report


def judge_accounting(report: Report, of: str, summary: dict, sent: int) -> None:
    received = summary["datagrams"]["received"]
    judge_sum(report, of + "datagrams sent", sent,
              {"received": received, "dropped by the kernel": summary["losses"]["kernel_drops"]})  # fmt: skip
    judge_sum(report, of + "datagrams received", received,
              summary["datagrams"]["outcomes"] | {"in doubt": summary["datagrams"]["in_doubt"]})  # fmt: skip


def judge_sum(report: Report, point: str, whole: int, terms: dict[str, int]) -> None:
    parts = " + ".join(f"{name} {count}" for name, count in terms.items() if count) or "0"
    total = sum(terms.values())
    report.check(f"{point} = {parts}", whole == total, whole if whole == total else f"{whole}, accounted for {total}")
