#!/bin/sh
# The man page of fbs, or of one of its verbs: make_man_page.sh PROGRAM [VERB] > PAGE.
# Options and examples come from --help, the rest from the page of the verb in docs/. Needs help2man and lowdown.
set -eu
program=$1 verb=${2-}
docs=$(dirname "$0")
extra=$(mktemp)
trap 'rm -f "$extra"' EXIT

include=
if [ -n "$verb" ] && [ -f "$docs/$verb.md" ]; then
  # What stands below the title of the page; its headings are a level lower here. Links to other pages lead nowhere, and
  # help2man knows no letters beyond ASCII.
  { echo '[DETAILS]'
    tail -n +2 "$docs/$verb.md" | lowdown -Tman --nroff-nolinks | sed 's/^\.SH/.SS/' |
      perl -CS -pe 's/([^\x00-\x7f])/sprintf "\\[u%04X]", ord $1/ge'
  } > "$extra"
  include=--include=$extra
fi
about=$("$program" $verb --help | head -n 1)
help2man --no-info --section=1 --manual='fbs manual' --source=fbs $include \
  --version-string="$("$program" --version | cut -d ' ' -f 2)" --name="${about#fbs, }" "$program${verb:+ $verb}" |
  sed "s/^\.TH FBS/.TH fbs${verb:+-$verb}/; s/^fbs $verb \\\\-/fbs-$verb \\\\-/"
