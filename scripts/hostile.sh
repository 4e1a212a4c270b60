#!/bin/sh
# Runs all that a stranger may hand over, in full: hostile files and texts, what the fuzzer kept, damaged studies, runs that are
# killed, and every single extreme value of every input. CI runs a quick part of it (all but the tests marked "nightly").
# The 2000 random machines of each example, which take hours, are for scripts/nightly.sh.
# Takes up to 20 minutes on two cores; JOBS sets the processes. Needs .venv (./run-tests sets it up); the arguments are those of pytest.
set -eu

cd "$(dirname -- "$0")/.."
exec .venv/bin/python -m pytest -n "${JOBS:-2}" --dist worksteal -m "" -k "not no_machine_is_left_unproved" tests/hostile tests/extremes \
    tests/cli/test_faults.py tests/config/test_limits.py tests/quantities/test_plausible.py \
    tests/study/test_damaged_store.py tests/study/test_interrupted.py "$@"
