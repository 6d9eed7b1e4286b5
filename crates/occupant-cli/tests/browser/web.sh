#!/usr/bin/env bash
# Opens the page that simulates in headless Chromium and holds it to the command. Wants chromium, node and npm.
#
#   crates/occupant-cli/tests/browser/web.sh target/release/occupant target/occupant.html [folder for screenshots]
set -euo pipefail
occupant=$(realpath "$1")
page=$(realpath "$2")
pictures=${3:+$(realpath -m "$3")}
cd "$(dirname "$0")"
[ -d node_modules/playwright-core ] || npm ci --no-audit --no-fund --silent
node web.test.mjs "$occupant" "$page" ${pictures:+"$pictures"}
