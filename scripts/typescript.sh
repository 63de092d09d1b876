#!/bin/sh
# The compiler that checks the types of the studio's page, beside the tools of an environment.
# Where npm or the network cannot be had it says so and ends well, and the test is skipped.
# Usage: typescript.sh PYTHON
version=7.0.2
place=$("$1" -c 'import sys; print(sys.prefix)')/typescript
if [ "$("$place/node_modules/.bin/tsc" --version 2>/dev/null)" = "Version $version" ]; then
  echo "checker of the page's types: TypeScript $version"
  exit 0
fi
mkdir -p "$place"
if command -v npm >/dev/null 2>&1 &&
  npm install --no-save --no-audit --no-fund --prefix "$place" "typescript@$version" >/dev/null 2>&1; then
  echo "checker of the page's types: TypeScript $version, installed"
  exit 0
fi
echo "no checker of the page's types: there is no npm, or it reaches nothing; the test is skipped"
