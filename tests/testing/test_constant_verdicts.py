"""A check whose verdict is the same for every machine is noted."""

from __future__ import annotations

from diecut_report.testing.contract import constant
from diecut_report.testing.machines import MachineCase
from tests.declaration.test_faults import check, made


def test_a_check_that_no_machine_fails_is_noted_and_one_that_some_fail_is_not() -> None:
    sound = made(
        checks=(
            check(limit=0.06),
            check(id="never", limit=1e9),
            check(id="always", limit=0.0),
            check(id="assumed", limit=1e9, presumed=True),
        )
    )
    found = dict(constant(MachineCase(sound, {"force": 5.0, "arm": 0.01, "mode": "near", "n_points": 36}), 80, 1))
    assert set(found) == {"never", "always"}
    assert "holds in all of 80" in found["never"] and "fails in all of 80" in found["always"]
