#!/bin/sh
# Runs a command with a Slurm cluster of one node, this machine, that lives as long as the command:
#     sh farm/slurm/private-cluster.sh COMMAND...   # fetches Slurm if need be
#     sh farm/slurm/private-cluster.sh --prepare    # only fetches it
#     sh farm/slurm/private-cluster.sh --check      # says whether it is there; fetches nothing
# to try array jobs without a cluster, and for facet's own test of them. The command finds sbatch,
# squeue and the others in PATH. Debian's packages come through apt and are unpacked into
# $FACET_SLURM (default: facet/slurm in the user's cache folder), without root or systemd.
# The daemons write to a temporary folder, run jobs of this user alone, and believe those alone who
# have this call's key (munge).
# Exit codes: 77 where there is no Slurm, with a line that says why; 2 wrong usage; else 0, or what
# COMMAND returns.
set -eu

program=private-cluster
# shellcheck source=cmake/unpacked-packages.sh
. "$(dirname "$0")/../../cmake/unpacked-packages.sh"

# Makes the folder $part/kept: Slurm's packages, unpacked.
fetch_slurm() {
  write_apt_settings
  update_lists
  [ -n "$(candidate slurmctld)" ] || none "$suite has no slurmctld"
  download slurmctld slurmd slurm-client slurm-wlm-basic-plugins munge libmunge2
  check_signed
  for archive in "$part"/cache/archives/*.deb; do dpkg-deb -x "$archive" "$part/kept"; done
  candidate slurmctld >"$part/kept/version"
}

# Writes the cluster's settings, with ports that differ from call to call.
# cred_expire is also how long a requeued job waits before it starts again.
write_settings() {
  cat >"$work/cgroup.conf" <<END
CgroupPlugin=cgroup/v1
END
  cat >"$work/slurm.conf" <<END
ClusterName=facet
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket,cred_expire=30
CredType=cred/munge
PluginDir=$plugins
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1
MpiDefault=none
SwitchType=switch/none
MailProg=/bin/true
ReturnToService=2
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=here Nodes=$node Default=YES State=UP
END
}

# Starts the daemon that signs what the others and the commands say to one another.
start_munge() {
  (umask 077 && head -c 128 /dev/urandom >"$work/munge.key")
  munged --foreground --force --key-file="$work/munge.key" --socket="$work/munge.socket" \
    --pid-file="$work/munge.pid" --log-file="$work/munge.log" --seed-file="$work/munge.seed" \
    >"$work/munge.out" 2>&1 &
  signer=$!
}

# Starts both daemons; fails where they do not find each other.
start_cluster() {
  write_settings
  slurmctld-wlm -D >"$work/slurmctld.out" 2>&1 &
  controller=$!
  slurmd-wlm -D -N "$node" -d "$kept/usr/sbin/slurmstepd-wlm" >"$work/slurmd.out" 2>&1 &
  daemon=$!
  tries=0
  while [ $tries -lt 60 ]; do
    case $(sinfo --noheader --format=%T 2>/dev/null) in idle*) return 0 ;; esac
    kill -0 "$controller" 2>/dev/null && kill -0 "$daemon" 2>/dev/null || break
    tries=$((tries + 1))
    sleep 0.5
  done
  stop_cluster
  return 1
}

stop_cluster() {
  scancel --quiet --user="$(id -un)" 2>/dev/null || true
  # Jobs end while the daemons are there to see to it.
  tries=0
  while [ -n "$(squeue --noheader 2>/dev/null)" ] && [ $tries -lt 60 ]; do
    tries=$((tries + 1))
    sleep 0.5
  done
  end "$daemon" "$controller"
}

end() {
  kill "$@" 2>/dev/null || true
  wait "$@" 2>/dev/null || true
}

run_on_cluster() {
  work=$(mktemp -d)
  trap 'stop_cluster; end "$signer"; rm -rf "$work"' EXIT
  trap 'exit 130' INT TERM HUP
  mkdir "$work/state" "$work/spool"
  node=$(uname -n | cut -d . -f 1)
  controller= daemon= signer=
  export SLURM_CONF="$work/slurm.conf" PATH="$kept/usr/bin:$kept/usr/sbin:$PATH"
  export LD_LIBRARY_PATH="$plugins:$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
  start_munge
  for attempt in 1 2 3 4 5; do
    port=$((20000 + ($$ * 10 + attempt * 2) % 20000))
    if start_cluster; then
      "$@" && return || return $?
    fi
  done
  none "Slurm's daemons do not start here: $(tail -n 1 "$work/slurmd.out" "$work/slurmctld.out" |
    tr '\n' ' ')"
}

case ${1:-} in
  --check | --prepare) ;;
  '' | -*)
    say "usage: sh farm/slurm/private-cluster.sh COMMAND... | --prepare | --check"
    exit 2
    ;;
esac
cache=${FACET_SLURM:-${XDG_CACHE_HOME:-${HOME:-/nonexistent}/.cache}/facet/slurm}
variable=FACET_SLURM
open_cache
suite=$codename

if [ "$1" = --check ]; then
  is_whole || none "not prepared; sh farm/slurm/private-cluster.sh --prepare fetches Slurm"
else
  prepare fetch_slurm
fi
libraries=$kept/usr/lib/$(uname -m)-linux-gnu
plugins=$libraries/slurm-wlm
libraries=$libraries:$kept/lib/$(uname -m)-linux-gnu
case $1 in
  --check | --prepare) echo "Slurm $(cat "$kept/version") in $kept" ;;
  *) run_on_cluster "$@" ;;
esac
