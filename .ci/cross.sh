# Sourced: how to build for another platform. `cross TARGET` sets `cargo` (a command with its options) and the environment for
# linking and running; it fails, with a word, where no compiler or no runner for that target is installed.
#
# A toolchain of rustup with the target added is used first; else one of the system whose standard library is there as source
# (Debian: rustc-web, cargo-web, rust-web-src, with lld-19 for wasm32, mingw-w64 and wine for Windows, gcc-aarch64-linux-gnu and
# qemu-user for ARM).

cross() {
  local target=$1 upper
  upper=$(printf %s "$1" | tr a-z- A-Z_)
  if [ "$target" = "$(rustc -vV | sed -n 's/^host: //p')" ]; then
    cargo=(cargo)
    return
  fi
  runner=
  case "$target" in
    x86_64-pc-windows-gnu) linker=x86_64-w64-mingw32-gcc runner=wine ;;
    aarch64-unknown-linux-gnu) linker=aarch64-linux-gnu-gcc runner='qemu-aarch64 -L /usr/aarch64-linux-gnu' ;;
    wasm32-unknown-unknown) linker=wasm-ld-19 ;;
    *) echo "left out: nothing is known of $target"; return 1 ;;
  esac
  if rustup target list --installed 2>/dev/null | grep -qx "$target"; then
    cargo=(cargo)
    [ "$target" != wasm32-unknown-unknown ] || linker=
  elif [ -d /usr/lib/rustlib/src/rust/library ] && [ -x /usr/bin/cargo ]; then
    local panic=panic_unwind
    [ "$target" != wasm32-unknown-unknown ] || panic=panic_abort
    export RUSTC=/usr/bin/rustc RUSTDOC=/usr/bin/rustdoc RUSTC_BOOTSTRAP=1
    cargo=(/usr/bin/cargo -Z "build-std=std,$panic")
  else
    echo "left out: no compiler for $target"
    return 1
  fi
  for tool in "$linker" "${runner%% *}"; do
    [ -z "$tool" ] || command -v "$tool" >/dev/null || { echo "left out: no $tool"; return 1; }
  done
  [ -z "$linker" ] || export "CARGO_TARGET_${upper}_LINKER=$linker"
  [ -z "$runner" ] || export "CARGO_TARGET_${upper}_RUNNER=$runner"
  export CC_aarch64_unknown_linux_gnu=aarch64-linux-gnu-gcc CC_x86_64_pc_windows_gnu=x86_64-w64-mingw32-gcc
  [ "$runner" != wine ] || prepare_wine
}

# a system for Wine in the target folder, with what it may lack
prepare_wine() {
  export WINEDEBUG=${WINEDEBUG:--all} WINEPREFIX=${WINEPREFIX:-${CARGO_TARGET_DIR:-$PWD/target}/wine}
  local system=$WINEPREFIX/drive_c/windows/system32
  [ -d "$system" ] || { mkdir -p "$WINEPREFIX" && wineboot --init >/dev/null 2>&1; }
  [ -e "$system/bcryptprimitives.dll" ] ||
    x86_64-w64-mingw32-gcc -shared -O1 -s -o "$system/bcryptprimitives.dll" .ci/bcryptprimitives.c -ladvapi32
}
