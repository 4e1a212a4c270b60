#!/bin/sh
# Renews requirements.lock (what a report needs), requirements-dev.lock (that, and what the tests need) and
# requirements-cluster.lock (what a report needs, and what a cluster needs).
#
#   scripts/renew-locks.sh [OPTIONS]   the options are those of pip-compile, such as --upgrade
#
# Runs with the oldest supported Python, so that every version in the locks exists for all supported ones.
# Local package folders and configuration of pip are switched off: a hash must be one that everybody gets.
set -eu

cd "$(dirname -- "$0")/.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"${PYTHON:-python3.11}" -m venv "$work/venv"
unset PIP_FIND_LINKS PIP_EXTRA_INDEX_URL PIP_INDEX_URL
export PIP_CONFIG_FILE=/dev/null CUSTOM_COMPILE_COMMAND=scripts/renew-locks.sh
"$work/venv/bin/python" -m pip install -q 'pip-tools==7.6.2'

compile() {
    "$work/venv/bin/pip-compile" --quiet --generate-hashes --allow-unsafe --strip-extras --no-emit-options \
        --no-emit-index-url --no-emit-trusted-host --no-emit-find-links "$@" pyproject.toml
}
compile --all-build-deps --output-file=requirements.lock "$@"
compile --all-build-deps --extra=dev --extra=cluster --constraint=requirements.lock --output-file=requirements-dev.lock "$@"
compile --extra=cluster --constraint=requirements-dev.lock --output-file=requirements-cluster.lock "$@"
