#!/usr/bin/env bash
# Runs COMMAND, or skips the test if one of the programs or files that it needs is missing.
# Usage: with_programs.sh NEEDED... -- COMMAND...
set -euo pipefail
while [[ $1 != -- ]]; do
  if ! command -v "$1" >/dev/null && [[ ! -e $1 ]]; then
    echo "skipped: no $1 (tools/setup test-all or tools/setup integrations installs it)"
    exit 77
  fi
  shift
done
shift
exec "$@"
