#!/bin/sh
# Runs what takes too long for every change: all tests with many examples of hypothesis, those marked "nightly" too,
# the benchmarks in one round, the whole documentation site, a mutation of each plugin and module of mechanics (scripts/change_signs.py),
# and the tests with each other interpreter that this machine has. Takes about an hour, and a quarter for each interpreter. Needs .venv (./run-tests sets it up); the arguments are those of pytest.
set -eu

cd "$(dirname -- "$0")/.."
python=$PWD/.venv/bin/python

HYPOTHESIS_PROFILE=nightly "$python" -m pytest -n auto --maxprocesses 4 --dist worksteal -o faulthandler_timeout=7200 -m "" "$@"
for benchmark in calc report batch_kernel warm; do
    "$python" "benchmarks/$benchmark.py" 1
done
scripts/site.sh
"$python" scripts/change_signs.py --seed "$(date +%j)" --per-plugin 3

# In a clone of the last commit each: an environment belongs to one interpreter. Those of pyenv are not on the PATH.
clones=$(mktemp -d)
trap 'rm -rf "$clones"' EXIT
failed=""
version='import sys; print("{}.{}".format(*sys.version_info))'
tried=$("$python" -c "$version")
for other in python3.11 python3.12 python3.13 python3.14 "${PYENV_ROOT:-$HOME/.pyenv}"/versions/3.1[1-9].*/bin/python3; do
    found=$("$other" -c "$version" 2>/dev/null) || continue
    case " $tried " in *" $found "*) continue ;; esac
    tried="$tried $found"
    git clone -q . "$clones/$found"
    PYTHON=$other "$clones/$found/run-tests" || failed="$failed $found" # the others are tried all the same
done
[ -z "$failed" ] || { echo "nightly.sh: the tests fail with Python$failed" >&2; exit 1; }
