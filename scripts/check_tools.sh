#!/bin/sh
# Says in one sentence what is missing before anything is installed.
python=${PYTHON:-python3}
if ! command -v "$python" >/dev/null 2>&1; then
    echo "make: no Python found as '$python': install Python 3.11 or later, or say make PYTHON=/path/to/python3" >&2
    exit 1
fi
if ! "$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))'; then
    echo "make: Python 3.11 or later is needed, '$python' is $("$python" -V 2>&1): say make PYTHON=python3.12 (or the like)" >&2
    exit 1
fi
if ! "$python" -c 'import venv, ensurepip' >/dev/null 2>&1; then
    echo "make: this Python cannot make virtual environments: install its venv package (Debian, Ubuntu: apt install python3-venv)" >&2
    exit 1
fi
# A CXX that is set is what the build takes: then nothing else counts.
for compiler in ${CXX:-c++ g++ clang++}; do
    if echo 'int main() { auto f = []<int N>() { return N; }; return f.operator()<0>(); }' |
        $compiler -std=c++20 -x c++ -fsyntax-only - >/dev/null 2>&1; then
        exit 0
    fi
done
echo "make: no C++20 compiler found: install g++ 10 or later or clang 12 or later (Debian, Ubuntu: apt install g++; macOS: xcode-select --install), or name one with CXX=..." >&2
exit 1
