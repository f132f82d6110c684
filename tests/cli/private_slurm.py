"""A private Slurm: a controller and several nodes on this machine, for the duration of a test.

Needs root and Debian's packages slurm-wlm and munge. All of its files are in one folder, and its
processes are ended by their process IDs.
"""

import os
import re
import shutil
import signal
import socket
import subprocess
import time

from program import HANG, read_text, wait_until, write_text

PROGRAMS = ("slurmctld", "slurmd", "sbatch", "squeue", "scancel", "sinfo", "munged")


def why_not():
    """The reason why Slurm cannot be started here; None if it can."""
    if os.geteuid() != 0:
        return "starting a private Slurm needs root"
    missing = [program for program in PROGRAMS if not shutil.which(program)]
    if missing:
        subprocess.run(
            [
                "apt-get",
                "-o",
                "DPkg::Lock::Timeout=300",
                "install",
                "-y",
                "--no-install-recommends",
                "slurm-wlm",
                "munge",
            ],
            capture_output=True,
        )
        missing = [program for program in PROGRAMS if not shutil.which(program)]
    if missing:
        return (
            f"{', '.join(missing)} not installed; Debian's packages slurm-wlm and munge have them"
        )
    if subprocess.run(["runuser", "-u", "munge", "--", "true"], capture_output=True).returncode:
        return "root may not become the user munge here"
    # From Slurm 23.11 on, Slurm.__init__ disables the plugin that needs them.
    if version() < (23, 11) and not os.path.isdir("/sys/fs/cgroup"):
        return "slurmd needs /sys/fs/cgroup"
    return None


def version():
    text = subprocess.run(["slurmd", "-V"], capture_output=True, text=True, check=True).stdout
    return tuple(int(number) for number in re.search(r"(\d+)\.(\d+)", text).groups())


def alive(pid):
    try:
        return read_text(f"/proc/{pid}/stat").rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def processes():
    """(process ID, parent, command line) of all processes."""
    found = []
    for name in os.listdir("/proc"):
        if not name.isdigit():
            continue
        try:
            with open(f"/proc/{name}/stat") as stat, open(f"/proc/{name}/cmdline", "rb") as line:
                parent = int(stat.read().rpartition(")")[2].split()[1])
                found.append((int(name), parent, line.read().replace(b"\0", b" ").decode()))
        except OSError:
            pass
    return found


