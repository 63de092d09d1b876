#!/bin/sh
# Builds sdist and wheel, the wheel from the sdist, and tries the wheel in a fresh environment where
# nothing can be compiled. Usage: wheel.sh PYTHON, that of an environment to build in.
set -eu
base=$1
environment=build/wheel/environment
sh scripts/install.sh "$base" build
rm -rf dist $environment
"$base" -m build --outdir dist .
"$base" -m venv $environment
python=$(pwd)/$environment/bin/python
# No compiler: none by name, and no package that would need one.
CC=false CXX=false sh scripts/install.sh "$python" --only-binary :all: dist/*.whl
script=$(pwd)/scripts/smoke.py
examples=$(pwd)/examples/data
# From a folder of its own, so that the package is the one that was installed.
mkdir -p $environment/desk && cd $environment/desk
exec "$python" -I "$script" "$examples"
