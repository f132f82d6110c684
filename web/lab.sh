#!/bin/sh
# `swirl lab`: builds both browser pages if they are out of date, then serves them on this machine or writes them:
# the Laboratory as one self-contained file, or both into a folder. Options of a run set the parameters with which the page starts.
set -eu
home=$(dirname "$(dirname "$(readlink -f "$0")")")
me=swirl
. "$home/cmake/launcher.sh"

usage() {
    cat <<'TEXT'
Interactive simulation in a browser, with the engine of the program.
Usage: swirl lab [OPTIONS] [OPTIONS OF swirl run]

Options:
  -h,--help                       Print this help message and exit
  --port N                        Port of the local server [8720]
  --out FILE.html|FOLDER/         Write the Laboratory, or both pages, instead of serving
  --no-browser                    Do not open a browser
  --quiet                         Print no messages

Parameters of a run, such as --discs and --mu, set the initial state of the page. See swirl help run all.

Examples:
  swirl lab
  swirl lab --discs 40 --mu 0.3
  swirl lab --port 9000 --no-browser
  swirl lab --out laboratory.html
  swirl lab --out web_site/
TEXT
}

# True if the page has this parameter. The length of a run has no meaning there.
is_parameter() {
    case $1 in
        periods | events) return 1 ;;
    esac
    grep -q "^| \`$(printf %s "$1" | tr - _)\` " "$home/docs/reference/parameters.md"
}

given= # NAME=VALUE, one per line
give() {
    case $2 in
        *"$newline"*) usage_error "--$1 contains a line break, but a value must be one line of text." ;;
    esac
    given=$given$(printf %s "$1" | tr - _)=$2$newline
}
newline='
'

port=8720 out= browser=yes quiet=
while [ $# -gt 0 ]; do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --port | --out)
            [ $# -gt 1 ] || usage_error "$1 needs a value." "see \`swirl lab --help\`."
            [ "$1" = --out ] && out=$2 || port=$2
            shift 2
            ;;
        --port=*) port=${1#*=} && shift ;;
        --out=*) out=${1#*=} && shift ;;
        --no-browser) browser=no && shift ;;
        --quiet) quiet=yes && shift ;;
        --)
            [ $# -eq 1 ] || usage_error "unexpected argument '$2'." "see \`swirl lab --help\`."
            break
            ;;
        --*)
            name=${1#--}
            name=$(printf %s "${name%%=*}" | tr _ -)
            is_parameter "$name" || usage_error "there is no option '${1%%=*}'." "see \`swirl lab --help\`."
            case $1 in
                *=*) give "$name" "${1#*=}" && shift ;;
                *)
                    [ $# -gt 1 ] || usage_error "$1 needs a value." "see \`swirl lab --help\`."
                    give "$name" "$2"
                    shift 2
                    ;;
            esac
            ;;
        *) usage_error "there is no option '$1'." "see \`swirl lab --help\`." ;;
    esac
done
case $port in
    '' | *[!0-9]* | ??????*) usage_error "--port is '$port', but it must be a whole number from 1 to 65535." ;;
esac
[ "$port" -ge 1 ] && [ "$port" -le 65535 ] ||
    usage_error "--port is '$port', but it must be a whole number from 1 to 65535."

# A rename would replace a device by a file, and would move the file into a folder.
case $out in
    */) folder=$out ;;
    *) [ -d "$out" ] && folder=$out || folder= ;;
esac
if [ -n "$out" ] && [ -z "$folder" ] && [ -e "$out" ] && ! [ -f "$out" ]; then
    usage_error "--out is '$out', which exists and is not a file." "choose another name."
fi

