# Functions for ./swirl, ./check and other scripts: install missing Debian packages, and build when the
# sources are newer than the last build. A script that sources this file sets $home, the root of the
# tree, $me, its name, and $long, the duration of a first build on two cores. It may set $settings,
# arguments for cmake, afterwards.
#
# All messages go to stderr: stdout belongs to the program (`--json -`). The functions use POSIX sh, and
# `find -cnewer`, which GNU and BSD have.

settings= # ignores a variable of that name in the environment

say() { echo "$me: $*" >&2; }
give_up() {
    say "$*"
    exit 1
}
usage_error() {
    say "$*"
    exit 2
}

# Prints a word with the quotes that a shell needs to read it back.
shell_word() {
    case $1 in
        '' | *[!A-Za-z0-9_+=./:,@%-]*) printf "'%s'" "$(printf %s "$1" | sed "s/'/'\\\\''/g")" ;;
        *) printf %s "$1" ;;
    esac
}

# Gives up if this user cannot write to $home/build or to the files and folders "$@" in it, which need
# not exist.
require_writable() {
    locked=$home/build
    [ ! -w "$locked" ] || locked=$(find "$@" ! -type l -exec sh -c '
        for file do [ -w "$file" ] || { printf "%s\n" "$file" && exit; }; done' sh {} + 2>/dev/null |
        head -n 1)
    [ -n "$locked" ] || return 0
    # shellcheck disable=SC2012
    say "cannot build: '$locked' cannot be written; it belongs to $(ls -ld "$locked" | awk '{print $3}')."
    say "hint: sudo chown -R $(id -u) $(shell_word "$home/build")"
    exit 1
}

# The packages in the given sections of the file `packages`.
listed_packages() {
    for section in "$@"; do
        sed -n "/^\[$section\]/,/^\[/p" "$home/packages" | sed -e 's/#.*//' -e '/^\[/d'
    done
}

# The packages of these sections that are not installed. One call of dpkg-query checks all of them.
missing_packages() {
    wanted=$(listed_packages "$@")
    # shellcheck disable=SC2086
    installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted 2>/dev/null |
        sed -n 's/^installed //p')
    for package in $wanted; do
        echo "$installed" | grep -qx -e "$package" || echo "$package"
    done
}

apt_install() {
    DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 install -y \
        --no-install-recommends "$@"
}

# Installs the missing packages of the sections "$@". Without root, or if that fails, it prints the
# command for it, and fails.
install_packages() {
    command -v dpkg-query >/dev/null || return 0 # not Debian: see has_tools
    missing=$(missing_packages "$@" | sort -u)
    [ -n "$missing" ] || return 0
    # shellcheck disable=SC2116,SC2086
    missing=$(echo $missing) # one line
    if [ "$(id -u)" -ne 0 ]; then
        say "some Debian packages are missing; this installs them:"
        echo "    sudo apt-get install --no-install-recommends $missing" >&2
        return 1
    fi
    if [ "${SWIRL_INSTALL-}" = no ]; then
        say "some Debian packages are missing, but SWIRL_INSTALL=no is set; this installs them:"
        echo "    apt-get install --no-install-recommends $missing" >&2
        return 1
    fi
    log=$home/build/packages.log
    say "installing Debian packages, once (SWIRL_INSTALL=no forbids it): $missing"
    # shellcheck disable=SC2086
    apt_install $missing </dev/null >"$log" 2>&1 && return 0
    # The lists of packages may be missing or old, for example on a new machine.
    # shellcheck disable=SC2086
    if ! is_interrupted_dpkg && apt-get -o DPkg::Lock::Timeout=300 update </dev/null >>"$log" 2>&1 &&
        apt_install $missing </dev/null >>"$log" 2>&1; then
        return 0
    fi
    tail -n 15 "$log" >&2
    if is_interrupted_dpkg; then
        say "an earlier installation of packages was interrupted; this completes it, then try again:"
        echo "    dpkg --configure -a" >&2
    else
        say "installing the packages failed (see above; full log: $log); this is the command:"
        echo "    apt-get install --no-install-recommends $missing" >&2
    fi
    return 1
}

is_interrupted_dpkg() { grep -q "dpkg --configure -a" "$log"; }

