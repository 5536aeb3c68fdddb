#!/bin/sh
# Builds the book from docs/ into target/book; index.html there opens in any browser, without a network.
#
# Warnings are errors: a link to a page or heading that does not exist, a page in no table of contents, a key
# that MyST does not know. Tools are installed once, into target/book-tools.
set -eu
cd "$(dirname "$0")/.."
target="${CARGO_TARGET_DIR:-target}"
tools="$target/book-tools"

if ! command -v python3 > /dev/null || ! python3 -c "import sys; assert sys.version_info >= (3, 11)" 2> /dev/null; then
    echo "skipped: the book needs Python 3.11 or later"
    [ "${HAMMERBEAM_REQUIRE_BOOK:-0}" = 0 ]
    exit
fi
if ! cmp -s docs/requirements.txt "$tools/requirements.txt"; then
    rm -rf "$tools"
    python3 -m venv "$tools"
    if ! "$tools/bin/pip" install --quiet --requirement docs/requirements.txt; then
        rm -rf "$tools"
        echo "skipped: the book needs the packages of docs/requirements.txt, and no package registry answers"
        [ "${HAMMERBEAM_REQUIRE_BOOK:-0}" = 0 ]
        exit
    fi
    cp docs/requirements.txt "$tools/requirements.txt"
fi
rm -rf "$target/book"
"$tools/bin/sphinx-build" -W --keep-going -n -q -E -d "$target/book-cache" docs "$target/book"
"$tools/bin/python" docs/readability.py --check docs README.md CHANGELOG.md
"$tools/bin/python" docs/_ext/check_tests.py
echo "book: $target/book/index.html"
