"""A Debian installed in a separate folder, for tests on a system without our packages. Needs root,
mmdebstrap and a mirror."""

import os
import re
import shutil
import subprocess

# /proc lets a program find the libraries next to it; Python's pty needs pseudo-terminals; POSIX
# shared memory needs /dev/shm; Slurm needs the control groups in /sys. The mounts exist for one
# command only.
MOUNTS = """
mount -t proc proc "$0/proc"
mount --rbind /sys "$0/sys"
mount -t tmpfs tmpfs "$0/dev/shm"
mount -t devpts -o newinstance,ptmxmode=0666 devpts "$0/dev/pts"
mount --bind "$0/dev/pts/ptmx" "$0/dev/ptmx"
"""


def mirror():
    """The mirror of Debian that this system uses, or None."""
    done = subprocess.run(
        ["apt-get", "indextargets", "--format", "$(SITE)", "Created-By: Packages"],
        capture_output=True,
        text=True,
    )
    sites = [site for site in done.stdout.split() if re.search(r"/debian/?$", site)]
    return sites[0] if sites else None


def what_is_missing():
    """The reason why this system cannot create and enter such a folder, or None."""
    if os.geteuid() != 0:
        return "only root can create a root folder for Debian"
    for tool in ("mmdebstrap", "apt-get", "unshare"):
        if not shutil.which(tool):
            return tool + " is missing"
    if subprocess.run(["unshare", "--mount", "true"], capture_output=True).returncode:
        return "mounts are not allowed here"
    return None if mirror() else "this system names no mirror of Debian"


def create(release, folder, packages=()):
    include = ["--include=" + ",".join(packages)] if packages else []
    subprocess.run(
        ["mmdebstrap", "--quiet", "--variant=minbase", *include, release, folder, mirror()],
        check=True,
        stdin=subprocess.DEVNULL,
    )


def run(folder, *command, inside="/root", **variables):
    """Runs a command in a folder of that Debian, with a small environment and `variables`."""
    script = f'set -e{MOUNTS}exec chroot "$0" /bin/sh -c \'cd "$0" && exec "$@"\' "$@"'
    return subprocess.run(
        ["unshare", "--mount", "sh", "-c", script, folder, inside, *command],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        env={
            "PATH": "/usr/sbin:/usr/bin:/sbin:/bin",
            "LC_ALL": "C.UTF-8",
            "HOME": "/root",
            **variables,
        },
    )
