#!/bin/sh
# Sets up whatever is missing: system libraries, the virtual environment .venv, the locked dependencies, the program.
#
#   scripts/setup.sh [report|tests]
#
# "report" is what a report needs, "tests" also what the tests and the checks need.
# Exit codes: 0 all is there; 2 something is missing that could not be installed, said in words.
# PYTHON names the interpreter to make the environment with (default: the first python3 that is new enough).
set -eu

purpose=${1:-report}
root=$(CDPATH='' cd -- "$(dirname -- "$0")/.." && pwd -P)
venv=$root/.venv

say() { printf 'set-up: %s\n' "$*" >&2; }

stop() {
    say "$*"
    exit 2
}

# --- Python -------------------------------------------------------------------------------------

# Prints the path of a new enough interpreter. It is the real file: after an upgrade of the system's
# Python the environment then points nowhere and is made anew, and not run with another version.
find_python() {
    for candidate in ${PYTHON:+"$PYTHON"} python3 python3.14 python3.13 python3.12 python3.11; do
        if "$candidate" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
            "$candidate" -c 'import os, sys; print(os.path.realpath(sys.executable))'
            return
        fi
        [ -z "${PYTHON:-}" ] || break # one that was asked for is not replaced by another
    done
    stop "Python 3.11 or newer is needed; ${PYTHON:-python3} says: $("${PYTHON:-python3}" --version 2>&1). Install a newer one, or name it: PYTHON=/path/to/python3"
}

# --- Debian packages ----------------------------------------------------------------------------

# Prints the packages that are missing, judged by whether the thing itself works, wherever it is from.
missing_packages() {
    "$python" - "$purpose" <<'PROBE'
import ctypes
import shutil
import sys

LIBRARIES = {  # what WeasyPrint loads
    "libpango-1.0-0": ("libpango-1.0.so.0", "libgobject-2.0.so.0", "libharfbuzz.so.0"),
    "libpangoft2-1.0-0": ("libpangoft2-1.0.so.0", "libfontconfig.so.1"),
    "libharfbuzz-subset0": ("libharfbuzz-subset.so.0",),
}
PROGRAMS = {"report": {}, "tests": {"poppler-utils": "pdftotext", "qpdf": "qpdf"}}


def loads(library):
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


missing = [package for package, libraries in LIBRARIES.items() if not all(map(loads, libraries))]
missing += [package for package, program in PROGRAMS[sys.argv[1]].items() if not shutil.which(program)]
try:
    import ensurepip, venv
except ImportError:
    missing.append("python{}.{}-venv".format(*sys.version_info))
print(*missing)
PROBE
}

# Prints what to put before a command so that it runs as root without a question; fails where nothing does.
root_prefix() {
    if [ "$(id -u)" = 0 ]; then
        echo env
    elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
        echo sudo -n env
    else
        return 1
    fi
}

install_packages() {
    command -v apt-get >/dev/null ||
        stop "missing (by their Debian names): $*. Install them with this system's package manager, then run this again."
    as_root=$(root_prefix) ||
        stop "missing: $*. Nothing was changed. Install them as root, then run this again:
    apt-get update && apt-get install -y --no-install-recommends $*"
    say "installing the Debian packages $*"
    $as_root apt-get -qq update >&2 </dev/null || say "the package lists could not be refreshed; going on with those there are"
    log=$($as_root DEBIAN_FRONTEND=noninteractive apt-get -qq -y --no-install-recommends install "$@" 2>&1 </dev/null) ||
        stop "apt-get could not install $*:
$log"
    left=$(missing_packages)
    [ -z "$left" ] || stop "still missing after the installation: $left."
}

# --- the virtual environment --------------------------------------------------------------------

# A stamp tells what a part was made from. It is written last, so an interrupted set-up leaves none.
stamp() {
    case $1 in
    report) set -- requirements.lock ;;
    tests) set -- requirements.lock requirements-dev.lock ;;
    program) set -- pyproject.toml ;;
    esac
    echo "$venv"
    (cd "$root" && sha256sum "$@")
}

is_current() { [ -x "$venv/bin/python" ] && [ "$(cat "$venv/$1.stamp" 2>/dev/null)" = "$(stamp "$1")" ]; }

# Python compiles a module when it is first imported: compiling all that is installed would take as long as the rest.
# Nothing is resolved either: a lock holds all that is needed.
pip_install() {
    "$venv/bin/python" -m pip --disable-pip-version-check --no-input install -qq --no-compile --no-deps "$@" >&2 </dev/null ||
        stop "pip could not install (its message is above). The first set-up needs the network; run this again, it begins anew."
}

install_dependencies() {
    if ! is_current report; then
        say "making .venv with $("$python" --version)"
        "$python" -m venv --clear "$venv" >&2 || stop "the virtual environment could not be made (the message is above)."
    fi
    say "installing the Python packages; this takes a minute"
    pip_install --require-hashes --only-binary :all: -r "$root/$1"
    stamp report >"$venv/report.stamp"
}

install_program() {
    say "installing the program"
    pip_install --no-build-isolation -e "$root"
    stamp program >"$venv/program.stamp"
}

case $purpose in
report) lock=requirements.lock ;;
tests) lock=requirements-dev.lock ;;
*) stop "unknown purpose \"$purpose\": give report or tests." ;;
esac

if is_current "$purpose"; then
    python=$venv/bin/python
else
    python=$(find_python) || exit
fi
missing=$(missing_packages)
# shellcheck disable=SC2086 # names of packages, one word each
[ -z "$missing" ] || install_packages $missing
if ! is_current "$purpose"; then
    install_dependencies "$lock"
    stamp "$purpose" >"$venv/$purpose.stamp"
fi
# a copy that pip put beside the checkout ("pip install .") would hide it
program_works() { (cd "$root" && "$venv/bin/python" -c 'import diecut_report.plugins' 2>/dev/null); }

if ! is_current program || ! program_works; then install_program; fi
