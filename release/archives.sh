#!/usr/bin/env bash
# Archives of the command for a release, one for each target that can be built here, into target/archives.
#
#   release/archives.sh              every target of the list below that this machine can build
#   release/archives.sh TARGET...    these, and it is a fault if one of them cannot be built
#
# An archive holds the command, the licences with those of its packages, README and CHANGELOG, manual pages and completions. The same
# commit gives the same archive, as far as the compiler gives the same command. SHA256SUMS has all of them.
set -euo pipefail
cd "$(dirname "$0")/.."

targets=(
    x86_64-unknown-linux-gnu
    x86_64-unknown-linux-musl
    aarch64-unknown-linux-gnu
    x86_64-apple-darwin
    aarch64-apple-darwin
    x86_64-pc-windows-msvc
    x86_64-pc-windows-gnu
)
wanted=("$@")
version=$(sed -n 's/^version = "\(.*\)"/\1/p' Cargo.toml | head -n 1)
host=$(rustc -vV | sed -n 's/^host: //p')
built="${CARGO_TARGET_DIR:-target}"
out="$built/archives"
# Files of an archive are as old as the commit.
time=$(git log -1 --format=%ct)

# What this machine lacks for a target, in words; nothing if it lacks nothing.
lacking() {
    local target=$1 compiler
    if [ ! -d "$(rustc --print target-libdir --target "$target")" ]; then
        echo "the standard library is not installed (rustup target add $target)"
        return
    fi
    # SQLite is written in C. What Rust calls unknown or pc, C compilers leave out.
    case $target in
        "$host") compiler=cc ;;
        *-linux-musl) compiler=musl-gcc ;;
        *-pc-windows-gnu) compiler=${target%%-*}-w64-mingw32-gcc ;;
        *-apple-darwin | *-windows-msvc) compiler= ;;
        *) compiler=${target/-unknown/}-gcc ;;
    esac
    case $target in
        *-apple-darwin) [ "$(uname)" = Darwin ] || echo "only macOS has its linker and libraries" ;;
        *-windows-msvc) case $host in *-windows-msvc) ;; *) echo "only Windows has its linker" ;; esac ;;
        *) command -v "$compiler" > /dev/null || echo "there is no C compiler for it ($compiler)" ;;
    esac
}

# The archive of a target that is built. Manual pages and completions are the same everywhere: the command of
# this machine writes them.
archive() {
    local target=$1 name="hammerbeam-$version-$1" suffix=
    case $target in *windows*) suffix=.exe ;; esac
    rm -rf "${out:?}/$name"
    mkdir -p "$out/$name/completions" "$out/$name/man"
    cp "$built/$target/release/hammerbeam$suffix" README.md CHANGELOG.md LICENSE-MIT LICENSE-APACHE THIRD-PARTY.txt "$out/$name"
    "$command" man --out "$out/$name/man" > /dev/null
    for shell in bash elvish fish powershell zsh; do
        "$command" completions "$shell" > "$out/$name/completions/hammerbeam.$shell"
    done
    tar --directory "$out" --sort=name --mtime="@$time" --owner=0 --group=0 --numeric-owner \
        --create --file - "$name" | gzip --no-name --best > "$out/$name.tar.gz"
    rm -r "${out:?}/$name"
}

mkdir -p "$out"
rm -f "$out"/*.tar.gz "$out/SHA256SUMS"
# The command that runs here, whatever is asked for.
cargo build --release --locked -p hammerbeam-cli --target "$host"
command="$built/$host/release/hammerbeam"

if [ ${#wanted[@]} -gt 0 ]; then targets=("${wanted[@]}"); fi
for target in "${targets[@]}"; do
    reason=$(lacking "$target")
    if [ -n "$reason" ]; then
        echo "not built: $target: $reason"
        [ ${#wanted[@]} -eq 0 ] || exit 1
        continue
    fi
    case $target in
        *-linux-musl) export CC_x86_64_unknown_linux_musl=musl-gcc ;;
        aarch64-unknown-linux-gnu) export CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc ;;
    esac
    cargo build --release --locked -p hammerbeam-cli --target "$target"
    archive "$target"
done
(cd "$out" && sha256sum ./*.tar.gz > SHA256SUMS)
cat "$out/SHA256SUMS"
