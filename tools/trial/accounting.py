# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The terracut authors
"""Where every datagram went: what is sent is received or dropped by the kernel, what is received is taken in or counted
by why not, what is taken in is decoded or rejected by cause. To the last one."""

from __future__ import annotations

from .report import Report

# Of the losses: datagrams that were received and not taken in.
NOT_TAKEN_IN = ["foreign_datagrams", "other_interface_datagrams", "overlong_datagrams"]


def judge_accounting(report: Report, of: str, summary: dict, sent: int) -> None:
    losses, taken_in = summary["losses"], summary["link"]["packets"]
    terms = {"taken in": taken_in, **{name: losses[name] for name in NOT_TAKEN_IN}, "kernel_drops": losses["kernel_drops"]}
    judge_sum(report, of + "datagrams sent", sent, terms)


def judge_sum(report: Report, point: str, whole: int, terms: dict[str, int]) -> None:
    parts = " + ".join(f"{name} {count}" for name, count in terms.items() if count) or "0"
    total = sum(terms.values())
    report.check(f"{point} = {parts}", whole == total, whole if whole == total else f"{whole}, accounted for {total}")