# On a system without dpkg: lists the tools and libraries that a build lacks, and fails if there are any.
has_tools() {
    ! command -v dpkg-query >/dev/null || return 0
    lacking=
    newline='
'
    lack() { lacking="$lacking$newline    $*"; }
    for tool in cmake ninja pkg-config; do command -v $tool >/dev/null || lack $tool; done
    compiler=
    for name in "${CXX-}" c++ g++ clang++; do
        if [ -z "$compiler" ] && command -v "$name" >/dev/null; then compiler=$name; fi
    done
    if [ -z "$compiler" ]; then
        lack "a C++20 compiler"
        lack "CLI11, fmt, nlohmann-json, toml++, HDF5 with its high-level library, cairo (all with headers)"
    else
        includes="$(pkg-config --cflags cairo 2>/dev/null) $(pkg-config --cflags hdf5 2>/dev/null)"
        for library in CLI11:CLI/CLI.hpp fmt:fmt/format.h nlohmann-json:nlohmann/json.hpp \
            toml++:toml++/toml.h HDF5:hdf5.h HDF5-high-level:hdf5_hl.h cairo:cairo.h; do
            # shellcheck disable=SC2086
            echo "#include <${library#*:}>" | "$compiler" -x c++ -std=c++20 -E $includes \
                -I/usr/include/hdf5/serial - >/dev/null 2>&1 ||
                lack "${library%%:*}, with the header ${library#*:}"
        done
    fi
    [ -n "$lacking" ] || return 0
    say "cannot build. This system has no dpkg, so install these yourself:$lacking"
    say "hint: \`./swirl\` then builds, or: cmake --preset release && cmake --build --preset release"
    return 1
}

# Succeeds if the packages in the sections "$@" are installed. Asks dpkg again only if packages were
# installed or removed since the last call.
has_packages() {
    packages_stamp=$home/build/.packages-$(echo "$@" | tr ' ' '-')
    if [ "$packages_stamp" -nt /var/lib/dpkg/status ] && [ "$packages_stamp" -nt "$home/packages" ]; then
        return 0
    fi
    command -v dpkg-query >/dev/null || return 0
    [ -z "$(missing_packages "$@")" ] || return 1
    touch "$packages_stamp" 2>/dev/null || true
}

# Installs the packages in the sections "$@", which a call needs in addition to the program. If that
# fails, the call continues, and the program reports what is missing.
packages_for_this_call() {
    mkdir -p "$home/build" 2>/dev/null || return 0
    has_packages "$@" || ! install_packages "$@" || touch "$packages_stamp" 2>/dev/null || true
}

# Succeeds if the sources, the current commit (which every result names) or the installed packages
# have changed since the stamp was set; "$@" names more files and folders. It compares ctime, so that files moved
# here with an old date count; a removed file counts because its folder has changed.
changed_since() {
    changed=$(
        cd "$home"
        git_folder=.git
        [ ! -f .git ] || git_folder=$(sed -n 's/^gitdir: //p' .git)
        set -- src cmake CMakeLists.txt CMakePresets.json packages "$@"
        for file in track "$git_folder/logs/HEAD" "$git_folder/HEAD" /var/lib/dpkg/status; do
            [ ! -e "$file" ] || set -- "$@" "$file"
        done
        find "$@" -cnewer "$stamp" -print 2>/dev/null
    ) || return 0
    [ -n "$changed" ]
}

# A lock is a symbolic link that names the process which has it: a link is created in one step or not at
# all.
is_running() { # also for a process of another user; on Linux also without ps
    kill -0 "$1" 2>/dev/null || [ -d "/proc/$1" ] || ps -p "$1" >/dev/null 2>&1
}
is_locked() {
    owner=$(readlink "$1" 2>/dev/null) && is_running "$owner"
}

# Waits for the lock $1 and takes it. Removes a lock whose process has ended, and an ordinary file with
# this name, because it names no process.
take_lock() {
    failed=0
    until ln -s $$ "$1" 2>/dev/null; do
        owner=$(readlink "$1") || owner=
        if [ -n "$owner" ] && is_running "$owner"; then
            sleep 1
        elif { [ -n "$owner" ] || [ -f "$1" ]; } && mv "$1" "$1.$$" 2>/dev/null; then
            # Another process may have replaced the lock in between.
            if [ "$(readlink "$1.$$")" = "$owner" ]; then rm -f "$1.$$"; else mv "$1.$$" "$1"; fi
        else
            failed=$((failed + 1))
            [ $failed -lt 100 ] || give_up "cannot create the lock '$1'."
        fi
    done
}

