#!/bin/sh
# Makes the pictures of the README from the examples: docs/pictures/*.png. Needs .venv (./make-report sets it up), chromium
# (CHROMIUM names its program) and pdftoppm; takes some two minutes.
set -eu

cd "$(dirname -- "$0")/.."
program=.venv/bin/diecut-report
browser=${CHROMIUM:-chromium}
pictures=docs/pictures
made=$(mktemp -d)
trap 'kill "${server:-}" 2>/dev/null || true; rm -rf "$made"' EXIT
mkdir -p "$pictures"

picture() { # NAME ADDRESS WIDTH HEIGHT
    "$browser" --headless --no-sandbox --hide-scrollbars --user-data-dir="$made/browser" --window-size="$3,$4" \
        --timeout=8000 --screenshot="$pictures/$1.png" "$2" 2>/dev/null
}

sheet() { # NAME TEXT: the sheet of the report on which a text stands first
    page=$(pdftotext "$made/press.pdf" - | awk -v text="$2" 'BEGIN { RS = "\f" } index($0, text) { print NR; exit }')
    pdftoppm -r 72 -png -singlefile -f "$page" -l "$page" "$made/press.pdf" "$pictures/$1"
}

cp configs/flat_cylinder_press.yaml "$made/press.yaml"
"$program" report "$made/press.yaml" --format pdf -o "$made" || [ $? -eq 1 ]
sheet sheet 'Connecting rod'
sheet cyclogram 'Cyclogram of the press'

"$program" check configs/flat_cylinder_press.yaml configs/flat_cylinder_press_mended.yaml configs/flat_cylinder_belt_press.yaml \
    -o "$made/machines" || [ $? -eq 1 ]
picture comparison "file://$(ls "$made"/machines/*.html)" 1100 760

"$program" live configs/circular_knife.yaml --no-open >"$made/live" &
server=$!
for _ in 1 2 3 4 5 6 7 8 9 10; do grep -q http "$made/live" && break; sleep 1; done
picture live "$(grep -o 'http[^ ]*' "$made/live")" 1100 760
