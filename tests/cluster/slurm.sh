#!/usr/bin/env bash
# Slurm on this machine alone, for tests: `slurm.sh start FOLDER PORT` and `slurm.sh stop FOLDER`.
# Real daemons (munged, slurmctld, slurmd) on loopback; all that they write lies in FOLDER.
# Afterwards SLURM_CONF=FOLDER/slurm.conf is all that sbatch, squeue and scontrol need.
set -euo pipefail
folder=$(realpath -m "$2")
export SLURM_CONF=$folder/slurm.conf

start() {
  local port=$1 host
  host=$(hostname -s)
  mkdir -p "$folder"/{state,spool,run}
  chmod 755 "$folder" "$folder"/{state,spool,run}
  head -c 1024 /dev/urandom >"$folder/munge.key"
  chmod 600 "$folder/munge.key"
  munged --force --key-file="$folder/munge.key" --socket="$folder/run/munge.sock" \
    --pid-file="$folder/run/munged.pid" --log-file="$folder/munged.log" --seed-file="$folder/run/munge.seed"
  cat >"$SLURM_CONF" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$folder/run/munge.sock,cred_expire=5
CryptoType=crypto/munge
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/run/slurmctld.pid
SlurmdPidFile=$folder/run/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MpiDefault=none
KillWait=2
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0,bf_interval=1,bf_yield_interval=100000
CompleteWait=0
MinJobAge=600
MaxArraySize=${MAX_ARRAY_SIZE:-1001}
MaxJobCount=${MAX_JOB_COUNT:-10000}
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=debug Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
  slurmctld -c
  slurmd -c
  for _ in $(seq 300); do
    case $(sinfo -h -o %T 2>/dev/null) in idle | mixed) return 0 ;; esac
    sleep 0.1
  done
  tail -q -n 5 "$folder"/*.log >&2
  echo "slurm did not come up" >&2
  return 1
}

stop() {
  for daemon in slurmd slurmctld munged; do
    local file=$folder/run/$daemon.pid pid
    [[ -s $file ]] || continue
    pid=$(<"$file")
    kill "$pid" 2>/dev/null || true
    for _ in $(seq 100); do
      kill -0 "$pid" 2>/dev/null || break
      sleep 0.05
    done
  done
}

case $1 in
  start) start "$3" ;;
  stop) stop ;;
  *) echo "slurm.sh start FOLDER PORT, or stop FOLDER" >&2 && exit 2 ;;
esac
