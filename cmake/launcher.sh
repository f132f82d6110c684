# Functions for ./swirl, ./check and other scripts: install missing Debian packages, and build when the
# sources are newer than the last build. A script that sources this file sets $home, the root of the
# tree, $me, its name, and $long, the duration of a first build on two cores. It may set $settings,
# arguments for cmake, and $building, what is built, afterwards. Messages go to stderr: stdout belongs to the program (`--json -`).
# The functions use POSIX sh, and `find -cnewer`, which GNU and BSD have.
# shellcheck disable=SC2086

dpkg=/var/lib/dpkg
settings= building="the program" # ignores variables of these names in the environment

say() { echo "$me: $*" >&2; }
# What is wrong, and a hint if there is one.
error() { echo "error: $1" >&2 && { [ $# -lt 2 ] || echo "hint: $2" >&2; }; }
give_up() { error "$@" && exit 1; }
usage_error() { error "$@" && exit 2; }

# Gives up if this user cannot write to $home/build or to the files and folders "$@" in it, which need
# not exist.
require_writable() {
    locked=$home/build
    [ ! -w "$locked" ] || locked=$(find "$@" ! -type l -exec sh -c '
        for file do [ -w "$file" ] || { printf "%s\n" "$file" && exit; }; done' sh {} + 2>/dev/null |
        head -n 1)
    [ -n "$locked" ] || return 0
    quoted=$(printf %s "$home/build" | sed "/[^A-Za-z0-9_+=./:,@%-]/{s/'/'\\\\''/g;s/.*/'&'/;}")
    if [ -O "$locked" ]; then
        give_up "cannot build: '$locked' cannot be written." \
            "chmod -R u+w $quoted; if the file system is read-only, copy this folder to another one."
    fi
    # shellcheck disable=SC2012
    give_up "cannot build: '$locked' cannot be written; it belongs to $(ls -ld "$locked" | awk '{print $3}')." \
        "sudo chown -R $(id -u) $quoted"
}

# The packages in the sections "$@" of the file `packages` that are not installed.
missing_packages() {
    wanted=$(for section in "$@"; do sed -n "/^\[$section\]/,/^\[/{s/#.*//;/^\[/!p;}" "$home/packages"; done)
    installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' $wanted 2>/dev/null) || true
    for package in $wanted; do
        echo "$installed" | grep -qx -e "installed $package" || echo "$package"
    done | LC_ALL=C sort -u | paste -s -d ' ' -
}

# Installs the missing packages of the sections "$@". Without root, or if that fails, it prints the
# command for it, and fails. Without dpkg it leaves them to the user.
install_packages() {
    command -v dpkg-query >/dev/null || return 0
    missing=$(missing_packages "$@")
    [ -n "$missing" ] || return 0
    # Another process may be installing them. This lock ends with the subshell; a lock of the caller continues.
    (install_missing "$@")
}
install_missing() {
    [ "$(id -u)" -ne 0 ] || [ "${SWIRL_INSTALL-}" = no ] || lock "$home/build" installation
    missing=$(missing_packages "$@")
    [ -n "$missing" ] || return 0
    command="apt-get install --no-install-recommends $missing"
    if [ "$(id -u)" -ne 0 ]; then
        say "some Debian packages are missing; this installs them:"
        command="sudo $command"
    elif [ "${SWIRL_INSTALL-}" = no ]; then
        say "some Debian packages are missing, but SWIRL_INSTALL=no is set; this installs them:"
    else
        say "installing Debian packages, once (SWIRL_INSTALL=no forbids it): $missing"
        log=$home/build/packages.log
        # A service that a package starts must not keep the lock.
        install() { DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 "$@" 9<&-; }
        interrupted() { grep -q "dpkg --configure -a" "$log"; }
        # The lists of packages may be missing or old, for example on a new machine.
        { install install -y --no-install-recommends $missing || { ! interrupted && install update &&
            install install -y --no-install-recommends $missing; }; } </dev/null >"$log" 2>&1 && return 0
        tail -n 15 "$log" >&2
        say "installing the packages failed (see above; full log: $log); this is the command:"
        ! interrupted || command="dpkg --configure -a"
    fi
    echo "    $command" >&2
    return 1
}

# Succeeds if the packages in the sections "$@" are installed. Asks dpkg again only if packages were
# installed or removed since the last call.
has_packages() {
    packages_stamp=$home/build/.packages-$(echo "$@" | tr ' ' '-')
    command -v dpkg-query >/dev/null || return 0
    if [ "$packages_stamp" -nt $dpkg/status ] && [ "$packages_stamp" -nt "$home/packages" ]; then
        return 0
    fi
    [ -z "$(missing_packages "$@")" ] && touch "$packages_stamp" 2>/dev/null
}

# Installs the packages in the sections "$@", which a call needs in addition to the program. If that
# fails, the call continues, and the program reports what is missing.
packages_for_this_call() {
    mkdir -p "$home/build" 2>/dev/null || return 0
    has_packages "$@" || ! install_packages "$@" || touch "$packages_stamp" 2>/dev/null || true
}

# Prints the sources "$@", the current commit (which every result names) and the packages in the sections $linked
# that have changed since the stamp was set. It compares ctime, so that files moved here with an old date count; a
# removed file counts because its folder has changed. A date in the future was set while the clock was ahead: such a
# stamp is no proof and counts as changed, and such a source is older than it seems.
changed_since() {
    git_folder=$home/.git
    [ ! -f "$git_folder" ] || git_folder=$(sed -n 's/^gitdir: //p' "$git_folder")
    libraries=$(awk -v info=$dpkg/info/ -v linked=" $linked " '/^\[/ { section = " " substr($1, 2, length($1) - 2) " " }
        /^[a-z]/ && index(linked, section) && !/^(cmake|ninja-build|pkg-config)/ { print info $1 "[.:]*list" }' \
        "$home/packages")
    (cd "$home" && find "$@" "$git_folder/logs/HEAD" "$git_folder/HEAD" $libraries "$stamp" \
        \( -name '.built*' -mmin -0 -o ! -name '.built*' -cnewer "$stamp" ! -cmin -0 \) 2>/dev/null)
}

# Holds the folder $1 until unlock or the end of this shell. If another process holds it for a $2, this says so and
# waits. The kernel frees the folder of a killed process. Perl is part of Debian and macOS; without it, two first calls
# at once are not protected.
lock() {
    if ! try_lock "$1" && command -v perl >/dev/null; then
        since=$(cat "$1/.since" 2>/dev/null) || true
        say "waiting for another $2${since:+ (since $since)}"
        flock_folder
    fi
    { date +%H:%M >"$1/.since"; } 2>/dev/null || true
}
# Fails instead of waiting, and without perl always.
try_lock() {
    exec 9<"$1"
    command -v perl >/dev/null && flock_folder only_try
}
flock_folder() {
    perl -MFcntl=:flock -e \
        'open FOLDER, "<&=9" and flock FOLDER, @ARGV ? LOCK_EX | LOCK_NB : LOCK_EX or exit 1' -- "$@"
}
unlock() { exec 9<&-; }

# Renames a file or folder. Never moves it into an existing folder.
rename() { ! [ -d "$2" ] && mv -f "$1" "$2"; }

# Prints the Python that has the packages of the file `packages`: on Debian /usr/bin/python3, on other
# systems the first python3 on PATH.
system_python() {
    if command -v dpkg-query >/dev/null; then echo /usr/bin/python3; else command -v python3; fi
}

# The program and its Python module are built with the compiler and libraries of the section [build]. This
# lists what a system without dpkg lacks; CMake names missing libraries.
has_tools() {
    lacking=
    for tool in cmake ninja; do command -v $tool >/dev/null || lacking="$lacking\n    $tool"; done
    for compiler in "${CXX-}" c++ g++ clang++ ''; do ! command -v "$compiler" >/dev/null || break; done
    [ -n "$compiler" ] || lacking="$lacking\n    a C++20 compiler"
    [ -n "$lacking" ] || return 0
    say "cannot build. This system has no dpkg, so install these yourself:$(printf "$lacking")"
    say "hint: \`./swirl\` then builds, or: cmake --preset release && cmake --build --preset release"
    return 1
}

# Reports the progress of the build with the log $1 every ten seconds. Ends with this shell, also if that was killed
# and its parent still waits for the end of its output.
report_progress() {
    while sleep 10 >/dev/null 2>&1 && kill -0 $$ 2>/dev/null && ! grep -qs '^State:.Z' /proc/$$/status; do
        # ninja writes "[37/98] Building …".
        step=$(sed -n '/Re-checking/d; s/^\[\([0-9]*\)\/\([0-9]*\)\].*/\1 \2/p' "$1" | tail -n 1)
        [ -z "$step" ] || say "building: ${step% *} of ${step#* }, $((100 * ${step% *} / ${step#* })) %"
    done
}

# is_built PRESET SECTIONS_NEEDED [FOLDERS_WATCHED [TARGETS]]: succeeds if these targets, or all, in build/PRESET are
# newer than their sources and than the packages in these sections.
is_built() {
    stamp="$home/build/$1/.built${4:+ $4}${settings:+ $settings}"
    sources="src track cmake CMakeLists.txt CMakePresets.json packages ${3-}"
    linked=$2
    [ -e "$stamp" ] && [ -z "$(changed_since $sources)" ]
}

# build PRESET SECTIONS_NEEDED [FOLDERS_WATCHED [TARGETS]]
# Builds these targets, or all, in build/PRESET if they are not up to date.
build() {
    ! is_built "$@" || return 0
    case $home in
        *[\"\;\\]*) give_up "cannot build in '$home': CMake does not support \", ; and \\ in the names of folders." ;;
    esac
    folder=$home/build/$1
    mkdir -p "$folder" 2>/dev/null || give_up "cannot write to $home/build, where the program is built."
    require_writable "$folder"
    lock "$folder" build
    # Another process may have built it while this one waited.
    built=yes
    is_built "$@" || (build_now "$@") || built=no
    unlock
    [ $built = yes ] || exit 1
}
# Whether the build failed because of a full disk.
is_full() {
    grep -qs 'No space left on device' "$log" && return
    { printf '%9000s' '' >"$folder/.space"; } 2>/dev/null && rm -f "$folder/.space" && return 1
    rm -f "$folder/.space"
}
no_space() {
    give_up "cannot build: no space is left in '$folder'." "make room on the disk, and repeat the call."
}
build_now() {
    reporter=
    trap '[ -z "$reporter" ] || kill "$reporter" 2>/dev/null' EXIT
    trap 'exit 130' INT
    trap 'exit 143' HUP TERM
    install_packages $2 || exit 1
    command -v dpkg-query >/dev/null || [ -e "$stamp" ] || has_tools || exit 1
    # ninja compares modification times only. A file that was replaced by one with an old date has a newer
    # ctime, so it gets a new date.
    [ ! -e "$stamp" ] || (cd "$home" && find $sources -type f -cnewer "$stamp" ! -newer "$stamp" \
        -exec touch {} + 2>/dev/null) || true
    # Dates in the future were set while the clock was ahead. What was built then is built again.
    find "$folder" -type f -mmin -0 -exec touch -t 200001010000 {} + 2>/dev/null || true
    (cd "$home" && find $sources -type f -mmin -0 -exec touch {} + 2>/dev/null) || true
    [ "$1" != release ] || settings="-DSWIRL_ONLY_WIDEST=ON $settings" # only for this machine
    [ -e "$stamp" ] || say "building $building, only once; this takes $long on two cores"
    log=$folder/build.log
    { touch "$stamp.building" && echo "cmake --preset $1" >"$log"; } 2>/dev/null || no_space
    report_progress "$log" 9<&- &
    reporter=$!
    # A build made elsewhere cannot be continued in a tree that was moved, so it begins from scratch.
    (cd "$home" && { cmake --preset "$1" $settings || cmake --preset "$1" --fresh $settings; } &&
        cmake --build "$folder" ${4:+--target} ${4-}) >>"$log" 2>&1 || built=no
    [ $built = yes ] || ! is_full || no_space
    [ $built = yes ] || { tail -n 40 "$log" >&2 && give_up "the build failed (see above; full log: $log)."; }
    mv "$stamp.building" "$stamp" # dated before the build: later changes are newer
}