pages=$home/build/lab
stamp=$home/build/.built-page
# The date of the stamp is that of the beginning of the last complete build (cmake/launcher.sh).
is_page_built() {
    [ -e "$pages/index.html" ] && [ -e "$pages/laboratory.html" ] && [ -e "$stamp" ] || return 1
    newer=$(cd "$home" && find src/swirl/math src/swirl/physics src/swirl/engine src/swirl/statistics \
        src/swirl/measure src/swirl/io src/swirl/run bindings/wasm web -path web/node_modules -prune -o \
        -path web/generated -prune -o -path web/test -prune -o \
        -newer "$stamp" ! -mmin -0 -type f -print 2>/dev/null | head -n 1)
    [ -z "$newer" ] && [ -z "$(find "$stamp" -mmin -0)" ]
}
build_page() {
    mkdir -p "$home/build/wasm" 2>/dev/null || give_up "cannot write to the build folder $home/build."
    lock "$home/build/wasm" build
    ! is_page_built || return 0 # by another process, or another user
    [ -w "$home/build" ] || give_up "cannot write to the build folder $home/build."
    require_writable "$stamp" "$home/build/lab.log" "$home/build/lab" "$home/build/wasm" "$home/web/generated"
    install_packages lab || exit 1
    command -v npm >/dev/null || install_packages npm || exit 1
    log=$home/build/lab.log
    say "building the page; this takes about a minute on two cores"
    touch "$stamp.building" 2>/dev/null || give_up "the page could not be built: no space is left in $home/build."
    # Not npm ci, which requires the packages of all platforms: some mirrors of the registry lack those.
    # The versions are those of the lock file in both cases, and no package needs its scripts.
    if ! {
        # In a tree that was moved, the build begins from scratch.
        { cmake -S "$home/bindings/wasm" -B "$home/build/wasm" -G Ninja ||
            cmake --fresh -S "$home/bindings/wasm" -B "$home/build/wasm" -G Ninja; } &&
            cmake --build "$home/build/wasm" &&
            mkdir -p "$home/web/generated" &&
            zopfli -c "$home/build/wasm/swirl.wasm" >"$home/web/generated/swirl.wasm.gz" &&
            zopfli -c "$home/build/wasm/dish.wasm" >"$home/web/generated/dish.wasm.gz" &&
            (cd "$home/web" && npm install --ignore-scripts --no-audit --no-fund --no-save && npm run build)
    } >"$log" 2>&1; then
        tail -n 30 "$log" >&2
        give_up "the page could not be built (see above; full log: $log)."
    fi
    mv "$stamp.building" "$stamp"
}
is_page_built || build_page
unlock

query=
if [ -n "$given" ]; then
    oldifs=$IFS
    IFS=$newline
    set -f
    # shellcheck disable=SC2086
    query=$(node "$home/web/start.mjs" "$home/build/wasm/swirl.wasm" $given) || exit 2
    set +f
    IFS=$oldifs
fi

# Writes a built page with the parameters in it. A page that is alone has no link to the other one.
# write_page NAME FILE
write_page() {
    temporary=$(mktemp "$2.partial.XXXXXX" 2>/dev/null) || give_up "'$2' cannot be written."
    chmod "$(printf %o $((0666 & ~0$(umask))))" "$temporary"
    {
        if [ -z "$query" ]; then cat "$pages/$1"; else node "$home/web/start.mjs" --page "$pages/$1" "$query"; fi |
            if [ -n "$folder" ]; then cat; else sed 's|<a id="to-dish".*</a>||'; fi >"$temporary"
    } 2>/dev/null && sync "$temporary" && rename "$temporary" "$2" || give_up "'$2' cannot be written."
    [ -n "$quiet" ] || say "wrote $2"
}
if [ -n "$out" ]; then
    temporary=
    trap '[ -z "$temporary" ] || rm -f "$temporary"' EXIT
    trap 'exit 130' INT
    trap 'exit 143' HUP TERM
    if [ -z "$folder" ]; then
        write_page laboratory.html "$out"
    else
        mkdir -p "$folder" 2>/dev/null || give_up "'$folder' cannot be written."
        write_page index.html "${folder%/}/index.html"
        write_page laboratory.html "${folder%/}/laboratory.html"
    fi
    exit 0
fi
exec node "$home/web/serve.mjs" "$pages" "$port" "$browser" "$query"