class Slurm:
    def __init__(self, folder, nodes, cpus):
        self.folder = folder
        self.nodes = [f"n{k}" for k in range(1, nodes + 1)]
        with socket.socket() as probe:  # a free port; the next ones are assumed to be free
            probe.bind(("127.0.0.1", 0))
            port = min(probe.getsockname()[1], 60000)
        for part in ("state", "spool", "log", "munge"):
            os.makedirs(f"{folder}/{part}", exist_ok=True)
        for entered in (os.path.dirname(folder), folder):  # munged runs as a user of its own
            os.chmod(entered, 0o755)
        self.environment = dict(os.environ, SLURM_CONF=f"{folder}/slurm.conf")
        host = socket.gethostname().split(".")[0]
        with open(f"{folder}/slurm.conf", "w") as conf:
            conf.write(
                f"""ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
SlurmctldPort={port}
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={folder}/munge/munge.socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/log/slurmctld.log
SlurmdLogFile={folder}/log/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,sched_interval=1,bf_interval=1
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SlurmctldTimeout=10
SlurmdTimeout=10
KillWait=2
JobRequeue=1
SlurmdParameters=config_overrides
"""
            )
            for k, node in enumerate(self.nodes):
                conf.write(
                    f"NodeName={node} NodeHostname={host} NodeAddr=127.0.0.1 "
                    f"Port={port + 101 + k} CPUs={cpus} RealMemory=500 State=UNKNOWN\n"
                )
            # A node needs control groups unless this plugin is disabled.
            if version() >= (23, 11):
                write_text(f"{folder}/cgroup.conf", "CgroupPlugin=disabled\n")
            conf.write(
                f"PartitionName=main Nodes={','.join(self.nodes)} Default=YES "
                "MaxTime=INFINITE State=UP OverSubscribe=NO\n"
            )

    def run(self, *command):
        return subprocess.run(
            command, env=self.environment, capture_output=True, text=True, timeout=HANG
        )

    def start(self):
        munge = f"{self.folder}/munge"
        with open(f"{munge}/key", "wb") as key:
            key.write(os.urandom(128))
        for name in (munge, f"{munge}/key"):
            shutil.chown(name, "munge", "munge")
        os.chmod(munge, 0o755)
        os.chmod(f"{munge}/key", 0o400)
        started = self.run(
            "runuser",
            "-u",
            "munge",
            "--",
            "munged",
            "--force",
            f"--socket={munge}/munge.socket",
            f"--key-file={munge}/key",
            f"--pid-file={munge}/pid",
            f"--log-file={munge}/log",
            f"--seed-file={munge}/seed",
        )
        assert started.returncode == 0, started.stderr
        for node in self.nodes:
            os.makedirs(f"{self.folder}/spool/{node}", exist_ok=True)
        # Without this, the daemons would keep the pipes of the test open.
        quiet = dict(env=self.environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        subprocess.run(["slurmctld"], check=True, **quiet)
        for node in self.nodes:
            subprocess.run(["slurmd", "-N", node], check=True, **quiet)
        wait_until(
            lambda: self.run("sinfo", "-h", "-N", "-o", "%T").stdout.split().count("idle")
            == len(self.nodes)
        )

    def pid_of(self, name):
        try:
            return int(read_text(f"{self.folder}/{name}"))
        except (OSError, ValueError):
            return None

    def steps_on(self, node):
        """The process IDs of slurmstepd processes that write to this node's log."""
        log = f"{self.folder}/log/slurmd.{node}.log"
        found = []
        for pid, _, line in processes():
            if not line.startswith("slurmstepd: ["):
                continue
            try:
                links = [
                    os.readlink(f"/proc/{pid}/fd/{fd}") for fd in os.listdir(f"/proc/{pid}/fd")
                ]
            except OSError:
                continue
            if log in links:
                found.append(pid)
        return found

    def kill_node(self, node):
        """Simulates a power failure: kills the daemon and all of its child processes."""
        os.kill(self.pid_of(f"slurmd.{node}.pid"), signal.SIGKILL)
        self.kill_trees(self.steps_on(node))

    def kill_trees(self, roots):
        children = {}
        for pid, parent, _ in processes():
            children.setdefault(parent, []).append(pid)
        pids = list(roots)
        for pid in pids:
            pids.extend(children.get(pid, []))
        for pid in reversed(pids):
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def stop(self):
        self.run("timeout", "5", "scancel", "-u", "root")
        time.sleep(0.5)
        for node in self.nodes:
            self.kill_trees(self.steps_on(node))
        for name in [f"slurmd.{n}.pid" for n in self.nodes] + ["slurmctld.pid", "munge/pid"]:
            pid = self.pid_of(name)
            if pid is None or not alive(pid):
                continue
            os.kill(pid, signal.SIGTERM)
            for _ in range(50):
                if not alive(pid):
                    break
                time.sleep(0.1)
            else:
                os.kill(pid, signal.SIGKILL)


def started_for(test, nodes):
    """A Slurm in the folder of a test (InFolder), and the environment to use it. Skips the test
    where none can run."""
    reason = why_not()
    if reason:
        test.skipTest(reason)
    slurm = Slurm(test.path("slurm"), nodes=nodes, cpus=1)
    test.addCleanup(slurm.stop)
    slurm.start()
    return slurm, {"SLURM_CONF": f"{test.path('slurm')}/slurm.conf"}
