#!/bin/sh
# Installs the packages that swirl needs on Fedora, or on AlmaLinux 9 (the image manylinux_2_34).
#
#   install.sh            packages that compile the program and the Python module
#   install.sh --tests    in addition, packages for ./check
#
# The file `packages` has the names of Debian. Not tested on these systems.
set -eu
if grep -q '^ID="\?almalinux' /etc/os-release; then
    dnf install -y epel-release dnf-plugins-core
    dnf config-manager --set-enabled crb
fi
dnf install -y gcc-c++ cmake ninja-build pkgconf-pkg-config cli11-devel fmt-devel json-devel \
    hdf5-devel tomlplusplus-devel cairo-devel
[ "${1-}" = --tests ] || exit 0
dnf install -y git-core python3-devel pybind11-devel python3-numpy python3-pandas \
    python3-matplotlib python3-pytest python3-hypothesis python3-h5py python3-pip gtest-devel \
    gmock-devel google-benchmark-devel rapidcheck-devel clang lld compiler-rt opencv-devel \
    ffmpeg-free valgrind chromium
