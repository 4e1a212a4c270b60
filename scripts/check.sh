#!/bin/sh
# Checks style and types with the tools of .venv (./run-tests sets it up).
#
#   scripts/check.sh [FILE…]   ruff and its formatter on the given files, by default on all; mypy on everything
set -eu

cd "$(dirname -- "$0")/.."
tools=$PWD/.venv/bin

"$tools/ruff" check "$@"
"$tools/ruff" format --check "$@"

# mypy does not follow the mapping of plugins/, templates/ and configs/ into the package (pyproject.toml, package-dir):
# it gets the package as it is installed, made of links.
types=build/types/diecut_report
rm -rf "$types"
mkdir -p "$types"
for entry in diecut_report/*; do
    ln -s "$PWD/$entry" "$types/"
done
ln -s "$PWD/plugins" "$PWD/templates" "$PWD/configs" "$types/"
ln -sfn "$PWD/tools" build/types/tools
ln -sfn "$PWD/examples" build/types/examples # of which the script is a user's, who knows the package by its types alone
"$tools/mypy" --strict -p diecut_report -p tools -m examples.press_script
