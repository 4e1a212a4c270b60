#!/usr/bin/env bash
# Tries both commands of the README on bare Debian systems: ./make-report, then ./run-tests, in a fresh clone of the last commit.
#
#   scripts/debian.sh [SUITE…]   by default bookworm (12), trixie (13) and testing
#
# Each system is built by debootstrap with nothing but Python, git and certificates, and removed afterwards; KEEP=1 keeps it, with its log, to look
# into. Root only. The mirror is the one that this machine's apt uses (MIRROR names another); its certificates and the configuration of pip are
# taken over.
# Takes some ten minutes and 3 GB for each system.
set -euo pipefail
exec </dev/null

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)

stop() { printf 'debian.sh: %s\n' "$*" >&2; exit 2; }

[ "$(id -u)" = 0 ] || stop "only root may build a system"
command -v debootstrap >/dev/null || stop "debootstrap is missing: apt-get update && apt-get install -y debootstrap"
targets() { apt-get indextargets --format "\$(REPO_URI)" "Identifier: Packages" "Origin: Debian" "$@"; }
mirror=${MIRROR:-$(targets | head -n 1)}
[ -n "$mirror" ] || stop "this machine's apt knows no mirror of Debian: give MIRROR=…"

work=$(mktemp -d "${TMPDIR:-/var/tmp}/debian.XXXXXX")
remove() { if [ -n "${KEEP:-}" ]; then printf 'kept: %s\n' "$1"; else rm -rf --one-file-system "$1"; fi; }
trap 'remove "$work"' EXIT

# Copies a file or folder of this machine to the same place in the system, where there is one.
take_over() {
    [ -e "$1" ] || return 0
    mkdir -p "$system$(dirname -- "$1")"
    cp -RL "$1" "$system$(dirname -- "$1")"
}

build() {
    debootstrap --variant=minbase --include=ca-certificates,git,python3 "$suite" "$system" "$mirror" ||
        { tail -n 5 "$system/debootstrap/debootstrap.log"; return 1; }
    take_over /etc/resolv.conf
    take_over /etc/ssl/certs/ca-certificates.crt
    take_over /etc/pip.conf
    for folder in .pip .config/pip; do
        [ ! -d "$HOME/$folder" ] || { mkdir -p "$system/root/$folder" && cp -RL "$HOME/$folder/." "$system/root/$folder"; }
    done
    git clone -q "$root" "$system/root/diecut-report"
}

# Runs a command in the clone. Mounts and processes live in namespaces of their own, so that none outlives the command.
inside() {
    local variables
    mapfile -t variables < <(env | grep -E '^(PIP_|SSL_CERT_|[a-z]*_proxy=)' || true)
    # shellcheck disable=SC2016 # the inner shell expands these
    unshare --mount --pid --fork sh -c '
        mount -t proc proc "$1/proc" && mount --rbind /dev "$1/dev" && mount -t tmpfs tmpfs "$1/tmp" || exit
        system=$1; shift
        exec chroot "$system" env -i "$@"' sh "$system" HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
        "${variables[@]}" sh -c "cd /root/diecut-report && $1"
}

try_system() {
    local suite=$1 system=$work/$1 failed=0
    build >"$system.log" 2>&1 || { cat "$system.log"; return 1; }
    printf '\n== %s: Debian %s, %s ==\n' "$suite" "$(cat "$system/etc/debian_version")" "$(inside 'python3 --version')"
    for command in ./make-report ./run-tests; do
        printf '%s … ' "$command"
        if inside "$command" >"$system.log" 2>&1; then
            tail -n 1 "$system.log"
        else
            printf 'FAILED\n' && tail -n 60 "$system.log" && failed=1 && break
        fi
    done
    remove "$system"
    return "$failed"
}

[ $# -gt 0 ] || set -- bookworm trixie testing
status=0
for suite in "$@"; do try_system "$suite" || status=1; done
exit "$status"
