#!/bin/sh
# A browser for the tests of the studio: one that is there, or one that this machine lets us install.
# Says which; where none can be had it says so and ends well, and the tests are skipped.
# Usage: browser.sh PYTHON
python=$1
for name in chromium chromium-browser google-chrome; do
  if command -v $name >/dev/null 2>&1; then
    echo "browser for the studio's tests: $(command -v $name)"
    exit 0
  fi
done
if "$python" -c "
from pathlib import Path
from playwright.sync_api import sync_playwright
with sync_playwright() as p:
    raise SystemExit(not Path(p.chromium.executable_path).exists())
" 2>/dev/null; then
  echo "browser for the studio's tests: Playwright's"
  exit 0
fi
if [ "$(id -u)" = 0 ] && command -v apt-get >/dev/null 2>&1; then
  (apt-get update && apt-get install --yes --no-install-recommends chromium) >/dev/null 2>&1 \
    && echo "browser for the studio's tests: chromium, installed" && exit 0
fi
"$python" -m playwright install chromium >/dev/null 2>&1 \
  && echo "browser for the studio's tests: Playwright's, installed" && exit 0
echo "no browser for the studio's tests: they are skipped"
