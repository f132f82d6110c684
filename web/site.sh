#!/bin/sh
# The site: README and docs as pages, the laboratory, the help of every command, in one folder that
# any web server, or none, can show.
set -eu
home=$(dirname "$(dirname "$(readlink -f "$0")")")
me=swirl
. "$home/cmake/launcher.sh"

usage() {
    cat <<'TEXT'
The site: documentation, the laboratory and the commands' help as pages in one folder.
Usage: swirl site --out DIR [--report DIR]

Options:
  -h,--help                       Print this help message and exit
  --out DIR                       the folder to write; a site that is there is replaced
  --report DIR                    put in what swirl paper wrote to DIR

Examples:
  swirl site --out site
  swirl paper --out results && swirl site --out site --report results
TEXT
}
out= report=
while [ $# -gt 0 ]; do
    case $1 in
        -h | --help) usage && exit 0 ;;
        --out | --report)
            [ $# -gt 1 ] && [ -n "$2" ] || wrong_call "$1 needs a value; swirl site --help has examples."
            [ "$1" = --out ] && out=$2 || report=$2
            shift 2
            ;;
        --out=*) out=${1#*=} && shift ;;
        --report=*) report=${1#*=} && shift ;;
        --)
            [ $# -eq 1 ] || wrong_call "There is no use for '$2' of swirl site."
            break
            ;;
        *) wrong_call "There is no option '$1' of swirl site; --out and --report are all." ;;
    esac
done
[ -n "$out" ] || wrong_call "swirl site needs --out DIR: the folder to write."
if [ -n "$report" ] && ! [ -e "$report/report.html" ]; then
    wrong_call "--report is '$report', but there is no report.html in it; swirl paper writes one."
fi
# Only a site of ours is replaced.
if [ -e "$out" ] && ! [ -e "$out/.swirl-site" ] && [ -n "$(ls -A "$out" 2>/dev/null || echo no folder)" ]; then
    wrong_call "--out is '$out', which is not empty and not a site; another name would be right."
fi

# Made in a folder beside it, which is locked for as long. What a kill left has no lock; if it came
# between the two names at the end, the site of before is in there, and goes back to its place.
out=${out%"${out##*[!/]}"} # without a slash at its end
for left in "$out".??????.partial; do
    [ -e "$left/lock" ] && flock --nonblock "$left/lock" true || continue
    [ -e "$out" ] || ! [ -e "$left/before" ] || mv -T "$left/before" "$out"
    rm -rf "$left"
done
mkdir -p "$(dirname "$out")" 2>/dev/null &&
    beside=$(mktemp -d --suffix=.partial "$out.XXXXXX" 2>/dev/null) || give_up "'$out' cannot be written."
trap 'rm -rf "$beside"' EXIT
trap 'exit 130' INT
trap 'exit 143' HUP TERM
exec 8>"$beside/lock"
flock 8
aside=$beside/site
mkdir -p "$aside/.help"
"$home/web/lab.sh" --quiet --out "$aside/lab.html"
program=${SWIRL-$home/swirl}
"$program" --help >"$aside/.help/swirl.txt"
for command in $(sed -n '/^Subcommands:/,/^$/s/^  \([a-z][a-z-]*\).*/\1/p' "$aside/.help/swirl.txt"); do
    "$program" "$command" --help >"$aside/.help/$command.txt"
done
for command in lab site; do
    "$home/web/$command.sh" --help >"$aside/.help/$command.txt"
done
mkdir "$aside/gallery"
install_packages images movies || true # what cannot be made without them is not shown
# shellcheck disable=SC2016
sed -n '/ | docs\//!s/^[^#].* | swirl //p' "$home/web/gallery.txt" | (
    cd "$aside/gallery"
    while read -r made; do
        # The file is ours, and its commands have quoted nothing.
        # shellcheck disable=SC2086
        "$program" $made --quiet 2>/dev/null || say "without an image in the gallery: swirl $made"
    done
)
mkdir "$aside/.notebooks"
python=${SWIRL_PYTHON-$home/bindings/python/python.sh}
# The first call builds the module where that is needed, and tells of it.
if ! install_packages notebooks || ! "$python" -P -c "import swirl, nbclient"; then
    say "the notebooks are shown without what they print."
elif ! "$python" "$home/web/notebooks.py" "$aside/.notebooks" "$home"/examples/*.ipynb 2>"$aside/.log"; then
    tail -n 5 "$aside/.log" >&2
    give_up "the notebooks of examples/ could not be run (see above)."
fi
node "$home/web/site.mjs" "$home" "$aside" "$aside/.help" "$aside/.notebooks" ${report:+"$report"} >"$aside/.log" 2>&1 || {
    tail -n 5 "$aside/.log" >&2
    give_up "the site could not be made (see above)."
}
pages=$(cat "$aside/.log")
rm -rf "$aside/.help" "$aside/.notebooks" "$aside/.log"
touch "$aside/.swirl-site"
trap '' INT HUP TERM # two names: either both or none
if [ -e "$out" ]; then
    mv -T "$out" "$beside/before" || give_up "'$out' cannot be replaced."
fi
mv -T "$aside" "$out" || {
    ! [ -e "$beside/before" ] || mv -T "$beside/before" "$out"
    give_up "'$out' cannot be written."
}
say "wrote $out/index.html and what belongs to it, $pages"
