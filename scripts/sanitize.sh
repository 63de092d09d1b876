#!/bin/sh
# Builds the kernel for AddressSanitizer and UndefinedBehaviorSanitizer, runs its native tests, then
# the quick suite on it. Usage: sanitize.sh PYTHON, that of an environment with all dependencies.
set -eu
base=$1
environment=build/sanitize/environment
python=$environment/bin/python
packages() { "$1" -c 'import sysconfig; print(sysconfig.get_path("purelib"))'; }

library() { "${CXX:-c++}" -print-file-name="$1"; }
if ! test -f "$(library libasan.so)"; then
    echo "make: '${CXX:-c++}' has no libasan.so: install g++ and say make sanitize CXX=g++" >&2
    exit 1
fi

# An environment of its own, which borrows the dependencies: the line of a .pth file adds their
# folder, whose own .pth files are not read, so that the package installed there stays out.
test -x $python || "$base" -m venv --without-pip $environment
packages "$base" >"$(packages $python)/dependencies.pth"
"$base" -m pip --python $python --disable-pip-version-check install --quiet --no-deps --editable . \
    -C build-dir=build/sanitize/build -C install.strip=false -C cmake.define.SANITIZE=ON
build/sanitize/build/kernel_tests

# The interpreter itself knows nothing of the checks, so their library is loaded before it, and that
# of C++ with it, whose exceptions it watches. Python keeps objects at its end: leaks are not asked.
LD_PRELOAD="$(library libasan.so) $(library libstdc++.so)"
export LD_PRELOAD ASAN_OPTIONS=detect_leaks=0:handle_abort=1 UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
exec $python -m pytest -q -n logical --dist worksteal -m "not slow" -p no:cacheprovider
