#!/bin/sh
# Within private-cluster.sh: renders two scenes in 16 parts each by submit.sh; amid that it preempts
# one part and kills another without a word; waits for the merges. Prints how often parts were
# started again.
#     sh kill_and_requeue.sh SUBMIT A.xml A-FOLDER B.xml B-FOLDER [options of facet render]
set -eu

submit=$1 a=$2 a_folder=$3 b=$4 b_folder=$5
shift 5
end=$(($(date +%s) + 1500))

# Waits until a checkpoint of a folder is there and sets $part to whose it is.
find_checkpoint() {
  while :; do
    for file in "$1"/checkpoints/[0-9]*.exr; do
      part=$(basename "$file" .exr)
      [ -f "$file" ] && [ ! -f "$1/parts/$part.exr" ] && return
    done
    [ "$(date +%s)" -lt $end ] || return 1
    sleep 0.05
  done
}

jobs=$(sh "$submit" 16 "$a_folder" "$a" "$@")
a_array=$(echo "$jobs" | head -n 1)
find_checkpoint "$a_folder"
scontrol requeue "${a_array}_$part"
echo "preempted: part $part of $a_folder"

jobs=$(sh "$submit" 16 "$b_folder" "$b" "$@")
b_array=$(echo "$jobs" | head -n 1)
killed=
while [ -z "$killed" ]; do
  find_checkpoint "$b_folder"
  for process in $(grep -lza "^--output=.*$b_folder/parts/\.$part\.exr$" /proc/[0-9]*/cmdline); do
    kill -KILL "$(echo "$process" | cut -d / -f 3)" && killed=$part
  done
done
echo "killed: part $killed of $b_folder"

while [ -n "$(squeue --noheader)" ]; do
  [ "$(date +%s)" -lt $end ] || {
    squeue >&2
    exit 1
  }
  sleep 0.5
done
for array in "$a_array" "$b_array"; do
  scontrol show job "$array" | sed -n 's/.*\(Restarts=[1-9][0-9]*\).*/\1/p'
done
