#!/bin/sh
# Tries the HTML report, the live page and the documentation site in headless Chromium: what a reader does with them, and axe-core
# on them (tests/browser).
#
#   scripts/browser.sh [CONFIG…]   of these configurations, by default of benchmarks/two_mechanisms.yaml and two examples
#
# Needs .venv (./run-tests sets it up), chromium (CHROMIUM names its program), npm and the network: Playwright, which drives
# it, and axe-core are no part of the program, and are put into .browser at the versions below.
set -eu

cd "$(dirname -- "$0")/.."
playwright=1.65.2
axe=4.14.1
axe_sha256=29348999450cdf2849a8e70b7912fc2da85a849da39c0d0d5394f51d4a9ed95c

mkdir -p .browser
[ -d ".browser/playwright-$playwright" ] ||
    .venv/bin/python -m pip install -q --target ".browser/playwright-$playwright" "playwright==$playwright"
if [ ! -f ".browser/axe-core-$axe.tgz" ]; then
    (cd .browser && npm pack --silent "axe-core@$axe" >/dev/null)
fi
tar -xzf ".browser/axe-core-$axe.tgz" -C .browser package/axe.min.js
echo "$axe_sha256  .browser/package/axe.min.js" | sha256sum --check --quiet

scripts/site.sh --quick
BROWSER_CONFIGS="$*" AXE=.browser/package/axe.min.js PYTHONPATH=.browser/playwright-$playwright \
    .venv/bin/python -m pytest -q -n 0 tests/browser/page_checks.py tests/browser/live_checks.py tests/browser/site_checks.py
