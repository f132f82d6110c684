# What ./swirl and ./check share: install the Debian packages that are missing, and build when the
# sources are newer than the last build. Sourced by both; expects $home, the root of the tree, $me,
# and $long, what a first build takes on two cores. Whoever wants other settings for cmake sets
# $settings afterwards.
#
# Everything said here goes to stderr: stdout belongs to the program (`--json -`).

settings= # not what the environment may have under that name

say() { echo "$me: $*" >&2; }
give_up() {
    say "$*"
    exit 1
}
wrong_call() {
    say "$*"
    exit 2
}

# A word as a shell reads it back.
shell_word() {
    case $1 in
        '' | *[!A-Za-z0-9_+=./:,@%-]*) printf "'%s'" "$(printf %s "$1" | sed "s/'/'\\\\''/g")" ;;
        *) printf %s "$1" ;;
    esac
}

# Gives up if $home/build, or something in "$@" (files and folders in it, which need not exist),
# belongs to somebody else.
require_writable() {
    locked=$home/build
    [ ! -w "$locked" ] || locked=$(find "$@" ! -type l ! -writable -print -quit 2>/dev/null) || true
    [ -n "$locked" ] || return 0
    say "cannot build: '$locked' cannot be written; it belongs to $(stat -c %U "$locked")."
    say "hint: sudo chown -R $(id -u) $(shell_word "$home/build")"
    exit 1
}

# The packages in the given sections of the file `packages`.
listed_packages() {
    for section in "$@"; do
        sed -n "/^\[$section\]/,/^\[/p" "$home/packages" | sed -e 's/#.*//' -e '/^\[/d'
    done
}

# Those of them that are not installed. One call of dpkg-query answers for all.
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

# Installs what is missing of the sections "$@". Without root, or where that fails, it says which
# command would, and fails.
install_packages() {
    command -v dpkg-query >/dev/null || return 0 # not Debian: who needs it will say what it lacks
    missing=$(missing_packages "$@" | sort -u)
    [ -n "$missing" ] || return 0
    # shellcheck disable=SC2116,SC2086
    missing=$(echo $missing) # one line
    if [ "$(id -u)" -ne 0 ]; then
        say "some Debian packages are missing; this installs them:"
        echo "    sudo apt-get install --no-install-recommends $missing" >&2
        return 1
    fi
    log=$home/build/packages.log
    say "installing Debian packages, once: $missing"
    # shellcheck disable=SC2086
    if ! apt_install $missing </dev/null >"$log" 2>&1; then
        # A machine that never asked for them has no lists of packages yet, or old ones.
        if ! apt-get -o DPkg::Lock::Timeout=300 update </dev/null >>"$log" 2>&1 ||
            ! apt_install $missing </dev/null >>"$log" 2>&1; then
            tail -n 15 "$log" >&2
            say "installing the packages failed (see above, all of it in $log); this is the command:"
            echo "    apt-get install --no-install-recommends $missing" >&2
            return 1
        fi
    fi
}

# What a call of the program needs besides the program itself: the packages in the sections "$@".
# Looked for again only when packages were installed or removed since. If they cannot be had, the
# program does what it can without them.
packages_for_this_call() {
    stamp=$home/build/.packages-$(echo "$@" | tr ' ' '-')
    if [ "$stamp" -nt /var/lib/dpkg/status ] && [ "$stamp" -nt "$home/packages" ]; then return 0; fi
    mkdir -p "$home/build" 2>/dev/null || return 0
    if install_packages "$@"; then touch "$stamp" 2>/dev/null || true; fi
}

# Sources, and the packages they are built with, whose status changed since the stamp; ctime, so
# that a file moved here with an old date, or a removed one (its folder changed), counts as well.
changed_since() {
    changed=$(cd "$home" && find src cmake CMakeLists.txt CMakePresets.json packages "$@" \
        -cnewer "$stamp" -print -quit 2>/dev/null) || return 0
    [ -n "$changed" ]
}

# Where the current commit is recorded: it goes into every result.
commit_files() {
    if [ -f "$home/.git" ]; then
        git_folder=$(sed -n 's/^gitdir: //p' "$home/.git")
    else
        git_folder=$home/.git
    fi
    for file in "$git_folder/logs/HEAD" "$git_folder/HEAD" /var/lib/dpkg/status; do
        [ -e "$file" ] && echo "$file"
    done
}

# While the build writes its log $1: how far it is, every ten seconds. Ends with this shell.
report_progress() {
    waited=0
    while sleep 1 >/dev/null 2>&1 && kill -0 $$ 2>/dev/null; do
        waited=$((waited + 1))
        [ $((waited % 10)) -eq 0 ] || continue
        # ninja writes "[37/98] Building …".
        step=$(sed -n 's/^\[\([0-9]*\)\/\([0-9]*\)\].*/\1 \2/p' "$1" | tail -n 1)
        [ -z "$step" ] || say "building: ${step% *} of ${step#* }, $((100 * ${step% *} / ${step#* })) %"
    done
}

# build PRESET SECTIONS_NEEDED [FOLDERS_WATCHED_BESIDES [TARGETS]]
# Returns at once if build/PRESET (of it, those targets) is newer than everything it was made of.
build() {
    folder=$home/build/$1
    stamp="$folder/.built${4:+ $4}${settings:+ $settings}"
    # shellcheck disable=SC2046,SC2086
    if [ -e "$stamp" ] && ! changed_since ${3-} $(commit_files); then return 0; fi

    mkdir -p "$folder" 2>/dev/null || give_up "cannot write to $home/build, where the program is built."
    require_writable "$home/build/.lock" "$folder"
    # One at a time; whoever waited finds the work done.
    exec 9>"$home/build/.lock"
    flock 9
    # shellcheck disable=SC2046,SC2086
    if [ -e "$stamp" ] && ! changed_since ${3-} $(commit_files); then
        exec 9>&-
        return 0
    fi
    # shellcheck disable=SC2086
    install_packages $2 || exit 1
    command -v cmake >/dev/null || give_up "cmake is missing; install it, a C++20 compiler and the libraries listed in $home/packages."
    # A tree that was moved cannot go on with a build made elsewhere.
    if [ -e "$folder/CMakeCache.txt" ] &&
        ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$home" "$folder/CMakeCache.txt"; then
        rm -rf "$folder"
        mkdir -p "$folder"
    fi
    # ninja goes by the date of a file alone; make the date tell.
    if [ -e "$stamp" ]; then
        # shellcheck disable=SC2086
        (cd "$home" && find src cmake CMakeLists.txt ${3-} -type f -cnewer "$stamp" ! -newer "$stamp" \
            -exec touch {} + 2>/dev/null) || true
    fi
    [ -e "$stamp" ] || say "building, once; on two cores this takes $long"
    touch "$stamp.building"
    log=$folder/build.log
    : >"$log"
    report_progress "$log" 9>&- &
    reporter=$!
    built=yes
    # shellcheck disable=SC2086
    (cd "$home" && cmake --preset "$1" $settings) >>"$log" 2>&1 &&
        cmake --build "$folder" ${4:+--target} ${4-} >>"$log" 2>&1 || built=no
    kill "$reporter" 2>/dev/null || true
    if [ $built = no ]; then
        tail -n 40 "$log" >&2
        give_up "the build failed (see above, all of it in $log)."
    fi
    mv "$stamp.building" "$stamp" # dated before the build: what changed meanwhile is newer
    exec 9>&-
}
