#!/usr/bin/env bash
# Makes reports of runs and of a study and opens them in headless Chromium. Wants chromium, node and npm; the program as first argument.
#
#   crates/occupant-cli/tests/browser/run.sh target/release/occupant [folder for screenshots]
set -euo pipefail
occupant=$(realpath "$1")
pictures=${2:+$(realpath -m "$2")}
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../../.." && pwd)
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

for case in cart-lap-torso cart-unbelted; do
  "$occupant" run "$root/tests/data/carts/$case.toml" --quiet --output "$out/$case.mcap"
done
"$occupant" report "$out/cart-lap-torso.mcap" --output "$out/report.html"
"$occupant" report "$out/cart-lap-torso.mcap" --verdict --output "$out/judged.html"
"$occupant" view "$out/cart-lap-torso.mcap" --output "$out/film.png" --3d >/dev/null
"$occupant" seal "$out/cart-lap-torso.mcap" --output "$out/sealed.html" --add "$out/film.png" >/dev/null
"$occupant" run "$root/tests/data/hand/side-by-side.toml" --quiet --output "$out/two.mcap" --set "time.end=80 ms"
"$occupant" report "$out/two.mcap" --output "$out/two.html"
"$occupant" run "$root/scenarios/pedestrian.toml" --quiet --output "$out/thrown.mcap"
"$occupant" report "$out/thrown.mcap" --output "$out/thrown.html"
"$occupant" run "$root/scenarios/head-on.toml" --quiet --output "$out/driven.mcap"
"$occupant" report "$out/driven.mcap" --output "$out/driven.html"
"$occupant" report "$out/cart-lap-torso.mcap" --against "$out/cart-unbelted.mcap" --output "$out/comparison.html"
study="$out/study"
"$occupant" sweep "$root/scenarios/studies/screening-morris.toml" --output "$study" --quiet
"$occupant" study report "$study" >/dev/null 2>&1
cp "$study/report.html" "$out/study.html"

cd "$here"
[ -d node_modules/playwright-core ] || npm ci --no-audit --no-fund --silent
node report.test.mjs "$out" ${pictures:+"$pictures"}
