#!/bin/sh
# Renders a scene as an array job of Slurm, and merges the parts when all are there:
#     sh farm/slurm/submit.sh PARTS FOLDER SCENE.xml [options of facet render]
# FOLDER, which all nodes must see, gets parts/, checkpoints/, logs/ and in the end SCENE.exr and
# SCENE.png. A part that is preempted, or whose node fails, continues where it stopped. Given again,
# the same command renders the parts that are missing. $FACET names the program (default: facet, by
# PATH), $SBATCH_OPTIONS more options of sbatch, as "--partition=cpu --cpus-per-task=8", and
# $FACET_MERGE_OPTIONS more of facet merge, as "--aov=variance".
# Prints the numbers of the array's job and of the merge's.
set -eu

fail() {
  echo "submit: $*" >&2
  exit 2
}

[ $# -ge 3 ] || fail "usage: sh farm/slurm/submit.sh PARTS FOLDER SCENE.xml [options of render]"
case $1 in '' | *[!0-9]* | 0*) fail "PARTS is \"$1\", a number from 1 on expected" ;; esac
here=$(cd "$(dirname "$0")" && pwd)
export FACET_PARTS="$1" FACET="${FACET:-facet}"
command -v "$FACET" >/dev/null || fail "$FACET: no such program; FACET names it"
mkdir -p "$2/parts" "$2/checkpoints" "$2/logs"
FACET_FOLDER=$(cd "$2" && pwd)
export FACET_FOLDER
FACET_SCENE=$(cd "$(dirname "$3")" && pwd)/$(basename "$3")
export FACET_SCENE
[ -f "$FACET_SCENE" ] || fail "$3: no such file"
shift 3
# Parts of two renders in one folder would be one image's.
request="$FACET_PARTS parts of $FACET_SCENE $*"
if [ ! -f "$FACET_FOLDER/request" ]; then
  echo "$request" >"$FACET_FOLDER/request"
elif [ "$request" != "$(cat "$FACET_FOLDER/request")" ]; then
  fail "$FACET_FOLDER is that of another render: $(cat "$FACET_FOLDER/request")"
fi
# sbatch reads % in the names of logs.
logs=$(printf '%s' "$FACET_FOLDER/logs" | sed 's/%/%%/g')

# Which parts there are not yet, as Slurm reads them: "3,5-9".
indices=
first=
i=1
while [ "$i" -le $((FACET_PARTS + 1)) ]; do
  if [ "$i" -le "$FACET_PARTS" ] && [ ! -f "$FACET_FOLDER/parts/$i.exr" ]; then
    first=${first:-$i}
  elif [ -n "$first" ]; then
    indices=$indices,$first-$((i - 1))
    first=
  fi
  i=$((i + 1))
done
after=
if [ -n "$indices" ]; then
  # shellcheck disable=SC2086
  array=$(sbatch --parsable --array="${indices#,}" --output="$logs/%a.log" \
    ${SBATCH_OPTIONS:-} "$here/part.sbatch" "$@")
  echo "$array"
  after="--dependency=afterok:${array%%;*} --kill-on-invalid-dep=yes"
fi
# shellcheck disable=SC2086
sbatch --parsable $after --output="$logs/merge.log" ${SBATCH_OPTIONS:-} \
  "$here/merge.sbatch"