# One build at a time.
lock_build() { take_lock "$home/build/.building"; }
unlock_build() { rm -f "$home/build/.building"; }

# Renames a file or folder. Never moves it into an existing folder.
rename() { ! [ -d "$2" ] && mv -f "$1" "$2"; }

# Prints the Python that has the packages of the file `packages`: on Debian /usr/bin/python3, on other
# systems the first python3 on PATH.
system_python() {
    if command -v dpkg-query >/dev/null; then echo /usr/bin/python3; else command -v python3; fi
}

# Reports the progress of the build with the log $1 every ten seconds. Ends with this shell.
report_progress() {
    waited=0
    while sleep 1 >/dev/null 2>&1 && kill -0 $$ 2>/dev/null; do
        waited=$((waited + 1))
        [ $((waited % 10)) -eq 0 ] || continue
        # ninja writes "[37/98] Building …".
        step=$(sed -n '/Re-checking/d; s/^\[\([0-9]*\)\/\([0-9]*\)\].*/\1 \2/p' "$1" | tail -n 1)
        [ -z "$step" ] || say "building: ${step% *} of ${step#* }, $((100 * ${step% *} / ${step#* })) %"
    done
}

# is_built PRESET [FOLDERS_WATCHED [TARGETS]]: succeeds if build/PRESET is newer than all of its sources.
is_built() {
    stamp="$home/build/$1/.built${3:+ $3}${settings:+ $settings}"
    # shellcheck disable=SC2086
    [ -e "$stamp" ] && ! changed_since ${2-}
}

# build PRESET SECTIONS_NEEDED [FOLDERS_WATCHED [TARGETS]]
# Builds these targets, or all, in build/PRESET if they are not up to date.
build() {
    if is_built "$1" "${3-}" "${4-}"; then return 0; fi
    case $home in
        *[\"\;\\]*) give_up "cannot build in '$home': CMake does not support \", ; and \\ in the names of folders." ;;
    esac
    folder=$home/build/$1
    mkdir -p "$folder" 2>/dev/null || give_up "cannot write to $home/build, where the program is built."
    require_writable "$folder"
    lock_build
    # Another process may have built it while this one waited.
    if is_built "$1" "${3-}" "${4-}"; then
        unlock_build
        return 0
    fi
    # shellcheck disable=SC2086
    if ! install_packages $2 || ! { [ -e "$stamp" ] || has_tools; }; then
        unlock_build
        exit 1
    fi
    # A build made elsewhere cannot be continued in a tree that was moved.
    if [ -e "$folder/CMakeCache.txt" ] &&
        ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$home" "$folder/CMakeCache.txt"; then
        rm -rf "$folder"
        mkdir -p "$folder"
    fi
    # ninja compares modification times only. A file that was replaced by one with an old date has a newer
    # ctime, so it gets a new date.
    if [ -e "$stamp" ]; then
        # shellcheck disable=SC2086
        (cd "$home" && find src track cmake CMakeLists.txt ${3-} -type f -cnewer "$stamp" ! -newer "$stamp" \
            -exec touch {} + 2>/dev/null) || true
    fi
    [ -e "$stamp" ] || say "building the program, only once; this takes $long on two cores"
    touch "$stamp.building"
    log=$folder/build.log
    : >"$log"
    report_progress "$log" &
    reporter=$!
    built=yes
    # shellcheck disable=SC2086
    (cd "$home" && cmake --preset "$1" $settings) >>"$log" 2>&1 &&
        cmake --build "$folder" ${4:+--target} ${4-} >>"$log" 2>&1 || built=no
    kill "$reporter" 2>/dev/null || true
    if [ $built = no ]; then
        tail -n 40 "$log" >&2
        unlock_build
        give_up "the build failed (see above; full log: $log)."
    fi
    mv "$stamp.building" "$stamp" # dated before the build: later changes are newer
    unlock_build
}

# print_section HEADING: prints the first block of text below `## HEADING` of docs/reference/commands.md.
print_section() {
    heading="## $1" awk '
        /^```/ { if (here && inside) exit; inside = !inside; next }
        /^## / && !inside { here = $0 == ENVIRON["heading"] }
        here && inside { print; found = 1 }
        END { exit !found }' "$home/docs/reference/commands.md" 2>/dev/null
}
