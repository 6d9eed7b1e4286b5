#!/usr/bin/env bash
# Builds the page: one HTML file that simulates in a browser. Wants a toolchain for wasm32-unknown-unknown, Node.js with npm,
# gzip and base64.
#
#   crates/occupant-web/build.sh target/occupant.html
set -euo pipefail
page=$(realpath -m "${1:-target/occupant.html}")
cd "$(dirname "$0")/../.."
viewer=$PWD/crates/occupant-jobs/assets/viewer
own=$PWD/crates/occupant-web/assets/src
target=wasm32-unknown-unknown
out=${WASM_TARGET_DIR:-$PWD/target/wasm}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

. .ci/cross.sh
cross "$target"
# vectors of two numbers, which browsers have had since 2023. A study's kernels in lanes are not called: compiled for size
export CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS='-C target-feature=+simd128'
# a crate type of the command line, so that the workspace links no library; the stack is that of a main thread
CARGO_TARGET_DIR=$out "${cargo[@]}" rustc --release --locked --config 'profile.release.package.occupant-study.opt-level="s"' \
  --target "$target" --package occupant-web --lib --crate-type cdylib -- -C link-arg=-zstack-size=8388608

[ -d "$viewer/node_modules/esbuild" ] || (cd "$viewer" && npm ci --no-audit --no-fund --silent)
bundle=(npx --prefix "$viewer" esbuild --bundle --minify --target=es2022 --charset=utf8 --legal-comments=inline)
"${bundle[@]}" --format=iife "$own/main.js" --outfile="$work/page.js"
"${bundle[@]}" "$own/style.css" --outfile="$work/page.css"
gzip -9 --no-name --stdout "$out/$target/release/occupant_web.wasm" | base64 -w 0 >"$work/module"

node "$own/../assemble.mjs" "$own/page.html" "$page" "style=$work/page.css" "licenses=$viewer/LICENSES.md" "module=$work/module" \
  "script=$work/page.js"
printf '%s: %s bytes, %s gzipped\n' "$page" "$(stat -c %s "$page")" "$(gzip -9 --stdout "$page" | wc -c)"
