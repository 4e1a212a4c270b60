#!/bin/sh
# Runs what takes too long for every change: all tests with many examples of hypothesis, those marked "nightly" too,
# the benchmarks in one round, the whole documentation site, and a mutation of each plugin and module of mechanics (scripts/change_signs.py).
# Takes about an hour. Needs .venv (./run-tests sets it up); the arguments are those of pytest.
set -eu

cd "$(dirname -- "$0")/.."
python=$PWD/.venv/bin/python

HYPOTHESIS_PROFILE=nightly "$python" -m pytest -n auto --maxprocesses 4 --dist worksteal -o faulthandler_timeout=7200 -m "" "$@"
for benchmark in calc report batch_kernel warm; do
    "$python" "benchmarks/$benchmark.py" 1
done
scripts/site.sh
"$python" scripts/change_signs.py --seed "$(date +%j)" --per-plugin 3
