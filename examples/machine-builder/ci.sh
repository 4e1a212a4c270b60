#!/bin/sh
# Checks all machines of this repository, and makes their reports.
#
#   ./ci.sh                    all steps, to the end
#   ./ci.sh check              this step alone: tests, check, changes or reports
#
# Ends with the worst of: 0 all is well, 1 a check of a machine or a test fails, 2 a file is wrong, 3 a plugin breaks.
set -eu

cd "$(dirname -- "$0")"
out=${OUT:-build}

# The tests of our own plugins.
tests() {
    python -m pytest -q -p no:cacheprovider tests
}

# All machines side by side: a table of verdicts, as a page for people and as data.
check() {
    diecut-report check configs/*.yaml --plugins plugins -o "$out/check" --format html,json
}

# What changed against the results that were released last. That a check fails (1) is told by "check", and is no fault here.
changes() {
    mkdir -p "$out/changes"
    for released in released/*.json; do
        [ -e "$released" ] || continue
        name=$(basename "$released" .json)
        code=0
        diecut-report diff "$released" "configs/$name.yaml" --plugins plugins >"$out/changes/$name.txt" || code=$?
        [ "$code" -le 1 ] || exit "$code"
        printf -- '-- %s\n' "$name"
        cat "$out/changes/$name.txt"
    done
}

# The reports. Those of machines that were released before tell what changed since; those of failing ones say NOT RELEASED.
reports() {
    mkdir -p "$out/reports"
    git rev-parse HEAD >"$out/reports/commit.txt"
    for config in configs/*.yaml; do
        name=$(basename "$config" .yaml)
        set -- report "$config" --plugins plugins -o "$out/reports" --quiet
        [ ! -e "released/$name.json" ] || set -- "$@" --previous "released/$name.json"
        code=0
        diecut-report "$@" || code=$?
        [ "$code" -le 1 ] || exit "$code"
    done
}

mkdir -p "$out"
if [ "$#" -gt 0 ]; then
    printf '== %s ==\n' "$1"
    "$1"
    exit
fi
worst=0
for step in tests check changes reports; do
    code=0
    ./ci.sh "$step" || code=$?
    [ "$code" -le "$worst" ] || worst=$code
done
exit "$worst"
