#!/bin/sh
# Makes the pictures of the README from the examples: docs/pictures/*.png. Needs .venv (./make-report sets it up), chromium
# (CHROMIUM names its program) and pdftoppm; takes some two minutes.
set -eu

cd "$(dirname -- "$0")/.."
program=.venv/bin/diecut-report
browser=${CHROMIUM:-chromium}
pictures=docs/pictures
made=$(mktemp -d)
trap 'rm -rf "$made"' EXIT
mkdir -p "$pictures"

sheet() { # NAME TEXT: the sheet of the report on which a text stands first
    page=$(pdftotext "$made/flat_cylinder_press.pdf" - | awk -v text="$2" 'BEGIN { RS = "\f" } index($0, text) { print NR; exit }')
    pdftoppm -r 64 -png -singlefile -f "$page" -l "$page" "$made/flat_cylinder_press.pdf" "$pictures/$1"
}

"$program" report configs/flat_cylinder_press.yaml --format pdf -o "$made" || [ $? -eq 1 ]
sheet verdict 'Contents'
sheet sheet '(B.28)'
sheet cyclogram 'Figure C.1 Cyclogram'

"$program" compare configs/flat_cylinder_press.yaml configs/flat_cylinder_press_mended.yaml configs/flat_cylinder_belt_press.yaml \
    -o "$made" --format html || [ $? -eq 1 ]
"$browser" --headless --no-sandbox --hide-scrollbars --user-data-dir="$made/browser" --window-size=1000,760 \
    --screenshot="$pictures/comparison.png" "file://$made/comparison.html" 2>/dev/null
