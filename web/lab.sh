#!/bin/sh
# The laboratory in the browser: builds it when it is out of date, then serves it on this machine, or
# writes it as one file that needs nothing else.
set -eu
home=$(dirname "$(dirname "$(readlink -f "$0")")")
me=swirl
. "$home/cmake/launcher.sh"

usage() {
    cat <<'TEXT'
The laboratory in a browser: the same engine, to look at and to play with.
Usage: swirl lab [OPTIONS]

Options:
  -h,--help                       Print this help message and exit
  --port N                        serve it here [8720]
  --out FILE.html                 write one file that works by double click, without a network, instead
  --no-browser                    do not open a browser
  --quiet                         do not say what was written

Examples:
  swirl lab
  swirl lab --port 9000 --no-browser
  swirl lab --out laboratory.html
TEXT
}

port=8720 out= browser=yes quiet=
while [ $# -gt 0 ]; do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --port | --out)
            [ $# -gt 1 ] || wrong_call "$1 needs a value; swirl lab --help has examples."
            [ "$1" = --out ] && out=$2 || port=$2
            shift 2
            ;;
        --port=*) port=${1#*=} && shift ;;
        --out=*) out=${1#*=} && shift ;;
        --no-browser) browser=no && shift ;;
        --quiet) quiet=yes && shift ;;
        --)
            [ $# -eq 1 ] || wrong_call "There is no use for '$2' of swirl lab."
            break
            ;;
        *) wrong_call "There is no option '$1' of swirl lab; --port, --out, --no-browser and --quiet are all." ;;
    esac
done
case $port in
    '' | *[!0-9]* | ??????*) wrong_call "--port is '$port', but it must be a whole number from 1 to 65535." ;;
esac
[ "$port" -ge 1 ] && [ "$port" -le 65535 ] ||
    wrong_call "--port is '$port', but it must be a whole number from 1 to 65535."

# What takes the place of a device is a file for good, and in a folder it would have another name.
if [ -n "$out" ] && [ -e "$out" ] && ! [ -f "$out" ]; then
    wrong_call "--out is '$out', which is there and is no file; another name would be right."
fi

page=$home/build/lab/index.html
build_page() {
    mkdir -p "$home/build" 2>/dev/null || give_up "cannot write to $home/build, where the page is built."
    # Opened for reading: a page that is up to date may belong to another user.
    lock=$home/build/.lab.lock
    [ -e "$lock" ] || true 2>/dev/null >"$lock" || give_up "cannot write to $home/build, where the page is built."
    exec 9<"$lock"
    flock 9
    # shellcheck disable=SC2086
    changed=$(cd "$home" && find src/swirl/math src/swirl/physics src/swirl/engine src/swirl/statistics src/swirl/measure src/swirl/run bindings/wasm web \
        -path web/node_modules -prune -o -path web/generated -prune -o -newer "$page" -type f -print \
        -quit 2>/dev/null || true)
    if [ -e "$page" ] && [ -z "$changed" ]; then return 0; fi
    require_writable "$home/build/lab.log" "$home/build/lab" "$home/build/wasm" "$home/web/generated"
    install_packages lab || exit 1
    command -v npm >/dev/null || install_packages npm || exit 1
    log=$home/build/lab.log
    say "building the page, once; on two cores this takes two minutes or so"
    # Not npm ci: it wants packages for all the machines that a tool could run on, and registries that
    # mirror the common ones do not have them. The versions are those of the lock file either way.
    if ! {
        cmake -S "$home/bindings/wasm" -B "$home/build/wasm" -G Ninja &&
            cmake --build "$home/build/wasm" &&
            mkdir -p "$home/web/generated" &&
            zopfli -c "$home/build/wasm/swirl.wasm" >"$home/web/generated/swirl.wasm.gz" &&
            cd "$home/web" && npm install --no-audit --no-fund --no-save && npm run build
    } >"$log" 2>&1; then
        tail -n 30 "$log" >&2
        give_up "the page could not be built (see above, all of it in $log)."
    fi
}
build_page
exec 9>&-

if [ -n "$out" ]; then
    aside=$(mktemp --suffix=.partial "$out.XXXXXX" 2>/dev/null) || give_up "'$out' cannot be written."
    trap 'rm -f "$aside"' EXIT
    trap 'exit 130' INT
    trap 'exit 143' HUP TERM
    chmod "$(printf %o $((0666 & ~0$(umask))))" "$aside"
    cp "$page" "$aside" 2>/dev/null && sync "$aside" && mv -T "$aside" "$out" ||
        give_up "'$out' cannot be written."
    [ -n "$quiet" ] || say "wrote $out"
    exit 0
fi
exec node "$home/web/serve.mjs" "$page" "$port" "$browser"
