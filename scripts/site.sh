#!/bin/sh
# Builds the documentation site: build/site/index.html, with which a browser needs no network.
#
#   scripts/site.sh [--quick]   --quick: with the reports of the small examples alone
#
# The pages are made from the documents, the plugins' declarations and the examples (tools/site), and set by Sphinx; a warning is
# an error, and so is a link within the site that leads nowhere. A few pages are opened in a headless browser, where one is installed. Needs .venv (./run-tests sets it up).
set -eu

cd "$(dirname -- "$0")/.."
python=$PWD/.venv/bin/python
unset PYTHONDONTWRITEBYTECODE

"$python" -m tools.site build/site-sources "$@"
rm -rf build/site
"$python" -m sphinx -q -W --keep-going -n -b html -d build/site-doctrees build/site-sources build/site
"$python" -m tools.site.built_links build/site
"$python" -m tools.site.look build/site
