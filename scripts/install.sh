#!/bin/sh
# pip install that begins again, up to three times, where a download broke off; what fails for
# another reason fails at once. The first argument is the Python to install for.
set -u
python=$1
shift
said=$(mktemp)
trap 'rm -f "$said"' EXIT
for pause in 10 30 60 none; do
    if "$python" -m pip install --quiet --disable-pip-version-check "$@" 2>"$said"; then
        cat "$said" >&2
        exit 0
    fi
    cat "$said" >&2
    if [ "$pause" = none ] ||
        ! grep -q -e incomplete-download -e 'Read timed out' -e 'Connection broken' -e 'Max retries exceeded' "$said"; then
        exit 1
    fi
    echo "make: the network broke off a download; trying again in $pause s" >&2
    sleep "$pause"
done
