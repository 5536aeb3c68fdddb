#!/usr/bin/env bash
# All tests of the Python package: builds the extension module, checks types and stubs, runs the tests, notebooks
# and snippets of the documentation among them. With `wheel` as its argument it builds the wheel instead.
#
# The extension is built as part of the workspace, with the features of its tests: what `cargo test --workspace`
# has compiled serves. Packages are installed once, into target/python-tools.
set -euo pipefail
cd "$(dirname "$0")/.."
target="${CARGO_TARGET_DIR:-target}"
tools="$target/python-tools"

skip() {
    echo "skipped: $1"
    [ "${HAMMERBEAM_REQUIRE_PYTHON:-0}" = 0 ]
    exit
}

if ! command -v python3 > /dev/null || ! python3 -c "import sys; assert sys.version_info >= (3, 11)" 2> /dev/null; then
    skip "the Python package needs Python 3.11 or later"
fi
# Each list that is installed whole leaves a copy behind: what is missing is tried again by the next call.
if ! cmp -s python/requirements.txt "$tools/requirements.txt"; then
    rm -rf "$tools"
    python3 -m venv "$tools" || skip "Python has no venv here"
    if ! "$tools/bin/pip" install --quiet --requirement python/requirements.txt; then
        rm -rf "$tools"
        skip "the tests need the packages of python/requirements.txt, and no package registry answers"
    fi
    cp python/requirements.txt "$tools/requirements.txt"
fi
if ! cmp -s python/requirements-clusters.txt "$tools/requirements-clusters.txt"; then
    missing=0
    # One by one: none of them is there for every system.
    for package in $(grep -v "^#" python/requirements-clusters.txt); do
        if ! "$tools/bin/pip" install --quiet "$package"; then
            echo "skipped: tests with $package, which is not to be had here"
            missing=1
        fi
    done
    if [ "$missing" = 0 ]; then
        cp python/requirements-clusters.txt "$tools/requirements-clusters.txt"
    fi
fi
if [ "${1:-}" = wheel ]; then
    exec "$tools/bin/maturin" build --release --out "$target/wheels"
fi

cargo build --workspace --locked --examples --lib --bins --features hammerbeam-python/stubs
case "$(uname)" in
    Darwin) library="$target/debug/libhammerbeam_native.dylib" ;;
    *) library="$target/debug/libhammerbeam_native.so" ;;
esac
# Moved to its place: a process that has the old one loaded keeps it.
cp "$library" python/hammerbeam/.native.new
mv -f python/hammerbeam/.native.new python/hammerbeam/_native.abi3.so

# Stubs say what the compiled module has: whoever changes it commits them as well.
stubs="python/hammerbeam/_native.pyi"
"$target/debug/stubs" "$library" "$target/_native.pyi"
if [ "${HAMMERBEAM_UPDATE:-0}" != 0 ]; then
    cp "$target/_native.pyi" "$stubs"
elif ! diff "$stubs" "$target/_native.pyi"; then
    echo "error: $stubs is not what the compiled module has; HAMMERBEAM_UPDATE=1 python/test.sh writes it" >&2
    exit 1
fi

export PYTHONPATH="$PWD/python" MPLBACKEND=agg JUPYTER_PLATFORM_DIRS=1
"$tools/bin/mypy"
"$tools/bin/python" -m mypy.stubtest hammerbeam._native --ignore-missing-stub
exec "$tools/bin/python" -m pytest "$@"
