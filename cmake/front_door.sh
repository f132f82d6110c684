# What ./swirl and ./check share: install the Debian packages that are missing, and build when the
# sources are newer than the last build. Sourced by both; expects $home, the root of the tree.
#
# Everything said here goes to stderr: stdout belongs to the program (`--json -`).

say() { echo "$me: $*" >&2; }
give_up() {
    say "$*"
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

# Installs what is missing of the sections $1 (needed) and $2 (good to have).
install_packages() {
    command -v dpkg-query >/dev/null || return 0 # not Debian: the build will say what it lacks
    # shellcheck disable=SC2086
    needed=$(missing_packages $1)
    # shellcheck disable=SC2086
    all=$(missing_packages $1 $2)
    [ -n "$all" ] || return 0
    # shellcheck disable=SC2116,SC2086
    all=$(echo $all) # one line
    if [ "$(id -u)" -ne 0 ]; then
        [ -n "$needed" ] || return 0
        say "some Debian packages are missing; install them and try again:"
        echo "    sudo apt-get install --no-install-recommends $all" >&2
        exit 1
    fi
    log=$home/build/packages.log
    say "installing Debian packages, once: $all"
    # shellcheck disable=SC2086
    if ! apt_install $all </dev/null >"$log" 2>&1; then
        # A machine that never asked for them has no lists of packages yet, or old ones.
        if ! apt-get -o DPkg::Lock::Timeout=300 update </dev/null >>"$log" 2>&1 ||
            ! apt_install $all </dev/null >>"$log" 2>&1; then
            tail -n 15 "$log" >&2
            give_up "installing the packages failed (see above, all of it in $log); this is the" \
                "command: apt-get install --no-install-recommends $all"
        fi
    fi
}

# Sources, and the packages they are built with, whose status changed since the stamp; ctime, so
# that a file moved here with an old date, or a removed one (its folder changed), counts as well.
changed_since() {
    changed=$(cd "$home" && find src include cmake CMakeLists.txt CMakePresets.json packages "$@" \
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

# build PRESET SECTIONS_NEEDED SECTIONS_GOOD_TO_HAVE [FOLDERS_WATCHED_BESIDES [TARGETS]]
# Returns at once if build/PRESET is newer than everything it was made of.
build() {
    folder=$home/build/$1
    stamp=$folder/.built
    # shellcheck disable=SC2046,SC2086
    if [ -e "$stamp" ] && ! changed_since ${4-} $(commit_files); then return 0; fi

    mkdir -p "$folder" 2>/dev/null || give_up "cannot write to $home/build, where the program is built."
    # One at a time; whoever waited finds the work done.
    exec 9>"$home/build/.lock"
    flock 9
    # shellcheck disable=SC2046,SC2086
    if [ -e "$stamp" ] && ! changed_since ${4-} $(commit_files); then
        exec 9>&-
        return 0
    fi
    install_packages "$2" "$3"
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
        (cd "$home" && find src include cmake CMakeLists.txt ${4-} -type f -cnewer "$stamp" ! -newer "$stamp" \
            -exec touch {} + 2>/dev/null) || true
    fi
    [ -e "$stamp" ] || say "building, once; this takes a minute or two"
    touch "$folder/.building"
    log=$folder/build.log
    # shellcheck disable=SC2086
    if ! (cd "$home" && cmake --preset "$1") >"$log" 2>&1 ||
        ! cmake --build "$folder" ${5:+--target} ${5-} >>"$log" 2>&1; then
        tail -n 40 "$log" >&2
        give_up "the build failed (see above, all of it in $log)."
    fi
    mv "$folder/.building" "$stamp" # dated before the build: what changed meanwhile is newer
    exec 9>&-
}
